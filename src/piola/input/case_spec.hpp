// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/base/expression.hpp"
#include "piola/base/identity.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/input/document.hpp"
#include "piola/input/guard_limits.hpp"
#include "piola/input/picture_spec.hpp"
#include "piola/input/probe_kinds.hpp"
#include "piola/setup/faces.hpp"
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// Place in the case file, or setting, of each key that a section gives, for messages of later checks. "" is the
/// section itself. A missing key has no entry: see place_of() and is_given().
using Places = std::map<std::string, Place, std::less<>>;

/// [run]
struct RunSpec {
  double end = 0;                                             ///< s
  double cfl = std::numeric_limits<double>::quiet_NaN();      ///< nan: the scheme's default
  double max_step = std::numeric_limits<double>::infinity();  ///< s, upper bound of the step
  double min_step = 0;            ///< s; a smaller stable step is a failure (0: 1e-6 of the first step)
  int threads = 0;                ///< 0: all cores
  double damping = 0;             ///< rate at which velocities decay [1/s]
  bool relax = false;             ///< dynamic relaxation: ends at rest
  double relax_tolerance = 1e-3;  ///< relax: residual force at rest / its maximum in the run
  std::string relax_method = "kinetic_damping";
  bool minimises() const { return relax && relax_method == "conjugate_gradients"; }
  std::string backend = "auto";  ///< instruction set: auto, scalar, v3, v4
  Repartition repartition;
  GuardLimits guards;
  Places places;
};

/// [[region]]: a named set of places for formulas of supports, loads, probes, ties and parts.
struct RegionSpec {
  std::string name;
  Names::OfPlace holds;         ///< 1 or 0 at a reference position [m]; never empty
  geometry::SolidPtr solid;     ///< where it is given by a shape
  std::string text;             ///< as the case gives it
  std::vector<CaseFile> files;  ///< that it was read from
};

/// [[body.part]]: the particles of a body that consist of another material.
struct PartSpec {
  std::string name;  ///< "part_1" if the case gives none to the first one
  Expression where;
  std::optional<std::size_t> region = {};  ///< where `where` is a region with a shape and nothing else: its number
  MaterialParameters material;
  std::string law;
  Places places;
};

/// [[body]]
struct BodySpec {
  std::string name;
  ShapeSpec shape;
  MaterialParameters material;
  std::string law;
  std::vector<PartSpec> parts;  ///< of other materials; the first that holds a particle counts
  FormulationSpec formulation;
  std::array<Expression, 3> initial_velocity;                             ///< m/s
  std::optional<std::array<Expression, 3>> initial_displacement;          ///< m
  std::optional<std::array<Expression, 9>> initial_deformation_gradient;  ///< row by row
  std::optional<Expression> initial_temperature;                          ///< K
  Places places;
};

/// [[support]]: the velocity of the particles that `where` selects, prescribed in some directions.
struct SupportSpec {
  std::string name;  ///< "support_1" if the case gives none to the second one
  std::string body;
  std::optional<Expression> where;  ///< both given: those of the patch that it selects
  std::optional<Face> patch;        ///< of a solid
  ShapeSpec shape;                  ///< of the body, if there is a patch
  enum class Hold { surface, particles };
  std::optional<Hold> hold;  ///< of a patch: itself, or the particles along it; nothing: what the formulation can do
  Support::Frame frame = Support::Frame::axes;
  std::array<bool, 3> fix{};                               ///< frame axes
  std::array<double, 3> normal{};                          ///< frames normal, tangent: unit vector
  std::optional<std::array<Expression, 3>> velocity;       ///< m/s, in X, Y, Z, t; nothing: at rest
  double until = std::numeric_limits<double>::infinity();  ///< s: released then
  Places places;
};

