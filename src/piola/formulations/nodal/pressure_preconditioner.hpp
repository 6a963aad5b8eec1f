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
  /// lanes: of the instruction set.
  PressurePreconditioner(NodalBody const& body, int lanes);

  /// For steps with tau = (dt/2)^2 [s2]; nothing changes while tau is near that of the present factor.
  void prepare(double tau);
  /// z = S^-1 (V r); per local particle.
  void solve(std::vector<double> const& r, std::vector<double>& z);
  std::size_t bytes() const;

 private:
  /// Derivative of the volume ratio of a cell by the position of a particle, at rest [1/m].
  struct Entry {
    Index cell;
    std::array<double, 3> G;
  };
  void read_gradients(int lanes);
  void hold();
  void order_cells();
  void take_envelope();
  void factorise();
  static double product(Entry const& one, Entry const& other);

  NodalBody const& body_;
  std::vector<std::vector<Entry>> cells_;  ///< per particle: the cells with it as a neighbour, and its own
  std::vector<std::size_t> place_;         ///< of a cell in the factor: along the longest side of the body
  std::vector<double> diagonal_;           ///< of D M^-1 D^T
  std::vector<std::size_t> first_;         ///< of each row of the factor: its first column; empty: no factor is made
  std::optional<EnvelopeCholesky> factor_;
  std::vector<double> sorted_;  ///< room for a vector in the order of the factor
  double tau_ = 0;              ///< of the factor or the diagonal [s2]; 0: none yet
};

}  // namespace piola::nodal
