// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/picture_observer.hpp"
#include "piola/drawing/rigid_picture.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/field_cache.hpp"
#include "piola/pictures/case_scene.hpp"
#include "piola/pictures/panel_pictures.hpp"
#include "piola/pictures/picture_overrides.hpp"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace piola {

namespace {

/// Rounded as in the stored file: whether a picture is drawn at once or at the end depends on the clock, and must not
/// be visible.
double as_kept(double value) { return static_cast<double>(static_cast<float>(value)); }

/// Length and entries of each list.
std::vector<std::int32_t> flattened(std::vector<std::vector<Index>> const& lists) {
  std::vector<std::int32_t> out;
  for (auto const& list : lists) {
    out.push_back(static_cast<std::int32_t>(list.size()));
    for (Index const k : list) out.push_back(static_cast<std::int32_t>(k));
  }
  return out;
}

template <class Number>
std::vector<std::vector<Index>> unflattened(std::vector<Number> const& numbers) {
  std::vector<std::vector<Index>> lists;
  for (std::size_t k = 0; k < numbers.size();) {
    auto& list = lists.emplace_back();
    auto const count = static_cast<std::size_t>(std::max<Number>(numbers[k++], 0));
    for (std::size_t n = 0; n < count && k < numbers.size(); ++n) list.push_back(static_cast<Index>(numbers[k++]));
  }
  return lists;
}

std::string name_in_state(char const* what, std::size_t panel) {
  return panel == 0 ? what : fmt::format("{}_{}", what, panel);
}

}  // namespace

PictureObserver::PictureObserver(Results results)
    : results_(std::move(results)), schedule_(results_.spec.output.pictures.every) {
  auto const& particles = results_.particles;
  Up const up = upwards(results_.spec);
  for (PictureSpec const& spec : panels_of(results_.spec.output.pictures))
    panels_.push_back({spec, camera_of(spec, up, results_.spec.bodies, particles.dimension), {}, {}});
  if (!schedule_.ever()) return;
  radii_ = ball_radii(particles.volume, particles.body, particles.dimension);
  Stage const stage = Stage::around(particles.X);
  stage_low_ = stage.low;
  stage_high_ = stage.high;
  bool const supports =
      std::any_of(panels_.begin(), panels_.end(), [](Shown const& panel) { return panel.spec.supports; });
  if (supports) held_ = held_particles(results_.spec, particles);
  if (particles.dimension < 3) return;
  for (Shown& panel : panels_)
    panel.camera.eye = eye_before(panel.camera, panel.spec.perspective, stage_low_, stage_high_);
}

/// The rigid shapes whose poses a stored picture contains.
std::vector<RigidState> PictureObserver::turning_shapes() const {
  std::vector<RigidState> shapes;
  for (RigidSpec const& rigid : results_.spec.rigids)
    if (rigid.turns()) shapes.emplace_back().name = rigid.name;
  return shapes;
}

std::filesystem::path PictureObserver::path(std::size_t number) const {
  Shown const& first = panels_.front();
  std::string const name = picture_name(first.field.name, first.field.components, first.component, number);
  return results_.folder / "pictures" / with_other_fields(name, panels_of(results_.spec.output.pictures));
}

std::filesystem::path PictureObserver::kept_path(std::size_t number) const {
  return path(number).replace_extension(".values");
}

void PictureObserver::keep(std::size_t number, Kept const& kept) const {
  std::vector<double> head{kept.time};
  for (RigidState const& rigid : kept.rigids)
    for (auto const& part : {rigid.centre, rigid.turn}) head.insert(head.end(), part.begin(), part.end());
  std::vector<float> numbers;
  numbers.reserve((3 + kept.values.size()) * kept.points.size());
  for (auto const& p : kept.points)
    for (double const c : p) numbers.push_back(static_cast<float>(c));
  for (auto const& values : kept.values)
    for (double const v : values) numbers.push_back(static_cast<float>(v));
  std::size_t const before = head.size() * sizeof(double);
  std::size_t const middle = before + numbers.size() * sizeof(float);
  auto const torn = flattened(kept.torn);
  std::vector<std::byte> bytes(middle + kept.loose.size() + torn.size() * sizeof(std::int32_t));
  std::memcpy(bytes.data(), head.data(), before);
  if (!numbers.empty()) std::memcpy(bytes.data() + before, numbers.data(), numbers.size() * sizeof(float));
  if (!kept.loose.empty()) std::memcpy(bytes.data() + middle, kept.loose.data(), kept.loose.size());
  if (!torn.empty())
    std::memcpy(bytes.data() + middle + kept.loose.size(), torn.data(), torn.size() * sizeof(std::int32_t));
  write_whole_file(kept_path(number), bytes);
}

