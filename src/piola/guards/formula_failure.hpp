// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/observers/time_state.hpp"
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// The first formula of a load, a driven support or a driven rigid shape that is not finite around the last step, as
/// the cause of a failure: its text, t and X. Empty if all are finite. Cost: a few evaluations per particle with a
/// formula.
std::optional<Failure> failure_of_formula(CaseSpec const& spec, ParticleSet const& particles, TimeState const& moment);

/// The tables among the values of loads, driven supports and rigid shapes: 'load on body "bar": traction: table ...'.
std::vector<std::string> notes_of_tables(CaseSpec const& spec);

}  // namespace piola
