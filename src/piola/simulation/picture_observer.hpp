// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/pictures/frame_pictures.hpp"
#include "piola/simulation/observers.hpp"
#include <chrono>
#include <map>
#include <optional>

namespace piola {

/// pictures/FIELD-000000.png at each due time and at the end, drawn from the frames of these times. All are drawn at
/// the end of the run, with the colour range (unless the case gives it) and the scale of all. During a long run a
/// preview is drawn if a second has passed since the last one, and the last picture when the run is stopped. The
/// pictures nearest to given times, if requested, are combined in pictures/FIELD-times.png at the end.
class PictureObserver : public Observer {
 public:
  /// `frames` must outlive this object and observe before it.
  PictureObserver(Results results, FrameObserver& frames);
  void observe(Formulation const& formulation, TimeState const& moment) override;
  void finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) override;
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, TimeState const& moment) override;
  std::vector<std::filesystem::path> files() const override;
  /// The last picture drawn; empty if there is none.
  std::filesystem::path last() const { return drawn_.empty() ? std::filesystem::path() : path(drawn_.rbegin()->first); }

 private:
  bool possible(Formulation const& formulation);
  void take(Formulation const& formulation, double time);
  void read_frames();
  std::filesystem::path path(std::size_t k) const;
  void draw(std::size_t k);
  void draw_preview();
  void draw_all();

  Results results_;
  FrameObserver& frames_;
  Schedule schedule_;
  std::vector<std::size_t> numbers_;       ///< of the frame of each picture
  std::optional<FramePictures> pictures_;  ///< made for the first picture of this part of the run
  std::size_t read_ = 0;                   ///< number of frames that are in pictures_, or cannot be read
  std::map<std::size_t, FramePictures::Look> drawn_;
  std::chrono::steady_clock::time_point next_preview_{};
  std::optional<bool> possible_;  ///< whether the formulation has the fields; nothing: not known yet
};

}  // namespace piola
