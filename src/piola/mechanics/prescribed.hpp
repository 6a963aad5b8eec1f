// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/mechanics/support.hpp"
#include <array>
#include <limits>
#include <optional>
#include <vector>

/// Evaluation of supports and loads.
namespace piola {

using Direction = std::array<double, 3>;

/// Whether a slot is local; `own` empty: all are.
inline bool is_local(std::optional<Range> const& own, Index slot) {
  return !own || (slot >= own->first && slot < own->last);
}

/// Whether `until` is reached, up to the round-off of a sum of many steps.
bool has_ended(double until, double time);

/// The next time after `time` at which one of these supports and loads ends; infinity if there is none.
template <class... Lists>
double next_end_time(double time, Lists const&... lists) {
  double next = std::numeric_limits<double>::infinity();
  auto const consider = [&](auto const& list) {
    for (auto const& item : list)
      if (!has_ended(item.until, time) && item.until < next) next = item.until;
  };
  (consider(lists), ...);
  return next;
}

/// None of the formulas depends on time.
bool is_steady(std::array<Expression, 3> const& formulas);

double dot(Direction const& a, Direction const& b);

/// Removes the components along the unit vectors `to` from d and normalises the rest. Returns false if nothing remains.
bool make_orthogonal(Direction& d, std::vector<Direction> const& to);

/// The directions that a support (Support or SupportSpec) holds, in a body of D dimensions; exact axes for directions
/// along an axis.
std::vector<Direction> directions_of(Support::Frame frame, std::array<bool, 3> const& fix, Direction normal, int D);
template <class Held>
std::vector<Direction> directions_of(Held const& support, int D) {
  return directions_of(support.frame, support.fix, support.normal, D);
}

/// One of the orthonormal directions in which a particle is held, computed from the requested directions.
struct PrescribedAxis {
  Direction direction;
  std::size_t row;               ///< first row that requests it
  std::array<double, 3> weight;  ///< its speed is the sum of weight[k] times the speed of row of[k]
  std::array<std::size_t, 3> of;
  std::size_t count;

  /// The speed along it, with speed_of(row) [m/s].
  template <class F>
  double speed(F const& speed_of) const {
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += weight[k] * speed_of(of[k]);
    return sum;
  }
};

/// Orthonormalises the rows in order. If two rows request different speeds in one direction, the first applies.
std::vector<PrescribedAxis> hold_along(std::vector<Direction> const& rows);

/// Prescribed speed along d of the particle with reference position X [m/s].
double speed_along(std::array<Expression, 3> const& velocity, Direction const& d, std::array<double, 3> const& X,
                   double time);

/// The acceleration factor * value at X, or factor * (-value[0] normal) by a pressure [m/s2].
Direction acceleration_by(std::array<Expression, 3> const& value, std::optional<Direction> const& normal, double factor,
                          std::array<double, 3> const& X, double time);

/// Returns dt, or less, so that a step ends after `rest` [s], at the end of a support or a load; otherwise the impulse
/// of loads would depend on the step. The last steps before are equal, so that none is tiny.
double clip_step_to_end_time(double dt, double rest);

}  // namespace piola
