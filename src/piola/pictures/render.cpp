// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/render.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/film.hpp"
#include "piola/drawing/rigid_picture.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/pictures/panel_pictures.hpp"
#include "piola/pictures/results_reader.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <set>

namespace piola {
namespace {

namespace fs = std::filesystem;

/// The pictures of a case with the requested field, range and view; for a run without a case, these alone.
PicturesSpec as_asked(std::optional<CaseSpec> const& found, RenderOptions const& options) {
  PicturesSpec pictures = found ? found->output.pictures : PicturesSpec{};
  auto const change = [&](PictureSpec const& picture) {
    PictureSpec changed = with_overrides(picture, options.look);
    if (!options.panels) {
      changed.field = options.field;
      changed.component = options.component;
      changed.range = options.range;
    }
    return changed;
  };
  if (!options.panels) pictures.panels.clear();
  static_cast<PictureSpec&>(pictures) = change(pictures);
  for (PictureSpec& panel : pictures.panels) panel = change(panel);
  return pictures;
}

TimeFormat format_of(std::vector<std::pair<double, fs::path>> const& frames) {
  double const last = frames.empty() ? 0 : frames.back().first;
  return time_format(last,
                     frames.size() < 2 ? last : (last - frames.front().first) / static_cast<double>(frames.size() - 1));
}

/// The appearance of the case, modified by the options.
Appearance appearance_of(RenderOptions const& options, std::optional<CaseSpec> const& spec,
                         PictureSpec const& picture) {
  Appearance appearance = spec ? appearance_of(*spec, picture) : Appearance{};
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
  appearance.quality = picture.quality == "high" ? Quality::high : Quality::normal;
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

/// Common data of the pictures of one field.
class Renderer {
 public:
  Renderer(std::shared_ptr<RunInFolder const> run, RenderOptions const& options, PictureSpec picture)
      : run_(std::move(run)),
        asked_(std::move(picture)),
        appearance_(appearance_of(options, run_->spec, asked_)),
        frames_(run_->frames) {
    CaseSpec spec = run_->spec.value_or(CaseSpec{});
    spec.output.pictures.up = asked_.up;
    up_ = upwards(spec);
    for (auto const& entry : frames_) survey(read(entry.second));
  }
  std::size_t count() const { return frames_.size(); }

  double time(std::size_t number) const { return frames_[number].first; }

  std::string const& title() const { return run_->title; }
  std::shared_ptr<RunInFolder const> const& run() const { return run_; }
  Window const& window() const { return window_; }
  void set_window(Window const& window) { window_ = window; }
  TimeFormat time_format() const { return format_of(frames_); }
  /// The number of the frame nearest in time; there must be one.
  std::size_t nearest(double time) const {
    auto const away = [&](auto const& entry) { return std::abs(entry.first - time); };
    auto const found = std::min_element(frames_.begin(), frames_.end(),
                                        [&](auto const& a, auto const& b) { return away(a) < away(b); });
    return static_cast<std::size_t>(found - frames_.begin());
  }
  /// Two runs get one range and windows of one size.
  void share_with(Renderer& other) {
    for (auto const& [one, two] : {std::pair{this, &other}, std::pair{&other, this}}) {
      one->spread_.include(two->spread_);
      one->window_.cover(two->window_);
    }
  }

  std::string name(std::size_t number) const { return picture_name(asked_.field, components_, component_, number); }
  Image picture(std::size_t number) const {
    Shot const seen = shot(number);
    return draw_picture(seen.data, style(seen.frame.dimension), seen.window);
  }
  PictureSpec const& asked() const { return asked_; }
  PictureStyle style(int dimension) const {
    PictureStyle style = style_of(asked_, camera_for(dimension), window_);
    style.appearance = appearance_;
    return style;
  }

  Shot shot(std::size_t number) const {
    Shot shot{.frame = read(frames_[number].second), .radii = {}, .values = {}, .shapes = {}, .loose = {}};
    Frame const& frame = shot.frame;
    int const components = frame.info.components, component = component_of(frame);
    shot.radii = ball_radii(frame.volume, frame.body, frame.dimension);
    shot.values = picture_values(frame.values, components, component);
    shot.shapes = run_->shapes_of(frame);
    shot.loose = loose_particles(frame.damage, frame.kernel_type, frame.points.size());
    Camera const camera = camera_for(frame.dimension);
    shot.points = points_of(frame);
    Subject const subject = subject_of(frame, shot.points, shot.radii);
    shot.data = {
        .points = shot.points,
        .radius = shot.radii,
        .values = shot.values,
        .label = picture_label(asked_.field, components, component),
        .unit = frame.info.unit,
        .title = title_of(run_->title, asked_),
        .time = frame.time,
        .dimension = frame.dimension,
        .rigid_shapes = shot.shapes,
        .stage_low = stage_.low,
        .stage_high = stage_.high,
        .spread = spread_,
        .case_text = run_->spec ? std::string_view(run_->spec->source) : std::string_view(),
        .eye = eye_at(camera, subject),
        .time_format = time_format(),
        .body = frame.body,
        .meshes = run_->has(frame) ? std::span<ReferenceMesh const>(run_->meshes) : std::span<ReferenceMesh const>(),
        .loose = shot.loose,
        .held = asked_.supports && run_->has(frame) ? std::span<std::uint8_t const>(run_->held)
                                                    : std::span<std::uint8_t const>(),
        .torn = torn_[number]};
    shot.window = shown_window(window_, camera, subject);
    return shot;
  }

 private:
  Frame read(fs::path const& path) const { return read_frame(path, asked_.field); }
  int component_of(Frame const& frame) const {
    if (auto const found = find_component(asked_.component, frame.info.components)) return *found;
    auto const known = component_words(frame.info.components);
    throw InputError(fmt::format("--component: {} has no component '{}' ({}) - choose one of these, or leave it out",
                                 asked_.field, asked_.component,
                                 known.empty() ? "it has none" : fmt::format("allowed: {}", fmt::join(known, ", "))));
  }
  void survey(Frame const& frame) {
    components_ = frame.info.components;
    component_ = component_of(frame);
    if (!(stage_.size() > 0)) stage_ = Stage::around(frame.points);
    Camera const camera = camera_for(frame.dimension);
    auto const radii = ball_radii(frame.volume, frame.body, frame.dimension);
    auto const points = points_of(frame);
    include(window_, camera, subject_of(frame, points, radii));
    torn_.emplace_back();
    if (run_->has(frame))
      torn_.back() = current_torn_cells(run_->meshes, frame.points,
                                        loose_particles(frame.damage, frame.kernel_type, frame.points.size()),
                                        torn_.size() < 2 ? Torn{} : torn_[torn_.size() - 2]);
    if (camera.follow < 0) show_shapes(window_, camera.view, run_->shapes_of(frame), stage_);
    spread_.include(picture_values(frame.values, frame.info.components, component_of(frame)));
  }
  Camera camera_for(int dimension) const {
    std::span<BodySpec const> const bodies = run_->spec ? std::span(run_->spec->bodies) : std::span<BodySpec const>();
    Camera camera = camera_of(asked_, up_, bodies, dimension);
    if (dimension == 3) camera.eye = eye_before(camera, asked_.perspective, stage_.low, stage_.high);
    return camera;
  }
  std::vector<std::array<double, 3>> points_of(Frame const& frame) const {
    if (asked_.warp == 1) return frame.points;
    if (run_->has(frame)) return warped(frame.points, run_->particles.X, asked_.warp);
    throw InputError(
        "--warp: where particles stood at the start is not known without the run's case.toml - leave it out");
  }
  static Subject subject_of(Frame const& frame, std::vector<std::array<double, 3>> const& points,
                            std::vector<double> const& radii) {
    double const margin = radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end());
    return {.points = points, .volume = frame.volume, .body = frame.body, .margin = margin};
  }

  std::shared_ptr<RunInFolder const> run_;
  PictureSpec asked_;
  Up up_ = Up::y;
  Appearance appearance_;
  std::vector<std::pair<double, fs::path>> const& frames_;
  using Torn = std::vector<std::vector<Index>>;
  std::vector<Torn> torn_;  ///< of each frame
  Window window_;
  Stage stage_;
  Spread spread_;
  int components_ = 1, component_ = whole_field;
};

void expect_frames(fs::path const& folder) {
  if (fs::exists(folder / "frames.hdf.series")) return;
  throw InputError(
      fmt::format("{}: has no frames to draw (no frames.hdf.series) - run the case with --set output.frames.every=TIME",
                  folder.string()));
}

/// Pictures of one run, or of several runs in adjacent panels, by the frame numbers of the first.
class Pictures {
 public:
  Pictures(fs::path const& folder, RenderOptions const& options) {
    std::vector<fs::path> folders{folder};
    folders.insert(folders.end(), options.beside.begin(), options.beside.end());
    for (fs::path const& one : folders) add_run(one, options);
    for (std::string const& field : options.more_fields) {
      PictureSpec picture = first().asked();
      picture.field = field;
      picture.component.clear();
      of_fields_.push_back(std::make_unique<Renderer>(first().run(), options, picture));
    }
    for (std::size_t k = 1; k < runs_.size(); ++k) runs_[0]->share_with(*runs_[k]);
    for (std::size_t k = 1; k < runs_.size(); ++k) runs_[0]->share_with(*runs_[k]);  // including later frames
    bool const all_differ = std::set<std::string>(names_.begin(), names_.end()).size() == names_.size();
    for (std::size_t k = 0; !all_differ && k < names_.size(); ++k) names_[k] = name_of(folders[k]);
    if (options.panels) make_panels(options);
  }
  Renderer const& first() const { return *runs_[0]; }
  std::size_t count() const { return first().count(); }
  double time(std::size_t number) const { return first().time(number); }

