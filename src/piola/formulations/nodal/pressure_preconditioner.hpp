// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include "piola/math/envelope_cholesky.hpp"
#include <array>
#include <optional>
#include <vector>

namespace piola::nodal {

/// Approximates the matrix S = V / kappa + tau V D M^-1 D^T V of an implicit pressure by that of the body at rest,
/// which rotations do not change. Slender and small bodies have a Cholesky factor of this matrix, others its diagonal.
/// D is the derivative of the volume ratios of cells by the positions. Host only, on one rank.
class PressurePreconditioner {
 public:
  /// lanes: of the instruction set.
  PressurePreconditioner(NodalBody const& body, int lanes);

  /// For steps with tau = (dt/2)^2 [s2]; nothing changes while tau is near that of the present factor.
  void prepare(double tau);
  /// Solves S z = V r approximately. Vectors have a value per local particle.
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
