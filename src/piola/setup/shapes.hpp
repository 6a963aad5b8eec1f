// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace piola {

class SolidParticles;
struct PointCloud;

/// A file that a case names, and where it is.
struct CaseFile {
  std::string given;
  std::filesystem::path path;
};

/// Settings of the case file for the shape of a body. Lengths in m. The number of components that the user gave for
/// `min`/`centre` is the dimension (1, 2 or 3).
struct ShapeSpec {
  enum class Kind { box, sphere, cylinder, solid, points };
  enum class Placement { on_boundary, cell_centred };
  enum class Arrangement { lattice, rings, lattice_with_rings, packed };
  Kind kind = Kind::box;
  int dimension = 3;
  bool axisymmetric = false;                       ///< a half section: x is the radius
  std::array<double, 3> min{}, max{};              ///< box
  std::array<double, 3> centre{};                  ///< sphere (2D: disc); cylinder: centre of the lower end
  double radius = 0;                               ///< sphere, cylinder
  double inner_radius = 0;                         ///< sphere, cylinder: of the hole; 0: none
  Arrangement arrangement = Arrangement::lattice;  ///< sphere in 2D; solid
  double length = 0;                               ///< cylinder
  int axis = 2;                                    ///< cylinder: 0 x, 1 y, 2 z
  std::array<int, 3> particles{1, 1,
                               1};  ///< box: particles per direction (already derived from spacing if that was given)
  double spacing = 0;               ///< sphere, cylinder, solid
  geometry::SolidPtr solid{};       ///< solid: the region
  double volume = 0;                ///< solid: of it [m^dimension]
  std::shared_ptr<SolidParticles> solid_particles{};  ///< solid: never null
  std::shared_ptr<PointCloud const> cloud{};          ///< kind points: in the order of the file
  std::vector<CaseFile> files{};                      ///< that it was read from
  std::vector<std::string> notes{};                   ///< on these files
  Placement placement = Placement::on_boundary;       ///< box, and cylinder along its axis; the rest is cell centred
  bool random = false;                                ///< box, on_boundary: inner particles at random, then relaxed
  double jitter = 0;       ///< random shift of each inner particle, as a fraction of the spacing
  std::uint32_t seed = 1;  ///< of the jitter or of the random places
};

/// Number of particles that `fill` would create, without creating them: exact for a box and up to about 1e8, an
/// estimate beyond.
std::int64_t count_particles(ShapeSpec const& shape);

/// Lattice spacing of the body [m]; 1 for dimensions that do not exist.
std::array<double, 3> spacing_of(ShapeSpec const& shape);

/// Particles over a length that come closest to the wanted spacing: length/spacing + 1 with particles on both ends,
/// length/spacing if they sit in the middle of cells.
int particles_over(double length, double spacing, ShapeSpec::Placement placement);

/// Appends a body's particles to the set, x fastest, then y, then z.
///  - Box, on_boundary: n points over a length l have the spacing l/(n-1) and lie on both faces; the tributary volume
///    is 1/2 of a cell at faces, 1/4 at edges, 1/8 at corners. A direction with one particle has the whole length as
///    its spacing, the particle in the middle, and counts as a full cell.
///  - Box, cell_centred: spacing l/n, every particle a full cell.
///  - Sphere (2D: disc, 1D: interval) and cylinder: the cells of a lattice, symmetric about the centre, whose middle
///    lies inside. Every particle is a full cell, so the body's volume is that of its staircase, not the exact one;
///    along the axis of a cylinder the spacing is fitted to the length, and on_boundary puts particles of half a cell
///    on its ends. With an inner radius, cells whose middle is nearer to the centre (or the axis) than that are left
///    out.
///  - Disc (2D), rings: a particle in the centre and n = radius/spacing circles of radius i * spacing, i = 1..n, with
///    round(2 pi i) particles each, all of the volume spacing^2; the last circle is at the radius.
///  - Disc, lattice_with_rings: the square lattice points i^2 + j^2 < (n-2)^2 about the centre, and circles n-1 and n
///    with floor(2 pi i) particles each, all of the volume spacing^2.
///  - Disc with an inner radius, rings: a polar grid of n = (radius - inner_radius)/spacing circles in the middle of
///    equal widths d, each of round(2 pi r/d) particles, r the mean radius; volumes are those of the sectors.
///    Circles start at the angle 0, the x axis. Ids run along the circles, from the innermost one outwards; such bodies
///    are not regular, and their kernel volumes are their volumes.
///  - Solid, packed: round(volume/spacing^dimension) particles of equal volumes that sum to the solid's, pushed apart
///    until they fill it evenly (geometry/packing.hpp); ids run cell by cell. Kernel volumes are the volumes.
///  - Solid, lattice: the cells of a lattice about the middle of its box whose middle lies inside, all full.
///  - Points: as read from a file; such a body has no outline.
/// Tributary volumes of a box sum to its exact volume; kernel volumes are the product of the spacings.
///  - Axisymmetric: discs are cut at the axis x = 0; volumes are those of rings, the full circle.
/// Jitter moves particles that are not on a face of the body by up to jitter * spacing in each direction; the same seed
/// gives the same particles on every machine.
void fill(ShapeSpec const& shape, std::string const& name, ParticleSet& set);

}  // namespace piola
