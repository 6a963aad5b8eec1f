// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/frame_reader.hpp"
#include "piola/output/skin.hpp"
#include "piola/report/frame_code.hpp"
#include "piola/report/run_folder.hpp"
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace piola::report {

/// What bodies look like in one frame; numbers of particles are those of the run.
struct BodySurfaces {
  std::vector<Place3> place;  ///< of each particle: at the surface where it has a part in it [m]
  std::vector<std::array<std::uint32_t, 3>> facets;
  std::vector<std::uint8_t> alone;  ///< per particle: belongs to no surface, not 0: seen as a ball
};

/// How the particles of a run hang together at its start, from its case: what surfaces and stretched balls need.
class BodyShapes {
 public:
  static constexpr std::size_t stretch_components = 6;
  /// Of the particles whose bodies are `body`; nothing if the case in the folder cannot be read any more, or makes
  /// other particles.
  static std::optional<BodyShapes> of(RunFolder const& run, int dimension, std::vector<std::uint16_t> const& body);

  /// Finds which cells are torn in each frame of the run, in the order of time, as pictures of all frames have it.
  void follow(RunFolder const& run);
  /// What pictures show of a frame that was followed; of another one, as if it were the first.
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
