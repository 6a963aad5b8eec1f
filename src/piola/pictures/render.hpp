// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/pictures/picture_overrides.hpp"
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace piola {

struct RenderOptions {
  std::string field = "Pressure";
  std::optional<std::array<double, 2>> range = {};  ///< SI; otherwise the range over all frames
  PictureOverrides look = {};
  std::string component = {};                 ///< see find_component
  std::filesystem::path out = {};             ///< folder of the pictures; empty: `pictures` in the folder of the run
  std::vector<std::size_t> only = {};         ///< numbers of the frames to draw; empty: all
  bool last = false;                          ///< draw the last one
  std::size_t every = 1;                      ///< every `every`-th frame
  std::vector<std::string> more_fields = {};  ///< drawn in adjacent panels, each with its own colours
  /// Folders of other runs, whose frames nearest in time are drawn in adjacent panels, with one range and one scale.
  std::vector<std::filesystem::path> beside = {};
  std::vector<std::string> as = {};  ///< "skin" for all bodies, "BODY=balls" for one, in addition to the case
  bool panels = false;               ///< draw the panels of the case instead of the field
};

/// Draws frames of a run to FIELD-000000.png, or FIELD-x-000000.png of a component, with the number of the frame,
/// including the rigid shapes of the case. All frames have one colour range and one window. Returns the paths. Throws
/// FileError, or InputError if there are no frames, no such frame, field or component.
std::vector<std::filesystem::path> render_frames(std::filesystem::path const& folder, RenderOptions const& options);

/// Draws the frames nearest to these times [s] into one picture, FIELD-times.png, with one bar. Returns its path.
/// Throws as render_frames does.
std::filesystem::path render_times(std::filesystem::path const& folder, RenderOptions const& options,
                                   std::vector<double> const& times);

/// Options of a film of a run, see Film and FilmPace.
struct FilmOptions {
  std::filesystem::path file;                      ///< NAME.webp or NAME.mp4
  std::optional<double> pictures_per_second = {};  ///< else 20, or as given by `seconds`
  std::optional<double> seconds = {};              ///< duration without the hold at the end
  double hold_end = 1;                             ///< s
};

/// Draws the selected frames to a film, at equal steps of simulated time: one picture per frame, unless both rate and
/// length are given; then the nearest frame is shown at each step. Returns the number of pictures. Throws as
/// render_frames and Film do.
std::size_t render_film(std::filesystem::path const& folder, RenderOptions const& options, FilmOptions const& film);

}  // namespace piola
