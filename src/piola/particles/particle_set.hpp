// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/copy_on_write_vector.hpp"
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// A small piece of a surface patch, nearly flat, close to some place.
struct PatchFoot {
  int patch = 0;
  std::array<double, 3> X{}, normal{};  ///< its middle [m]; outward unit vector
  double radius = 0;                    ///< about half its extent [m]
};

/// The region that a body fills in its reference configuration.
struct Outline {
  std::array<double, 3> min{}, max{};  ///< the box around it [m]
  /// Whether a point of that box belongs to it; nothing: all do.
  std::function<bool(std::array<double, 3> const&)> inside = {};
  /// Optional signed distance, negative inside, in absolute value at most the true one [m].
  std::function<double(std::array<double, 3> const&)> distance = {};
  /// Optional. Returns the patches of the surface within `reach` [m] of X, each once.
  std::function<std::vector<PatchFoot>(std::array<double, 3> const& X, double reach)> patches = {};
};

/// A body: a contiguous range of particles of one material, generated on a lattice, on rings about a centre, or packed.
struct Body {
  std::string name;
  std::int64_t first = 0, last = 0;  ///< particle ids [first, last)
  std::array<double, 3> spacing{};   ///< lattice spacing [m]; 1 for dimensions that do not exist
  std::array<int, 3> lattice{};      ///< lattice points per direction
  bool regular = true;               ///< positions are exactly on the lattice (no jitter)
  bool off_lattice = false;  ///< not generated on a lattice: `lattice` and the lattice indices only serve to find
                             ///< spatial neighbours
  Outline outline = {};
};

/// A straight crack through a two-dimensional body. Particles on it are doubled, one for each face, except at ends
/// inside the body (tips).
struct Crack {
  int body = 0;                        ///< index into bodies
  std::array<double, 3> from{}, to{};  ///< ends in the reference configuration [m]
  bool tip_at_from = false, tip_at_to = true;
};

/// The particles of a run in Id order, as set-up generates them. Reference data only; evolved fields belong to a
/// formulation. Copies share their arrays (copy_on_write_vector.hpp), so a copy in a formulation costs no memory. All
/// positions have three components; unused ones are zero. Volumes are m^Dim (per unit thickness or section).
/// Axisymmetric bodies have two components, x the radius and y along the axis x = 0; their volumes are those of rings,
/// the full circle [m^3].
struct ParticleSet {
  int dimension = 3;
  bool axisymmetric = false;
  std::vector<Body> bodies;
  CopyOnWriteVector<std::array<double, 3>> X;           ///< reference position [m]
  CopyOnWriteVector<std::array<int, 3>> lattice_index;  ///< position in the body's lattice
  CopyOnWriteVector<double> volume;         ///< tributary volume: mass and quadrature weight; sums to the body's volume
  CopyOnWriteVector<double> kernel_volume;  ///< full volume (spacing product) for kernel sums; see docs/decisions
  CopyOnWriteVector<int> body;              ///< index into bodies
  /// Number of the material within the particle's body: 0 for that of the body, k for its k-th part. Empty: no body has
  /// parts.
  CopyOnWriteVector<int> part;
  std::vector<Crack> cracks;
  /// Side of a crack for particles on its faces: +1 on the left of from -> to, -1 on the right; 0 elsewhere. Empty: no
  /// cracks.
  CopyOnWriteVector<std::int8_t> crack_side;

  std::int64_t size() const { return static_cast<std::int64_t>(X.size()); }
  /// Memory of the arrays, once for all copies.
  std::size_t bytes() const {
    return X.size() * (sizeof(std::array<double, 3>) + sizeof(std::array<int, 3>) + 2 * sizeof(double) + sizeof(int)) +
           crack_side.size() + part.size() * sizeof(int);
  }
};

/// Which of its body's materials a particle has.
inline std::size_t part_of(ParticleSet const& particles, std::size_t id) {
  return particles.part.empty() ? 0 : static_cast<std::size_t>(particles.part[id]);
}

/// The body with this name; null if there is none.
inline Body const* body_named(ParticleSet const& particles, std::string_view name) {
  for (Body const& body : particles.bodies)
    if (body.name == name) return &body;
  return nullptr;
}

}  // namespace piola
