// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include "piola/simulation/estimate.hpp"
#include <array>

namespace piola {

/// Whether bodies may tell all ranks more than each of them does alone: they meet, or there are several.
bool may_meet(CaseSpec const& spec);

/// A case made anew with about these numbers of particles.
inline constexpr std::array<double, 2> coarse_cases{10e3, 40e3};

/// What bodies that meet tell all ranks in a step, in place of what each would alone, for a case that is too large to
/// be built for a look: the whole case is built twice with coarser particles, and what each body tells is continued as
/// the power of its number of particles that goes through both. Throws InputError for particles that cannot be made
/// coarser (packed ones, those of files), and for what the formulations refuse there.
void count_meetings(CaseSpec const& spec, ParticleSet const& particles, Estimate& cost,
                    std::array<double, 2> const& sizes = coarse_cases);

}  // namespace piola
