// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_columns.hpp"
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace piola {

MaterialParameters rubber(double poissons_ratio) {
  MaterialParameters material;
  material.law = find_law("neo_hookean")->index;
  std::array const values{1100.0, 17e6, poissons_ratio};
  std::copy(values.begin(), values.end(), material.value);
  return material;
}

Assembly column(Column which, std::array<int, 3> const& particles, MaterialParameters const& material,
                FormulationSpec const& formulation, std::string const& backend) {
  Assembly a;
  ShapeSpec shape;
  shape.particles = particles;
  shape.min = {-0.5, 0, -0.5};
  shape.max = {0.5, 6, 0.5};
  fill(shape, "column", a.particles);
  a.materials = {material};
  a.formulations = {formulation};
  Support foot;
  foot.fix = {true, true, true};
  for (std::int64_t id = 0; id < a.particles.size(); ++id) {
    auto const& X = a.particles.X[static_cast<std::size_t>(id)];
    double const omega = 105 * std::sin(std::numbers::pi * X[1] / 12);
    if (which == Column::twisting)
      a.initial_velocity.push_back({omega * X[2], 0, -omega * X[0]});
    else
      a.initial_velocity.push_back({10 * X[1] / 6, 0, 0});
    if (X[1] < 1e-9) foot.particles.push_back(id);
  }
  a.supports.push_back(foot);
  a.backend = backend;
  return a;
}

}  // namespace piola