/// [[load]]: a dead load on the particles that `where` selects.
struct LoadSpec {
  enum class Kind { traction, body_force, acceleration, pressure, non_reflecting };
  std::string name;  ///< empty: its force is not recorded
  std::string body;
  std::optional<Expression> where;  ///< default all
  Kind kind = Kind::acceleration;
  std::array<Expression, 3> value;  ///< Pa, N/m^3 or m/s^2, in X, Y, Z, t; non-reflecting: background velocity [m/s]
  Absorption absorption;            ///< non-reflecting
  Face face;                        ///< traction, pressure, non-reflecting
  ShapeSpec shape;                  ///< of the body
  bool follower = false;            ///< pressure: on the deformed face
  /// Key of `value`.
  char const* value_key() const {
    constexpr std::array keys{"traction", "body_force", "acceleration", "pressure", "background_velocity"};
    return keys[static_cast<std::size_t>(kind)];
  }
  bool on_face() const { return kind != Kind::body_force && kind != Kind::acceleration; }
  double until = std::numeric_limits<double>::infinity();  ///< s: gone then
  Places places;
};

/// [[mirror]]: symmetry plane at a face of a body.
struct MirrorSpec {
  std::string body;
  Face face;
  bool antisymmetric = false;  ///< the image moves the opposite way
  Places places;
};

/// [[crack]]: a straight crack in a two-dimensional box.
struct CrackSpec {
  std::string body;
  std::array<double, 3> from{}, to{};  ///< ends [m]
  Places places;
};

/// [[rigid]]: an obstacle that no body enters.
struct RigidSpec : RigidShape {
  Places places;
};

/// [[spring]]: a spring and dashpot of a free rigid shape.
struct SpringSpec : RigidSpring {
  Places places;
};

/// [contact]: what keeps bodies apart.
struct ContactSpec : ContactRule {
  Places places;
};

/// [[contact]] with `between`.
struct ContactPairSpec : ContactPair {
  Places places;
};

/// [[tie]]: two bodies, or a body and a rigid shape, held together where their surfaces touch at the start.
struct TieSpec : contact::TieRule {
  std::array<std::string, 2> between;
  Places places;
};

/// [[probe]]: one or more columns NAME.quantity in history.csv.
struct ProbeSpec {
  using Kind = ProbeKind;
  enum class Fragment { largest, largest_free };
  std::string name;
  std::string body;
  Kind kind = Kind::point;
  /// point: the nearest particle is used; stress_intensity: that is the crack tip; fragment, rim, hole: a point of the
  /// axis [m]
  std::array<double, 3> at{};
  std::optional<Expression> where;      ///< where it has a meaning: particles that count (default all)
  int axis = 1;                         ///< twist, extent, fragment, rim, hole: 0 x, 1 y, 2 z
  std::string field;                    ///< error: name of a field, e.g. "FirstPiolaStress"
  std::vector<Expression> reference;    ///< error: one formula in X, Y, Z, t per component of the field [SI]
  std::vector<std::string> quantities;  ///< e.g. "velocity_x", "pressure"; twist: "twist_angle"; extent: "extent";
                                        ///< error: "relative_error"; stress_intensity: "stress_intensity"; other kinds:
                                        ///< see probe_kinds
  std::array<double, 3> direction{1, 0, 0};  ///< stress_intensity: ahead of the tip, unit vector
  double from = 0, to = 0;                   ///< stress_intensity: distances from the tip [m]
  double link = 1.5;                         ///< fragment, rim, hole: linked if closer than this many spacings
  std::optional<Expression> anchored_where;  ///< fragment, rim, hole: particles in X, Y, Z of what stays in place
  Fragment fragment = Fragment::largest;     ///< fragment: which one
  double near_axis = std::numeric_limits<double>::infinity();  ///< fragment: extents, distance from the axis [m]
  int min_particles = 1;                                       ///< fragment: smaller ones are not counted as large
  double within = 0, base = 0;        ///< rim: largest radius; coordinate along the axis from which heights count [m]
  int sectors = 24;                   ///< rim
  double slab_from = 0, slab_to = 0;  ///< hole: coordinates along the axis [m]
  double cavity_from = 0, cavity_to = std::numeric_limits<double>::infinity();  ///< hole: the same for the cavity [m]
  double bin = 1;                                                               ///< hole: in spacings
  Places places;
};