bool PictureObserver::read_kept(std::size_t number, Kept& kept) const {
  if (!std::filesystem::exists(kept_path(number))) return false;
  std::string const bytes = read_text_file(kept_path(number));
  std::size_t const n = radii_.size();
  std::vector<float> numbers((3 + panels_.size()) * n);
  kept.rigids = turning_shapes();
  std::vector<double> head(1 + 6 * kept.rigids.size());
  std::size_t const before = head.size() * sizeof(double);
  std::size_t const middle = before + numbers.size() * sizeof(float);
  if (bytes.size() < middle + n || (bytes.size() - middle - n) % sizeof(std::int32_t) != 0) return false;
  kept.loose.assign(bytes.begin() + static_cast<std::ptrdiff_t>(middle),
                    bytes.begin() + static_cast<std::ptrdiff_t>(middle + n));
  std::vector<std::int32_t> torn((bytes.size() - middle - n) / sizeof(std::int32_t));
  if (!torn.empty()) std::memcpy(torn.data(), bytes.data() + middle + n, torn.size() * sizeof(std::int32_t));
  kept.torn = unflattened(torn);
  std::memcpy(head.data(), bytes.data(), before);
  if (n > 0) std::memcpy(numbers.data(), bytes.data() + before, numbers.size() * sizeof(float));
  auto from = head.begin();
  kept.time = *from++;
  for (RigidState& rigid : kept.rigids)
    for (auto* part : {&rigid.centre, &rigid.turn}) {
      std::copy_n(from, 3, part->begin());
      from += 3;
    }
  kept.points.resize(n);
  for (std::size_t i = 0; i < 3 * n; ++i) kept.points[i / 3][i % 3] = static_cast<double>(numbers[i]);
  kept.values.clear();
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    auto const first = numbers.begin() + static_cast<std::ptrdiff_t>((3 + k) * n);
    kept.values.emplace_back(first, first + static_cast<std::ptrdiff_t>(n));
  }
  return true;
}

PictureObserver::Points PictureObserver::points_of(std::size_t panel, Kept const& kept) const {
  return warped(kept.points, results_.particles.X, panels_[panel].spec.warp);
}

PictureData PictureObserver::data_of(std::size_t panel, Kept const& kept, Points const& points,
                                     std::span<RigidShape const> shapes) const {
  Shown const& shown = panels_[panel];
  return {.points = points,
          .radius = radii_,
          .values = kept.values[panel],
          .label = picture_label(shown.field.name, shown.field.components, shown.component),
          .unit = shown.field.unit,
          .title = title_of(results_.spec.title, shown.spec),
          .time = kept.time,
          .dimension = results_.particles.dimension,
          .rigid_shapes = shapes,
          .stage_low = stage_low_,
          .stage_high = stage_high_,
          .spread = shown.spread,
          .case_text = results_.spec.source,
          .eye = eye_at(shown.camera, subject(points)),
          .time_format = time_format(results_.spec.run.end, results_.spec.output.pictures.every),
          .body = results_.particles.body,
          .meshes = meshes_,
          .loose = kept.loose,
          .held = shown.spec.supports ? std::span<std::uint8_t const>(held_) : std::span<std::uint8_t const>(),
          .torn = kept.torn};
}

PictureObserver::Look PictureObserver::look() const {
  Look look;
  for (Shown const& panel : panels_) {
    look.spread.push_back(panel.spread);
    look.window.push_back(panel.window);
  }
  give_one_size(look.window);
  return look;
}

void PictureObserver::make_meshes() {
  if (meshes_.empty()) meshes_ = reference_meshes(results_.particles);
}

Image PictureObserver::picture(Kept const& kept) const {
  auto const shapes = shapes_at(results_.spec.rigids, kept.time, kept.rigids);
  auto const windows = look().window;
  std::vector<PanelPicture> panels;
  std::vector<Points> points;
  for (std::size_t k = 0; k < panels_.size(); ++k) points.push_back(points_of(k, kept));
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    Shown const& shown = panels_[k];
    PictureStyle style = style_of(shown.spec, shown.camera, windows[k]);
    style.appearance = appearance_of(results_.spec, shown.spec);
    panels.push_back(
        {data_of(k, kept, points[k], shapes), style, shown_window(windows[k], shown.camera, subject(points[k]))});
  }
  return draw_together(panels, results_.spec.output.pictures, windows.front());
}

