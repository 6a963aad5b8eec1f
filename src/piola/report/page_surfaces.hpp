// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/report/body_shapes.hpp"
#include "piola/report/frame_statistics.hpp"
#include <cstdint>
#include <vector>

namespace piola::report {

/// Surfaces of all frames of the statistics in the format of a page: particles on a surface at some time, or alone, and
/// lists of triangles, one of which most frames have in common.
struct PageSurfaces {
  std::vector<std::uint32_t> particles = {};           ///< their numbers in the run, rising
  std::vector<std::vector<std::uint32_t>> lists = {};  ///< three places in `particles` for each triangle
  std::vector<std::size_t> list_of = {};               ///< of each frame of the statistics
};

/// Reads the frames of the statistics. Enlarges their box where surfaces extend beyond their particles.
PageSurfaces find_surfaces(RunFolder const& run, BodyShapes const& shapes, FrameStatistics& statistics);

/// Numbers below 2^32 for encode_numbers(): all lower halves, then all upper ones.
std::vector<std::uint8_t> encode_large_numbers(std::vector<std::uint32_t> const& numbers);

}  // namespace piola::report
