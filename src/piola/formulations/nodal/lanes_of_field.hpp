// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field_view.hpp"

/// Reads many components of a field at once.
namespace piola::nodal::inline PIOLA_BACKEND {

/// Components of a group of lanes that are contiguous in memory; the layout is evaluated once, not per component.
struct LanesOfField {
  double const* data;
  std::ptrdiff_t component_stride;
  PIOLA_INLINE_FN Lanes operator[](int c) const { return load<Lanes>(data + c * component_stride); }
};
PIOLA_INLINE_FN LanesOfField lanes_of(View const& v, Index i) {
  return {v.data + i * v.particle_stride + (i >> tile_bits) * v.tile_extra, v.component_stride};
}
PIOLA_INLINE_FN LanesOfField lanes_of(ReferenceView const& v, Index i) { return lanes_of(v.stored, v.place(i)); }

}  // namespace piola::nodal::inline PIOLA_BACKEND
