// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/state.hpp"
#include <array>
#include <span>
#include <vector>

namespace piola::adaptle {

/// Changes of gradients near the axis, with which a uniform stress leaves no radial force on the particles there, and a
/// gradient of the stress along the axis accelerates all alike (docs/theory/adaptle.md, "Axisymmetric bodies"). The
/// volumes of rings, weights of their stress, have a kink on the axis. The constructor throws InputError if they cannot
/// be found.
class AxisCorrection {
 public:
  /// Sums over reference neighbours, of which those beyond `particles` are images behind the axis.
  struct Sums {
    Index particles;
    std::span<Offset const> begin;  ///< per slot, one more at the end
    std::span<Index const> neighbour;
    std::span<double const> s;       ///< per pair: -W'(r)/r
    std::span<double const> radial;  ///< per pair: A0_b G_ab along the radius
    std::span<double const> axial;   ///< per pair: A0_b G_ab along the axis
    Fields const& fields;
  };
  /// Particles of one body.
  struct Body {
    Range slots;
    double spacing, own_weight;  ///< own_weight: s(0.6 h)
  };

  AxisCorrection() = default;
  AxisCorrection(Sums const& sums, std::span<Body const> bodies);

  AxisCorrectionTable view() const;
  std::size_t bytes() const;

 private:
  /// The weighted linear fit through the neighbours of a particle and itself: inverse of its moments, symmetric, for 1,
  /// R and Z in spacings.
  using Fit = std::array<double, 6>;

  void set_fits(Sums const& sums);
  void set_residuals(Sums const& sums);
  bool is_on_axis(Sums const& sums, Index a) const;
  double weight(Sums const& sums, Index a) const;
  bool is_complete(Sums const& sums, Index a) const;
  std::array<double, 3> fitted(Sums const& sums, Index a, std::span<double const> mu) const;
  /// The change of the gradient of particle a at its pair k.
  double change(Sums const& sums, Index a, Offset k, std::span<double const> mu,
                std::array<double, 3> const& fit) const;
  std::vector<double> radial_changes(Sums const& sums, std::span<double const> mu);
  void add_axial_changes(Sums const& sums, Index a, std::vector<double>& to) const;
  double circle_ratio(Sums const& sums, Index a, Offset k) const;
  void apply(Sums const& sums, std::span<double const> mu, std::vector<double>& to) const;
  std::vector<double> solve(Sums const& sums);
  void store(Sums const& sums, std::array<std::vector<double>, 2> const& changes);
  template <class F>
  void each_particle(F const& f) const {
    for (Body const& body : bodies_)
      for (Index a = body.slots.first; a < body.slots.last; ++a) f(a, body);
  }

  std::vector<Body> bodies_;
  std::vector<Fit> fits_;                   ///< per slot
  std::vector<double> residual_, spacing_;  ///< per slot
  std::vector<double> own_weight_;
  std::vector<std::uint8_t> closed_;  ///< per slot: whether its residual is removed
  std::vector<Offset> begin_;
  std::vector<Index> neighbour_;
  std::vector<AxisChange> change_;
};

}  // namespace piola::adaptle
