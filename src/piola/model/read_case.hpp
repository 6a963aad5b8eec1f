// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include "piola/setup/packed_bodies.hpp"
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// Limits for a case.
struct ReadLimits {
  std::int64_t particles = 2147483647;  ///< of all bodies together; Ids fit in 32 bits
  bool memory = true;                   ///< refuse cases that cannot fit into the memory of this machine
  /// The case is that of a results folder: the files that it names are those that its run began with.
  bool of_results = false;
  /// Called after each sweep of a packing with the name of the body and the fraction done.
  std::function<AfterSweep(std::string const&, double)> packing = {};
  std::filesystem::path unfinished = {};  ///< see SolidParticles::unfinished
};

/// Bytes per particle that a run needs at least; used to refuse hopeless cases before any particle is made.
inline constexpr double least_bytes_per_particle = 500;

/// Reads and checks a case file, or the case.toml of a folder (docs/user/case-file.md). `overrides` are settings
/// "path=value" that replace values of the file (see apply_overrides). Throws InputError with every problem that was
/// found, each "file:line:column: what is wrong (what is allowed) - what to do", in the order of the file, or that the
/// file cannot be read.
/// The readers of input/ make the specification; the last checks need particles (make_particles and
/// check_with_particles in model/case_particles.hpp), which are left in `made` if that is given.
CaseSpec read_case(std::filesystem::path const& path, std::vector<std::string> const& overrides = {},
                   ReadLimits const& limits = {}, ParticleSet* made = nullptr);

/// As read_case(), for a text. `name` replaces the file name in messages.
CaseSpec read_case_text(std::string_view text, std::string const& name, std::vector<std::string> const& overrides = {},
                        ReadLimits const& limits = {}, ParticleSet* made = nullptr);

}  // namespace piola
