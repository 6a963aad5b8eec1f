// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/picture.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/output/frame_reader.hpp"
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace piola {

/// The upward direction in the pictures of a case: output.pictures.up; else against gravity (a constant acceleration
/// along an axis of all particles of a body); else the outward normal of a resting rigid plane across an axis; else y.
Up upwards(CaseSpec const& spec);

/// The rigid shapes of a case at a time [s]. Free or rotating shapes have the poses of FrameReader::rigid_poses();
/// those without one stand as at the start.
std::vector<RigidShape> shapes_at(std::vector<RigidSpec> const& rigids, double time,
                                  std::span<double const> poses = {});

/// The panels of a case, or its picture alone.
std::span<PictureSpec const> panels_of(PicturesSpec const& pictures);

/// Upwards, if the picture shows a ground below the bodies: see PictureData::ground.
std::optional<Point3> ground_of(CaseSpec const& spec, PictureSpec const& picture);

/// The angle through which a picture sweeps half sections [deg], see PictureData::swept; nothing: other bodies. Throws
/// InputError if a picture asks for it without axisymmetric bodies, or beside a cut.
std::optional<double> sweep_of(PictureSpec const& picture, bool axisymmetric);

/// Number of dimensions of a picture of bodies of `dimension` dimensions.
int dimension_shown(std::optional<double> const& swept, int dimension);

/// The title of a picture: that of the case, with the magnification of displacements.
std::string title_of(std::string const& title, PictureSpec const& picture);

/// Positions with displacements magnified by `warp` [m]: X + warp (x - X).
std::vector<std::array<double, 3>> warped(std::span<std::array<double, 3> const> x,
                                          std::span<std::array<double, 3> const> X, double warp);

/// Per particle: whether supports of the case hold it, in some direction at some time.
std::vector<std::uint8_t> held_particles(CaseSpec const& spec, ParticleSet const& particles);

/// Per body: torn cells of its mesh, see torn_cells. `before`: those of the moment before; empty: none.
std::vector<std::vector<Index>> current_torn_cells(std::span<ReferenceMesh const> meshes,
                                                   std::span<std::array<double, 3> const> points,
                                                   std::span<std::uint8_t const> loose,
                                                   std::vector<std::vector<Index>> const& before);

/// Per particle: whether it has permanently lost its neighbours: damage 1, or Eulerian (kernel type 1). Empty spans:
/// none.
std::vector<std::uint8_t> loose_particles(std::span<double const> damage, std::span<double const> kernel_type,
                                          std::size_t particles);
/// Per particle of a frame: whether it has permanently lost its neighbours.
std::vector<std::uint8_t> loose_particles(FrameReader const& frame);

}  // namespace piola
