// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/kernels/registry.hpp"
#include "piola/math/envelope_cholesky.hpp"
#include "piola/mechanics/resultants.hpp"
#include <array>
#include <span>
#include <vector>

namespace piola::jst_sph {

/// The particles of a body for an interpolation.
struct Cloud {
  int dimension = 3;
  std::vector<std::array<double, 3>> X;  ///< per slot [m]
  std::vector<double> volume;            ///< tributary, per slot [m^D]
  Kernel const* kernel = nullptr;
  double h = 0;  ///< smoothing length of the interpolation [m]
};

/// Exact boundary values by Lagrange multipliers (Lee et al. 2016, Appendix B): the velocity v~ nearest to v, in the
/// norm sum V |v~ - v|^2, for which
///   sum_a w_a(X_B) v~_a . d = prescribed       for every held direction d of every supported particle B,
///   sum V v~ = sum V v,  sum V x cross v~ = sum V x cross v       over the particles within reach of these,
/// with w_a(X_B) the linearly corrected kernel. Theory: docs/theory/boundaries.md.
class Multipliers {
 public:
  Multipliers(std::span<PrescribedDirection const> held, Cloud const& cloud);

  /// Corrects the velocity of the body, or the acceleration that leads to it. Collective on a distributed body.
  void enforce(BodyState& body, MultiplierCall const& call);
  /// Impulses of the corrections since their last reset, by support; those of a particle count for the support of the
  /// held particle with the largest weight there. Their sum vanishes unless the rows prescribe a rigid motion.
  std::vector<Impulse> const& impulses() const { return impulses_; }
  void reset_impulses() { impulses_.assign(impulses_.size(), {}); }
  std::size_t bytes() const;

 private:
  using Point = std::array<double, 3>;
  static constexpr std::size_t most_modes = 6;
  struct Weight {
    std::size_t particle;  ///< index in slots_
    double weight;
  };
  struct Row {
    std::size_t held;
    Point direction;
    std::size_t first, last;  ///< indices in weights_
  };
  void find_weights(std::span<PrescribedDirection const> held, Cloud const& cloud);
  void set_modes(std::vector<Point> const& x);
  void find_owners(std::span<PrescribedDirection const> held);
  void complete(BodyState const& body, bool kick, bool stage) const;
  struct Motion {
    std::vector<Point> x, v;
  };
  /// Positions for the moments of impulses, and the velocities to correct.
  Motion motion(BodyState const& body, MultiplierCall const& call) const;
  void correct(std::vector<Point> const& v, std::vector<double> const& wanted);

  int D_;
  std::vector<Index> slots_;     ///< of the particles within the support of held particles
  std::vector<double> volume_;   ///< of these particles
  std::vector<Weight> weights_;  ///< row by row
  std::vector<Row> rows_;
  std::vector<std::size_t> owner_;  ///< of these particles: a support
  std::vector<Impulse> impulses_;   ///< per support
  EnvelopeCholesky matrix_{{}};     ///< sum_a w_ra w_sa / V_a  d_r.d_s
  // Work arrays of one call: rigid motions of the particles and their values in the rows; the correction.
  std::vector<std::array<Point, most_modes>> modes_;
  std::vector<std::array<double, most_modes>> mode_rows_;
  std::vector<Point> change_;
};

}  // namespace piola::jst_sph