  std::string name(std::size_t number) const {
    std::string name = first().name(number);
    for (auto const& one : of_fields_) name.insert(name.rfind('-'), "-" + one->asked().field);
    return panels_.empty() ? name : with_other_fields(name, panels_of(asked_));
  }
  Image picture(std::size_t number) const {
    if (!panels_.empty()) return picture_of_panels(number);
    if (!of_fields_.empty()) {
      std::vector<Image> images{first().picture(number)};
      for (auto const& one : of_fields_) images.push_back(one->picture(number));
      return tiled(images, fitting_columns(first().window(), images.size()));
    }
    if (runs_.size() == 1) return first().picture(number);
    std::vector<Shot> shots;
    for (auto const& run : runs_) shots.push_back(run->shot(run->nearest(time(number))));
    std::vector<Panel> panels;
    for (std::size_t k = 0; k < shots.size(); ++k) panels.push_back({shots[k].data, shots[k].window, names_[k]});
    return sheet(first(), panels, "", "t = " + first().time_format().text(time(number)));
  }

  /// Panels with the look of a run.
  static Image sheet(Renderer const& run, std::vector<Panel> const& panels, std::string title, std::string at_right) {
    int const columns = fitting_columns(run.window(), panels.size());
    return draw_sheet(panels, {std::move(title), std::move(at_right), columns}, run.asked(), run.window(),
                      run.style(panels[0].data.dimension));
  }

