// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/render.hpp"
#include "piola/base/problems.hpp"
#include "piola/input/read_case.hpp"
#include "piola/output/files.hpp"
#include "piola/output/frames.hpp"
#include "piola/output/rigid_picture.hpp"
#include "piola/simulation/rigid_history.hpp"
#include "piola/simulation/scene.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
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

/// The case that the run was started with; nothing if it is not there or cannot be read any more.
std::optional<CaseSpec> case_of(fs::path const& folder, ParticleSet& particles) {
  if (!fs::exists(folder / "case.toml")) return std::nullopt;
  try {
    return read_case(folder / "case.toml", {}, {}, &particles);
  } catch (InputError const&) {
    return std::nullopt;
  }
}

View view_of(RenderOptions const& options, std::optional<CaseSpec> const& spec, int dimension) {
  View view = options.view;
  for (std::size_t k = 0; k < up_words.size(); ++k)
    if (options.up == up_words[k]) view.upwards = static_cast<Up>(k);
  if (options.up == "auto" && spec) view.upwards = upwards(*spec);
  return view.in(dimension);
}

/// What the case says, changed by what the options say.
Appearance appearance_of(RenderOptions const& options, std::optional<CaseSpec> const& spec) {
  Appearance appearance = spec ? appearance_of(*spec) : Appearance{};
  std::vector<std::string> bodies;
  for (std::size_t b = 0; spec && b < spec->bodies.size(); ++b) bodies.push_back(spec->bodies[b].name);
  appearance.as.resize(std::max<std::size_t>(bodies.size(), 1), Representation::automatic);
  for (std::string const& one : options.as) {
    auto const sign = one.find('=');
    std::string const word = sign == std::string::npos ? one : one.substr(sign + 1), body = one.substr(0, sign);
    if (std::find(representation_words.begin(), representation_words.end(), word) == representation_words.end())
      throw InputError(fmt::format("--as: {} is no way to draw bodies (allowed: {}) - choose one of these", word,
                                   fmt::join(representation_words, ", ")));
    auto const at = std::find(bodies.begin(), bodies.end(), body);
    if (sign == std::string::npos)
      appearance.as.assign(appearance.as.size(), representation_of(word));
    else if (at != bodies.end())
      appearance.as[static_cast<std::size_t>(at - bodies.begin())] = representation_of(word);
    else
      throw InputError(
          fmt::format("--as: there is no body '{}' (allowed: {}) - name one of these", body,
                      bodies.empty() ? "none without a case.toml" : fmt::format("{}", fmt::join(bodies, ", "))));
  }
  appearance.outline = appearance.outline && options.outline;
  if (options.cut) appearance.cut = options.cut;
  return appearance;
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
        spec_(case_of(folder, particles_)),
        appearance_(appearance_of(options, spec_)),
        frames_(list_frames(folder)) {
    if (spec_) meshes_ = reference_meshes(particles_);
    if (spec_) rigids_.emplace(folder / "history.csv", spec_->rigids);
    for (auto const& entry : frames_) survey(read(entry.second));
  }
  std::size_t count() const { return frames_.size(); }

  fs::path draw(std::size_t number, fs::path const& folder) const {
    Frame const frame = read(frames_[number].second);
    int const components = frame.info.components, component = component_of(frame);
    auto const radii = ball_radii(frame.volume, frame.body, frame.dimension);
    auto const values = picture_values(frame.values, components, component);
    auto const shapes = shapes_of(frame);
    auto const loose = loose_particles(frame.damage, frame.kernel_type, frame.points.size());
    PictureData const data{
        .points = frame.points,
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
        .body = frame.body,
        .meshes = belongs(frame) ? std::span<ReferenceMesh const>(meshes_) : std::span<ReferenceMesh const>(),
        .loose = loose};
    PictureStyle const style{options_.width, options_.height, view_of(options_, spec_, frame.dimension),
                             options_.range ? *options_.range : range_, appearance_};
    fs::path path = folder / picture_name(options_.field, components, component, number);
    write_png(path, draw_picture(data, style, window_));
    return path;
  }

 private:
  /// Whether the frame is of the case that lies in the folder now.
  bool belongs(Frame const& frame) const {
    return frame.points.size() == particles_.X.size() && frame.dimension == particles_.dimension &&
           std::equal(frame.body.begin(), frame.body.end(), particles_.body.begin(), particles_.body.end());
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
    View const view = view_of(options_, spec_, frame.dimension);
    auto const radii = ball_radii(frame.volume, frame.body, frame.dimension);
    window_.include(view, frame.points, radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end()));
    show_shapes(window_, view, shapes_of(frame), stage_);
    auto const range = typical_range(picture_values(frame.values, frame.info.components, component_of(frame)));
    range_ = {std::min(range_[0], range[0]), std::max(range_[1], range[1])};
  }

  RenderOptions const& options_;
  std::string title_;
  ParticleSet particles_;  ///< of the case
  std::optional<CaseSpec> spec_;
  Appearance appearance_;
  std::vector<ReferenceMesh> meshes_;
  std::optional<RigidHistory> rigids_;  ///< where there is a case
  std::vector<std::pair<double, fs::path>> frames_;
  Window window_;
  Stage stage_;
  std::array<double, 2> range_{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

}  // namespace

std::vector<fs::path> render_frames(fs::path const& folder, RenderOptions const& options,
                                    std::function<void(fs::path const&)> const& drawn) {
  if (!fs::exists(folder / "frames.hdf.series")) {
    throw InputError(fmt::format(
        "{}: has no frames to draw (no frames.hdf.series) - run the case with --set output.frames.every=TIME",
        folder.string()));
  }
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
