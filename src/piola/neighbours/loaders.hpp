// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/neighbours/pair_table_views.hpp"
#include "piola/neighbours/record_gather.hpp"

/// Loaders define how values of neighbours are loaded. The summed terms are defined once, by a Body:
///
///   static constexpr int sums;    // number of sums
///   static constexpr int fields;  // values it reads of a neighbour; those of outer pairs first
///   static constexpr int outer_fields;
///   static constexpr bool smooths;  // it uses the kernel itself and nothing else of the geometry
///   View gathered;                // where these values are
///   template <class V> Own<V> own(Index i)           what it needs of the particle (or of the lanes) itself
///   pair(sums, own, geometry, f)  inner pair;  outer(sums, own, geometry, f)  outer pair
///
/// Both loaders give the sums of lane_count consecutive particles, one per lane.
namespace piola::inline PIOLA_BACKEND {

/// Geometry of a pair, or of one pair per lane.
template <int D, class V>
struct PairGeometry {
  V s;
  Vec<D, V> sr;  ///< raw gradient s r
  Vec<D, V> r;   ///< X_b - X_a
  V r2;
  V l;       ///< raw Laplacian weight
  V weight;  ///< 1, or 0 for a lane without this neighbour
  V kernel;  ///< W of the Laplacian's support, where tables hold it
};

/// Lanes are consecutive particles of a regular lattice: neighbours arrive by unit-stride loads, geometry is the same
/// for all lanes and comes from a small table.
template <int D>
struct StencilLoader {
  StencilTable table;
  static constexpr bool contiguous = true;

  template <class Body>
  PIOLA_INLINE_FN void operator()(Index i, Body const& body, Lanes (&result)[Body::sums]) const {
    Lanes sums[Body::sums];  // local, so that the compiler keeps them in registers
    for (int c = 0; c < Body::sums; ++c) sums[c] = Lanes(0.0);
    auto const own = body.template own<Lanes>(i);
    StencilPattern const& p = table.patterns[table.pattern_of[i / lane_count]];
    visit_all<true>(i, p.inner, body, own, sums);
    if constexpr (Body::outer_fields > 0) visit_all<false>(i, p.outer, body, own, sums);
    for (int c = 0; c < Body::sums; ++c) result[c] = sums[c];
  }

 private:
  /// Entries that all lanes have come in long runs, so that the branch costs little.
  template <bool Inner, class Body, class Own>
  PIOLA_INLINE_FN void visit_all(Index i, std::int32_t const (&run)[2], Body const& body, Own const& own,
                                 Lanes (&sums)[Body::sums]) const {
    for (int e = run[0]; e < run[1]; ++e) {
      StencilEntry const& entry = table.entries[e];
      if (entry.weights < 0)
        visit<false, Inner>(i, entry, body, own, sums);
      else
        visit<true, Inner>(i, entry, body, own, sums);
    }
  }
  template <bool Masked, bool Inner, class Body, class Own>
  PIOLA_INLINE_FN void visit(Index i, StencilEntry const& e, Body const& body, Own const& own,
                             Lanes (&sums)[Body::sums]) const {
    constexpr int fields = Inner ? Body::fields : Body::outer_fields;
    StencilOffset const& o = table.offsets[e.offset];
    Lanes f[fields];
    double const* const b = body.gathered.data + (i + e.delta);
    for (int c = 0; c < fields; ++c) f[c] = load<Lanes>(b + c * body.gathered.component_stride);
    PairGeometry<D, Lanes> g;
    g.s = Lanes(o.s);
    for (int c = 0; c < D; ++c) {
      g.sr[c] = Lanes(o.sr[c]);
      g.r[c] = Lanes(o.r[c]);
    }
    g.r2 = Lanes(o.r2);
    g.l = Lanes(o.l);
    if constexpr (Body::smooths) g.kernel = Lanes(table.kernel[e.offset]);
    if constexpr (Masked) {
      g.weight = load<Lanes>(table.weights + e.weights);
      g.s = g.weight * g.s;
      g.sr = g.weight * g.sr;
    }
    if constexpr (Inner)
      body.template pair<Masked>(sums, own, g, f);
    else
      body.template outer<Masked>(sums, own, g, f);
  }
};

/// Lanes are neighbours of one particle, taken from a list; their records are loaded and transposed. Without SIMD packs
/// (and on a GPU) this is the plain loop over neighbours.
template <int D>
struct ListLoader {
  ListTable table;
  static constexpr bool contiguous = false;

