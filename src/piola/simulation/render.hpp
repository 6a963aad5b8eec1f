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
  View view = {};
  int width = 1000, height = 800;
};

/// Draws every frame of a finished run to pictures/FIELD-000000.png, all with one range and one window. `drawn` is told
/// of each. Returns the paths. Throws FileError, or InputError if there are no frames or no such field.
std::vector<std::filesystem::path> render_frames(std::filesystem::path const& folder, RenderOptions const& options,
                                                 std::function<void(std::filesystem::path const&)> const& drawn = {});

}  // namespace piola
