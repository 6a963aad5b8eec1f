// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/local_fits.hpp"
#include <array>
#include <optional>
#include <vector>

namespace piola::nodal {

/// Preconditioner of the system for the divergence theorem, whose matrix is that of |third derivatives|^2 for smooth
/// fields, so that neighbours alone carry a long wave through a body only in many steps. Fields are sums of cubic
/// splines on grids of 2, 4, 8 ... spacings; on each level every spline is corrected by itself, over its own energy,
///   z += sum over levels, splines B of level:  B (B.r) / (stiffness |grad^3 B|^2)
/// (Bramble, Pasciak and Xu, Math. Comp. 55, 1990). The number of iterations then depends little on the body's size.
template <int D>
class SplineLevels {
 public:
  /// Positions in spacings. shared: distributed positions; the splines of the finest level are distributed too.
  SplineLevels(Points const& X, std::optional<DistributedSlots> const& shared);

  /// A field whose sum of squares of third derivatives is `probe_square` everywhere; D columns alike.
  LazyZeroArray<double> probe() const;
  /// stiffness: of the matrix, per volume and square of third derivatives.
  void set_stiffness(double stiffness) { stiffness_ = stiffness; }
  static constexpr double probe_square = D;
  /// z += preconditioned r; D values per particle. Collective: z is valid for local particles, and r is replicated
  /// afterwards.
  void add(LazyZeroArray<double>& r, LazyZeroArray<double>& z);

 private:
  struct Level {
    double spacing = 1;
    std::array<int, 3> intervals{1, 1, 1}, splines{1, 1, 1};
    std::vector<double> energy;  ///< integral of |grad^3 B|^2 per spline
    std::vector<double> value;   ///< D per spline
  };
  void add_level(double spacing);
  void add_to_splines(LazyZeroArray<double> const& r);
  static void restrict_to(Level const& fine, Level& coarse);
  static void prolong(Level const& coarse, Level& fine);
  /// Index of the interval of the finest level that contains particle a, along an axis.
  int interval(std::size_t a, std::size_t axis) const;
  /// Calls f(number of the spline, its value) for the splines of the finest level at particle a.
  template <class F>
  void visit(std::size_t a, F const& f) const;

  Points const& X_;
  std::optional<DistributedSlots> shared_;
  std::array<double, 3> low_{}, length_{};
  std::vector<Level> levels_;
  double stiffness_ = 1;
};

extern template class SplineLevels<1>;
extern template class SplineLevels<2>;
extern template class SplineLevels<3>;

}  // namespace piola::nodal
