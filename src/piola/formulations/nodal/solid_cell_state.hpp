// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/math/embedding.hpp"
#include "piola/math/scalar.hpp"

namespace piola::nodal::inline PIOLA_BACKEND {

/// State of a group of cells of solids in rate form at one instant, one cell per lane.
template <int D>
struct SolidCellState {
  static constexpr int points = Quadratic<D>::points;

  Mat<3, Lanes> F[points];
  SymMat<3, Lanes> S[points];
  Lanes spread[points];  ///< tension of a point over that of the cell [Pa]
  Lanes pressure;        ///< of the cell, positive in compression [Pa]
  Lanes shock_pressure;  ///< viscous, of the cell [Pa]
  Lanes energy;          ///< specific internal energy [J/kg]
  // Cells that may fail have these values, too, see FailureLayout.
  Lanes condition, softening, volume_factor, toughness;
  Lanes carried;  ///< share of tension and shear that the gradients of the cell carry, 0 for cells that are not intact

  PIOLA_FN auto is_intact() const { return condition < 0.5; }
};

/// Reads and stores the state of cells in the field `history`.
template <int D>
class SolidCellHistory {
 public:
  using Cell = SolidCellState<D>;
  static constexpr int points = Cell::points;

  PIOLA_FN explicit SolidCellHistory(BodyState const& body)
      : fails_(body.has.failure),
        least_resting_(body.has.converts ? 0.5 : 1.5),
        in_(read(body.history)),
        out_(write(body.history)) {}

  PIOLA_FN bool fails() const { return fails_; }
  /// Whether gradients are without use for a cell, which is at rest in its reference shape: detached or Eulerian.
  PIOLA_FN auto rests(Lanes const& condition) const { return condition > least_resting_; }
  PIOLA_FN auto rests(Index i) const { return rests(of_failure(i, FailureLayout::condition)); }
  PIOLA_FN bool rests_at(Index i) const { return of_failure_at(i, FailureLayout::condition) > least_resting_; }
  PIOLA_FN Lanes of_failure(Index i, int of) const {
    return in_.template scalar<Lanes>(i, Fields::failure_value(of, D));
  }
  PIOLA_FN double of_failure_at(Index i, int of) const {
    return in_.template scalar<double>(i, Fields::failure_value(of, D));
  }
  PIOLA_FN double value(Index i, int c) const { return in_.template scalar<double>(i, c); }
  PIOLA_FN void put(Index i, double now, int c) const { out_.scalar(i, now, c); }
  PIOLA_FN void put_of_failure(Index i, double now, int of) const { put(i, now, Fields::failure_value(of, D)); }

  /// The state at the end of the last step.
  PIOLA_FN Cell operator()(Index i) const {
    auto const number = [&](int c) { return in_.template scalar<Lanes>(i, c); };
    Cell cell;
    cell.pressure = number(HistoryLayout::pressure);
    cell.shock_pressure = number(HistoryLayout::shock_pressure);
    cell.energy = number(HistoryLayout::energy);
    if (fails_) {
      cell.condition = of_failure(i, FailureLayout::condition);
      cell.softening = of_failure(i, FailureLayout::softening);
      cell.volume_factor = of_failure(i, FailureLayout::volume_factor);
      cell.toughness = of_failure(i, FailureLayout::toughness);
      cell.carried = select(cell.is_intact(), Lanes(1.0 - cell.softening), Lanes(0.0));
    }
    for (int q = 0; q < points; ++q) {
      int const at = HistoryLayout::point(q, D);
      cell.spread[q] = number(at + HistoryLayout::spread);
      for (int c = 0; c < 6; ++c) cell.S[q].c[c] = number(at + HistoryLayout::S + c);
      Mat<D, Lanes> F;
      for (int c = 0; c < D * D; ++c) F.c[c] = number(at + HistoryLayout::F + c);
      cell.F[q] = embed<D>(F);
      if constexpr (D == 2) cell.F[q](2, 2) = number(at + HistoryLayout::F + D * D);
    }
    return cell;
  }
  /// Stores the state of the cells whose entry in `mine` is not 0, except what the yield surface and softening store.
  PIOLA_FN void put(Index i, Cell const& cell, double const (&mine)[lane_count]) const {
    auto const stored = load<Lanes>(mine) > 0.5;
    auto const put_lanes = [&](Lanes const& now, int c) {
      out_.scalar(i, select(stored, now, in_.template scalar<Lanes>(i, c)), c);
    };
    put_lanes(cell.pressure, HistoryLayout::pressure);
    put_lanes(cell.energy, HistoryLayout::energy);
    put_lanes(cell.shock_pressure, HistoryLayout::shock_pressure);
    for (int q = 0; q < points; ++q) {
      int const at = HistoryLayout::point(q, D);
      put_lanes(cell.spread[q], at + HistoryLayout::spread);
      for (int c = 0; c < 6; ++c) put_lanes(cell.S[q].c[c], at + HistoryLayout::S + c);
      for (int c = 0; c < D * D; ++c) put_lanes(cell.F[q](c / D, c % D), at + HistoryLayout::F + c);
      if constexpr (D == 2) put_lanes(cell.F[q](2, 2), at + HistoryLayout::F + D * D);
    }
  }

 private:
  bool fails_;  ///< cells may fail
  double least_resting_;
  View in_;
  WriteView out_;
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
