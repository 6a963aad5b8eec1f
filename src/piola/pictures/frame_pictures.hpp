// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/drawing/panels.hpp"
#include "piola/drawing/revolution.hpp"
#include "piola/drawing/rigid_picture.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/output/frame_reader.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace piola {

/// A run whose frames are drawn as its spec.output.pictures say.
struct PicturedRun {
  CaseSpec spec = {};                          ///< without a case that can be read: the title of the run alone
  ParticleSet particles = {};                  ///< of the case
  std::optional<TimeFormat> time_format = {};  ///< nothing: one that fits the frames

  /// The run in a results folder.
  static PicturedRun in(std::filesystem::path const& folder);
};

/// A frame as pictures show it.
struct Shot {
  /// Content of one panel.
  struct Panel {
    FieldInfo field;
    int component;
    std::vector<double> values;
    std::vector<std::array<double, 3>> points;  ///< with magnified displacements [m]
    std::optional<double> swept = {};           ///< see PictureData::swept
    RevolvedPoints in_space = {};               ///< of axisymmetric bodies
  };
  double time;                                ///< s
  int dimension;                              ///< of the bodies
  std::vector<std::array<double, 3>> points;  ///< m
  std::vector<int> body;
  std::vector<std::uint8_t> loose;  ///< see loose_particles
  std::vector<RigidShape> shapes;
  bool axisymmetric = false;
  bool of_case = false;  ///< particles are those of the case
  std::vector<double> volume = {}, radii = {};
  std::vector<Panel> panels = {};
};

/// Draws the pictures of one run from its frames, with one colour range and one scale: those of all frames added so
/// far. A picture without panels is drawn like one with a single panel.
class FramePictures {
 public:
  explicit FramePictures(PicturedRun run);
  /// Adds the next frame in order of time; `number` is that of its picture. Throws FileError, or InputError if the
  /// frame has not the fields of the pictures, or the case not the body to follow; nothing is added then.
  void add(std::filesystem::path const& frame, std::size_t number);
  /// Gives both the range and the scale of both.
  void share_with(FramePictures& other);

  std::size_t count() const { return frames_.size(); }
  double time(std::size_t k) const {
    PIOLA_EXPECTS(k < frames_.size());
    return frames_[k].time;
  }
  std::filesystem::path const& frame(std::size_t k) const {
    PIOLA_EXPECTS(k < frames_.size());
    return frames_[k].path;
  }
  /// The frame nearest in time; there must be one.
  std::size_t nearest(double time) const;
  TimeFormat time_format() const;
  std::string const& title() const { return run_.spec.title; }
  /// "Pressure-000012.png" with the number of the picture, "Pressure-Damage-000012.png" of panels with several fields.
  std::string name(std::size_t k) const;
  Image picture(std::size_t k) const;
  /// The first panel of frames as one picture with one bar: frame `frames[n]` of the run `*runs[n]`. Scale, view and
  /// size are those of the first run.
  static Image sheet(std::span<FramePictures const* const> runs, std::span<std::size_t const> frames,
                     std::span<std::string const> captions, Sheet labels);
  /// The frames nearest to these times [s] as one picture.
  Image picture_of_times(std::span<double const> times) const;
  std::string name_of_times() const;

  /// Range and scale of a picture.
  struct Look {
    std::vector<Spread> spread;
    std::vector<Window> window;  ///< of equal size
    bool operator==(Look const&) const = default;
  };
  Look look() const;

 private:
  using Torn = std::vector<std::vector<Index>>;  ///< cells of each body, see current_torn_cells
  struct PanelView {
    PictureSpec spec;
    std::vector<std::uint8_t> held = {};  ///< by supports, if they are shown
    Camera camera = {};                   ///< set by the first frame, as the following two
    FieldInfo field = {};
    int component = whole_field;
    Window window = {};
    Spread spread = {};
    Stage stage = {};
  };
  struct Entry {
    double time;
    std::filesystem::path path;
    std::size_t number;
    Torn torn;
  };
  Shot read(std::filesystem::path const& path) const;
  Shot::Panel panel_of(FrameReader const& frame, Shot const& shot, PictureSpec const& spec) const;
  void begin(Shot const& first);
  Subject subject(Shot const& shot, std::size_t panel) const;
  PictureData data(Shot const& shot, std::size_t panel, Torn const& torn) const;
  PictureStyle style(std::size_t panel, Window const& window) const;

  PicturedRun run_;
  std::vector<ReferenceMesh> meshes_;
  std::vector<PanelView> views_;
  std::vector<Entry> frames_;
};

}  // namespace piola
