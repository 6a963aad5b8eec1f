// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/neighbours/cell_list.hpp"
#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

/// The search for neighbours among sorted particles: 16 candidates at a time in single precision, along runs of cells.
/// The radius is slightly too large; the kernel itself cuts off in double precision.
namespace piola::inline PIOLA_BACKEND {

/// Candidates of one target, collected on the stack.
struct FoundList {
  static constexpr Index room = 4096;
  Index number[room + 16];
  Index count = 0;
};

PIOLA_FN bool related(CellListSearch const& s, Index i, Index j) {
  return s.group == nullptr || (s.group[i] == s.group[j]) != s.across;
}

/// Appends the sorted particles of [first, last) within the radius of target i, without i itself.
#if PIOLA_HAS_PACKS && defined(__AVX512F__)
PIOLA_FN void collect_run(CellListSearch const& s, Index i, float reach, Index first, Index last, FoundList& found) {
  __m512 const x = _mm512_set1_ps(s.place[0][i]), y = _mm512_set1_ps(s.place[1][i]), z = _mm512_set1_ps(s.place[2][i]),
               limit = _mm512_set1_ps(reach);
  __m512i const self = _mm512_set1_epi32(i),
                steps = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  for (Index j = first; j < last && found.count < FoundList::room; j += 16) {
    Index const rest = last - j;
    __mmask16 inside = rest >= 16 ? static_cast<__mmask16>(0xffff) : static_cast<__mmask16>((1U << rest) - 1U);
    __m512 const a = _mm512_sub_ps(_mm512_loadu_ps(s.place[0] + j), x);
    __m512 square = _mm512_mul_ps(a, a);
    __m512 const b = _mm512_sub_ps(_mm512_loadu_ps(s.place[1] + j), y);
    square = _mm512_fmadd_ps(b, b, square);
    if (s.dimension == 3) {
      __m512 const c = _mm512_sub_ps(_mm512_loadu_ps(s.place[2] + j), z);
      square = _mm512_fmadd_ps(c, c, square);
    }
    __m512i const number = _mm512_add_epi32(_mm512_set1_epi32(j), steps);
    inside = _mm512_mask_cmp_ps_mask(inside, square, limit, _CMP_LT_OQ);
    inside = _mm512_mask_cmpneq_epi32_mask(inside, number, self);
    if (s.group != nullptr) {
      __m512i const group = _mm512_maskz_loadu_epi32(inside, s.group + j), own = _mm512_set1_epi32(s.group[i]);
      inside = s.across ? _mm512_mask_cmpneq_epi32_mask(inside, group, own)
                        : _mm512_mask_cmpeq_epi32_mask(inside, group, own);
    }
    _mm512_storeu_si512(found.number + found.count, _mm512_maskz_compress_epi32(inside, number));
    found.count += __builtin_popcount(static_cast<unsigned>(inside));
  }
}
#elif PIOLA_HAS_PACKS && defined(__AVX2__)
PIOLA_FN void collect_run(CellListSearch const& s, Index i, float reach, Index first, Index last, FoundList& found) {
  __m256 const x = _mm256_set1_ps(s.place[0][i]), y = _mm256_set1_ps(s.place[1][i]), z = _mm256_set1_ps(s.place[2][i]),
               limit = _mm256_set1_ps(reach);
  for (Index j = first; j < last && found.count < FoundList::room; j += 8) {
    Index const rest = last - j;
    unsigned inside = rest >= 8 ? 0xffU : (1U << rest) - 1U;
    __m256 const a = _mm256_sub_ps(_mm256_loadu_ps(s.place[0] + j), x);
    __m256 square = _mm256_mul_ps(a, a);
    __m256 const b = _mm256_sub_ps(_mm256_loadu_ps(s.place[1] + j), y);
    square = _mm256_fmadd_ps(b, b, square);
    if (s.dimension == 3) {
      __m256 const c = _mm256_sub_ps(_mm256_loadu_ps(s.place[2] + j), z);
      square = _mm256_fmadd_ps(c, c, square);
    }
    inside &= static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(square, limit, _CMP_LT_OQ)));
    for (; inside != 0; inside &= inside - 1) {
      Index const k = j + __builtin_ctz(inside);
      if (k != i && related(s, i, k)) found.number[found.count++] = k;
    }
  }
}
#else
PIOLA_FN void collect_run(CellListSearch const& s, Index i, float reach, Index first, Index last, FoundList& found) {
  for (Index j = first; j < last && found.count < FoundList::room; ++j) {
    float square = 0;
    for (int c = 0; c < s.dimension; ++c) {
      float const a = s.place[c][j] - s.place[c][i];
      square += a * a;
    }
    if (square < reach && j != i && related(s, i, j)) found.number[found.count++] = j;
  }
}
#endif

/// Lists the neighbours of each target, in the order of cells, filled up to whole lanes with the number `sources`.
struct FindNeighbours {
  CellListSearch s;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) find(t);
  }

 private:
  PIOLA_FN void find(Index t) const {
    Index const i = s.target[t], row = s.cells[0], layer = s.cells[0] * s.cells[1];
    float const reach = s.reach[s.group == nullptr ? 0 : s.group[i]];
    FoundList found;
    for (Index dz = s.dimension == 3 ? -1 : 0; dz <= (s.dimension == 3 ? 1 : 0); ++dz)
      for (Index dy = s.dimension > 1 ? -1 : 0; dy <= (s.dimension > 1 ? 1 : 0); ++dy) {
        Index const middle = s.cell[i] + dz * layer + dy * row;
        collect_run(s, i, reach, s.begin[middle - 1], s.begin[middle + 2], found);
      }
    s.found[t] = found.count;
    Index const filled = (found.count + lane_count - 1) / lane_count * lane_count;
    s.length[t] = filled;
    if (filled > s.capacity) return;
    Index* const row_out = s.list + static_cast<std::ptrdiff_t>(t) * s.capacity;
    for (Index k = 0; k < found.count; ++k) row_out[k] = found.number[k];
    for (Index k = found.count; k < filled; ++k) row_out[k] = s.sources;
  }
};

inline void find_neighbours(CellListSearch const& s) { exec::for_each_block(Range{0, s.targets}, FindNeighbours{s}); }

}  // namespace piola::inline PIOLA_BACKEND
