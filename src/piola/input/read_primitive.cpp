// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/geometry/extruded_revolved.hpp"
#include "piola/geometry/level_set.hpp"
#include "piola/geometry/primitives.hpp"
#include "piola/geometry/transformed_solid.hpp"
#include "piola/input/places.hpp"
#include "piola/input/read_polygon.hpp"
#include "piola/input/read_solid.hpp"
#include "piola/math/array_conversion.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace piola {

Vec<3> first_three(std::vector<double> const& numbers) {
  Vec<3> v;
  for (std::size_t c = 0; c < std::min<std::size_t>(3, numbers.size()); ++c) v[static_cast<int>(c)] = numbers[c];
  return v;
}

namespace {

using geometry::SolidPtr;

constexpr double default_feature_angle = std::numbers::pi / 6;

SolidPtr read_plain(Section const& section, std::string_view kind) {
  ShapeSpec shape;
  std::size_t const before = section.problems().count();
  if (kind == "box") {
    shape.kind = ShapeSpec::Kind::box;
    read_box(section, shape);
  } else if (kind == "sphere") {
    shape.kind = ShapeSpec::Kind::sphere;
    read_sphere(section, shape);
    section.refuse("arrangement", "is for a sphere as it is, on a lattice or in rings");
  } else {
    shape.kind = ShapeSpec::Kind::cylinder;
    read_cylinder(section, shape);
  }
  if (section.problems().count() > before) return nullptr;
  if (shape.dimension >= 2) return solid_of(shape);
  section.problems().add(section.place(), section.name_of("") + "is in 1D (allowed: 2D and 3D) - solids have no 1D");
  return nullptr;
}

Vec<3> axis_of(Section const& section) {
  int const word = section.word_index("axis");
  Vec<3> axis;
  axis[word < 0 ? 2 : word] = 1;
  return axis;
}

/// A point with three components, or two where the solid may be in 2D.
std::optional<Vec<3>> place_in(Section const& section, std::string_view key, int& dimension, bool flat) {
  auto const point = section.point(key);
  if (!point) return {};
  if (point->size() == 3 || (flat && point->size() == 2)) {
    dimension = static_cast<int>(point->size());
    return first_three(*point);
  }
  section.problems().add(section.place_of(key), section.name_of(key) + " has " + std::to_string(point->size()) +
                                                    " components (allowed: " + (flat ? "2 or 3)" : "3)"));
  return {};
}

SolidPtr read_torus(Section const& section) {
  int dimension = 3;
  auto const centre = place_in(section, "centre", dimension, false);
  double radius = 0, tube = 0;
  section.read("radius", radius);
  section.read("tube_radius", tube);
  Vec<3> const axis = axis_of(section);
  section.refuse_unknown();
  check_below_radius(section, "tube_radius", tube, radius);
  return centre ? geometry::torus(*centre, axis, radius, tube) : nullptr;
}

SolidPtr read_cone(Section const& section) {
  int dimension = 3;
  auto const centre = place_in(section, "centre", dimension, false);
  double radius = 0, end_radius = 0, length = 0;
  section.read("radius", radius);
  section.read("end_radius", end_radius);
  section.read("length", length);
  Vec<3> const axis = axis_of(section);
  section.refuse_unknown();
  if (!(radius > 0) && !(end_radius > 0))
    section.problems().add(section.place(),
                           "body.shape.cone has no radius above 0 (allowed: one of radius and "
                           "end_radius may be 0)");
  return centre ? geometry::cone(*centre, axis, length, radius, end_radius) : nullptr;
}

SolidPtr read_capsule(Section const& section) {
  int from_dimension = 3, to_dimension = 3;
  auto const from = place_in(section, "from", from_dimension, true), to = place_in(section, "to", to_dimension, true);
  double radius = 0;
  section.read("radius", radius);
  section.refuse_unknown();
  if (!from || !to) return nullptr;
  Vec<3> const line = *to - *from;
  if (from_dimension != to_dimension || !(dot(line, line) > 0))
    section.problems().add(section.place_of("to"), section.name_of("to") +
                                                       " is no other place than from, with as many components "
                                                       "(allowed: another place) - for a ball use sphere");
  return geometry::capsule(*from, *to, radius, from_dimension);
}

SolidPtr read_half_space(Section const& section) {
  int dimension = 3, normal_dimension = 3;
  auto const point = place_in(section, "point", dimension, true);
  auto const normal = place_in(section, "normal", normal_dimension, true);
  section.refuse_unknown();
  if (!point || !normal) return nullptr;
  double const length = std::sqrt(dot(*normal, *normal));
  if (dimension != normal_dimension || !(length > 0))
    section.problems().add(section.place_of("normal"), section.name_of("normal") +
                                                           " is no direction (allowed: as many components as "
                                                           "point, not all 0)");
  return geometry::half_space(*point, (1 / length) * *normal, dimension);
}

/// The shape must end within its box.
bool reports_faces(Section const& section, Expression const& f, Vec<3> const& min, Vec<3> const& max, int dimension) {
  constexpr int points = 41;
  for (int face = 0; face < 2 * dimension; ++face)
    for (int j = 0; j < (dimension == 3 ? points : 1); ++j)
      for (int i = 0; i < points; ++i) {
        int const axis = face / 2, a = (axis + 1) % dimension, b = (axis + 2) % 3;
        std::array<double, 3> X{};
        X[static_cast<std::size_t>(axis)] = face % 2 == 0 ? min[axis] : max[axis];
        X[static_cast<std::size_t>(a)] = min[a] + (max[a] - min[a]) * i / (points - 1);
        if (dimension == 3) X[static_cast<std::size_t>(b)] = min[b] + (max[b] - min[b]) * j / (points - 1);
        if (!(f(X) < 0)) continue;
        section.problems().add(section.place_of(face % 2 == 0 ? "min" : "max"),
                               "the shape reaches out of its box at " + point_text(X, dimension) +
                                   " (allowed: nothing inside on the faces of the box) - make the box larger, or "
                                   "intersect with a half_space");
        return true;
      }
  return false;
}

SolidPtr read_level_set(Section const& section, Names const& names, double spacing) {
  std::string inside;
  int dimension = 3, other = 3;
  bool const given = section.read("inside", inside);
  auto const min = place_in(section, "min", dimension, true), max = place_in(section, "max", other, true);
  section.refuse_unknown();
  if (!given || !min || !max) return nullptr;
  bool box = dimension == other;
  for (int c = 0; c < dimension; ++c) box = box && (*max)[c] > (*min)[c];
  if (!box) {
    section.problems().add(section.place_of("max"), section.name_of("max") +
                                                        " does not lie beyond min in every direction (allowed: a box "
                                                        "around the shape)");
    return nullptr;
  }
  auto const level = geometry::level_of(inside);
  if (!level) {
    section.problems().add(section.place_of("inside"),
                           section.name_of("inside") + " is " + in_quotes(inside) +
                               " (allowed: one comparison with < or >, such as \"X^2 + Y^2 < 1\") - combine several "
                               "by union, difference, intersection");
    return nullptr;
  }
  try {
    Expression const f(*level, names);
    if (!reports_faces(section, f, *min, *max, dimension))
      return geometry::level_set(f, {*min, *max}, spacing, dimension);
  } catch (ExpressionError const& error) {
    section.problems().add(section.place_of("inside"), section.name_of("inside") + " is " + in_quotes(inside) + ": " +
                                                           error.text + " - see the formulas of the manual");
  }
  return nullptr;
}

bool has_empty(std::vector<std::vector<Vec<2>>> const& polygons) {
  return std::any_of(polygons.begin(), polygons.end(), [](auto const& p) { return p.empty(); });
}

SolidPtr read_extruded(Section const& section) {
  std::vector<std::vector<Vec<2>>> polygons;
  auto const outline = section.find("polygon");
  if (outline) polygons.push_back(read_polygon(*outline, false, section.problems()));
  if (auto const holes = section.find("holes"))
    if (auto const items = read_list(*holes, 1, 1000, section.problems()))
      for (Value const& item : *items) polygons.push_back(read_polygon(item, false, section.problems()));
  double from = 0, to = 0;
  bool const solid = section.has("from") || section.has("to");
  if (solid) {
    if (!section.has("from") || !section.has("to"))
      section.problems().add(section.place(),
                             "body.shape.extrude has only one of from and to (allowed: both in 3D, "
                             "none in 2D)");
    section.read("from", from);
    if (section.read("to", to) && section.has("from") && !(to > from))
      section.problems().add(section.place_of("to"), section.name_of("to") + " is " + number_text(to) +
                                                         " m (allowed: above from, which is " + number_text(from) +
                                                         " m)");
  }
  section.refuse_unknown();
  if (!outline || has_empty(polygons)) return nullptr;
  std::size_t const before = section.problems().count();
  check_polygons(polygons, section.place_of("polygon"), "body.shape.extrude", section.problems());
  if (section.problems().count() > before) return nullptr;
  std::vector<std::string> names;
  std::vector<std::vector<geometry::ProfileEdge>> loops;
  for (std::size_t p = 0; p < polygons.size(); ++p)
    loops.push_back(geometry::polygon_loop(polygons[p], p > 0, default_feature_angle, names));
  geometry::Profile profile(loops, names);
  if (solid) return std::make_shared<geometry::Extruded>(std::move(profile), from, to);
  return std::make_shared<geometry::Flat>(std::move(profile));
}

SolidPtr read_revolved(Section const& section) {
  auto const outline = section.find("polygon");
  Vec<3> const axis = axis_of(section);
  section.refuse_unknown();
  if (!outline) return nullptr;
  auto const polygon = read_polygon(*outline, true, section.problems());
  if (polygon.empty()) return nullptr;
  std::size_t const before = section.problems().count();
  check_polygons({polygon}, section.place_of("polygon"), "body.shape.revolve", section.problems());
  if (section.problems().count() > before) return nullptr;
  std::vector<std::string> names;
  auto const loop = geometry::polygon_loop(polygon, false, default_feature_angle, names);
  return geometry::placed(std::make_shared<geometry::Revolved>(geometry::Profile::half(loop, names)),
                          {1, geometry::rotation_from_z(axis), {}});
}

}  // namespace

SolidPtr read_primitive(Section const& section, std::string_view kind, Names const& names, double spacing) {
  if (kind == "box" || kind == "sphere" || kind == "cylinder") return read_plain(section, kind);
  if (kind == "torus") return read_torus(section);
  if (kind == "cone") return read_cone(section);
  if (kind == "capsule") return read_capsule(section);
  if (kind == "half_space") return read_half_space(section);
  if (kind == "formula") return read_level_set(section, names, spacing);
  return kind == "extrude" ? read_extruded(section) : read_revolved(section);
}

geometry::SolidPtr solid_of(ShapeSpec const& shape) {
  if (shape.kind == ShapeSpec::Kind::box)
    return geometry::box(vector_of(shape.min), vector_of(shape.max), shape.dimension);
  if (shape.kind == ShapeSpec::Kind::sphere)
    return geometry::ball(vector_of(shape.centre), shape.radius, shape.inner_radius, shape.dimension);
  Vec<3> axis;
  axis[shape.axis] = 1;
  return geometry::cylinder(vector_of(shape.centre), axis, shape.length, shape.radius, shape.inner_radius);
}

}  // namespace piola
