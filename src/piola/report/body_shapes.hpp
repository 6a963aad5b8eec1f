// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/skin.hpp"
#include "piola/output/frame_reader.hpp"
#include "piola/report/frame_codec.hpp"
#include "piola/report/run_folder.hpp"
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace piola::report {

/// Surfaces of the bodies in one frame. Particles are numbered as in the run.
struct BodySurfaces {
  std::vector<Point3> place;  ///< of each particle: at the surface where it has a part in it [m]
  std::vector<std::array<std::uint32_t, 3>> facets;
  std::vector<std::uint8_t> alone;  ///< per particle: belongs to no surface, not 0: seen as a ball
};

/// Reference meshes of the bodies of a run, from its case; for surfaces and stretched balls.
class BodyShapes {
 public:
  static constexpr std::size_t stretch_components = 6;
  /// Builds the meshes. body: body of each particle. Returns nothing if the case in the folder cannot be read or yields
  /// other particles.
  static std::optional<BodyShapes> of(RunFolder const& run, int dimension, std::vector<std::uint16_t> const& body);

  /// Finds which cells are torn in each frame of the run, in the order of time, as for pictures of all frames.
  void find_torn_cells(RunFolder const& run);
  /// Surfaces of a frame as in pictures. A frame that find_torn_cells() has not visited is treated as the first one.
  BodySurfaces surfaces(FrameReader const& frame) const;
  /// V of F = V R for each `every`-th particle, XX YY ZZ XY YZ XZ: what makes an ellipsoid of a ball. Stretches are
  /// bounded as in pictures; particles whose F is unknown have V = I.
  std::array<std::vector<std::uint8_t>, stretch_components> stretches(FrameReader const& frame,
                                                                      std::size_t every) const;
  /// The bytes of a component of V.
  static ByteScale stretch_scale(std::size_t component);

 private:
  explicit BodyShapes(std::vector<ReferenceMesh> meshes) : meshes_(std::move(meshes)) {}
  std::vector<ReferenceMesh> meshes_;
  std::map<double, std::vector<std::vector<Index>>> torn_;  ///< by the time of a frame: of each body, see torn_cells
};

}  // namespace piola::report
