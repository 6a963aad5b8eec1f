// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/render.hpp"
#include "piola/base/problems.hpp"
#include "piola/input/read_case.hpp"
#include "piola/output/files.hpp"
#include "piola/output/film.hpp"
#include "piola/output/frames.hpp"
#include "piola/output/rigid_picture.hpp"
#include "piola/simulation/rigid_history.hpp"
#include "piola/simulation/scene.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
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

/// The case that the run was started with; nothing if it is not there or cannot be read any more.
std::optional<CaseSpec> case_of(fs::path const& folder) {
  if (!fs::exists(folder / "case.toml")) return std::nullopt;
  try {
    return read_case(folder / "case.toml");
  } catch (InputError const&) {
    return std::nullopt;
  }
}

/// The case with the field, the range and the look asked for; of a run without one, with those alone.
CaseSpec as_asked(std::optional<CaseSpec> const& found, RenderOptions const& options) {
  CaseSpec spec = found.value_or(CaseSpec{});
  spec.output.picture_field = options.field;
  spec.output.picture_range = options.range;
  spec.output = with_look(spec.output, options.look);
  return spec;
}

TimeFormat format_of(std::vector<std::pair<double, fs::path>> const& frames) {
  double const last = frames.empty() ? 0 : frames.back().first;
  return time_format(last,
                     frames.size() < 2 ? last : (last - frames.front().first) / static_cast<double>(frames.size() - 1));
}

std::vector<std::size_t> chosen(RenderOptions const& options, std::size_t count) {
  if (options.last && count > 0) return {count - 1};
  std::vector<std::size_t> numbers = options.only;
  for (std::size_t const k : numbers) {
    if (k < count) continue;
    throw InputError(
        fmt::format("--frame: there is no frame {} (allowed: 0 to {}) - choose one of these", k, count - 1));
  }
  for (std::size_t k = 0; options.only.empty() && k < count; k += std::max<std::size_t>(options.every, 1))
    numbers.push_back(k);
  return numbers;
}

/// Everything that the pictures of one run have in common.
class Renderer {
 public:
  Renderer(fs::path const& folder, RenderOptions const& options)
      : options_(options),
        title_(title_of(folder)),
        spec_(case_of(folder)),
        asked_(as_asked(spec_, options)),
        frames_(list_frames(folder)) {
    if (spec_) rigids_.emplace(folder / "history.csv", spec_->rigids);
    for (auto const& entry : frames_) survey(read(entry.second));
  }
  std::size_t count() const { return frames_.size(); }

  double time(std::size_t number) const { return frames_[number].first; }

  fs::path draw(std::size_t number, fs::path const& folder) const {
    Frame const frame = read(frames_[number].second);
    fs::path path = folder / picture_name(options_.field, frame.info.components, component_of(frame), number);
    write_png(path, picture(frame));
    return path;
  }
  Image picture(std::size_t number) const { return picture(read(frames_[number].second)); }

