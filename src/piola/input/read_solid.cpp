// SPDX-License-Identifier: Apache-2.0
#include "piola/input/read_solid.hpp"
#include "piola/base/read_file.hpp"
#include "piola/base/text.hpp"
#include "piola/geometry/boolean_solid.hpp"
#include "piola/geometry/mesh.hpp"
#include "piola/geometry/patch_measures.hpp"
#include "piola/geometry/transformed_solid.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/sections.hpp"
#include "piola/setup/packed_bodies.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace piola {
namespace {

using geometry::BooleanOperation;
using geometry::SolidPtr;

constexpr std::array<std::string_view, 14> solid_kinds{"box",     "sphere",     "cylinder",     "torus",   "cone",
                                                       "capsule", "half_space", "formula",      "extrude", "revolve",
                                                       "union",   "difference", "intersection", "mesh"};

/// Reads the tree of a shape. Null where something is wrong, which is then among the problems.
class SolidReader {
 public:
  /// Files that are read are added to those of the shape.
  SolidReader(Names const& names, ShapeSpec& shape)
      : names_(names), shape_(shape), spacing_(shape.spacing > 0 ? shape.spacing : 1) {}

  SolidPtr read(Section const& node) const {
    int given = 0;
    SolidPtr solid;
    for (std::string_view const kind : solid_kinds) {
      if (!node.has(kind)) continue;
      ++given;
      solid = read_kind(node, kind);
    }
    if (given != 1) {
      node.refuse_count("a shape", given, fmt::format("{}", fmt::join(solid_kinds, ", ")));
      return nullptr;
    }
    return solid ? placed_by(node, solid) : nullptr;
  }

 private:
  SolidPtr read_kind(Section const& node, std::string_view kind) const {
    if (kind == "union" || kind == "difference" || kind == "intersection") return read_parts(node, kind);
    auto const section = table_with_keys(node, kind, "body.shape." + std::string(kind));
    if (!section) return nullptr;
    std::size_t const before = node.problems().count();
    SolidPtr solid = kind == "mesh" ? read_surface(*section) : read_primitive(*section, kind, names_, spacing_);
    return node.problems().count() == before ? solid : nullptr;
  }

  SolidPtr read_surface(Section const& section) const {
    std::string file;
    geometry::MeshOptions options;
    options.spacing = shape_.spacing;
    bool const given = section.read("file", file);
    auto const unit = read_length_unit(section);
    int const word = section.word_index("repair");
    options.repair = static_cast<geometry::MeshOptions::Repair>(std::max(0, word));
    section.read("feature_angle", options.feature_angle);
    if (options.repair != geometry::MeshOptions::Repair::holes)
      section.refuse("largest_hole", "is used only with repair = \"holes\"");
    else if (!section.has("largest_hole"))
      section.report_missing("largest_hole", "how large a hole may be", "largest_hole = \"1 mm\"");
    section.read("largest_hole", options.largest_hole);
    section.read("merge", options.merge);
    section.refuse_unknown();
    if (!given || !unit) return nullptr;
    options.scale = *unit;
    shape_.files.push_back(case_file(section, file));
    geometry::MeshReport report;
    SolidPtr solid = geometry::read_mesh(shape_.files.back().path.string(), options, report);
    for (std::string const& problem : report.problems) section.problems().add(section.place_of("file"), problem);
    shape_.notes.insert(shape_.notes.end(), report.notes.begin(), report.notes.end());
    return solid;
  }

  SolidPtr read_parts(Section const& node, std::string_view kind) const {
    auto const value = node.find(kind);
    auto const items = read_list(*value, 1, 10000, node.problems());
    std::vector<SolidPtr> parts;
    bool good = items.has_value();
    for (std::size_t k = 0; items && k < items->size(); ++k) {
      Value const& item = (*items)[k];
      if (!item.node.is_table()) {
        node.problems().add(item.node.place,
                            item.name + " is " + shown(item.node) + " (allowed: a table with a shape)");
        good = false;
        continue;
      }
      Section const part(item.node, "body.shape.part", node.problems());
      part.refuse_unknown();
      parts.push_back(read(part));
      good = good && parts.back() != nullptr;
    }
    if (!good) return nullptr;
    for (SolidPtr const& part : parts)
      if (part->dimension() != parts.front()->dimension()) {
        node.problems().add(value->node.place, value->name + " has parts in 2D and in 3D (allowed: one dimension)");
        return nullptr;
      }
    return geometry::combined(kind == "union"        ? BooleanOperation::join
                              : kind == "difference" ? BooleanOperation::cut
                                                     : BooleanOperation::common,
                              std::move(parts));
  }

  /// Applies `transform`.
  static SolidPtr placed_by(Section const& node, SolidPtr solid) {
    auto const section = table_with_keys(node, "transform", "body.shape.transform");
    if (!section) return solid;
    std::size_t const before = node.problems().count();
    geometry::RigidTransform placing;
    section->read("scale", placing.scale);
    if (section->has("rotate")) read_turns(*section, solid->dimension(), placing);
    if (auto const move = section->point("move")) {
      if (static_cast<int>(move->size()) != solid->dimension())
        node.problems().add(section->place_of("move"),
                            section->name_of("move") + " has " + std::to_string(move->size()) +
                                " components (allowed: " + std::to_string(solid->dimension()) + ")");
      placing.move = first_three(*move);
    }
    section->refuse_unknown();
    return node.problems().count() == before ? geometry::placed(std::move(solid), placing) : nullptr;
  }

