// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/picture_observer.hpp"
#include "piola/output/files.hpp"
#include "piola/output/rigid_picture.hpp"
#include "piola/simulation/look.hpp"
#include "piola/simulation/scene.hpp"
#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace piola {

namespace {

/// Rounded as in the file of what is kept: whether a picture is drawn at once or at the end depends on the clock, and
/// must not show.
double as_kept(double value) { return static_cast<double>(static_cast<float>(value)); }

}  // namespace

PictureObserver::PictureObserver(Results results)
    : results_(std::move(results)), schedule_(results_.spec.output.pictures_every) {
  auto const& particles = results_.particles;
  auto const& output = results_.spec.output;
  camera_ = camera_of(output, upwards(results_.spec), results_.spec.bodies, particles.dimension);
  if (!schedule_.ever()) return;
  radii_ = ball_radii(particles.volume, particles.body, particles.dimension);
  Stage const stage = Stage::around(particles.X);
  stage_low_ = stage.low;
  stage_high_ = stage.high;
  if (particles.dimension == 3) camera_.eye = eye_before(camera_, output.picture_perspective, stage_low_, stage_high_);
}

/// Those whose places a kept picture holds.
std::vector<RigidState> PictureObserver::turning_shapes() const {
  std::vector<RigidState> shapes;
  for (RigidSpec const& rigid : results_.spec.rigids)
    if (rigid.turns()) shapes.emplace_back().name = rigid.name;
  return shapes;
}

std::filesystem::path PictureObserver::path(std::size_t number) const {
  return results_.folder / "pictures" / picture_name(field_.name, field_.components, component_, number);
}

std::filesystem::path PictureObserver::kept_path(std::size_t number) const {
  return path(number).replace_extension(".values");
}

void PictureObserver::keep(std::size_t number, Kept const& kept) const {
  std::vector<double> head{kept.time};
  for (RigidState const& rigid : kept.rigids)
    for (auto const& part : {rigid.centre, rigid.turn}) head.insert(head.end(), part.begin(), part.end());
  std::vector<float> numbers;
  numbers.reserve(4 * kept.values.size() + 2);
  for (auto const& p : kept.points)
    for (double const c : p) numbers.push_back(static_cast<float>(c));
  for (double const v : kept.values) numbers.push_back(static_cast<float>(v));
  std::size_t const before = head.size() * sizeof(double);
  std::size_t const middle = before + numbers.size() * sizeof(float);
  std::vector<std::byte> bytes(middle + kept.loose.size());
  std::memcpy(bytes.data(), head.data(), before);
  if (!numbers.empty()) std::memcpy(bytes.data() + before, numbers.data(), numbers.size() * sizeof(float));
  if (!kept.loose.empty()) std::memcpy(bytes.data() + middle, kept.loose.data(), kept.loose.size());
  write_whole_file(kept_path(number), bytes);
}

bool PictureObserver::read_kept(std::size_t number, Kept& kept) const {
  if (!std::filesystem::exists(kept_path(number))) return false;
  std::string const bytes = read_text_file(kept_path(number));
  std::size_t const n = radii_.size();
  std::vector<float> numbers(4 * n);
  kept.rigids = turning_shapes();
  std::vector<double> head(1 + 6 * kept.rigids.size());
  std::size_t const before = head.size() * sizeof(double);
  std::size_t const middle = before + numbers.size() * sizeof(float);
  if (bytes.size() != middle + n) return false;
  kept.loose.assign(bytes.begin() + static_cast<std::ptrdiff_t>(middle), bytes.end());
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
  kept.values.assign(numbers.begin() + static_cast<std::ptrdiff_t>(3 * n), numbers.end());
  return true;
}

void PictureObserver::draw(std::size_t number, Kept const& kept) {
  auto const& output = results_.spec.output;
  auto const shapes = shapes_at(results_.spec.rigids, kept.time, kept.rigids);
  if (meshes_.empty()) meshes_ = reference_meshes(results_.particles);
  PictureData const data{.points = kept.points,
                         .radius = radii_,
                         .values = kept.values,
                         .label = picture_label(field_.name, field_.components, component_),
                         .unit = field_.unit,
                         .title = results_.spec.title,
                         .time = kept.time,
                         .dimension = results_.particles.dimension,
                         .rigid_shapes = shapes,
                         .stage_low = stage_low_,
                         .stage_high = stage_high_,
                         .spread = spread_,
                         .case_text = results_.spec.source,
                         .eye = eye_at(camera_, subject(kept.points)),
                         .time_format = time_format(results_.spec.run.end, output.pictures_every),
                         .body = results_.particles.body,
                         .meshes = meshes_,
                         .loose = kept.loose};
  PictureStyle style = style_of(output, camera_, window_);
  style.appearance = appearance_of(results_.spec);
  write_png(path(number), draw_picture(data, style, shown_window(window_, camera_, subject(kept.points))));
  drawn_[number] = look();
}

