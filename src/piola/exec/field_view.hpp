// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/math/tensor.hpp"

namespace piola {
/// Reports that a field is read at neighbours without a halo refresh since the last write. Host only; never returns.
[[noreturn]] void stale_halo(char const* field);
}  // namespace piola

namespace piola::inline PIOLA_BACKEND {

/// Reading access to a field at particle i, or at the lanes that start at i.
struct View {
  double const* data;
  std::ptrdiff_t component_stride, particle_stride, tile_extra = 0;

  template <class V>
  PIOLA_INLINE_FN V scalar(Index i, int c = 0) const {
    double const* p = data + c * component_stride + i * particle_stride + (i >> tile_bits) * tile_extra;
    if constexpr (std::is_same_v<V, double>) {
      return *p;
    } else {
      if (particle_stride == 1) return load<V>(p);
      V r{};
      for (int l = 0; l < width<V>; ++l) r[l] = p[l * particle_stride];
      return r;
    }
  }
  template <int D, class V>
  PIOLA_INLINE_FN Vec<D, V> vector(Index i, int first = 0) const {
    Vec<D, V> r;
    for (int c = 0; c < D; ++c) r[c] = scalar<V>(i, first + c);
    return r;
  }
  template <int D, class V>
  PIOLA_INLINE_FN Mat<D, V> matrix(Index i) const {
    Mat<D, V> r;
    for (int c = 0; c < D * D; ++c) r.c[c] = scalar<V>(i, c);
    return r;
  }
  template <int D, class V>
  PIOLA_INLINE_FN SymMat<D, V> symmetric(Index i) const {
    SymMat<D, V> r;
    for (int c = 0; c < SymMat<D>::size; ++c) r.c[c] = scalar<V>(i, c);
    return r;
  }
};

/// Reading access to a reference field, whose values groups of lanes may share (FieldRef::group).
struct ReferenceView {
  View stored;
  std::int32_t const* group;

  PIOLA_INLINE_FN Index place(Index i) const {
    return group == nullptr ? i : group[i / lane_count] * lane_count + i % lane_count;
  }
  template <class V>
  PIOLA_INLINE_FN V scalar(Index i, int c = 0) const {
    return stored.scalar<V>(place(i), c);
  }
  template <int D, class V>
  PIOLA_INLINE_FN Vec<D, V> vector(Index i) const {
    return stored.vector<D, V>(place(i));
  }
  template <int D, class V>
  PIOLA_INLINE_FN SymMat<D, V> symmetric(Index i) const {
    return stored.symmetric<D, V>(place(i));
  }
};

/// Writing access. A pass may write only particles that it owns.
struct WriteView {
  double* data;
  std::ptrdiff_t component_stride, particle_stride, tile_extra = 0;

  template <class V>
  PIOLA_INLINE_FN void scalar(Index i, V const& value, int c = 0) const {
    double* p = data + c * component_stride + i * particle_stride + (i >> tile_bits) * tile_extra;
    if constexpr (std::is_same_v<V, double>) {
      *p = value;
    } else {
      if (particle_stride == 1) return store(value, p);
      for (int l = 0; l < width<V>; ++l) p[l * particle_stride] = value[l];
    }
  }
  template <int D, class V>
  PIOLA_INLINE_FN void vector(Index i, Vec<D, V> const& v, int first = 0) const {
    for (int c = 0; c < D; ++c) scalar(i, v[c], first + c);
  }
  template <int D, class V>
  PIOLA_INLINE_FN void matrix(Index i, Mat<D, V> const& m, int first = 0) const {
    for (int c = 0; c < D * D; ++c) scalar(i, m.c[c], first + c);
  }
};

/// Views are created by these functions only. They make the data flow of a step explicit and are counted in contract
/// builds.
inline View read(FieldRef const& f) { return {f.data, f.component_stride, f.particle_stride, f.tile_extra}; }
inline ReferenceView read_reference(FieldRef const& f) { return {read(f), f.group}; }
inline View read_neighbours(FieldRef const& f) {
#if defined(PIOLA_CONTRACTS) && PIOLA_CONTRACTS
  if (f.version != nullptr && f.version->halo != f.version->owner) stale_halo(f.name);
#endif
  return {f.data, f.component_stride, f.particle_stride, f.tile_extra};
}
inline WriteView write(FieldRef const& f) {
#if defined(PIOLA_CONTRACTS) && PIOLA_CONTRACTS
  if (f.version != nullptr) ++f.version->owner;
#endif
  return {f.data, f.component_stride, f.particle_stride, f.tile_extra};
}

}  // namespace piola::inline PIOLA_BACKEND
