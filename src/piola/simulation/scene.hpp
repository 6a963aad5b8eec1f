// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/mechanics/rigid_state.hpp"
#include "piola/output/picture.hpp"
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// What points upwards in the pictures of a case: what output.pictures.up says; else against gravity (a constant
/// acceleration along an axis of all particles of a body); else the outward normal of a resting rigid plane across an
/// axis; else y.
Up upwards(CaseSpec const& spec);

/// The rigid shapes of a case as they stand at a time [s]; those that are free or turn as `states` says, where it does:
/// else they stand where they started.
std::vector<RigidShape> shapes_at(std::vector<RigidSpec> const& rigids, double time,
                                  std::vector<RigidState> const& states = {});

/// What a word of representation_words means.
Representation representation_of(std::string_view word);

/// What a picture of a case says of how bodies are drawn.
Appearance appearance_of(CaseSpec const& spec, PictureSpec const& picture);

/// The title of a picture: that of the case, and by how much displacements are enlarged.
std::string title_of(std::string const& title, PictureSpec const& picture);

/// Places with displacements so many times as large [m]: X + warp (x - X).
std::vector<std::array<double, 3>> warped(std::span<std::array<double, 3> const> x,
                                          std::span<std::array<double, 3> const> X, double warp);

/// Which particles the supports of a case hold, in some direction at some time.
std::vector<std::uint8_t> held_particles(CaseSpec const& spec, ParticleSet const& particles);

/// Of each body, which cells of its mesh are torn, see torn_cells. `before`: at the moment before; empty: none were.
std::vector<std::vector<Index>> torn_now(std::span<ReferenceMesh const> meshes,
                                         std::span<std::array<double, 3> const> points,
                                         std::span<std::uint8_t const> loose,
                                         std::vector<std::vector<Index>> const& before);

/// Which particles have lost their neighbours for good: damage 1, or Eulerian (kernel type 1). Empty spans: none.
std::vector<std::uint8_t> loose_particles(std::span<double const> damage, std::span<double const> kernel_type,
                                          std::size_t particles);

}  // namespace piola
