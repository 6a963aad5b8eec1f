// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace piola {

/// Derived facts of a body of a case, in SI units.
struct BodyProperties {
  std::string name;
  std::int64_t particles = 0;
  std::array<double, 3> spacing{};
  std::array<int, 3> lattice{};
  double mass = 0;               ///< kg (per unit thickness or section in 2D and 1D)
  double p_wave = 0;             ///< speed of pressure waves at rest [m/s]
  double s_wave = 0;             ///< speed of shear waves at rest [m/s]; 0 if the law has none
  double largest_speed = 0;      ///< of the initial velocity [m/s]
  std::array<double, 3> size{};  ///< edges of the box around its particles [m]
  double modulus = 0;            ///< of pressure waves, rho c^2, at rest; of parts the largest [Pa]
  double yield = std::numeric_limits<double>::infinity();  ///< yield stress at the start; of parts the least [Pa]
};

std::vector<BodyProperties> body_properties(CaseSpec const& spec, ParticleSet const& particles);

/// Yield stress of the material at rest, at its initial temperature [Pa]; infinity if it does not yield.
double yield_at_start(MaterialParameters const& material);
/// [m]
double smallest_spacing(BodyProperties const& body, int dimension);

/// Step that waves at rest allow: cfl * smallest spacing / largest wave speed [s]. What the formulation really takes
/// may be smaller.
double step_estimate(CaseSpec const& spec, std::vector<BodyProperties> const& facts);

/// Reports allowed but implausible numbers (units, a missing zero, a body too thin) by the rules of
/// input/plausibility.hpp, one sentence each with its place in the file. `step` is the expected time step [s].
void find_implausible_values(CaseSpec const& spec, ParticleSet const& particles,
                             std::vector<BodyProperties> const& facts, double step, Problems& slips);
/// The part of find_implausible_values() for loads, driven supports and driven shapes.
void find_implausible_loads(CaseSpec const& spec, ParticleSet const& particles,
                            std::vector<BodyProperties> const& facts, Problems& slips);

}  // namespace piola
