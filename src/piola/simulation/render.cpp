// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/render.hpp"
#include "piola/base/problems.hpp"
#include "piola/output/files.hpp"
#include "piola/output/frames.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_summary_bytes = 100'000'000;

std::string title_of(fs::path const& folder) {
  if (!fs::exists(folder / "summary.json")) return folder.filename().string();
  auto const summary =
      nlohmann::json::parse(read_text_file(folder / "summary.json", most_summary_bytes), nullptr, false);
  bool const titled = summary.is_object() && summary.contains("title") && summary["title"].is_string();
  return titled ? summary["title"].get<std::string>() : folder.filename().string();
}

/// What all frames have in common: the window and the range of values.
struct Survey {
  Window window;
  std::array<double, 2> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

View view_of(Frame const& frame, View const& asked) { return frame.dimension < 3 ? View{0, 0} : asked; }

void look_at(Survey& survey, Frame const& frame, View const& view) {
  auto const radii = ball_radii(frame.volume, frame.body, frame.dimension);
  survey.window.include(view_of(frame, view), frame.points,
                        radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end()));
  auto const range = typical_range(picture_values(frame.values, frame.info.components));
  survey.range = {std::min(survey.range[0], range[0]), std::max(survey.range[1], range[1])};
}

}  // namespace

std::vector<fs::path> render_frames(fs::path const& folder, RenderOptions const& options,
                                    std::function<void(fs::path const&)> const& drawn) {
  if (!fs::exists(folder / "frames.hdf.series")) {
    throw InputError(
        fmt::format("{}: has no frames to draw (no frames.hdf.series) - run the case with output.frames.every set",
                    folder.string()));
  }
  auto const frames = list_frames(folder);
  Survey survey;
  for (auto const& entry : frames) look_at(survey, read_frame(entry.second, options.field), options.view);

  make_folder(folder / "pictures");
  std::string const title = title_of(folder);
  std::vector<fs::path> paths;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    Frame const frame = read_frame(frames[k].second, options.field);
    auto const radii = ball_radii(frame.volume, frame.body, frame.dimension);
    auto const values = picture_values(frame.values, frame.info.components);
    PictureData const data{frame.points,    radii, values,     picture_label(options.field, frame.info.components),
                           frame.info.unit, title, frame.time, frame.dimension};
    PictureStyle const style{options.width, options.height, view_of(frame, options.view),
                             options.range ? *options.range : survey.range};
    paths.push_back(folder / "pictures" / fmt::format("{}-{:06}.png", options.field, k));
    write_png(paths.back(), draw_picture(data, style, survey.window));
    if (drawn) drawn(paths.back());
  }
  return paths;
}

}  // namespace piola
