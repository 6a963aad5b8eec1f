// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/read_solid.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>
#include <array>

namespace piola {
namespace {

using ShapeKind = ShapeSpec::Kind;

void set_point(std::vector<double> const& numbers, std::array<double, 3>& target) {
  for (std::size_t d = 0; d < numbers.size(); ++d) target[d] = numbers[d];
}

}  // namespace

void check_below_radius(Section const& section, std::string_view key, double value, double radius) {
  if (!(value > 0) || !(radius > 0) || value < radius) return;
  section.problems().add(section.place_of(key), section.name_of(key) + " is " + number_text(value) +
                                                    " m (allowed: below radius, which is " + number_text(radius) +
                                                    " m)");
}

void read_box(Section const& section, ShapeSpec& shape) {
  auto const min = section.point("min"), max = section.point("max");
  section.refuse_unknown();
  if (min) shape.dimension = static_cast<int>(min->size());
  if (!min || !max) return;
  if (min->size() != max->size()) {
    section.problems().add(section.place_of("max"),
                           "body.shape.box.max has " + std::to_string(max->size()) + " components, min has " +
                               std::to_string(min->size()) +
                               " (allowed: as many) - their number is the dimension of the case");
    return;
  }
  set_point(*min, shape.min);
  set_point(*max, shape.max);
  for (std::size_t d = 0; d < min->size(); ++d) {
    if ((*max)[d] - (*min)[d] >= 1e-15) continue;
    section.problems().add(section.place_of("max"), "body.shape.box.max[" + std::to_string(d) + "] is " +
                                                        number_text((*max)[d]) + " m (allowed: above min, which is " +
                                                        number_text((*min)[d]) + " m)");
  }
}

namespace {

void read_radii(Section const& section, ShapeSpec& shape) {
  section.read("radius", shape.radius);
  section.read("inner_radius", shape.inner_radius);
  check_below_radius(section, "inner_radius", shape.inner_radius, shape.radius);
}

void read_arrangement(Section const& section, ShapeSpec& shape) {
  int const word = section.word_index("arrangement");
  if (word <= 0) return;
  std::string const is = section.name_of("arrangement") + " is " +
                         in_quotes(section.info_of("arrangement").words[static_cast<std::size_t>(word)]);
  shape.arrangement = static_cast<ShapeSpec::Arrangement>(word);
  if (shape.dimension != 2 && section.has("centre")) {
    section.problems().add(section.place_of("arrangement"), is + " (allowed in " + std::to_string(shape.dimension) +
                                                                "D: lattice) - circles are for discs");
  } else if (shape.inner_radius > 0 && shape.arrangement == ShapeSpec::Arrangement::lattice_with_rings) {
    section.problems().add(section.place_of("arrangement"),
                           is + " (allowed with inner_radius: lattice, rings) - choose one of these");
  }
}

}  // namespace

void read_sphere(Section const& section, ShapeSpec& shape) {
  if (auto const centre = section.point("centre")) {
    shape.dimension = static_cast<int>(centre->size());
    set_point(*centre, shape.centre);
  }
  read_radii(section, shape);
  read_arrangement(section, shape);
  if (shape.dimension == 1) section.refuse("inner_radius", "is used only in 2D and 3D");
  section.refuse_unknown();
}

void read_cylinder(Section const& section, ShapeSpec& shape) {
  if (auto const centre = section.point("centre")) {
    set_point(*centre, shape.centre);
    if (centre->size() != 3) {
      section.problems().add(section.place_of("centre"),
                             "body.shape.cylinder.centre has " + std::to_string(centre->size()) +
                                 " components (allowed: 3) - a cylinder in 2D is a sphere or a box");
    }
  }
  read_radii(section, shape);
  section.read("length", shape.length);
  if (int const axis = section.word_index("axis"); axis >= 0) shape.axis = axis;
  section.refuse_unknown();
}

namespace {

void refuse_box_key(Section const& section, std::string_view key) {
  if (!section.has(key)) return;
  section.problems().add(section.place_of(key), section.name_of(key) +
                                                    " belongs to a box (allowed here: spacing, jitter, "
                                                    "seed) - remove it");
}

/// A spacing that is larger than the body leaves one particle or none, which no support or probe would find.
void refuse_wide_spacing(Section const& section, ShapeSpec const& shape, double spacing) {
  double largest = shape.kind == ShapeKind::cylinder ? std::max(shape.length, 2 * shape.radius) : 2 * shape.radius;
  for (std::size_t d = 0; shape.kind == ShapeKind::box && d < static_cast<std::size_t>(shape.dimension); ++d)
    largest = std::max(largest, shape.max[d] - shape.min[d]);
  if (!(largest > 0) || !(spacing > largest)) return;
  section.problems().add(section.place_of("spacing"),
                         "body.shape.spacing is " + quantity_text(spacing, "m") + ", larger than the body, " +
                             quantity_text(largest, "m") +
                             ", which would be a single particle (allowed: less; a third of the smallest edge to "
                             "bend) - check the units of both");
}

void read_box_particles(Section const& section, ShapeSpec& shape) {
  auto const count = static_cast<std::size_t>(shape.dimension);
  if (auto const value = section.find("particles")) {
    auto const items = read_list(*value, count, count, section.problems());
    Interval const allowed = key_info("body.shape", "particles").allowed;
    for (std::size_t d = 0; items && d < count; ++d) {
      auto const n = read_whole((*items)[d], allowed, section.problems());
      if (n) shape.particles[d] = static_cast<int>(*n);
    }
  } else if (double spacing = 0; section.read("spacing", spacing)) {
    for (std::size_t d = 0; d < count; ++d) {
      shape.particles[d] = particles_over(shape.max[d] - shape.min[d], spacing, shape.placement);
    }
    refuse_wide_spacing(section, shape, spacing);
  }
}

// The resolution of a box is given by particles or spacing, that of round bodies only by spacing.
void read_fineness(Section const& section, ShapeSpec& shape) {
  bool const box = shape.kind == ShapeKind::box;
  if (box && section.has("particles") && section.has("spacing")) {
    section.problems().add(section.place_of("spacing"),
                           "body.shape has both \"particles\" and \"spacing\" (allowed: one of "
                           "them) - remove one");
  } else if (!section.has("spacing") && !(box && section.has("particles"))) {
    section.report_missing(box ? "particles\" or \"spacing" : "spacing", "how fine the body is",
                           box ? "particles = [...]" : "spacing = \"1 mm\"");
  } else if (box) {
    read_box_particles(section, shape);
  } else {
    section.read("spacing", shape.spacing);
    refuse_wide_spacing(section, shape, shape.spacing);
  }
}

/// Where the particles of a box or round body are: on its boundary, in the centres of cells, or at random.
void read_placement(Section const& section, ShapeSpec& shape) {
  using Placement = ShapeSpec::Placement;
  if (shape.kind != ShapeKind::box) shape.placement = Placement::cell_centred;
  if (std::string word; shape.kind != ShapeKind::sphere && section.read("placement", word)) {
    shape.placement = word == "cell_centred" ? Placement::cell_centred : Placement::on_boundary;
    shape.random = word == "random";
  }
  if (shape.random && shape.kind != ShapeKind::box)
    section.problems().add(section.place_of("placement"),
                           "body.shape.placement is \"random\" (allowed in a cylinder: on_boundary, cell_centred) - "
                           "only a box is filled at random; jitter moves the particles of a cylinder");
  if (shape.random) section.refuse("jitter", "is used only by particles on a lattice");
  if (shape.kind != ShapeKind::box) {
    if (shape.kind == ShapeKind::sphere) refuse_box_key(section, "placement");
    refuse_box_key(section, "particles");
  }
  if (shape.arrangement != ShapeSpec::Arrangement::lattice) {
    section.refuse("jitter", "is used only by particles on a lattice");
    section.refuse("seed", "is used only by particles on a lattice");
  }
}

}  // namespace

ShapeSpec read_shape(Section const& section, Names const& names) {
  if (section.has("points")) return read_points_shape(section);
  if (is_solid_section(section)) return read_solid_shape(section, names);
  ShapeSpec shape;
  constexpr std::array<std::string_view, 3> kinds{"box", "sphere", "cylinder"};
  int given = 0;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (!section.has(kinds[k])) continue;
    ++given;
    shape.kind = static_cast<ShapeKind>(k);
    auto const part = section.table(kinds[k]);
    if (!part) continue;
    if (shape.kind == ShapeKind::box) read_box(*part, shape);
    if (shape.kind == ShapeKind::sphere) read_sphere(*part, shape);
    if (shape.kind == ShapeKind::cylinder) read_cylinder(*part, shape);
  }
  section.refuse_unknown();
  if (given != 1) {
    section.refuse_count("body.shape", given, "box, sphere, cylinder or another shape");
    return shape;
  }
  read_placement(section, shape);
  section.read("jitter", shape.jitter);
  if (auto const seed = section.whole("seed")) shape.seed = static_cast<std::uint32_t>(*seed);
  read_fineness(section, shape);
  return shape;
}

}  // namespace piola
