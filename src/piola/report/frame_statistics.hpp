// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/frame_reader.hpp"
#include "piola/report/frame_codec.hpp"
#include "piola/report/run_folder.hpp"
#include <array>
#include <span>
#include <string>
#include <vector>

namespace piola::report {

/// A field as a page shows it: one number per particle, as in pictures (vectors by their length, stresses by von
/// Mises').
struct ShownField {
  FieldInfo info;
  std::string label = {};                            ///< "von Mises stress"
  ByteScale scale = {};                              ///< half a per cent of all values lies below it, and above
  std::vector<std::array<double, 2>> extremes = {};  ///< least and largest of each frame, nan if it has none
};

/// Data of all frames of a run that are required to code any of them.
struct FrameStatistics {
  int dimension = 3;
  bool axisymmetric = false;  ///< half sections
  std::size_t particles = 0;
  std::vector<std::size_t> frames = {};               ///< numbers of the frames that were read
  std::vector<double> times = {};                     ///< of these frames [s]
  std::vector<std::vector<double>> rigid_poses = {};  ///< in each, see FrameReader::rigid_poses()
  std::vector<ShownField> fields = {};
  std::array<double, 3> low{}, high{};              ///< the box that the page shows [m]
  std::array<double, 3> first_low{}, first_high{};  ///< the box of the first frame [m]
  std::vector<std::uint16_t> body = {};             ///< of each particle
  std::vector<double> radius = {};                  ///< of the balls of each body [m]
  std::size_t outside = 0;  ///< particles that leave the box at some time, counted in the frame with most of them
};

/// Numbers of `wanted` of `count` frames, evenly, the first and the last among them.
std::vector<std::size_t> spread(std::size_t count, std::size_t wanted);

/// The most informative fields of a frame, at most `most`. `first`: the field placed before all.
std::vector<std::string> usual_fields(FrameReader const& frame, std::string const& first, std::size_t most);

/// Reads frames. Throws FileError if one is damaged or has other particles than the first, InputError for a field
/// that they do not have.
FrameStatistics read_statistics(RunFolder const& run, std::vector<std::size_t> const& frames,
                                std::vector<std::string> const& fields);

/// One value per particle, see ShownField.
std::vector<float> shown_values(FrameReader const& frame, FieldInfo const& info);

/// The codes of a frame: of every `every`-th particle, with these fields of the statistics.
FrameCodes codes_of(FrameReader const& frame, FrameStatistics const& statistics, Lattice const& lattice,
                    std::size_t fields, std::size_t every);

}  // namespace piola::report
