// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/mechanics/contact/surface_mirror.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola {

/// An assembly whose bodies are continued behind their mirror planes, as far as surface contact near a plane reaches.
/// Surface points behind a plane are marked as images; a mirror face is no surface. Images follow the particles of
/// their body, so ids differ from those of the run.
struct MirroredAssembly {
  explicit MirroredAssembly(Assembly const& whole);

  /// The particle x' = sign x + shift, component by component, stands for the particle `id` of the run.
  struct Origin {
    std::int64_t id = 0;
    std::array<double, 3> sign{1, 1, 1}, shift{};
    bool image = false;
  };
  /// A particle of the run that lies on a plane never leaves it.
  struct OnPlane {
    std::int64_t id;
    int axis;
  };

  Origin origin(std::int64_t id_here) const {
    if (origins.empty()) return {id_here, {1, 1, 1}, {0, 0, 0}, false};
    return origins[static_cast<std::size_t>(id_here)];
  }

  Assembly assembly;
  std::vector<Origin> origins;  ///< by id in `assembly`; empty: no mirrors, all as in the run
  std::vector<OnPlane> on_planes;
  std::vector<std::vector<contact::SurfaceMirror>> mirrors;  ///< by body; empty: none
};

}  // namespace piola
