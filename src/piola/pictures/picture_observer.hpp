// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/picture.hpp"
#include "piola/observers/observer.hpp"
#include "piola/observers/output_schedule.hpp"
#include <chrono>
#include <map>

namespace piola {

/// pictures/FIELD-000000.png at each due time and at the end. At the end of a run all pictures are drawn with one
/// colour range (unless the case gives it) and one scale, from particle positions and values stored until then. During
/// a long run a preview is also drawn if a second has passed since the last one, with the colours and scale so far; and
/// the last one when the run is stopped. The pictures nearest to given times, if requested, are combined in
/// pictures/FIELD-times.png at the end.
class PictureObserver : public Observer {
 public:
  explicit PictureObserver(Results results);
  void observe(Formulation const& formulation, TimeState const& moment) override;
  void finish(Formulation const& formulation, TimeState const& moment, RunStatus ending) override;
  void save(StateWriter& writer) const override;
  void load(NamedState& reader, TimeState const& moment) override;
  std::vector<std::filesystem::path> files() const override;
  std::filesystem::path const& last() const { return last_; }

 private:
  using Torn = std::vector<std::vector<Index>>;  ///< cells of each body, see torn_cells
  /// Data of one picture, stored on disk.
  struct Kept {
    double time = 0;
    std::vector<std::array<double, 3>> points;
    std::vector<std::vector<double>> values;  ///< per panel
    std::vector<RigidState> rigids = {};      ///< free or rotating shapes
    std::vector<std::uint8_t> loose = {};     ///< see loose_particles
    Torn torn = {};
  };
  std::vector<RigidState> turning_shapes() const;
  void see_now(Formulation const& formulation, double time);
  void draw(std::size_t number, Kept const& kept);
  using Points = std::vector<std::array<double, 3>>;
  Points points_of(std::size_t panel, Kept const& kept) const;
  PictureData data_of(std::size_t panel, Kept const& kept, Points const& points,
                      std::span<RigidShape const> shapes) const;
  Image picture(Kept const& kept) const;
  void make_meshes();
  void draw_if_cheap(std::size_t number, Kept const& kept);
  bool prepare(Formulation const& formulation);
  bool drawn_as_now(std::size_t number) const;
  void draw_all();
  void draw_last();
  void draw_times(std::vector<Kept> const& nearest);
  std::filesystem::path path(std::size_t number) const;
  std::filesystem::path kept_path(std::size_t number) const;
  void keep(std::size_t number, Kept const& kept) const;
  bool read_kept(std::size_t number, Kept& kept) const;

  Results results_;
  Schedule schedule_;
  /// Content of one panel; a picture without panels has one.
  struct Shown {
    PictureSpec spec;
    Camera camera;
    Window window;
    Spread spread;
    FieldInfo field{};  ///< without name before the first picture
    int component = whole_field;
  };
  std::vector<Shown> panels_;
  std::vector<double> radii_;
  std::vector<ReferenceMesh> meshes_;  ///< created for the first picture
  std::vector<std::uint8_t> held_;     ///< by supports, if a panel shows them
  Torn torn_;                          ///< at the last picture
  std::array<double, 3> stage_low_{}, stage_high_{};
  /// Settings of a drawn picture; unknown for pictures drawn before the run was resumed.
  struct Look {
    std::vector<Spread> spread;
    std::vector<Window> window;
    bool operator==(Look const&) const = default;
  };
  Look look() const;
  Subject subject(std::vector<std::array<double, 3>> const& points) const;
  std::map<std::size_t, Look> drawn_;
  std::chrono::steady_clock::time_point next_drawn_{};  ///< earliest time of the next preview
  bool impossible_ = false;                             ///< the formulation has no such field; the user has been warned
  double count_ = 0, last_time_ = -1;
  std::filesystem::path last_;
};

}  // namespace piola