void PictureObserver::draw(std::size_t number, Kept const& kept) {
  make_meshes();
  write_png(path(number), picture(kept));
  drawn_[number] = look();
}

/// Draws previews during a run; at the end pictures whose window or range has changed are drawn again.
void PictureObserver::draw_if_cheap(std::size_t number, Kept const& kept) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds pause(1);
  constexpr int work_between = 50;  // multiple of the time of the last picture
  auto const now = Clock::now();
  if (now < next_drawn_) return;
  draw(number, kept);
  auto const drawn = Clock::now();
  next_drawn_ = drawn + std::max<Clock::duration>(pause, work_between * (drawn - now));
}

/// Prepares the panels; false if the formulation has no such field.
bool PictureObserver::prepare(Formulation const& formulation) {
  if (impossible_ || !panels_.front().field.name.empty()) return !impossible_;
  FieldCache const cache(formulation, results_.particles);
  for (Shown& panel : panels_) {
    PictureSpec const& spec = panel.spec;
    if (cache.knows(spec.field)) {
      FieldInfo const& info = cache.info(spec.field);
      if (auto const component = find_component(spec.component, info.components)) {
        panel.field = info;
        panel.component = *component;
        continue;
      }
    }
    impossible_ = true;
    results_.journal.warn(
        fmt::format("pictures: the formulation has no field '{}'{}, so that no picture is drawn", spec.field,
                    spec.component.empty() ? "" : fmt::format(" with a component '{}'", spec.component)));
  }
  return !impossible_;
}

void PictureObserver::see_now(Formulation const& formulation, double time) {
  if (!prepare(formulation)) return;
  FieldCache cache(formulation, results_.particles);
  Kept kept{time, std::vector<std::array<double, 3>>(radii_.size()), {}, formulation.rigids()};
  auto const x = cache.values("Position");
  for (std::size_t i = 0; i < 3 * radii_.size(); ++i) kept.points[i / 3][i % 3] = as_kept(x[i]);
  for (Shown const& panel : panels_) {
    auto& values = kept.values.emplace_back(
        picture_values(cache.values(panel.field.name), panel.field.components, panel.component));
    for (double& value : values) value = as_kept(value);
  }
  auto const if_known = [&](char const* field) {
    return cache.knows(field) ? cache.values(field) : std::span<double const>();
  };
  kept.loose = loose_particles(if_known("Damage"), if_known("KernelType"), radii_.size());

  make_meshes();
  torn_ = kept.torn = current_torn_cells(meshes_, kept.points, kept.loose, torn_);

  auto const shapes = shapes_at(results_.spec.rigids, time, kept.rigids);
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    Shown& panel = panels_[k];
    include(panel.window, panel.camera, subject(points_of(k, kept)));
    if (panel.camera.follow < 0) show_shapes(panel.window, panel.camera.view, shapes, {stage_low_, stage_high_});
    panel.spread.include(kept.values[k]);
  }
  make_folder(results_.folder / "pictures");
  auto const number = static_cast<std::size_t>(count_);
  keep(number, kept);
  draw_if_cheap(number, kept);
  last_ = path(number);
  count_ += 1;
  last_time_ = time;
}

Subject PictureObserver::subject(std::vector<std::array<double, 3>> const& points) const {
  double const margin = radii_.empty() ? 0 : *std::max_element(radii_.begin(), radii_.end());
  return {.points = points, .volume = results_.particles.volume, .body = results_.particles.body, .margin = margin};
}

bool PictureObserver::drawn_as_now(std::size_t number) const {
  auto const found = drawn_.find(number);
  return found != drawn_.end() && found->second == look();
}