/// What is drawn; false if the formulation has no such field.
bool PictureObserver::prepare(Formulation const& formulation) {
  if (impossible_ || !field_.name.empty()) return !impossible_;
  auto const& output = results_.spec.output;
  FieldCache const cache(formulation, results_.particles);
  if (cache.knows(output.picture_field)) {
    FieldInfo const& info = cache.info(output.picture_field);
    if (auto const component = find_component(output.picture_component, info.components)) {
      field_ = info;
      component_ = *component;
      return true;
    }
  }
  impossible_ = true;
  results_.journal.warn(fmt::format(
      "pictures: the formulation has no field '{}'{}, so that no picture is drawn", output.picture_field,
      output.picture_component.empty() ? "" : fmt::format(" with a component '{}'", output.picture_component)));
  return false;
}

void PictureObserver::see_now(Formulation const& formulation, double time) {
  if (!prepare(formulation)) return;
  FieldCache cache(formulation, results_.particles);
  Kept kept{time, std::vector<std::array<double, 3>>(radii_.size()), {}, formulation.rigids()};
  auto const x = cache.values("Position");
  for (std::size_t i = 0; i < 3 * radii_.size(); ++i) kept.points[i / 3][i % 3] = as_kept(x[i]);
  kept.values = picture_values(cache.values(field_.name), field_.components, component_);
  for (double& value : kept.values) value = as_kept(value);
  auto const if_known = [&](char const* field) {
    return cache.knows(field) ? cache.values(field) : std::span<double const>();
  };
  kept.loose = loose_particles(if_known("Damage"), if_known("KernelType"), radii_.size());

  include(window_, camera_, subject(kept.points));
  if (camera_.follow < 0)
    show_shapes(window_, camera_.view, shapes_at(results_.spec.rigids, time, kept.rigids), {stage_low_, stage_high_});
  spread_.include(kept.values);
  make_folder(results_.folder / "pictures");
  auto const number = static_cast<std::size_t>(count_);
  keep(number, kept);
  constexpr std::chrono::seconds pause(1);
  auto const now = std::chrono::steady_clock::now();
  if (now - last_drawn_ >= pause) {
    last_drawn_ = now;
    draw(number, kept);
  }
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
  for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
    if (Kept kept; !drawn_as_now(k) && read_kept(k, kept)) draw(k, kept);
    std::filesystem::remove(kept_path(k));
  }
}

/// A run that is stopped ends soon: the pictures that are missing are drawn when it is resumed and comes to its end.
void PictureObserver::draw_last() {
  if (!(count_ > 0)) return;
  auto const last = static_cast<std::size_t>(count_) - 1;
  if (Kept kept; !std::filesystem::exists(path(last)) && read_kept(last, kept)) draw(last, kept);
}

void PictureObserver::see(Formulation const& formulation, Moment const& moment) {
  if (schedule_.due(moment.time)) see_now(formulation, moment.time);
}

void PictureObserver::finish(Formulation const& formulation, Moment const& moment, Ending ending) {
  if (!schedule_.ever() || !prepare(formulation)) return;
  if (ending == Ending::stopped) {
    draw_last();
  } else {
    if (last_time_ != moment.time) see_now(formulation, moment.time);
    draw_all();
  }
}

void PictureObserver::save(StateWriter& writer) const {
  writer.put("pictures", std::array{count_, last_time_, window_.set ? 1.0 : 0.0, window_.x0, window_.x1, window_.y0,
                                    window_.y1, spread_.typical[0], spread_.typical[1]});
  writer.put("picture_extremes",
             std::array{spread_.extremes[0], spread_.extremes[1], spread_.not_a_number ? 1.0 : 0.0});
}

void PictureObserver::load(NamedState& reader, Moment const& moment) {
  std::array<double, 9> v{};
  reader.get("pictures", v);
  schedule_.start_after(moment.time);
  count_ = v[0];
  last_time_ = v[1];
  window_ = {v[2] != 0, v[3], v[4], v[5], v[6]};
  spread_.typical = {v[7], v[8]};
  if (!reader.has("picture_extremes")) return;  // written by an earlier version
  std::array<double, 3> extremes{};
  reader.get("picture_extremes", extremes);
  spread_.extremes = {extremes[0], extremes[1]};
  spread_.not_a_number = extremes[2] != 0;
}

}  // namespace piola
