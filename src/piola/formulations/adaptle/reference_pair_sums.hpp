// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/component_views.hpp"
#include "piola/formulations/adaptle/viscosity.hpp"
#include "piola/neighbours/loaders.hpp"

/// Common parts of the two sweeps over reference neighbours: their forms, and access to values of neighbours.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// s of the pairs as stored: floats if K compensates the rounding, else doubles.
template <MaterialForm Form>
PIOLA_FN auto gradients_of(MaterialTable const& table) {
  if constexpr (EquationSet{Form}.rounds_gradients())
    return table.gradient;
  else
    return table.s;
}

/// Location of the record of one particle.
struct RecordPlace {
  double* value;
  std::ptrdiff_t step;  ///< between components
  PIOLA_FN double& operator[](int c) const { return value[c * step]; }
};
template <int D>
PIOLA_FN RecordPlace record_of(MaterialTable const& table, EquationSet equations, Index slot) {
  if (table.rows.record != nullptr) return {table.rows.record + (slot - table.rows.first), table.rows.stride};
  return {table.record + static_cast<std::ptrdiff_t>(slot) * MaterialRecord<D>::stride(equations), 1};
}

/// Components [0, N) of the records of listed neighbours from pair k on, also of lattices, where this is slow.
template <int D, int N>
PIOLA_FN void load_listed(MaterialTable const& table, EquationSet equations, Offset k, Index filler, Lanes (&f)[N]) {
  MaterialRows const& rows = table.rows;
  if (rows.record == nullptr)
    return load_components<N>(table.record, MaterialRecord<D>::stride(equations), table.neighbour + k, f);
  double gathered[N][lane_count];
  for (int l = 0; l < lane_count; ++l) {
    Index const j = table.neighbour[k + l], place = j == filler ? rows.empty : j - rows.first;
    for (int c = 0; c < N; ++c) gathered[c][l] = rows.record[c * rows.stride + place];
  }
  for (int c = 0; c < N; ++c) f[c] = load<Lanes>(gathered[c]);
}

/// Loads a value of the particle itself: broadcast to all lanes of neighbours, or one value per lane for a group of
/// particles.
template <class V>
PIOLA_FN V load_local(RecordPlace const& p, int c) {
  return load<V>(p.value + c * p.step);
}

/// The sums of `Pairs` for the particle of `own`, over its list; extrema follow the sums. f: components from `first`
/// on.
template <int D, MaterialForm Form, class Pairs>
PIOLA_FN void sum_listed(MaterialTable const& table, Index slot, Pairs const& pairs, RecordPlace const& own,
                         double (&a)[whole(Pairs::sums + 1)]) {
  using R = MaterialRecord<D>;
  constexpr int first = Pairs::first_component, last = Pairs::last_component > R::A ? Pairs::last_component : R::A,
                values = last - first;  // with X
  constexpr EquationSet equations{Form};
  constexpr int stride = R::stride(equations);
  Lanes sums[Pairs::sums];
  Lanes const zeros = zeros_from(own[R::volume]);
  for (auto& s : sums) s = zeros;
  auto const mine = pairs.template own_at<double>(own);
  for (Offset k = table.begin[slot]; k < table.begin[slot + 1]; k += lane_count) {
    Lanes f[values];
    load_components<values>(table.record + first, stride, table.neighbour + k, f);
    PairGeometry<D, Lanes> g;
    for (int c = 0; c < D; ++c) g.r[c] = f[R::X - first + c] - own[R::X + c];
    g.s = load_gradients(gradients_of<Form>(table) + k);
    if constexpr (equations.has_kernel_part()) g.kernel = load<Lanes>(table.W + k);
    pairs.add(sums, mine, g, [&](int c) { return f[c - first]; });
  }
  if constexpr (Pairs::extrema > 0) {
    Lanes const least = sums[Pairs::sums - 1];
    sums[Pairs::sums - 1] = Lanes(0.0);
    add_lanes(sums, a);
    a[Pairs::sums - 1] = -largest_of(-1.0 * least);
  } else {
    add_lanes(sums, a);
  }
}