void PictureObserver::draw_all() {
  auto const& times = results_.spec.output.pictures.times;
  std::vector<Kept> nearest(times.size());
  bool complete = !times.empty();
  for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
    Kept kept;
    bool const as_now = drawn_as_now(k);
    if (as_now && times.empty()) {
      std::filesystem::remove(kept_path(k));
      continue;
    }
    bool const there = read_kept(k, kept);
    complete = complete && there;
    if (there && !as_now) draw(k, kept);
    for (std::size_t n = 0; there && n < times.size(); ++n)
      if (k == 0 || std::abs(kept.time - times[n]) < std::abs(nearest[n].time - times[n])) nearest[n] = kept;
    std::filesystem::remove(kept_path(k));
  }
  if (complete && count_ > 0) draw_times(nearest);
}

/// In a run extended after its end some moments are no longer stored: the picture then stays unchanged.
void PictureObserver::draw_times(std::vector<Kept> const& nearest) {
  Shown const& shown = panels_.front();
  TimeFormat const format = time_format(results_.spec.run.end, results_.spec.output.pictures.every);
  std::vector<std::vector<RigidShape>> shapes;
  std::vector<PictureData> data;
  std::vector<Points> points;
  make_meshes();
  std::vector<Panel> panels;
  for (Kept const& kept : nearest) shapes.push_back(shapes_at(results_.spec.rigids, kept.time, kept.rigids));
  for (Kept const& kept : nearest) points.push_back(points_of(0, kept));
  for (std::size_t k = 0; k < nearest.size(); ++k) data.push_back(data_of(0, nearest[k], points[k], shapes[k]));
  for (std::size_t k = 0; k < nearest.size(); ++k)
    panels.push_back(
        {data[k], shown_window(shown.window, shown.camera, subject(points[k])), format.text(nearest[k].time)});
  PictureStyle style = style_of(shown.spec, shown.camera, shown.window);
  style.appearance = appearance_of(results_.spec, shown.spec);
  std::string name = path(0).filename().string();
  write_png(results_.folder / "pictures" / name.replace(name.rfind("000000"), 6, "times"),
            draw_sheet(panels, {results_.spec.title, "", fitting_columns(shown.window, panels.size())}, shown.spec,
                       shown.window, style));
}

/// A run that is stopped ends soon: the pictures that are missing are drawn when it is resumed and comes to its end.
void PictureObserver::draw_last() {
  if (!(count_ > 0)) return;
  auto const last = static_cast<std::size_t>(count_) - 1;
  if (Kept kept; !std::filesystem::exists(path(last)) && read_kept(last, kept)) draw(last, kept);
}

void PictureObserver::observe(Formulation const& formulation, TimeState const& moment) {
  if (schedule_.due(moment.time)) see_now(formulation, moment.time);
}

void PictureObserver::finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) {
  if (!schedule_.ever() || !prepare(formulation)) return;
  if (ending == RunStatus::stopped) {
    draw_last();
  } else {
    if (last_time_ != moment.time) see_now(formulation, moment.time);
    draw_all();
  }
}

void PictureObserver::save(StateWriter& writer) const {
  auto const torn = flattened(torn_);
  if (!torn.empty()) writer.put("picture_torn", std::vector<double>(torn.begin(), torn.end()));
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    Window const& window = panels_[k].window;
    Spread const& spread = panels_[k].spread;
    writer.put(name_in_state("pictures", k),
               std::array{count_, last_time_, window.set ? 1.0 : 0.0, window.x0, window.x1, window.y0, window.y1,
                          spread.typical[0], spread.typical[1]});
    writer.put(name_in_state("picture_extremes", k),
               std::array{spread.extremes[0], spread.extremes[1], spread.not_a_number ? 1.0 : 0.0});
  }
}

std::vector<std::filesystem::path> PictureObserver::files() const {
  std::vector<std::filesystem::path> list;
  for (auto const& drawn : drawn_) list.push_back(path(drawn.first));
  return list;
}

void PictureObserver::load(NamedState& reader, TimeState const& moment) {
  if (reader.has("picture_torn")) torn_ = unflattened(reader.all("picture_torn"));
  schedule_.start_after(moment.time);
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    Shown& panel = panels_[k];
    std::array<double, 9> v{};
    reader.get(name_in_state("pictures", k), v);
    count_ = v[0];
    last_time_ = v[1];
    panel.window = {v[2] != 0, v[3], v[4], v[5], v[6]};
    panel.spread.typical = {v[7], v[8]};
    std::array<double, 3> extremes{};
    reader.get(name_in_state("picture_extremes", k), extremes);
    panel.spread.extremes = {extremes[0], extremes[1]};
    panel.spread.not_a_number = extremes[2] != 0;
  }
}

}  // namespace piola
