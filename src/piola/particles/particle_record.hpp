// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/particle_set.hpp"
#include <string>

namespace piola {

/// Fingerprint of the particles in reference configuration for checkpoints: a line per body with its name, its number
/// of particles, and hashes of positions, volumes, and parts with sides of cracks.
std::string particle_record(ParticleSet const& particles);

/// Describes the differences between two records: "body \"b\": 1200 particles, not 1300"; empty if they are equal.
std::string particle_difference(std::string const& before, std::string const& now);

}  // namespace piola
