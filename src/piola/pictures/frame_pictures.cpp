// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/frame_pictures.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/revolved_shapes.hpp"
#include "piola/observers/results_folder.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/summary.hpp"
#include "piola/pictures/case_scene.hpp"
#include "piola/pictures/picture_overrides.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <set>

namespace piola {
namespace {

/// The title of a run; without a summary, the name of its folder.
std::string title_of_run(std::filesystem::path const& folder) {
  if (!std::filesystem::exists(folder / "summary.json")) return folder.filename().string();
  auto const summary =
      nlohmann::json::parse(read_text_file(folder / "summary.json", most_summary_bytes), nullptr, false);
  bool const titled = summary.is_object() && summary.contains("title") && summary["title"].is_string();
  return titled ? summary["title"].get<std::string>() : folder.filename().string();
}

/// The component that a picture shows. Throws InputError if the field has no such component.
int component_of(PictureSpec const& spec, int components) {
  if (auto const found = find_component(spec.component, components)) return *found;
  auto const known = component_words(components);
  throw InputError(fmt::format("--component: {} has no component '{}' ({}) - choose one of these, or leave it out",
                               spec.field, spec.component,
                               known.empty() ? "it has none" : fmt::format("allowed: {}", fmt::join(known, ", "))));
}

/// One panel of a picture, ready to be drawn.
struct PanelPicture {
  PictureData data;
  PictureStyle style;
  Window window;  ///< equal size for all panels
};

/// The label of a panel: its caption, else its view if that has a name.
std::string caption_of(PictureSpec const& panel) {
  if (!panel.caption.empty()) return panel.caption;
  bool const from_an_end = !panel.named_view.empty() && !panel.named_view.starts_with("iso");
  return from_an_end ? "from " + panel.named_view : "";
}

/// Whether panels can share one colour bar: equal field, component, range and colours.
bool one_bar(std::span<PictureSpec const> panels) {
  return std::all_of(panels.begin(), panels.end(), [&](PictureSpec const& one) {
    PictureSpec const& first = panels.front();
    return one.field == first.field && one.component == first.component && one.range == first.range &&
           one.map == first.map;
  });
}

/// Enlarges windows to equal size, so that panels have one scale.
void give_one_size(std::span<Window> windows) {
  double wide = 0, high = 0;
  for (Window const& one : windows) {
    wide = std::max(wide, one.x1 - one.x0);
    high = std::max(high, one.y1 - one.y0);
  }
  for (Window& one : windows) {
    double const more_x = (wide - (one.x1 - one.x0)) / 2, more_y = (high - (one.y1 - one.y0)) / 2;
    one.x0 -= more_x;
    one.x1 += more_x;
    one.y0 -= more_y;
    one.y1 += more_y;
  }
}

int scaled(int side, double scale) { return 2 * std::max(1, static_cast<int>(std::lround(scale * side / 2))); }

/// Draws panels with one colour bar, in the size of the picture or, without one, a fitting size.
Image draw_sheet(std::span<Panel const> panels, Sheet const& sheet, PictureSpec const& picture, Window const& all,
                 PictureStyle style) {
  if (picture.width <= 0 || picture.height <= 0) {
    auto const size = fitting_size(all, panels.size(), sheet.columns);
    style.width = scaled(size[0], picture.scale);
    style.height = scaled(size[1], picture.scale);
  }
  return draw_panels(panels, sheet, style);
}

/// Adjacent pictures, each with its own bar; a caption replaces the title.
Image each_with_its_bar(std::span<PanelPicture const> panels, PicturesSpec const& pictures, int columns) {
  std::vector<Image> images;
  auto const rows =
      static_cast<int>((panels.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns));
  for (std::size_t k = 0; k < panels.size(); ++k) {
    PanelPicture panel = panels[k];
    if (std::string const caption = caption_of(pictures.panels[k]); !caption.empty()) panel.data.title = caption;
    if (pictures.width > 0 && pictures.height > 0) {
      panel.style.width = std::max(1, pictures.width / columns);
      panel.style.height = std::max(1, pictures.height / rows);
    }
    images.push_back(draw_picture(panel.data, panel.style, panel.window));
  }
  return tiled(images, columns);
}

/// Combines panels in one picture: below one title with one bar if possible, else as adjacent pictures. `all`: the
/// window of the whole run.
Image draw_together(std::span<PanelPicture const> panels, PicturesSpec const& pictures, Window const& all) {
  PanelPicture const& first = panels.front();
  if (pictures.panels.empty()) return draw_picture(first.data, first.style, first.window);
  int const columns = pictures.columns > 0 ? std::min(pictures.columns, static_cast<int>(panels.size()))
                                           : fitting_columns(all, panels.size());
  if (!one_bar(pictures.panels)) return each_with_its_bar(panels, pictures, columns);
  std::vector<Panel> sheet;
  for (std::size_t k = 0; k < panels.size(); ++k)
    sheet.push_back({panels[k].data, panels[k].window, caption_of(pictures.panels[k]), &panels[k].style});
  std::string const time = "t = " + first.data.time_format->text(first.data.time);
  return draw_sheet(sheet, {first.data.title, time, columns}, pictures, all, first.style);
}

}  // namespace

PicturedRun PicturedRun::in(std::filesystem::path const& folder) {
  PicturedRun run;
  if (auto const spec = case_in_results(folder, &run.particles)) {
    run.spec = *spec;
  } else {
    run.particles = {};
    run.spec.title = title_of_run(folder);
  }
  return run;
}

FramePictures::FramePictures(PicturedRun run) : run_(std::move(run)), meshes_(reference_meshes(run_.particles)) {
  for (PictureSpec const& spec : panels_of(run_.spec.output.pictures)) {
    PanelView& view = views_.emplace_back(PanelView{.spec = spec});
    if (spec.supports) view.held = held_particles(run_.spec, run_.particles);
  }
}

Shot::Panel FramePictures::panel_of(FrameReader const& frame, Shot const& shot, PictureSpec const& spec) const {
  if (spec.warp != 1 && !shot.of_case)
    throw InputError(
        "--warp: where particles stood at the start is not known without the run's case.toml - leave it out");
  FieldInfo const field = frame.info(spec.field);
  int const component = component_of(spec, field.components);
  auto const stored = frame.values(spec.field);
  std::vector<double> const values(stored.begin(), stored.end());
  Shot::Panel panel{field, component, picture_values(values, field.components, component),
                    warped(shot.points, run_.particles.X.seen(), spec.warp)};
  panel.swept = sweep_of(spec, shot.axisymmetric);
  if (panel.swept)
    panel.in_space = revolved({.points = panel.points, .volume = shot.volume, .body = shot.body}, *panel.swept);
  return panel;
}

Shot FramePictures::read(std::filesystem::path const& path) const {
  FrameReader const frame(path);
  ParticleSet const& particles = run_.particles;
  Shot shot{.time = frame.time(),
            .dimension = frame.dimension(),
            .points = frame.positions(),
            .body = frame.bodies(),
            .loose = loose_particles(frame),
            .shapes = shapes_at(run_.spec.rigids, frame.time(), frame.rigid_poses())};
  shot.axisymmetric = frame.axisymmetric() || run_.spec.axisymmetric;
  shot.of_case = shot.dimension == particles.dimension && shot.body == particles.body.seen();
  auto const stored = frame.volumes();
  shot.volume.assign(stored.begin(), stored.end());
  if (shot.of_case) shot.volume = particles.volume.seen();
  shot.radii = shot.axisymmetric
                   ? ball_radii_of_rings(shot.volume, shot.of_case ? particles.X.seen() : shot.points, shot.body)
                   : ball_radii(shot.volume, shot.body, shot.dimension);
  for (PanelView const& view : views_) shot.panels.push_back(panel_of(frame, shot, view.spec));
  return shot;
}

void FramePictures::begin(Shot const& first) {
  Stage const stage = Stage::around(first.of_case ? run_.particles.X.seen() : first.points);
  for (std::size_t k = 0; k < views_.size(); ++k) {
    PanelView& view = views_[k];
    view.field = first.panels[k].field;
    view.component = first.panels[k].component;
    auto const& swept = first.panels[k].swept;
    int const dimension = dimension_shown(swept, first.dimension);
    view.stage = swept ? revolved(stage, *swept) : stage;
    view.camera = camera_of(view.spec, upwards(run_.spec), run_.spec.bodies, dimension);
    if (dimension == 3)
      view.camera.eye = eye_before(view.camera, view.spec.perspective, view.stage.low, view.stage.high);
  }
}

void FramePictures::add(std::filesystem::path const& frame, std::size_t number) {
  Shot const shot = read(frame);
  if (frames_.empty()) begin(shot);
  Entry entry{shot.time, frame, number, {}};
  if (shot.of_case)
    entry.torn = current_torn_cells(meshes_, shot.points, shot.loose, frames_.empty() ? Torn{} : frames_.back().torn);
  for (std::size_t k = 0; k < views_.size(); ++k) {
    PanelView& view = views_[k];
    include(view.window, view.camera, subject(shot, k));
    if (view.camera.followed_body < 0)
      show_all_shapes(view.window, view.camera.view, shot.shapes, view.stage, shot.panels[k].swept);
    view.spread.include(shot.panels[k].values);
  }
  frames_.push_back(std::move(entry));
}

void FramePictures::share_with(FramePictures& other) {
  PanelView &one = views_.front(), &two = other.views_.front();
  for (auto const& [to, from] : {std::pair{&one, &two}, std::pair{&two, &one}}) {
    to->spread.include(from->spread);
    to->window.cover(from->window);
  }
}

std::size_t FramePictures::nearest(double time) const {
  PIOLA_EXPECTS(!frames_.empty());
  auto const found = std::min_element(frames_.begin(), frames_.end(), [&](Entry const& a, Entry const& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
  return static_cast<std::size_t>(found - frames_.begin());
}

TimeFormat FramePictures::time_format() const {
  PIOLA_EXPECTS(run_.time_format || !frames_.empty());
  if (run_.time_format) return *run_.time_format;
  double const first = frames_.front().time, last = frames_.back().time;
  double const count = static_cast<double>(frames_.size());
  return piola::time_format(last, count < 2 ? last : (last - first) / (count - 1));
}

std::string FramePictures::name(std::size_t k) const {
  PIOLA_EXPECTS(k < frames_.size());
  PanelView const& first = views_.front();
  std::string name = picture_name(first.spec.field, first.field.components, first.component, frames_[k].number);
  std::set<std::string> known{first.spec.field};
  for (PanelView const& view : views_)
    if (known.insert(view.spec.field).second) name.insert(name.rfind('-'), "-" + view.spec.field);
  return name;
}

std::string FramePictures::name_of_times() const {
  std::string const first = name(0);
  return first.substr(0, first.rfind('-')) + "-times.png";
}

FramePictures::Look FramePictures::look() const {
  Look look;
  for (PanelView const& view : views_) {
    look.spread.push_back(view.spread);
    look.window.push_back(view.window);
  }
  give_one_size(look.window);
  return look;
}

Subject FramePictures::subject(Shot const& shot, std::size_t panel) const {
  double const margin = shot.radii.empty() ? 0 : *std::max_element(shot.radii.begin(), shot.radii.end());
  RevolvedPoints const& in_space = shot.panels[panel].in_space;
  if (!in_space.points.empty())
    return {.points = in_space.points, .volume = in_space.volume, .body = in_space.body, .margin = margin};
  return {.points = shot.panels[panel].points, .volume = shot.volume, .body = shot.body, .margin = margin};
}

PictureData FramePictures::data(Shot const& shot, std::size_t panel, Torn const& torn) const {
  PanelView const& view = views_[panel];
  Shot::Panel const& shown = shot.panels[panel];
  return {.points = shown.points,
          .radius = shot.radii,
          .values = shown.values,
          .label = picture_label(shown.field.name, shown.field.components, shown.component),
          .unit = shown.field.unit,
          .title = title_of(title(), view.spec),
          .time = shot.time,
          .dimension = dimension_shown(shown.swept, shot.dimension),
          .rigid_shapes = shot.shapes,
          .stage_low = view.stage.low,
          .stage_high = view.stage.high,
          .spread = view.spread,
          .case_text = run_.spec.source,
          .eye = eye_at(view.camera, subject(shot, panel)),
          .time_format = time_format(),
          .body = shot.body,
          .ground = ground_of(run_.spec, view.spec),
          .meshes = shot.of_case ? std::span<ReferenceMesh const>(meshes_) : std::span<ReferenceMesh const>(),
          .loose = shot.loose,
          .held = shot.of_case ? std::span<std::uint8_t const>(view.held) : std::span<std::uint8_t const>(),
          .swept = shown.swept,
          .torn = torn};
}

PictureStyle FramePictures::style(std::size_t panel, Window const& window) const {
  PanelView const& view = views_[panel];
  PictureStyle style = style_of(view.spec, view.camera, window);
  style.appearance = view.spec.appearance;
  return style;
}

Image FramePictures::picture(std::size_t k) const {
  PIOLA_EXPECTS(k < frames_.size());
  Shot const shot = read(frames_[k].path);
  auto const windows = look().window;
  std::vector<PanelPicture> panels;
  for (std::size_t p = 0; p < views_.size(); ++p)
    panels.push_back({data(shot, p, frames_[k].torn), style(p, windows[p]),
                      shown_window(windows[p], views_[p].camera, subject(shot, p))});
  return draw_together(panels, run_.spec.output.pictures, windows.front());
}

Image FramePictures::sheet(std::span<FramePictures const* const> runs, std::span<std::size_t const> frames,
                           std::span<std::string const> captions, Sheet labels) {
  PIOLA_EXPECTS(!runs.empty() && frames.size() == runs.size() && captions.size() == runs.size());
  std::vector<Shot> shots;
  std::vector<PictureData> data;
  std::vector<Panel> panels;
  for (std::size_t n = 0; n < runs.size(); ++n) shots.push_back(runs[n]->read(runs[n]->frames_[frames[n]].path));
  for (std::size_t n = 0; n < runs.size(); ++n)
    data.push_back(runs[n]->data(shots[n], 0, runs[n]->frames_[frames[n]].torn));
  for (PictureData& one : data) one.ground = data.front().ground;  // as the style: that of the first run
  for (std::size_t n = 0; n < runs.size(); ++n) {
    PanelView const& view = runs[n]->views_.front();
    panels.push_back({data[n], shown_window(view.window, view.camera, runs[n]->subject(shots[n], 0)), captions[n]});
  }
  PanelView const& first = runs.front()->views_.front();
  labels.columns = fitting_columns(first.window, panels.size());
  return draw_sheet(panels, labels, first.spec, first.window, runs.front()->style(0, first.window));
}

Image FramePictures::picture_of_times(std::span<double const> times) const {
  std::vector<std::size_t> frames;
  std::vector<std::string> captions;
  for (double const time : times) {
    frames.push_back(nearest(time));
    captions.push_back(time_format().text(frames_[frames.back()].time));
  }
  return sheet(std::vector<FramePictures const*>(times.size(), this), frames, captions, {title(), ""});
}

}  // namespace piola
