// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include <array>
#include <span>

namespace piola {
class HaloPlan;
void exchange(HaloPlan& plan, std::span<FieldRef const> fields);
}  // namespace piola

namespace piola::inline PIOLA_BACKEND {

/// Computes the values of one copy (see Copies) from its source particle.
struct UpdateCopy {
  FieldRef field;
  Copies copies;
  PIOLA_FN void operator()(Index k) const {
    double const* const sign = copies.sign + copies.transform[k] * copies.values;
    auto const at = [this](Index i, int c) {
      return field.data + c * field.component_stride + i * field.particle_stride + (i >> tile_bits) * field.tile_extra;
    };
    for (int c = 0; c < copies.values; ++c) {
      double const shift = copies.shift == nullptr ? 0 : copies.shift[k * copies.values + c];
      *at(copies.first + k, c) = sign[c] * *at(copies.source[k], c) + shift;
    }
  }
};

/// Updates the ghosts of other ranks, then the copies of a body (mirror images), whose sources may be ghosts. Updates
/// the version that detects forgotten refreshes in contract builds.
struct Halo {
  HaloPlan* plan = nullptr;  ///< nullptr: one rank

  /// Collective if `plan` is set. Updates the ghosts and copies of all `fields`, with one message per neighbouring
  /// rank.
  template <class... Ref>
  void refresh(Ref const&... fields) const {
    if (plan != nullptr) piola::exchange(*plan, std::array<FieldRef, sizeof...(Ref)>{fields...});
    (update(fields), ...);
  }

 private:
  static void update(FieldRef const& f) {
    if (f.copies != nullptr) exec::for_each_item(f.copies->count, UpdateCopy{f, *f.copies});
    if (f.version != nullptr) f.version->halo = f.version->owner;
  }
};

}  // namespace piola::inline PIOLA_BACKEND
