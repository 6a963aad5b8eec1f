// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/estimates/estimate.hpp"
#include "piola/model/body_properties.hpp"
#include <string>
#include <vector>

namespace piola {

/// Plan of a run: content, cost and warnings of a case.
struct CasePlan {
  CaseSpec spec;
  ParticleSet particles;
  std::vector<BodyProperties> facts;
  Estimate cost;
  std::vector<std::string> warnings;  ///< as in warnings_of()
  std::vector<std::string> left_out;  ///< checks omitted because they take too long, one sentence each
};

/// Builds the case, or parts of it from `large_case` particles on, and takes trial steps. Throws InputError if the
/// formulation rejects the case. `reading_seconds`: wall time of reading and particle generation, added to set-up.
CasePlan plan_of_case(CaseSpec spec, ParticleSet particles, double reading_seconds);

/// The plan for scripts: one JSON object in SI units; keys end with their unit.
std::string plan_json(CasePlan const& plan);

}  // namespace piola
