// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_facts.hpp"
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// What a run is judged by before it starts.
struct Prospect {
  double step = 0;  ///< expected time step [s]
  /// Energies at the start; nothing where the formulation was not built, or knows no contact.
  std::optional<Diagnostics> start = {};
};

/// The largest fraction of the energy at the start that contact may hold.
inline constexpr double largest_unpaid_contact = 0.01;
/// Throws InputError if the contact of a formulation holds more of the energy at the start than that, which nothing has
/// paid for, unless the case names a law of contact or nothing moves at the start.
void refuse_unpaid_contact(CaseSpec const& spec, ParticleSet const& particles, Diagnostics const& start);

/// All that looks odd about a case that can run: slips of units, settings without effect, laws that lock or cannot
/// fail, bodies that touch or cannot touch. One sentence each, "file:line:column: what (what is usual) - what to do",
/// in the order of the file. What `piola check` shows, and `piola run` tells and writes to summary.json and log.txt.
std::vector<std::string> warnings_of(CaseSpec const& spec, Assembly const& assembly, Prospect const& prospect);

}  // namespace piola
