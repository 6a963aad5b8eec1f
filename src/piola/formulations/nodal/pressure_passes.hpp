// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/stress_resultants.hpp"
#include "piola/materials/laws.hpp"
#include "piola/math/embedding.hpp"

/// Sweeps for a pressure that is solved for: the derivative of the volume ratios of cells by the positions, and its
/// transpose. Theory: docs/theory/nodal.md, section 5.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Mean volume ratio of a cell, and the resultants of a unit pressure, which are its derivative by F and H.
template <int D, bool SmallStrain>
struct LinearisePressure {
  static constexpr int points = Quadratic<D>::points, numbers = MotionSums<D>::numbers;
  StressResultants<D> resultants;
  View offset;
  WriteView unit, ratio;

  PIOLA_INLINE_FN void operator()(Index i, exec::Scratch const& in) const {
    CellPoints<D> at = cell_points<D>(resultants.L, false, i, in);
    if (offset.data != nullptr) at.F = at.F + offset.matrix<D, Lanes>(i);
    Mat<3, Lanes> area[points];
    Lanes mean = Lanes(0.0);
    for (int q = 0; q < points; ++q) {
      Mat<3, Lanes> const F = embed<D>(at.at(q));
      mean = mean + (1.0 / points) * volume_ratio_of(SmallStrain, F);
      if constexpr (SmallStrain)
        area[q] = identity<3, Lanes>();
      else
        area[q] = cofactor(F);
    }
    ratio.scalar(i, mean, 0);
    Lanes rows[D][numbers];
    resultants.rows_of(i, area, rows);
    for (int c = 0; c < D; ++c)
      for (int n = 0; n < numbers; ++n) unit.scalar(i, rows[c][n], c * numbers + n);
  }
};

/// The change of the volume ratios by the vectors that the sums were taken of.
template <int D>
struct ChangeOfRatio {
  static constexpr int numbers = MotionSums<D>::numbers;
  View unit;
  WriteView ratio;

  PIOLA_INLINE_FN void operator()(Index i, exec::Scratch const& in) const {
    LanesOfField const rows = lanes_of(unit, i);
    Lanes sum = Lanes(0.0);
    for (int n = 0; n < D * numbers; ++n) sum = sum + rows[n] * load<Lanes>(in.at(i, n));
    ratio.scalar(i, sum, 0);
  }
};

/// The resultants of the pressures in `ratio`.
template <int D>
struct StressOfPressure {
  static constexpr int numbers = MotionSums<D>::numbers;
  StressResultants<D> resultants;
  View unit, pressure;

  PIOLA_INLINE_FN void operator()(Index i) const {
    LanesOfField const of_unit = lanes_of(unit, i);
    Lanes const p = pressure.scalar<Lanes>(i);
    Lanes rows[D][numbers];
    for (int c = 0; c < D; ++c)
      for (int n = 0; n < numbers; ++n) rows[c][n] = p * of_unit[c * numbers + n];
    Lanes const no_hoop[3]{};
    resultants.put(i, rows, no_hoop);
  }
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