/// [[quantity]]: a number of summary.json, taken from a column of history.csv.
struct QuantitySpec {
  enum class Statistic {
    maximum,
    minimum,
    final_value,
    initial_value,
    first_peak,
    time_of_first_peak,
    time_of_maximum,
    time_of_minimum,
    first_time_above,
    first_time_below,
    mean_absolute_difference,
    at_time,
    relative_error,
    oscillation_period,
    range,
    change,
    mean
  };
  std::string name;
  std::string column;
  Statistic take = Statistic::maximum;
  double threshold = 0;                 ///< first_time_above, first_time_below [SI]
  double time = 0;                      ///< at_time [s]
  std::optional<Expression> reference;  ///< mean_absolute_difference, relative_error: formula in t
  std::string unit = "1";               ///< as shown
  double from = 0;  ///< mean, mean_absolute_difference, relative_error: rows from this time on; change: start [s]
  double until = std::numeric_limits<double>::infinity();  ///< and up to this one; change: end [s]
};

/// Whether what is taken is an instant [s].
inline bool needs_time(QuantitySpec::Statistic take) {
  using enum QuantitySpec::Statistic;
  return take == time_of_first_peak || take == time_of_maximum || take == time_of_minimum || take == first_time_above ||
         take == first_time_below;
}

/// [output]; times in s, 0 = never. Output falls on the first step at or after each multiple.
struct OutputSpec {
  double frames_every = 0;
  std::vector<std::string> frame_fields;  ///< empty: the formulation's default list
  double history_every = 0;               ///< 0: a five-hundredth of the run
  double checkpoints_every = 0;           ///< also written at the end, on a signal, on failure
  PicturesSpec pictures;
  bool compress = true;
};

/// Fields of the frames of a run: those that the case asks for and those of its pictures; empty: all of the
/// formulation. `failed`: in the last state of a failed run, which has all where only pictures are asked for.
inline std::vector<std::string> fields_of_frames(OutputSpec const& output, bool failed = false) {
  std::vector<std::string> fields = output.frame_fields;
  bool const pictures_alone = output.frames_every <= 0 && !failed;
  if (output.pictures.every <= 0 || (fields.empty() && !pictures_alone)) return fields;
  fields.insert(fields.end(), {output.pictures.field, "Damage", "KernelType"});
  for (PictureSpec const& panel : output.pictures.panels) fields.push_back(panel.field);
  return fields;
}

/// A whole case: plain values in SI, checked.
struct CaseSpec {
  std::string title;
  bool axisymmetric = false;               ///< x is the radius, y along the axis
  std::string source;                      ///< the case file as run: overrides applied, present spellings, TOML
  std::vector<OldSpelling> old_spellings;  ///< that the case file and the settings have
  Identity identity;                       ///< of a run of it, taken when its files were read
  RunSpec run;
  std::vector<RegionSpec> regions;
  std::vector<BodySpec> bodies;
  std::vector<SupportSpec> supports;
  std::vector<LoadSpec> loads;
  std::vector<MirrorSpec> mirrors;
  std::vector<CrackSpec> cracks;
  std::vector<RigidSpec> rigids;
  std::vector<SpringSpec> springs;
  std::optional<ContactSpec> contact;  ///< nothing: the formulation's rule
  std::vector<ContactPairSpec> contact_pairs;
  std::vector<TieSpec> ties;
  std::vector<ProbeSpec> probes;
  std::vector<QuantitySpec> quantities;
  OutputSpec output;
  std::vector<CaseFile> files;  ///< that the case names; bodies and regions hold what they take from them
};

}  // namespace piola