/// The sums of `Pairs` for the particles of a group of lanes on a lattice. Values are loaded at their use, because they
/// exceed the registers.
template <int D, MaterialForm Form, class Pairs>
PIOLA_FN void sum_rows(MaterialRows const& rows, Index place, Pairs const& pairs, Lanes (&result)[Pairs::sums]) {
  constexpr EquationSet equations{Form};
  StencilTable const& table = rows.stencil;
  Lanes sums[Pairs::sums];
  for (auto& s : sums) s = Lanes(0.0);
  auto const mine = pairs.template own_at<Lanes>(RecordPlace{rows.record + place, rows.stride});
  StencilPattern const& pattern = table.patterns[table.pattern_of[place / lane_count]];
  for (std::int32_t k = pattern.inner[0]; k < pattern.inner[1]; ++k) {
    StencilEntry const& entry = table.entries[k];
    StencilOffset const& offset = table.offsets[entry.offset];
    double const* const there = rows.record + (place + entry.delta);
    PairGeometry<D, Lanes> g;
    g.s = Lanes(offset.s);
    if constexpr (equations.has_kernel_part()) g.kernel = Lanes(table.kernel[entry.offset]);
    for (int c = 0; c < D; ++c) g.r[c] = Lanes(offset.r[c]);
    if (entry.weights >= 0) {
      Lanes const weight = load<Lanes>(table.weights + entry.weights);
      g.s = weight * g.s;
      if constexpr (equations.has_kernel_part()) g.kernel = weight * g.kernel;
    }
    pairs.add(sums, mine, g, [&](int c) { return load<Lanes>(there + c * rows.stride); });
  }
  for (int c = 0; c < Pairs::sums; ++c) result[c] = sums[c];
}

/// Stores components [first, first + N) of the records of a group.
template <int D, int N>
PIOLA_FN void store_in_records(MaterialTable const& table, EquationSet equations, Group g, int first,
                               Lanes const (&f)[N]) {
  RecordPlace const place = record_of<D>(table, equations, g.first);
  if (table.rows.record != nullptr) {
    for (int c = 0; c < N; ++c) store_group(place.value + (first + c) * place.step, g, f[c]);
    return;
  }
  double* to[lane_count];
  for (int l = 0; l < lane_count; ++l)
    to[l] = l < g.count ? place.value + std::ptrdiff_t{l} * MaterialRecord<D>::stride(equations) : nullptr;
  store_records(to, first, f);
}
/// Loads them.
template <int D, int N>
PIOLA_FN void load_own_records(MaterialTable const& table, EquationSet equations, Group g, int first, Lanes (&f)[N]) {
  RecordPlace const place = record_of<D>(table, equations, g.first);
  if (table.rows.record != nullptr) {
    for (int c = 0; c < N; ++c) f[c] = load<Lanes>(place.value + (first + c) * place.step);
    return;
  }
  Index slots[lane_count];
  for (int l = 0; l < lane_count; ++l) slots[l] = l < g.count ? l : 0;
  load_components<N>(place.value + first, MaterialRecord<D>::stride(equations), slots, f);
}

/// Lanes of the particles with wants(slot).
template <class Wants>
PIOLA_FN Lanes marks_of(Group g, Wants const& wants) {
  double marks[lane_count];
  for (int l = 0; l < lane_count; ++l) marks[l] = l < g.count && wants(g.first + l) ? 1 : 0;
  return load<Lanes>(marks);
}

/// Calls f(group, marks, sums) for the particles of a block of lattice positions that `wants` selects.
template <int D, MaterialForm Form, class Pairs, class Wants, class F>
PIOLA_FN void each_in_rows(MaterialTable const& table, Pairs const& pairs, Range block, Index last, Wants const& wants,
                           F const& f) {
  MaterialRows const& rows = table.rows;
  each_group(block, [&](Group places) {
    Index const slot = rows.first + places.first;
    Group const g{slot, static_cast<int>(last - slot < places.count ? last - slot : places.count)};
    Lanes const marks = marks_of(g, wants);
    if (!any(marks > 0.0)) return;
    Lanes sums[Pairs::sums];
    sum_rows<D, Form>(rows, places.first, pairs, sums);
    f(g, marks, sums);
  });
}

/// As above, over the lists of a block of slots.
template <int D, MaterialForm Form, class Pairs, class Wants, class F>
PIOLA_FN void each_in_lists(MaterialTable const& table, Pairs const& pairs, Range block, Wants const& wants,
                            F const& f) {
  each_group(block, [&](Group g) {
    Lanes const marks = marks_of(g, wants);
    if (!any(marks > 0.0)) return;
    double a[lane_count][whole(Pairs::sums + 1)];
    for (int l = 0; l < lane_count; ++l) {
      if (lane(marks, l) > 0)
        sum_listed<D, Form>(table, g.first + l, pairs, record_of<D>(table, EquationSet{Form}, g.first + l), a[l]);
      else
        for (double& value : a[l]) value = 0;
    }
    Lanes sums[Pairs::sums];
    Index rows[lane_count];
    for (int l = 0; l < lane_count; ++l) rows[l] = l;
    load_components<Pairs::sums>(a[0], whole(Pairs::sums + 1), rows, sums);
    f(g, marks, sums);
  });
}

}  // namespace piola::adaptle::inline PIOLA_BACKEND
