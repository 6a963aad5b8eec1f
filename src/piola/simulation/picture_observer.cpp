// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/picture_observer.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/pictures/case_scene.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {

PictureObserver::PictureObserver(Results results, FrameObserver& frames)
    : results_(std::move(results)), frames_(frames), schedule_(results_.spec.output.pictures.every) {}

/// Whether the formulation has the fields of all panels; warns if not.
bool PictureObserver::possible(Formulation const& formulation) {
  if (possible_) return *possible_;
  possible_ = true;
  FieldCache const cache(formulation, results_.particles);
  for (PictureSpec const& spec : panels_of(results_.spec.output.pictures)) {
    if (cache.knows(spec.field) && find_component(spec.component, cache.info(spec.field).components)) continue;
    possible_ = false;
    results_.journal.warn(
        fmt::format("pictures: the formulation has no field '{}'{}, so that no picture is drawn", spec.field,
                    spec.component.empty() ? "" : fmt::format(" with a component '{}'", spec.component)));
  }
  return *possible_;
}

void PictureObserver::take(Formulation const& formulation, double time) {
  frames_.write(formulation, time);
  numbers_.push_back(frames_.times().size() - 1);
  comm::on_root([&] {
    read_frames();
    draw_preview();
  });
}

/// Reads the frames of new pictures; in a resumed run also those of the parts before.
void PictureObserver::read_frames() {
  CaseSpec const& spec = results_.spec;
  if (!pictures_)
    pictures_.emplace(PicturedRun{spec, results_.particles, time_format(spec.run.end, spec.output.pictures.every)});
  std::string problem;
  std::size_t unreadable = 0;
  for (; read_ < numbers_.size(); ++read_) {
    try {
      pictures_->add(results_.folder / frame_name(numbers_[read_]), read_);
    } catch (std::runtime_error const& error) {  // one of an earlier part was removed, or has not these fields
      if (unreadable++ == 0) problem = error.what();
    }
  }
  if (unreadable > 0)
    results_.journal.warn(fmt::format("pictures: {} of {} frames are not drawn: {}", unreadable, read_, problem));
}

std::filesystem::path PictureObserver::path(std::size_t k) const {
  return results_.folder / "pictures" / pictures_->name(k);
}

void PictureObserver::draw(std::size_t k) {
  make_folder(results_.folder / "pictures");
  write_png(path(k), pictures_->picture(k));
  drawn_[k] = pictures_->look();
}

void PictureObserver::draw_preview() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds pause(1);
  constexpr int work_between = 50;  // multiple of the time of the last preview
  auto const now = Clock::now();
  if (now < next_preview_ || pictures_->count() == 0) return;
  draw(pictures_->count() - 1);
  auto const drawn = Clock::now();
  next_preview_ = drawn + std::max<Clock::duration>(pause, work_between * (drawn - now));
}

/// Draws the pictures whose previews have another range or scale, or that have none. Frames that were removed during
/// the run are left out.
void PictureObserver::draw_all() {
  auto const look = pictures_->look();
  auto const& times = results_.spec.output.pictures.times;
  bool complete = true;
  for (std::size_t k = 0; k < pictures_->count(); ++k) {
    bool const there = std::filesystem::exists(pictures_->frame(k));
    auto const preview = drawn_.find(k);
    if (there && (preview == drawn_.end() || preview->second != look)) draw(k);
    complete = complete && there;
  }
  if (complete && !times.empty())
    write_png(results_.folder / "pictures" / pictures_->name_of_times(), pictures_->picture_of_times(times));
}

void PictureObserver::observe(Formulation const& formulation, TimeState const& moment) {
  if (schedule_.due(moment.time) && possible(formulation)) take(formulation, moment.time);
}

void PictureObserver::finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) {
  if (!schedule_.ever() || !possible(formulation)) return;
  bool const taken = !numbers_.empty() && frames_.times()[numbers_.back()] == moment.time;
  if (!taken && ending != RunStatus::stopped) take(formulation, moment.time);
  comm::on_root([&] {
    if (!pictures_ || pictures_->count() == 0) return;  // nothing new in this part of the run
    if (ending != RunStatus::stopped)
      draw_all();
    else if (!drawn_.contains(pictures_->count() - 1))
      draw(pictures_->count() - 1);
  });
}

void PictureObserver::save(StateWriter& writer) const {
  writer.put("picture_frames", std::vector<double>(numbers_.begin(), numbers_.end()));
}

void PictureObserver::load(NamedState& reader, TimeState const& moment) {
  schedule_.start_after(moment.time);
  numbers_.clear();
  for (double const number : reader.all("picture_frames")) numbers_.push_back(static_cast<std::size_t>(number));
}

std::vector<std::filesystem::path> PictureObserver::files() const {
  std::vector<std::filesystem::path> list;
  for (auto const& drawn : drawn_) list.push_back(path(drawn.first));
  return list;
}

}  // namespace piola
