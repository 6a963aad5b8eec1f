// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"

namespace piola::inline PIOLA_MACHINE {

/// Brings the copies of neighbours that other ranks own up to date. On one rank there are none: only the count that
/// finds forgotten refreshes is kept.
struct Halo {
  template <class... Ref>
  void refresh(Ref const&... fields) const {
    (mark(fields), ...);
  }

 private:
  static void mark(FieldRef const& f) {
    if (f.version != nullptr) f.version->halo = f.version->owner;
  }
};

}  // namespace piola::inline PIOLA_MACHINE