  static void read_turns(Section const& section, int dimension, geometry::RigidTransform& placing) {
    auto const value = section.find("rotate");
    std::vector<Node const*> turns;
    if (value->node.is_table()) turns.push_back(&value->node);
    for (Node const& item : value->node.items) turns.push_back(&item);
    bool const good =
        !turns.empty() && std::all_of(turns.begin(), turns.end(), [](Node const* turn) { return turn->is_table(); });
    if (!good) {
      section.problems().add(value->node.place, value->name + " is " + shown(value->node) +
                                                    " (allowed: a table { axis = [...], angle = \"30 degree\" } or a "
                                                    "list of them)");
      return;
    }
    for (Node const* turn : turns) {
      Section const one(*turn, "body.shape.rotate", section.problems());
      Vec<3> axis{{0, 0, 1}};
      if (dimension == 2) one.refuse("axis", "is used only in 3D");
      if (auto const given = one.point("axis")) axis = first_three(*given);
      double angle = 0;
      one.read("angle", angle);
      one.refuse_unknown();
      double const length = std::sqrt(dot(axis, axis));
      if (length > 0)
        placing.rotation = geometry::rotation_about((1 / length) * axis, angle) * placing.rotation;
      else
        section.problems().add(one.place_of("axis"), one.name_of("axis") + " is 0 (allowed: a direction)");
    }
  }

  Names const& names_;
  ShapeSpec& shape_;
  double spacing_;
};

/// Checks and measures a solid as a whole.
void measure(Section const& section, ShapeSpec& shape) {
  geometry::Bounds const box = shape.solid->bounds();
  double cells = 1;
  bool finite = true;
  for (int c = 0; c < shape.dimension; ++c) {
    finite = finite && std::isfinite(box.min[c]) && std::isfinite(box.max[c]);
    cells *= std::max(1.0, (box.max[c] - box.min[c]) / shape.spacing);
  }
  if (!finite) {
    section.problems().add(section.place(),
                           "body.shape has no end (allowed: a shape within a box) - intersect its "
                           "half_space with something that ends");
    return;
  }
  constexpr double countable = 2147483647;
  if (cells > countable) {
    section.problems().add(section.place_of("spacing"), "the box around body.shape has " + number_text(cells, 3) +
                                                            " cells of this spacing (allowed: at most 2147483647) - "
                                                            "use a larger spacing");
    return;
  }
  shape.volume = geometry::volume_of(*shape.solid, shape.spacing);
  double const particles = shape.volume / std::pow(shape.spacing, shape.dimension);
  if (particles < shape.dimension + 1)
    section.problems().add(section.place(), "body.shape has a volume of " + number_text(shape.volume, 3) +
                                                (shape.dimension == 3 ? " m^3" : " m^2") + ", which is that of " +
                                                number_text(particles, 2) +
                                                " particles (allowed: a few) - check the parts of the shape, or make "
                                                "the spacing smaller");
}

}  // namespace

std::string key_of(std::vector<CaseFile> const& files) {
  std::string key;
  for (CaseFile const& file : files) {
    bool const readable = FileToRead(file.path).problem().empty();
    key += "\n" + file.given + " " + (readable ? content_hash(file.path) : "");
  }
  return key;
}

namespace {

/// Where the packing may lie from before. Its key holds the text of the shape, the constants, and what is in its files.
void set_cache(Section const& section, Names const& names, bool beside, ShapeSpec& shape) {
  SolidParticles& particles = *shape.solid_particles;
  particles.key = toml_value(section.node());
  for (auto const& [name, value] : names.constants) particles.key += "\n" + name + " = " + number_text(value, 17);
  particles.key += key_of(shape.files);
  std::filesystem::path const folder = std::filesystem::path(section.base_of("").file).parent_path();
  particles.folders = {folder / kept_files, folder};
  if (beside) particles.cache = folder;
}

}  // namespace

bool is_solid_section(Section const& section) {
  for (std::string_view const kind : solid_kinds)
    if (kind != "box" && kind != "sphere" && kind != "cylinder" && section.has(kind)) return true;
  return section.has("transform") || section.has("arrangement");
}

geometry::SolidPtr read_part_solid(Section const& section, Names const& names, ShapeSpec& shape) {
  section.refuse_unknown();
  return SolidReader(names, shape).read(section);
}

ShapeSpec read_solid_shape(Section const& section, Names const& names) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::solid;
  shape.arrangement =
      section.word_index("arrangement") == 1 ? ShapeSpec::Arrangement::lattice : ShapeSpec::Arrangement::packed;
  shape.placement = ShapeSpec::Placement::cell_centred;
  shape.solid_particles = std::make_shared<SolidParticles>();
  for (std::string_view const key : {"particles", "placement", "jitter", "seed"})
    section.refuse(key, "is used only by a box, sphere or cylinder without transform and arrangement");
  bool const spaced = section.read("spacing", shape.spacing);
  if (!section.has("spacing")) section.report_missing("spacing", "how fine the body is", "spacing = \"1 mm\"");
  section.refuse_unknown();
  shape.solid = SolidReader(names, shape).read(section);
  bool beside = false;
  if (section.read("cache", beside) && shape.arrangement == ShapeSpec::Arrangement::lattice)
    section.refuse("cache", "is used only by packed shapes");
  if (!shape.solid) return shape;
  shape.dimension = shape.solid->dimension();
  if (spaced) measure(section, shape);
  set_cache(section, names, beside, shape);
  return shape;
}

}  // namespace piola
