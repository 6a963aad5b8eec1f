// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/model/body_properties.hpp"
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// Expected values of a run before its start.
struct StartEstimate {
  double step = 0;  ///< expected time step [s]
  /// Energies at the start; empty if the formulation was not built, or has no contact.
  std::optional<Diagnostics> start = {};
};

/// The largest fraction of the initial energy that contact may store at the start.
inline constexpr double largest_unpaid_contact = 0.01;
/// Throws InputError if the contact of a formulation stores more of the initial energy than that, without work done for
/// it, unless the case names a law of contact or nothing moves at the start.
void refuse_unpaid_contact(CaseSpec const& spec, ParticleSet const& particles, Diagnostics const& start);

/// Warnings about a valid case: wrong units, settings without effect, laws that lock or cannot fail, bodies that are or
/// cannot be in contact. One sentence each, "file:line:column: what (what is usual) - what to do", in the order of the
/// file. Shown by `piola check` and `piola run`, which also writes them to summary.json and log.txt.
std::vector<std::string> warnings_of(CaseSpec const& spec, Assembly const& assembly, StartEstimate const& prospect);

}  // namespace piola
