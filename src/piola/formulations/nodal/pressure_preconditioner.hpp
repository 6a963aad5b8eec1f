// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include "piola/math/envelope_cholesky.hpp"
#include <array>
#include <optional>
#include <vector>

namespace piola::nodal {

/// Approximate inverse of the matrix of an implicit pressure, V / kappa + tau V D M^-1 D^T V, with the derivative D of
/// the volume ratios at rest, which rotations leave as it is: a Cholesky factor for slender and small bodies, the
/// diagonal for others. Host only, on one rank.
class PressurePreconditioner {
 public:
  /// Gradient of a cell with respect to a particle [1/m].
  struct Entry {
    Index particle;
    std::array<double, 3> G;
  };

  explicit PressurePreconditioner(NodalBody& body, int lanes);

  /// For steps with tau = (dt/2)^2 [s2]; nothing changes while tau is near that of the present factor.
  void prepare(double tau);
  /// z = S^-1 (V r); per local particle.
  void solve(std::vector<double> const& r, std::vector<double>& z);
  std::size_t bytes() const;

 private:
  void read_lists(NodalBody const& body);
  void read_lattice(NodalBody const& body, int lanes);
  void hold(NodalBody const& body);
  void order_cells(NodalBody const& body);
  std::vector<std::size_t> envelope() const;
  void factorise(double tau);
  double product(Entry const& one, Entry const& other) const;

  NodalBody& body_;
  std::vector<std::vector<Entry>> cells_;  ///< per particle: the cells that see it, Entry::particle is the cell
  std::vector<std::size_t> place_;         ///< of a cell in the factor: along the longest side of the body
  std::vector<double> diagonal_;           ///< of D M^-1 D^T
  std::optional<EnvelopeCholesky> factor_;
  std::vector<double> sorted_;
  bool slender_ = true;
  double tau_ = 0;
};

}  // namespace piola::nodal
