// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/particle_set.hpp"
#include <string>

namespace piola {

/// What a checkpoint keeps of the particles in reference configuration, to tell them from others: a line for each body
/// with its name, its number of particles, and hashes of positions, volumes, and parts with sides of cracks.
std::string particle_record(ParticleSet const& particles);

/// What differs between two records, in words: "body \"b\": 1200 particles, not 1300"; empty if nothing does.
std::string particle_difference(std::string const& before, std::string const& now);

}  // namespace piola
