// SPDX-License-Identifier: Apache-2.0
#include "piola/base/units.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/read_solid.hpp"
#include "piola/setup/cloud_file.hpp"

namespace piola {

ShapeSpec read_points_shape(Section const& section) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::points;
  shape.arrangement = ShapeSpec::Arrangement::packed;
  for (std::string_view const key : {"spacing", "particles", "placement", "jitter", "seed", "arrangement", "transform"})
    section.refuse(key, "is not used by points, which are the particles as they stand in the file");
  for (std::string_view const key : {"box", "sphere", "cylinder"})
    section.refuse(key, "cannot be combined with points");
  section.refuse_unknown();
  auto const points = section.table("points");
  if (!points) return shape;
  std::string file;
  CloudOptions options;
  bool const given = points->read("file", file);
  points->read("body", options.body);
  points->read("group", options.group);
  if (auto const length = read_length_unit(*points)) options.length_unit = *length;
  double volume = 0;
  if (points->read("volume", volume)) options.total_volume = volume;
  points->refuse_unknown();
  if (!given) return shape;
  shape.files.push_back(case_file(*points, file));
  std::vector<std::string> problems;
  auto cloud = std::make_shared<PointCloud>(read_cloud(shape.files.back().path.string(), options, problems));
  for (std::string const& problem : problems) section.problems().add(points->place_of("file"), problem);
  if (!problems.empty()) return shape;
  shape.notes = cloud->notes;
  shape.dimension = cloud->dimension;
  shape.spacing = cloud->spacing;
  shape.cloud = std::move(cloud);
  return shape;
}

std::optional<double> read_length_unit(Section const& section) {
  std::string unit;
  if (!section.read("unit", unit)) return {};
  Quantity const one = read_quantity("1 " + unit, "m");
  if (!one.problem && one.value > 0) return one.value;
  section.problems().add(section.place_of("unit"), section.name_of("unit") + " is \"" + unit +
                                                       "\" (allowed: a unit of length such as mm, cm, inch)");
  return {};
}

}  // namespace piola
