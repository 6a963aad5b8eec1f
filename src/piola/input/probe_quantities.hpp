// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/input/history_names.hpp"
#include <span>
#include <string_view>

namespace piola {

/// Quantities that a kind of probe computes, in its order; empty for kinds that sample fields. Volumes of kind fragment
/// assume a thickness of 1 m in 2D.
std::span<HistoryName const> own_quantities(ProbeSpec::Kind kind);

/// SI unit of a quantity of a probe, of a kind's own or of a field; "1" if it is not known.
std::string_view unit_of_probe_quantity(ProbeSpec::Kind kind, std::string_view quantity);

}  // namespace piola
