// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_keys.hpp"
#include "piola/base/text.hpp"
#include <array>
#include <cmath>
#include <stdexcept>

namespace piola {
namespace {

using enum KeyInfo::Kind;
using Words = std::span<std::string_view const>;

// Lengths outside these bounds are slips, and their volumes would leave the range of numbers.
constexpr Interval place_range{-1e15, 1e15, false, false};
constexpr Interval length_range{1e-15, 1e15, false, false};
constexpr Interval count_range{1, 2147483647, false, false};
constexpr Interval half_open{0, 0.5, false, true};

constexpr std::array<std::string_view, 5> machine_words{"auto", "scalar", "v2", "v3", "v4"};
constexpr std::array<std::string_view, 2> placement_words{"on_boundary", "cell_centred"};
constexpr std::array<std::string_view, 3> axis_words{"x", "y", "z"};
constexpr std::array<std::string_view, 6> face_words{"-x", "+x", "-y", "+y", "-z", "+z"};
constexpr std::array<std::string_view, 8> probe_words{"point", "average", "maximum", "minimum",
                                                      "twist", "extent",  "error",   "stress_intensity"};
constexpr std::array<std::string_view, 15> take_words{"maximum",
                                                      "minimum",
                                                      "final_value",
                                                      "initial_value",
                                                      "first_peak",
                                                      "time_of_first_peak",
                                                      "time_of_maximum",
                                                      "time_of_minimum",
                                                      "first_time_above",
                                                      "first_time_below",
                                                      "mean_absolute_difference",
                                                      "at_time",
                                                      "relative_error",
                                                      "oscillation_period",
                                                      "range"};

constexpr std::array sections{
    SectionInfo{"", "", "the top of the file"},
    SectionInfo{"run", "[run]", "how long and how to run"},
    SectionInfo{"body", "[[body]]", "one body of particles; a case has one or more"},
    SectionInfo{"body.shape", "shape = { ... }", "what a body looks like: exactly one of box, sphere, cylinder"},
    SectionInfo{"body.shape.box", "box = { ... }", "a box; the number of components is the dimension of the case"},
    SectionInfo{"body.shape.sphere", "sphere = { ... }", "a sphere; a disc with two components, an interval with one"},
    SectionInfo{"body.shape.cylinder", "cylinder = { ... }", "a circular cylinder, three dimensions only"},
    SectionInfo{"body.material", "material = { ... }", "the law of the material and its parameters"},
    SectionInfo{"body.formulation", "formulation = { ... }", "the SPH formulation and its settings"},
    SectionInfo{"support", "[[support]]", "particles whose velocity is prescribed in some directions: zero, or driven"},
    SectionInfo{"load", "[[load]]", "a dead load: exactly one of traction, body_force, acceleration"},
    SectionInfo{"mirror", "[[mirror]]", "a face of a box across which the body goes on as its mirror image"},
    SectionInfo{"crack", "[[crack]]", "a straight crack in a two-dimensional box, without traction on its faces"},
    SectionInfo{"probe", "[[probe]]", "columns NAME.QUANTITY of history.csv"},
    SectionInfo{"quantity", "[[quantity]]", "a number of summary.json, taken from a column of history.csv"},
    SectionInfo{"output", "[output]", "what is written; each part may be left out"},
    SectionInfo{"output.frames", "[output.frames]", "files for ParaView with a field of values per particle"},
    SectionInfo{"output.history", "[output.history]", "the table history.csv"},
    SectionInfo{"output.pictures", "[output.pictures]", "PNG pictures coloured by a field"},
    SectionInfo{"output.checkpoints", "[output.checkpoints]", "files to resume from; one is always written at the end"},
};

constexpr std::array keys{
    KeyInfo{"", "title", text, "", {}, "", "what the case is called in files and pictures", {}},
    KeyInfo{"",
            "constants",
            table,
            "",
            {},
            "none",
            "named numbers for formulas: name = \"105 rad/s\" or a number in SI units",
            {}},
    KeyInfo{"", "run", table, "", {}, "", "how long and how to run", {}},
    KeyInfo{"", "body", list, "", {}, "", "the bodies", {}},
    KeyInfo{"", "support", list, "", {}, "none", "the supports", {}},
    KeyInfo{"", "load", list, "", {}, "none", "the loads", {}},
    KeyInfo{"", "mirror", list, "", {}, "none", "the planes of symmetry", {}},
    KeyInfo{"", "crack", list, "", {}, "none", "the cracks", {}},
    KeyInfo{"", "probe", list, "", {}, "none", "the probes", {}},
    KeyInfo{"", "quantity", list, "", {}, "none", "the quantities of the summary", {}},
    KeyInfo{"", "output", table, "", {}, "a history only", "what is written", {}},

    KeyInfo{"run", "end", quantity, "s", positive, "", "time at which the run ends", {}},
    KeyInfo{"run",
            "cfl",
            quantity,
            "1",
            {0, 2, true, false},
            "the formulation's",
            "step as a fraction of spacing / wave speed",
            {}},
    KeyInfo{"run", "max_step", quantity, "s", positive, "no bound", "largest step", {}},
    KeyInfo{"run",
            "min_step",
            quantity,
            "s",
            not_negative,
            "1e-6 of the first step",
            "a smaller stable step stops the run as failed",
            {}},
    KeyInfo{"run",
            "threads",
            whole,
            "",
            {1, 4096, false, false},
            "\"auto\" (all cores)",
            "number of threads, or \"auto\"",
            {}},
    KeyInfo{"run", "machine", word, "", {}, "\"auto\"", "instruction set of the processor", machine_words},

    KeyInfo{"body", "name", name, "", {}, "", "name that supports and probes refer to", {}},
    KeyInfo{"body", "shape", table, "", {}, "", "shape and particles", {}},
    KeyInfo{"body", "material", table, "", {}, "", "law and parameters", {}},
    KeyInfo{"body", "formulation", table, "", {}, "", "formulation and settings", {}},
    KeyInfo{"body",
            "define",
            table,
            "",
            {},
            "none",
            "named formulas for the formulas of this body, its supports and probes",
            {}},
    KeyInfo{"body",
            "initial_velocity",
            formulas,
            "m/s",
            {},
            "at rest",
            "velocity at the start, one formula per direction",
            {}},
    KeyInfo{"body",
            "initial_displacement",
            formulas,
            "m",
            {},
            "none",
            "displacement at the start, one formula per direction",
            {}},
    KeyInfo{"body",
            "initial_deformation_gradient",
            formulas,
            "1",
            {},
            "the identity",
            "deformation gradient at the start, a list of rows of formulas",
            {}},

    KeyInfo{"body.shape", "box", table, "", {}, "none", "a box", {}},
    KeyInfo{"body.shape", "sphere", table, "", {}, "none", "a sphere, disc or interval", {}},
    KeyInfo{"body.shape", "cylinder", table, "", {}, "none", "a cylinder", {}},
    KeyInfo{"body.shape", "particles", list, "", count_range, "from spacing", "box: particles per direction", {}},
    KeyInfo{"body.shape",
            "spacing",
            quantity,
            "m",
            length_range,
            "from particles",
            "distance of particles; a box takes the nearest that fits",
            {}},
    KeyInfo{"body.shape",
            "placement",
            word,
            "",
            {},
            "\"on_boundary\"",
            "box: particles on the faces, or in the middle of cells",
            placement_words},
    KeyInfo{"body.shape",
            "jitter",
            quantity,
            "1",
            half_open,
            "0",
            "random shift of inner particles as a fraction of the spacing",
            {}},
    KeyInfo{"body.shape", "seed", whole, "", {0, 4294967295.0, false, false}, "1", "seed of the jitter", {}},

    KeyInfo{"body.shape.box", "min", point, "m", place_range, "", "lowest corner", {}},
    KeyInfo{"body.shape.box", "max", point, "m", place_range, "", "highest corner", {}},
    KeyInfo{"body.shape.sphere", "centre", point, "m", place_range, "", "centre", {}},
    KeyInfo{"body.shape.sphere", "radius", quantity, "m", length_range, "", "radius", {}},
    KeyInfo{"body.shape.cylinder", "centre", point, "m", place_range, "", "centre of the lower end", {}},
    KeyInfo{"body.shape.cylinder", "radius", quantity, "m", length_range, "", "radius", {}},
    KeyInfo{
        "body.shape.cylinder", "length", quantity, "m", length_range, "", "length from the lower to the upper end", {}},
    KeyInfo{
        "body.shape.cylinder", "axis", word, "", {}, "\"z\"", "direction from the lower to the upper end", axis_words},

    KeyInfo{"body.material",
            "law",
            text,
            "",
            {},
            "that of `name`",
            "name of the law; its words and parameters are further keys",
            {}},
    KeyInfo{"body.material",
            "name",
            text,
            "",
            {},
            "none",
            "a material of the library; further keys change its parameters",
            {}},
    KeyInfo{"body.formulation", "name", text, "", {}, "", "name of the formulation; its settings are further keys", {}},

    KeyInfo{"support", "body", name, "", {}, "", "name of the body", {}},
    KeyInfo{"support", "where", formula, "", {}, "", "condition in X, Y, Z that selects particles", {}},
    KeyInfo{
        "support",
        "fix",
        text,
        "",
        {},
        "",
        "directions held: letters of \"xyz\"; with normal: \"normal\" (a roller) or \"tangent\" (across the normal)",
        {}},
    KeyInfo{"support", "normal", point, "1", place_range, "none", "direction that fix refers to, of any length", {}},
    KeyInfo{"support",
            "velocity",
            formulas,
            "m/s",
            {},
            "at rest",
            "prescribed velocity, one formula in X, Y, Z, t per direction; only the held directions count",
            {}},
    KeyInfo{"support", "until", quantity, "s", positive, "the end of the run", "released at this time", {}},

    KeyInfo{"load", "body", name, "", {}, "", "name of the body", {}},
    KeyInfo{"load", "where", formula, "", {}, "all particles", "condition in X, Y, Z that selects particles", {}},
    KeyInfo{"load",
            "traction",
            formulas,
            "Pa",
            {},
            "none",
            "force per reference area of a face, one formula in X, Y, Z, t per direction",
            {}},
    KeyInfo{"load", "face", word, "", {}, "none", "traction (required there): the loaded face of a box", face_words},
    KeyInfo{"load",
            "body_force",
            formulas,
            "N/m^3",
            {},
            "none",
            "force per reference volume, one formula in X, Y, Z, t per direction",
            {}},
    KeyInfo{"load",
            "acceleration",
            formulas,
            "m/s^2",
            {},
            "none",
            "force per mass, for example gravity, one formula in X, Y, Z, t per direction",
            {}},
    KeyInfo{"load", "until", quantity, "s", positive, "the end of the run", "gone from this time on", {}},

    KeyInfo{"mirror", "body", name, "", {}, "", "name of the body, a box with particles on its faces", {}},
    KeyInfo{"mirror", "face", word, "", {}, "", "the face that is the plane of symmetry", face_words},
    KeyInfo{"mirror",
            "skew",
            flag,
            "",
            {},
            "false",
            "the image moves the opposite way: held along the plane instead of across it; for small strains",
            {}},

    KeyInfo{"crack", "body", name, "", {}, "", "name of the body, a two-dimensional box", {}},
    KeyInfo{"crack", "from", point, "m", place_range, "", "one end, at a particle; inside the body it is a tip", {}},
    KeyInfo{"crack", "to", point, "m", place_range, "", "the other end, at a particle", {}},

    KeyInfo{"probe", "name", name, "", {}, "", "first part of the column names", {}},
    KeyInfo{"probe", "body", name, "", {}, "", "name of the body", {}},
    KeyInfo{"probe", "kind", word, "", {}, "\"point\"", "what is measured", probe_words},
    KeyInfo{"probe",
            "at",
            point,
            "m",
            place_range,
            "none",
            "point, stress_intensity (required there): the nearest particle is used; stress_intensity: the crack tip",
            {}},
    KeyInfo{"probe",
            "where",
            formula,
            "",
            {},
            "all particles",
            "all but point and stress_intensity: condition that selects particles",
            {}},
    KeyInfo{"probe", "axis", word, "", {}, "\"y\"", "twist, extent: direction", axis_words},
    KeyInfo{"probe", "quantities", list, "", {}, "none", "what to record; required but for kinds with one number", {}},
    KeyInfo{"probe", "field", text, "", {}, "none", "error (required there): name of the field to compare", {}},
    KeyInfo{"probe",
            "reference",
            formulas,
            "",
            {},
            "none",
            "error (required there): one formula in X, Y, Z, t per component of the field (tensors row by row, "
            "CauchyStress as XX YY ZZ XY YZ XZ)",
            {}},
    KeyInfo{"probe",
            "direction",
            point,
            "1",
            place_range,
            "[1, 0]",
            "stress_intensity: direction ahead of the crack tip, of any length",
            {}},
    KeyInfo{"probe",
            "from",
            quantity,
            "m",
            length_range,
            "none",
            "stress_intensity (required there): distance from the tip from which on particles count",
            {}},
    KeyInfo{"probe",
            "to",
            quantity,
            "m",
            length_range,
            "none",
            "stress_intensity (required there): distance from the tip up to which particles count",
            {}},

    KeyInfo{"quantity", "name", name, "", {}, "", "key in the summary", {}},
    KeyInfo{"quantity", "column", text, "", {}, "", "column of history.csv", {}},
    KeyInfo{"quantity", "take", word, "", {}, "\"maximum\"", "which number of the column", take_words},
    KeyInfo{"quantity",
            "threshold",
            quantity,
            "",
            any_value,
            "none",
            "first_time_above, first_time_below (required there), in the unit of the column",
            {}},
    KeyInfo{"quantity", "time", quantity, "s", not_negative, "none", "at_time (required there)", {}},
    KeyInfo{"quantity",
            "reference",
            formula,
            "",
            {},
            "none",
            "mean_absolute_difference, relative_error (required there): formula in t and the constants",
            {}},
    KeyInfo{"quantity",
            "from",
            quantity,
            "s",
            not_negative,
            "0",
            "mean_absolute_difference, relative_error: rows from this time on count",
            {}},
    KeyInfo{"quantity",
            "until",
            quantity,
            "s",
            not_negative,
            "the end of the run",
            "mean_absolute_difference, relative_error: rows up to this time count",
            {}},
    KeyInfo{"quantity", "unit", text, "", {}, "that of the column", "unit in which the summary shows the number", {}},

    KeyInfo{"output", "frames", table, "", {}, "no frames", "files for ParaView", {}},
    KeyInfo{"output", "history", table, "", {}, "500 rows", "the table history.csv", {}},
    KeyInfo{"output", "pictures", table, "", {}, "no pictures", "PNG pictures", {}},
    KeyInfo{"output", "checkpoints", table, "", {}, "at the end only", "files to resume from", {}},
    KeyInfo{"output.frames", "every", quantity, "s", not_negative, "", "time between two frames; 0 for none", {}},
    KeyInfo{"output.frames", "fields", list, "", {}, "the formulation's", "names of the fields to write", {}},
    KeyInfo{"output.frames", "compress", flag, "", {}, "true", "smaller files, a little more time", {}},
    KeyInfo{"output.history", "every", quantity, "s", not_negative, "", "time between two rows", {}},
    KeyInfo{"output.pictures", "every", quantity, "s", not_negative, "", "time between two pictures; 0 for none", {}},
    KeyInfo{"output.pictures",
            "field",
            text,
            "",
            {},
            "\"Pressure\"",
            "field that gives the colour; the length of a vector",
            {}},
    KeyInfo{"output.pictures",
            "range",
            list,
            "",
            any_value,
            "from the data",
            "values at the two ends of the colour bar, in the field's unit",
            {}},
    KeyInfo{"output.pictures",
            "view",
            list,
            "degree",
            {-360, 360, false, false},
            "[30, 20]",
            "direction of view: azimuth and elevation",
            {}},
    KeyInfo{"output.pictures",
            "size",
            list,
            "",
            {16, 16384, false, false},
            "[1000, 800]",
            "width and height in pixels",
            {}},
    KeyInfo{"output.checkpoints",
            "every",
            quantity,
            "s",
            not_negative,
            "",
            "time between two checkpoints; 0 for none but the last",
            {}},
};

}  // namespace

std::span<KeyInfo const> case_keys() { return keys; }
std::span<SectionInfo const> case_sections() { return sections; }

std::vector<KeyInfo> keys_of(std::string_view section) {
  std::vector<KeyInfo> found;
  for (KeyInfo const& info : keys) {
    if (info.section == section) found.push_back(info);
  }
  return found;
}

KeyInfo const& key_info(std::string_view section, std::string_view key) {
  for (KeyInfo const& info : keys) {
    if (info.section == section && info.key == key) return info;
  }
  throw std::logic_error("no key " + std::string(section) + "." + std::string(key) + " in the table of keys");
}

std::string value_text(KeyInfo const& info) {
  std::string const unit(info.unit);
  switch (info.kind) {
    case text: return "a text";
    case name: return "a name of letters, digits and _";
    case word: return "one of " + joined(info.words);
    case quantity:
      if (unit.empty()) return "a number, or a text with a unit";
      return unit == "1" ? "a number" : "a number in " + unit + " or a text such as \"2 " + unit + "\"";
    case whole: return "a whole number";
    case flag: return "true or false";
    case point:
      if (unit == "1") return "a list of numbers, one per direction";
      return "a list of numbers in " + unit + " or texts such as \"2 " + unit + "\", one per direction";
    case formula: return "a text with a formula";
    case formulas: return "a list of formulas";
    case list: return "a list";
    case table: return "a table";
  }
  return "";
}

std::string interval_text(Interval const& allowed) {
  bool const low = std::isfinite(allowed.low), high = std::isfinite(allowed.high);
  std::string const from = exact_text(allowed.low), to = exact_text(allowed.high);
  if (!low && !high) return "";
  if (!high) return allowed.low_open ? "above " + from : "at least " + from;
  if (!low) return allowed.high_open ? "below " + to : "at most " + to;
  if (allowed.low_open && allowed.high_open) return "between " + from + " and " + to + ", ends excluded";
  if (allowed.low_open) return "above " + from + ", at most " + to;
  if (allowed.high_open) return "at least " + from + ", below " + to;
  return "from " + from + " to " + to;
}

std::string condition_text(Condition const& condition) {
  if (condition.always()) return "";
  std::string const text = std::string(condition.choice) + " = " + in_quotes(condition.word);
  return condition.other.empty() ? text : text + " or " + in_quotes(condition.other);
}

}  // namespace piola
