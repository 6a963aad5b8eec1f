// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_keys.hpp"
#include "piola/base/text.hpp"
#include "piola/input/key_tables.hpp"
#include <array>
#include <cmath>
#include <stdexcept>

namespace piola {
namespace {

using enum KeyInfo::Kind;

constexpr std::array sections{
    SectionInfo{"", "", "the top of the file"},
    SectionInfo{"run", "[run]", "how long and how to run"},
    SectionInfo{"run.guards", "guards = { ... }",
                "from where on a run warns of its answer, or stops; guards = \"off\" for none, \"off\" for one limit"},
    SectionInfo{"body", "[[body]]", "one body of particles; a case has one or more"},
    SectionInfo{"body.shape", "shape = { ... }",
                "what a body looks like: exactly one kind of shape, and its particles"},
    SectionInfo{"body.shape.box", "box = { ... }", "a box; the number of components is the dimension of the case"},
    SectionInfo{"body.shape.sphere", "sphere = { ... }", "a sphere; a disc with two components, an interval with one"},
    SectionInfo{"body.shape.cylinder", "cylinder = { ... }", "a circular cylinder, three dimensions only"},
    SectionInfo{"body.shape.points", "points = { ... }", "particles from a file, as they stand there"},
    SectionInfo{"body.shape.torus", "torus = { ... }", "a ring of circular cross-section, three dimensions only"},
    SectionInfo{"body.shape.cone", "cone = { ... }", "a cone or a frustum, three dimensions only"},
    SectionInfo{"body.shape.capsule", "capsule = { ... }", "all places within a radius of a line"},
    SectionInfo{"body.shape.half_space", "half_space = { ... }",
                "one side of a plane (2D: a line); it has no end, so it stands in an intersection or is cut away"},
    SectionInfo{"body.shape.formula", "formula = { ... }", "the places in a box that satisfy a formula"},
    SectionInfo{"body.shape.extrude", "extrude = { ... }", "a polygon, drawn along z in 3D"},
    SectionInfo{"body.shape.revolve", "revolve = { ... }", "a polygon in radius and height, turned about an axis"},
    SectionInfo{"body.shape.mesh", "mesh = { ... }", "the inside of a closed surface of triangles"},
    SectionInfo{"body.shape.part", "union = [{ ... }, ...]",
                "a part of a union, difference or intersection: exactly one kind of shape"},
    SectionInfo{"body.shape.transform", "transform = { ... }", "scales, turns and moves a shape, in this order"},
    SectionInfo{"body.shape.rotate", "rotate = { ... }", "a turn about an axis through the origin"},
    SectionInfo{"body.material", "material = { ... }", "the law of the material and its parameters"},
    SectionInfo{"body.part", "[[body.part]]", "a part of a body that consists of another material"},
    SectionInfo{"region", "[[region]]",
                "places with a name, for the formulas that say where: exactly one of where, shape, near"},
    SectionInfo{"region.near", "near = { ... }", "places close to a surface of triangles, which need not be closed"},
    SectionInfo{"body.formulation", "formulation = { ... }", "the SPH formulation and its settings"},
    SectionInfo{"support", "[[support]]", "particles whose velocity is prescribed in some directions: zero, or driven"},
    SectionInfo{"load", "[[load]]", "a load: exactly one of traction, pressure, body_force, acceleration"},
    SectionInfo{"mirror", "[[mirror]]", "a face of a box across which the body goes on as its mirror image"},
    SectionInfo{"crack", "[[crack]]", "a straight crack in a two-dimensional box, without traction on its faces"},
    SectionInfo{"rigid", "[[rigid]]", "a rigid obstacle or free body: exactly one of plane, sphere, cylinder, box"},
    SectionInfo{"rigid.plane", "plane = { ... }", "the half-space behind a plane (2D: a line)"},
    SectionInfo{"rigid.sphere", "sphere = { ... }", "a sphere (2D: a disc)"},
    SectionInfo{"rigid.cylinder", "cylinder = { ... }", "a circular cylinder, three dimensions only"},
    SectionInfo{"rigid.box", "box = { ... }", "a box (2D: a rectangle): min and max, or centre and lengths"},
    SectionInfo{"spring", "[[spring]]",
                "a spring, a dashpot or both between rigid shapes, or a rigid shape and a point"},
    SectionInfo{"contact", "[contact]", "what keeps bodies, and bodies and rigid shapes, apart"},
    SectionInfo{"tie", "[[tie]]",
                "two bodies, or a body and a rigid shape, held together where their surfaces touch at the start"},
    SectionInfo{"table", "{ table = [...] }",
                "a table in place of a formula of a value with a unit: exactly one of table, file"},
    SectionInfo{"probe", "[[probe]]", "columns NAME.QUANTITY of history.csv"},
    SectionInfo{"quantity", "[[quantity]]", "a number of summary.json, taken from a column of history.csv"},
    SectionInfo{"output", "[output]", "what is written; each part may be left out"},
    SectionInfo{"output.frames", "[output.frames]", "files for ParaView with a field of values per particle"},
    SectionInfo{"output.history", "[output.history]", "the table history.csv"},
    SectionInfo{"output.pictures", "[output.pictures]", "PNG pictures coloured by a field"},
    SectionInfo{"output.pictures.cut", "cut = { ... }", "a plane that cuts bodies open"},
    SectionInfo{"output.pictures.panel", "[[output.pictures.panel]]", "one of several views or fields in each picture"},
    SectionInfo{"output.pictures.panel.cut", "cut = { ... }", "a plane that cuts bodies open"},
    SectionInfo{"output.checkpoints", "[output.checkpoints]", "files to resume from; one is always written at the end"},
};

std::vector<KeyInfo> joined_tables() {
  std::vector<KeyInfo> all;
  for (auto const& part : {keys_of_run(), keys_of_bodies(), keys_of_solids(), keys_of_regions(), keys_of_boundaries(),
                           keys_of_tables(), keys_of_observers(), keys_of_output()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

std::span<KeyInfo const> case_keys() {
  static std::vector<KeyInfo> const keys = joined_tables();
  return keys;
}
std::span<SectionInfo const> case_sections() { return sections; }

std::vector<KeyInfo> keys_of(std::string_view section) {
  std::vector<KeyInfo> found;
  for (KeyInfo const& info : case_keys()) {
    if (info.section == section) found.push_back(info);
  }
  return found;
}

KeyInfo const& key_info(std::string_view section, std::string_view key) {
  for (KeyInfo const& info : case_keys()) {
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
    case formula: return unit.empty() ? "a text with a formula" : "a text with a formula, or a table";
    case formulas: return unit.empty() ? "a list of formulas" : "a list of formulas or tables";
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
