// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field_view.hpp"
#include "piola/math/circle.hpp"

/// Views of fields with one array per component, and groups of lanes that may begin at any slot, because bodies follow
/// one another without gaps.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Particles first ... first + count - 1, one per lane. Further lanes hold the next memory: they are computed and never
/// stored.
struct Group {
  Index first;
  int count;
  PIOLA_FN auto mask() const { return numbers() < static_cast<double>(count); }

 private:
  PIOLA_FN static Lanes numbers() {
    constexpr double n[] = {0, 1, 2, 3, 4, 5, 6, 7};
    return load<Lanes>(n);
  }
};

/// Calls f(group) for the particles of a range.
template <class F>
PIOLA_FN void each_group(Range r, F const& f) {
  for (Index i = r.first; i < r.last; i += lane_count)
    f(Group{i, r.last - i < lane_count ? static_cast<int>(r.last - i) : lane_count});
}

PIOLA_FN void store_group(double* to, Group g, Lanes const& value) {
  if (g.count == lane_count) return store(value, to);
  for (int l = 0; l < g.count; ++l) to[l] = lane(value, l);
}

/// Records a failure for the particles of a group whose lane is marked.
template <class Mask>
PIOLA_FN void record_where(FailureSlot* failure, Group g, Mask const& where, int code) {
  auto const failing = g.mask() && where;
  if (!any(failing)) return;
  Lanes const marks = select(failing, Lanes(1.0), Lanes(0.0));
  for (int l = 0; l < g.count; ++l)
    if (lane(marks, l) > 0) exec::record(failure, g.first + l, code);
}

PIOLA_FN Lanes magnitude(Lanes const& a) { return select(a < 0.0, -a, a); }

/// Read access.
struct Components {
  double const* data = nullptr;
  std::ptrdiff_t stride = 0;

  PIOLA_FN Components(View const& v) : data(v.data), stride(v.component_stride) {}
  PIOLA_FN Components(double const* first, std::ptrdiff_t step) : data(first), stride(step) {}

  PIOLA_FN double const& at(Index i, int c = 0) const { return data[c * stride + i]; }
  template <class V>
  PIOLA_FN V scalar(Index i, int c = 0) const {
    return load<V>(data + c * stride + i);
  }
  /// For a field that may be absent.
  template <class V>
  PIOLA_FN V scalar_or(Index i, double otherwise) const {
    return data != nullptr ? load<V>(data + i) : V(otherwise);
  }
  template <int D, class V>
  PIOLA_FN Vec<D, V> vector(Index i) const {
    Vec<D, V> r;
    for (int c = 0; c < D; ++c) r[c] = scalar<V>(i, c);
    return r;
  }
  template <class V>
  PIOLA_FN Mat<3, V> matrix(Index i) const {
    Mat<3, V> r;
    for (int c = 0; c < 9; ++c) r.c[c] = scalar<V>(i, c);
    return r;
  }
  template <class V>
  PIOLA_FN SymMat<3, V> symmetric(Index i) const {
    SymMat<3, V> r;
    for (int c = 0; c < 6; ++c) r.c[c] = scalar<V>(i, c);
    return r;
  }
};

/// Write access, which can also read.
struct OwnComponents {
  double* data = nullptr;
  std::ptrdiff_t stride = 0;

  PIOLA_FN OwnComponents(WriteView const& v) : data(v.data), stride(v.component_stride) {}

  PIOLA_FN Components seen() const { return {data, stride}; }
  PIOLA_FN double& at(Index i, int c = 0) const { return data[c * stride + i]; }
  PIOLA_FN void put(Group g, Lanes const& value, int c = 0) const {
    store_group(data + c * stride + g.first, g, value);
  }
  template <int N>
  PIOLA_FN void put_all(Group g, Lanes const (&values)[N]) const {
    for (int c = 0; c < N; ++c) put(g, values[c], c);
  }
  PIOLA_FN void add(Group g, Lanes const& value, int c = 0) const {
    put(g, load<Lanes>(data + c * stride + g.first) + value, c);
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
