// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/simulation/moment.hpp"
#include <optional>

namespace piola {

/// The first formula of a load, a driven support or a driven rigid shape that was no finite number around the last
/// step, as the cause of a failure: its text, t and X. Nothing if all are finite. Cost: a few evaluations per particle
/// that a formula acts on.
std::optional<Failure> failure_of_formula(CaseSpec const& spec, ParticleSet const& particles, Moment const& moment);

}  // namespace piola
