// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/picture.hpp"
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace piola {

struct RenderOptions {
  std::string field = "Pressure";
  std::optional<std::array<double, 2>> range = {};  ///< SI; otherwise the range over all frames
  View view = {};                                   ///< its `upwards` counts only if `up` is not "auto"
  int width = 1000, height = 800;
  std::string component = {};          ///< see find_component
  std::string up = "auto";             ///< auto: as the case in the folder has it
  std::filesystem::path out = {};      ///< folder of the pictures; empty: `pictures` in the folder of the run
  std::vector<std::size_t> only = {};  ///< numbers of the frames to draw; empty: all
  bool last = false;                   ///< draw the last one
  std::size_t every = 1;               ///< each so many
  std::vector<std::string> as = {};    ///< "skin" for all bodies, "BODY=balls" for one: besides what the case says
  std::optional<CutPlane> cut = {};    ///< instead of that of the case
  bool outline = true;                 ///< false: none, whatever the case says
};

/// Draws frames of a run to FIELD-000000.png, or FIELD-x-000000.png of a component, with the number of the frame; with
/// the rigid shapes of the case. One range and one window, those of all frames, so that pictures drawn one by one
/// belong together. `drawn` is told of each. Returns the paths. Throws FileError, or InputError if there are no frames,
/// no such frame, field or component.
std::vector<std::filesystem::path> render_frames(std::filesystem::path const& folder, RenderOptions const& options,
                                                 std::function<void(std::filesystem::path const&)> const& drawn = {});

}  // namespace piola
