// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/look.hpp"
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
  LookOptions look = {};
  std::string component = {};                 ///< see find_component
  std::filesystem::path out = {};             ///< folder of the pictures; empty: `pictures` in the folder of the run
  std::vector<std::size_t> only = {};         ///< numbers of the frames to draw; empty: all
  bool last = false;                          ///< draw the last one
  std::size_t every = 1;                      ///< each so many
  std::vector<std::string> more_fields = {};  ///< drawn beside the first one, each with its own colours
  /// Folders of other runs, whose frames nearest in time are drawn beside, with one range and one scale.
  std::vector<std::filesystem::path> beside = {};
  std::vector<std::string> as = {};  ///< "skin" for all bodies, "BODY=balls" for one: besides what the case says
  std::optional<CutPlane> cut = {};  ///< instead of that of the case
  bool panels = false;               ///< what the panels of the case show, in place of the field
  bool outline = true;               ///< false: none, whatever the case says
};

/// Draws frames of a run to FIELD-000000.png, or FIELD-x-000000.png of a component, with the number of the frame; with
/// the rigid shapes of the case. One range and one window, those of all frames, so that pictures drawn one by one
/// belong together. `drawn` is told of each. Returns the paths. Throws FileError, or InputError if there are no frames,
/// no such frame, field or component.
std::vector<std::filesystem::path> render_frames(std::filesystem::path const& folder, RenderOptions const& options,
                                                 std::function<void(std::filesystem::path const&)> const& drawn = {});

/// Draws the frames nearest to these times [s] into one picture, FIELD-times.png, with one bar. Returns its path.
/// Throws as render_frames does.
std::filesystem::path render_times(std::filesystem::path const& folder, RenderOptions const& options,
                                   std::vector<double> const& times);

/// What a film of a run is like, see Film and FilmPace.
struct FilmOptions {
  std::filesystem::path file;                      ///< NAME.webp or NAME.mp4
  std::optional<double> pictures_per_second = {};  ///< else 20, or as many as `seconds` ask for
  std::optional<double> seconds = {};              ///< how long it is, without the end that is held
  double hold_end = 1;                             ///< s
};

/// Draws the frames that the options choose to a film, at equal steps of simulated time: one picture per frame, unless
/// both rate and length are given; then the nearest frame is shown at each step. Returns the number of pictures. Throws
/// as render_frames and Film do.
std::size_t render_film(std::filesystem::path const& folder, RenderOptions const& options, FilmOptions const& film);

}  // namespace piola
