// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/input/history_names.hpp"
#include <span>
#include <string_view>

namespace piola {

/// The numbers that a kind of probe stands for, in the order in which it computes them; empty for the kinds that take
/// any quantities of fields. Those of kind fragment that count volume take a body in 2D as one metre thick.
std::span<HistoryName const> own_quantities(ProbeSpec::Kind kind);

/// SI unit of a quantity of a probe, of a kind's own or of a field; "1" if it is not known.
std::string_view unit_of_probe_quantity(ProbeSpec::Kind kind, std::string_view quantity);

}  // namespace piola
