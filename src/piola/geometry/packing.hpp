// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace piola::geometry {

/// A packing that was stopped. pack() continues from it to the same places, bit for bit, as without the stop.
struct UnfinishedPacking {
  std::vector<std::array<double, 3>> X;         ///< places [m]
  std::vector<std::array<double, 3>> listed;    ///< places when neighbours were last looked for [m]
  std::vector<std::array<double, 3>> known_at;  ///< places at which the surface was last looked for [m]
  std::vector<double> away;                     ///< least distance of those from the surface [m]
  int sweeps = 0;                               ///< done
};

/// Particles that fill a solid evenly, their outermost layer half a spacing inside.
struct Packing {
  std::vector<std::array<double, 3>> X;  ///< [m]
  double volume = 0;                     ///< of each: that of the solid over their number [m3; 2D m2]
  double spacing = 0;                    ///< volume^(1/dimension) [m]
  int sweeps = 0;
  std::optional<UnfinishedPacking> unfinished = {};  ///< where `progress` has ended the packing early
};

struct PackingOptions {
  int sweeps = 100;  ///< at most
  /// Called after each sweep with the number of sweeps done; false ends the packing early.
  std::function<bool(int)> progress = {};
  /// State to continue from; nothing: start. Precondition: same solid, volume and spacing, and one value per particle
  /// in each array.
  std::optional<UnfinishedPacking> from = {};
};

/// Number of particles: the volume over that of a spacing, rounded; may be beyond what memory holds.
double packed_count(double volume, double spacing, int dimension);

/// Packs n = packed_count(volume, spacing) particles. They start on the places of a lattice that lie deepest inside and
/// are pushed apart by a constant pressure, as in Zhu et al. (J. Hydrodyn. 33, 2021) and Neher et al. (arXiv
/// 2506.21206, 2025); the kernel support outside is completed by the exact integral of W n over the surface. The
/// positions do not depend on the number of threads.
Packing pack(Solid const& solid, double volume, double spacing, PackingOptions const& options = {});

/// How good a packing is.
struct PackingQuality {
  double nearest_least = 0, nearest_mean = 0;  ///< distance to the nearest particle, in spacings
  double in_place = 0;  ///< fraction of the outer layer (depth below 0.9 spacings) at half a spacing, to 0.02
  double gap = 0;       ///< largest distance of the surface from a particle, in spacings
};
PackingQuality quality_of(Solid const& solid, Packing const& packing);

}  // namespace piola::geometry
