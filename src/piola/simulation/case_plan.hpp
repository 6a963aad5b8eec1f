// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_facts.hpp"
#include "piola/simulation/estimate.hpp"
#include <string>
#include <vector>

namespace piola {

/// What a case would run, what that would take and what looks odd.
struct CasePlan {
  CaseSpec spec;
  ParticleSet particles;
  std::vector<BodyFacts> facts;
  Estimate cost;
  std::vector<std::string> warnings;  ///< as warnings_of()
  std::vector<std::string> left_out;  ///< what was too long for a look, one sentence each
};

/// Builds the case, or parts of it from `large_case` particles on, and takes trial steps. Throws InputError for what
/// the formulation refuses. `reading_seconds`: wall time that reading and particles took; counts as set-up.
CasePlan plan_of_case(CaseSpec spec, ParticleSet particles, double reading_seconds);

/// The plan for scripts: one JSON object, SI units, which the names of keys end with.
std::string plan_json(CasePlan const& plan);

}  // namespace piola
