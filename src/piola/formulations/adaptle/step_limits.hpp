// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/parallel.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/math/tensor.hpp"

namespace piola::adaptle::inline PIOLA_MACHINE {

/// Share of a volume, or of a spacing between bodies, that a step may take: with 0.1 the error in time of an impact at
/// several km/s shows in the fourth digit of its energy.
inline constexpr double largest_change = 0.07;

/// The stable step of the particles of a block: CFL h / c with the current speed of sound, the compressed length of
/// material pairs and the quadratic viscosity; 0.25 sqrt(h / |a|); 0.5 sqrt(m / k) of contacts; no volume changes and
/// no two bodies close by more than `largest_change`, of itself or of a spacing, in a step. What it asks of each
/// particle is put aside, so that roots and quotients are those of whole lanes.
class StepLimits {
 public:
  /// F_inverse: of half time; null: nothing is compressed. length [m]: h at rest. speed [m/s]: of sound and viscosity.
  /// rate [1/s]: of volume, or at which bodies close.
  PIOLA_FN void add(Mat<3> const* F_inverse, double length, double speed, double const* a, double mass,
                    double stiffness, double rate) {
    Index const k = count_++;
    size_[k] = 1;
    spread_[k] = 0;
    if (F_inverse != nullptr) measure(*F_inverse, size_[k], spread_[k]);
    length_[k] = length;
    speed_[k] = speed;
    acceleration_[k] = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    mass_[k] = mass;
    stiffness_[k] = stiffness;
    rate_[k] = rate;
  }

  /// The shortest of all [s]. What is not a number is found elsewhere.
  PIOLA_FN double shortest(double cfl, double h) {
    constexpr double unit[3]{}, never = 1e300;
    while (count_ % lane_count != 0) add(nullptr, never, 1, unit, 1, 0, 0);
    Lanes least(never);
    for (Index k = 0; k < count_; k += lane_count) {
      Lanes const square = load<Lanes>(size_ + k) + 2.0 * square_root(load<Lanes>(spread_ + k) / 6.0);
      Lanes const length = load<Lanes>(length_ + k) / square_root(select(square > 1.0, square, Lanes(1.0)));
      Lanes step = cfl * length / load<Lanes>(speed_ + k);
      Lanes const a = square_root(load<Lanes>(acceleration_ + k));
      step = shorter(step, select(a > 0.0, 0.25 * square_root(h / a), Lanes(never)));
      Lanes const stiffness = load<Lanes>(stiffness_ + k);
      step =
          shorter(step, select(stiffness > 0.0, 0.5 * square_root(load<Lanes>(mass_ + k) / stiffness), Lanes(never)));
      Lanes const rate = load<Lanes>(rate_ + k);
      least = shorter(least, select(rate * step > largest_change, largest_change / rate, step));
    }
    double shortest = never;
    for (int l = 0; l < lane_count; ++l) shortest = lane(least, l) < shortest ? lane(least, l) : shortest;
    return shortest;
  }

 private:
  PIOLA_FN static Lanes shorter(Lanes const& a, Lanes const& b) { return select(b < a, b, a); }

  /// The largest eigenvalue of A A^T, or a little more, is q + 2 p with q = tr/3 and p^2 = B:B/6 of the rest.
  PIOLA_FN static void measure(Mat<3> const& A, double& q, double& B) {
    q = 0;
    for (double const a : A.c) q += a * a / 3;
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b) {
        double sum = a == b ? -q : 0;
        for (int k = 0; k < 3; ++k) sum += A(a, k) * A(b, k);
        B += (a == b ? 1 : 2) * sum * sum;
      }
  }

  static constexpr int most = exec::block_size;
  double size_[most], spread_[most], length_[most], speed_[most], acceleration_[most], mass_[most], stiffness_[most],
      rate_[most];
  Index count_ = 0;
};

}  // namespace piola::adaptle::inline PIOLA_MACHINE
