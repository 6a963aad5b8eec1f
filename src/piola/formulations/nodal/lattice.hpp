// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <cstdint>

/// Lattice data for loops: plain data, independent of the instruction set.
namespace piola::nodal {

/// Offset of a lattice row from a particle's row: steps along the second and the third direction.
struct LatticeRow {
  int j, k;
};

/// Offsets of rows within the support radius, one of each two opposite rows.
template <int D>
struct LatticeRows;
template <>
struct LatticeRows<1> {
  static constexpr int pairs = 0, bits = 4;
  static constexpr LatticeRow pair[1]{{0, 0}};
};
template <>
struct LatticeRows<2> {
  static constexpr int pairs = 2, bits = 2 * pairs + 4;
  static constexpr LatticeRow pair[pairs]{{1, 0}, {2, 0}};
};
template <>
struct LatticeRows<3> {
  static constexpr int pairs = 10, bits = 2 * pairs + 4;
  static constexpr LatticeRow pair[pairs]{{1, 0}, {0, 1}, {1, 1},  {1, -1}, {2, 0},
                                          {0, 2}, {2, 1}, {2, -1}, {1, 2},  {1, -2}};
};

/// Rows along the longest direction, one after the other in memory.
struct LatticeTable {
  std::ptrdiff_t row = 0, plane = 0;  ///< slots to the neighbour along the second and the third direction
  int place[3][6] = {};               ///< index of i^d / d! times monomial m of (j, k) among the monomials of X, Y, Z
  /// Per group of lanes, a bit per lane: whether the body has a row at +-pair, for every pair; then whether it has the
  /// positions i + 1, i - 1, i + 2, i - 2. nullptr: no lattice.
  std::uint8_t const* present = nullptr;
};

}  // namespace piola::nodal
