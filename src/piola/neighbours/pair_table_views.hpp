// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <cstdint>

/// Reference neighbours of one body for loops. Plain data, so that code of different instruction sets may exchange it.
///
/// Each pair has three numbers: r = X_b - X_a; s = -V_b W'(|r|) / |r| >= 0, the raw gradient being s r; and l, the raw
/// Laplacian weight 2 s of the Laplacian's own support. All corrections are per particle:
///   GRAD f_a = (sum s (f_b - f_a) (x) r) C_a,        L f_a = sum (l + alpha_a.r + beta_a r.r) (f_b - f_a).
/// V_b is the kernel volume, the same for all particles of a body. The gradient's support lies within the Laplacian's:
/// pairs of both supports are called inner, those of the Laplacian alone outer.
namespace piola {

/// Numbers of one lattice offset.
struct StencilOffset {
  double s;      ///< [m^-2]
  double sr[3];  ///< s r [m^-1 m^-1 m^-D m^D]
  double r[3];   ///< [m]
  double r2;     ///< r.r [m2]
  double l;      ///< [m^-2]
};

/// Neighbours of W consecutive particles that lie `delta` further on, all at the same lattice offset.
struct StencilEntry {
  std::int32_t delta;
  std::int32_t offset;
  std::int32_t weights;  ///< position of W factors, 1 where the neighbour exists, else 0; negative: all lanes have it
};

/// Entries of a group of lanes, as two runs [begin, end), each in the order of lattice offsets. Every lane thus visits
/// its neighbours in this order, whatever is adjacent in memory. Several entries share an offset where lanes find that
/// neighbour at different distances.
struct StencilPattern {
  std::int32_t inner[2], outer[2];
};

/// Regular lattices: no list per particle, only a few hundred distinct patterns per body.
struct StencilTable {
  StencilOffset const* offsets = nullptr;
  StencilEntry const* entries = nullptr;
  StencilPattern const* patterns = nullptr;
  std::int32_t const* pattern_of = nullptr;  ///< per group of W particles
  double const* weights = nullptr;
  double const* kernel = nullptr;  ///< per offset: W of the Laplacian's support [m^-D]
};

/// Any set of points: a list per particle, inner pairs first; both parts padded to a multiple of the lane count with
/// the particle itself and zero weights.
struct ListTable {
  std::int64_t const* begin = nullptr;  ///< per particle: first inner pair; begin[n] is the end of the last
  std::int32_t const* inner = nullptr;  ///< per particle: number of inner pairs with padding
  Index const* neighbour = nullptr;
  double const* s = nullptr;
  double const* l = nullptr;       ///< nullptr: l = 2 s (equal supports)
  double const* kernel = nullptr;  ///< W of the Laplacian's support [m^-D]; nullptr: not wanted
};

}  // namespace piola