  template <class Body>
  PIOLA_INLINE_FN void operator()(Index i, Body const& body, Lanes (&sums)[Body::sums]) const {
    constexpr int padded = (Body::sums + 7) / 8 * 8;
    double rows[lane_count * padded];
    for (int k = 0; k < lane_count; ++k) {
      Lanes own_sums[Body::sums];
      for (int c = 0; c < Body::sums; ++c) own_sums[c] = Lanes(0.0);
      sum_one(i + k, body, own_sums);
      add_lanes(own_sums, rows + k * padded);
    }
    Index row[lane_count];
    for (int k = 0; k < lane_count; ++k) row[k] = k;
    load_records(rows, padded, row, sums);
  }

 private:
  template <class Body>
  PIOLA_INLINE_FN void sum_one(Index a, Body const& body, Lanes (&sums)[Body::sums]) const {
    auto const own = body.template own<double>(a);
    std::int64_t k = table.begin[a];
    std::int64_t const inner_end = k + table.inner[a];
    for (; k < inner_end; k += lane_count) visit<true>(a, k, body, own, sums);
    if constexpr (Body::outer_fields > 0)
      for (; k < table.begin[a + 1]; k += lane_count) visit<false>(a, k, body, own, sums);
  }

  /// A record is X_b followed by the body's fields; `gathered` points at the fields.
  template <bool Inner, class Body, class Own>
  PIOLA_INLINE_FN void visit(Index a, std::int64_t k, Body const& body, Own const& own,
                             Lanes (&sums)[Body::sums]) const {
    constexpr int fields = Inner ? Body::fields : Body::outer_fields;
    std::ptrdiff_t const stride = body.gathered.particle_stride;
    if constexpr (Body::smooths) return smooth(k, body, own, sums);
    double const* const base = body.gathered.data - D;
    Lanes record[D + fields], f[fields];
    fetch_ahead<D + fields>(base, stride, table.neighbour + k);
    load_records(base, stride, table.neighbour + k, record);
    for (int c = 0; c < fields; ++c) f[c] = record[D + c];
    PairGeometry<D, Lanes> g;
    g.s = load<Lanes>(table.s + k);
    for (int c = 0; c < D; ++c) {
      g.r[c] = record[c] - base[a * stride + c];
      g.sr[c] = g.s * g.r[c];
    }
    g.r2 = dot(g.r, g.r);
    g.l = table.l != nullptr ? load<Lanes>(table.l + k) : 2.0 * g.s;
    if constexpr (Inner)
      body.template pair<false>(sums, own, g, f);
    else
      body.template outer<false>(sums, own, g, f);
  }

  /// Prefetches the next neighbours. Rows are contiguous in memory, so neighbours of the next particles mostly follow
  /// those of this one. Prefetching into the second-level cache saves up to a tenth of both sweeps (record 4).
  template <int Values>
  PIOLA_INLINE_FN static void fetch_ahead(double const* base, std::ptrdiff_t stride, Index const* neighbour) {
#if PIOLA_HAS_PACKS
    constexpr int ahead = 3, line = 8;  // records, doubles
    for (int l = 0; l < lane_count; ++l)
      for (int c = 0; c < Values; c += line) __builtin_prefetch(base + (neighbour[l] + ahead) * stride + c);
#else
    static_cast<void>(base), static_cast<void>(stride), static_cast<void>(neighbour);
#endif
  }

  /// Few values per neighbour and no geometry: no record is worth loading.
  template <class Body, class Own>
  PIOLA_INLINE_FN void smooth(std::int64_t k, Body const& body, Own const& own, Lanes (&sums)[Body::sums]) const {
    Lanes f[Body::fields];
    View const& from = body.gathered;
    for (int c = 0; c < Body::fields; ++c) {
      double const* const value = from.data + c * from.component_stride;
#if PIOLA_HAS_PACKS
      for (int l = 0; l < lane_count; ++l) f[c][l] = value[table.neighbour[k + l] * from.particle_stride];
#else
      f[c] = value[table.neighbour[k] * from.particle_stride];
#endif
    }
    PairGeometry<D, Lanes> g{};
    g.kernel = load<Lanes>(table.kernel + k);
    body.template pair<false>(sums, own, g, f);
  }
};

}  // namespace piola::inline PIOLA_BACKEND