 private:
  void add_run(fs::path const& folder, RenderOptions const& options) {
    expect_frames(folder);
    auto const run = std::make_shared<RunInFolder const>(folder);
    PicturesSpec const asked = as_asked(run->spec, options);
    if (runs_.empty()) asked_ = asked;
    PictureSpec const& shown = panels_of(asked).front();
    runs_.push_back(std::make_unique<Renderer>(run, options, shown));
    names_.push_back(runs_.back()->title());
    if (runs_.back()->count() == 0)
      throw InputError(fmt::format("{}: has no frames to draw - let the run write some", folder.string()));
  }

  void make_panels(RenderOptions const& options) {
    if (asked_.panels.empty())
      throw InputError("--panels: the case of the run has none - add [[output.pictures.panel]] to its case.toml");
    std::vector<Window> windows;
    for (PictureSpec const& panel : asked_.panels) {
      panels_.push_back(std::make_unique<Renderer>(first().run(), options, panel));
      windows.push_back(panels_.back()->window());
    }
    give_one_size(windows);
    for (std::size_t k = 0; k < panels_.size(); ++k) panels_[k]->set_window(windows[k]);
  }

  Image picture_of_panels(std::size_t number) const {
    std::vector<Shot> shots;
    for (auto const& panel : panels_) shots.push_back(panel->shot(number));
    std::vector<PanelPicture> pictures;
    for (std::size_t k = 0; k < shots.size(); ++k)
      pictures.push_back({shots[k].data, panels_[k]->style(shots[k].frame.dimension), shots[k].window});
    return draw_together(pictures, asked_, panels_.front()->window());
  }

  static std::string name_of(fs::path const& folder) {
    fs::path const whole = fs::absolute(folder).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  }
  std::vector<std::unique_ptr<Renderer>> runs_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<Renderer>> of_fields_;
  PicturesSpec asked_;                             ///< of the first run
  std::vector<std::unique_ptr<Renderer>> panels_;  ///< if panels are requested
};

/// `count` of the frames, those nearest to equal steps of time; a frame may be there several times.
std::vector<std::size_t> at_equal_steps(Pictures const& renderer, std::vector<std::size_t> numbers, std::size_t count) {
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
  Pictures const renderer(folder, options);
  auto const numbers = chosen(options, renderer.count());
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

fs::path render_times(fs::path const& folder, RenderOptions const& options, std::vector<double> const& times) {
  Pictures const pictures(folder, options);
  Renderer const& run = pictures.first();
  std::vector<Shot> shots;
  std::vector<Panel> panels;
  for (double const time : times) shots.push_back(run.shot(run.nearest(time)));
  for (Shot const& shot : shots) panels.push_back({shot.data, shot.window, run.time_format().text(shot.frame.time)});
  fs::path const out = options.out.empty() ? folder / "pictures" : options.out;
  make_folder(out);
  std::string name = run.name(0);
  fs::path path = out / name.replace(name.rfind("000000"), 6, "times");
  write_png(path, Pictures::sheet(run, panels, run.title(), ""));
  return path;
}

std::vector<fs::path> render_frames(fs::path const& folder, RenderOptions const& options,
                                    std::function<void(fs::path const&)> const& drawn) {
  Pictures const pictures(folder, options);
  fs::path const own = options.beside.empty() ? folder / "pictures" : fs::path("side-by-side");
  fs::path const out = options.out.empty() ? own : options.out;
  auto const numbers = chosen(options, pictures.count());
  make_folder(out);
  std::vector<fs::path> paths;
  for (std::size_t const k : numbers) {
    paths.push_back(out / pictures.name(k));
    write_png(paths.back(), pictures.picture(k));
    if (drawn) drawn(paths.back());
  }
  return paths;
}

}  // namespace piola
