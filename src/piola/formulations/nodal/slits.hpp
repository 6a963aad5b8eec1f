// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/scaled_body.hpp"
#include <functional>
#include <optional>

namespace piola::nodal {

/// Whether the line between two particles of the body, by slot, crosses a slit; empty: none does, as far as is known.
/// Keeps references to both.
std::function<bool(std::size_t, std::size_t)> lines_across_slits(SetUp const& from, ScaledBody const& scaled);

/// As scaled_body(), where facets that a slit goes through are surface. Measured cells do not show slits narrower than
/// about a fifth of a spacing.
ScaledBody body_with_slits(SetUp const& from, std::optional<LatticeShape> const& lattice);

}  // namespace piola::nodal
