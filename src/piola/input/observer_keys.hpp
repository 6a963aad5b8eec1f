// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/bound_keys.hpp"
#include "piola/input/case_spec.hpp"
#include <span>
#include <string_view>

/// Rows of the schema of probes and quantities. Order: that of the manual.
namespace piola {

/// Kinds of probes as bits.
template <class... Kinds>
constexpr unsigned kinds_of_probe(Kinds... kinds) {
  return ((1U << static_cast<unsigned>(kinds)) | ...);
}

/// A key of [[probe]], and which kinds use it.
struct ProbeKey {
  BoundKey<ProbeSpec> row;
  unsigned kinds = ~0U;                   ///< see kinds_of_probe
  std::string_view needed_for = {};       ///< these kinds need it, for this; empty: they may leave it out
  std::string_view example = "\"1 mm\"";  ///< for the message that it is missing

  bool is_used_by(ProbeKind kind) const { return (kinds & kinds_of_probe(kind)) != 0; }
};
std::span<ProbeKey const> probe_keys();
std::span<BoundKey<QuantitySpec> const> quantity_keys();

}  // namespace piola