 private:
  Image picture(Frame const& frame) const {
    int const components = frame.info.components, component = component_of(frame);
    auto const radii = ball_radii(frame.volume, frame.body, frame.dimension);
    auto const values = picture_values(frame.values, components, component);
    auto const shapes = shapes_of(frame);
    PictureData const data{.points = frame.points,
                           .radius = radii,
                           .values = values,
                           .label = picture_label(options_.field, components, component),
                           .unit = frame.info.unit,
                           .title = title_,
                           .time = frame.time,
                           .dimension = frame.dimension,
                           .rigid_shapes = shapes,
                           .stage_low = stage_.low,
                           .stage_high = stage_.high,
                           .spread = spread_,
                           .time_format = format_of(frames_)};
    Camera const camera = camera_for(frame);
    PictureStyle const style = style_of(asked_.output, camera, window_);
    Window const window = shown_window(window_, camera, subject_of(frame, radii));
    return draw_picture(data, style, window);
  }
  Frame read(fs::path const& path) const { return read_frame(path, options_.field); }
  std::vector<RigidShape> shapes_of(Frame const& frame) const {
    if (!spec_) return {};
    return shapes_at(spec_->rigids, frame.time, rigids_->at(frame.time));
  }
  int component_of(Frame const& frame) const {
    if (auto const found = find_component(options_.component, frame.info.components)) return *found;
    auto const known = component_words(frame.info.components);
    throw InputError(fmt::format("--component: {} has no component '{}' ({}) - choose one of these, or leave it out",
                                 options_.field, options_.component,
                                 known.empty() ? "it has none" : fmt::format("allowed: {}", fmt::join(known, ", "))));
  }
  void survey(Frame const& frame) {
    if (!(stage_.size() > 0)) stage_ = Stage::around(frame.points);
    Camera const camera = camera_for(frame);
    auto const radii = ball_radii(frame.volume, frame.body, frame.dimension);
    include(window_, camera, subject_of(frame, radii));
    if (camera.follow < 0) show_shapes(window_, camera.view, shapes_of(frame), stage_);
    spread_.include(picture_values(frame.values, frame.info.components, component_of(frame)));
  }
  Camera camera_for(Frame const& frame) const {
    return camera_of(asked_.output, upwards(asked_), asked_.bodies, frame.dimension);
  }
  static Subject subject_of(Frame const& frame, std::vector<double> const& radii) {
    double const margin = radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end());
    return {.points = frame.points, .volume = frame.volume, .body = frame.body, .margin = margin};
  }

  RenderOptions const& options_;
  std::string title_;
  std::optional<CaseSpec> spec_;
  CaseSpec asked_;
  std::optional<RigidHistory> rigids_;  ///< where there is a case
  std::vector<std::pair<double, fs::path>> frames_;
  Window window_;
  Stage stage_;
  Spread spread_;
};

void expect_frames(fs::path const& folder) {
  if (fs::exists(folder / "frames.hdf.series")) return;
  throw InputError(
      fmt::format("{}: has no frames to draw (no frames.hdf.series) - run the case with --set output.frames.every=TIME",
                  folder.string()));
}

/// `count` of the frames, those nearest to equal steps of time; a frame may be there several times.
std::vector<std::size_t> at_equal_steps(Renderer const& renderer, std::vector<std::size_t> numbers, std::size_t count) {
  std::sort(numbers.begin(), numbers.end());
  double const first = renderer.time(numbers.front()), last = renderer.time(numbers.back());
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < count; ++k) {
    double const time =
        count < 2 ? last : first + (last - first) * static_cast<double>(k) / static_cast<double>(count - 1);
    out.push_back(*std::min_element(numbers.begin(), numbers.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(renderer.time(a) - time) < std::abs(renderer.time(b) - time);
    }));
  }
  return out;
}

}  // namespace

std::size_t render_film(fs::path const& folder, RenderOptions const& options, FilmOptions const& film) {
  expect_frames(folder);
  Renderer const renderer(folder, options);
  auto const numbers = chosen(options, renderer.count());
  if (numbers.empty())
    throw InputError(fmt::format("{}: has no frames to draw - let the run write some", folder.string()));
  double const frames = static_cast<double>(numbers.size());
  FilmPace pace{.hold_end = film.hold_end};
  if (film.pictures_per_second) pace.pictures_per_second = *film.pictures_per_second;
  if (film.seconds && !film.pictures_per_second) pace.pictures_per_second = frames / *film.seconds;
  double const count = film.seconds ? std::max(1.0, std::round(*film.seconds * pace.pictures_per_second)) : frames;
  auto const order = at_equal_steps(renderer, numbers, static_cast<std::size_t>(count));
  Image picture = renderer.picture(order.front());
  Film out(film.file, picture.width, picture.height, pace);
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k > 0 && order[k] != order[k - 1]) picture = renderer.picture(order[k]);
    out.add(picture);
  }
  out.finish();
  return order.size();
}

std::vector<fs::path> render_frames(fs::path const& folder, RenderOptions const& options,
                                    std::function<void(fs::path const&)> const& drawn) {
  expect_frames(folder);
  Renderer const renderer(folder, options);
  fs::path const out = options.out.empty() ? folder / "pictures" : options.out;
  auto const numbers = chosen(options, renderer.count());
  make_folder(out);
  std::vector<fs::path> paths;
  for (std::size_t const k : numbers) {
    paths.push_back(renderer.draw(k, out));
    if (drawn) drawn(paths.back());
  }
  return paths;
}

}  // namespace piola
