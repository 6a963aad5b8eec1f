// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/sections.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include <algorithm>
#include <cmath>

/// How the mass of a free rigid shape lies, where it is not that of the shape.
namespace piola {
namespace {

/// Row by row, of the moments and products of inertia [kg m2].
using Rows = std::array<std::array<double, 3>, 3>;

std::optional<std::vector<double>> read_numbers(Section const& section, std::vector<Value> const& items,
                                                std::string_view unit) {
  std::vector<double> numbers;
  for (Value const& item : items)
    if (auto const number = read_number(item, unit, {}, section.problems())) numbers.push_back(*number);
  if (numbers.size() < items.size()) return std::nullopt;
  return numbers;
}

/// Three moments about x, y and z, or three rows of three.
std::optional<Rows> read_rows(Section const& section, Value const& value) {
  auto const items = read_list(value, 3, 3, section.problems());
  if (!items) return std::nullopt;
  Rows rows{};
  for (std::size_t i = 0; i < 3 && (*items)[0].node.is_array(); ++i) {
    auto const row = read_list((*items)[i], 3, 3, section.problems());
    auto const numbers = row ? read_numbers(section, *row, "kg m^2") : std::nullopt;
    if (!numbers) return std::nullopt;
    std::copy(numbers->begin(), numbers->end(), rows[i].begin());
  }
  if ((*items)[0].node.is_array()) return rows;
  auto const moments = read_numbers(section, *items, "kg m^2");
  if (!moments) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) rows[i][i] = (*moments)[i];
  return rows;
}

/// Error text for an inertia tensor that no body can have; empty if it is valid.
std::string impossible(Rows const& rows) {
  constexpr double rounding = 1e-9;
  SymMat<3> I;
  double size = 0;
  for (auto const& row : rows)
    for (double const component : row) size = std::max(size, std::fabs(component));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) {
      I(static_cast<int>(i), static_cast<int>(j)) = rows[i][j];
      if (std::fabs(rows[i][j] - rows[j][i]) > rounding * size)
        return "has " + number_text(rows[i][j]) + " in row " + std::to_string(i) + " and " + number_text(rows[j][i]) +
               " in row " + std::to_string(j) + " for the same product (allowed: a symmetric tensor)";
    }
  Eigen<3> const e = symmetric_eigen(I);
  std::array<double, 3> moment{e.value[0], e.value[1], e.value[2]};
  std::sort(moment.begin(), moment.end());
  if (!(moment[0] > rounding * size))
    return "has the principal moment " + number_text(moment[0]) + " kg m^2 (allowed: above 0)";
  if (moment[2] > (1 + rounding) * (moment[0] + moment[1]))
    return "has the principal moments " + number_text(moment[0]) + ", " + number_text(moment[1]) + " and " +
           number_text(moment[2]) + " kg m^2 (allowed: none above the sum of the others, as mass has no negative part)";
  return {};
}

/// In 2D one moment, about z.
void read_plane_inertia(Section const& section, Value const& value, RigidSpec& rigid) {
  auto const items = read_list(value, 1, 1, section.problems());
  if (!items) return;
  Interval const positive_moment{0, unbounded, true, true};
  if (auto const moment = read_number((*items)[0], "kg m", positive_moment, section.problems()))
    rigid.inertia = {0, 0, *moment, 0, 0, 0};
}

}  // namespace

void read_inertia(Section const& section, int dimension, RigidSpec& rigid) {
  auto const value = section.find("inertia");
  if (!value) return;
  if (dimension < 3) return read_plane_inertia(section, *value, rigid);
  auto const rows = read_rows(section, *value);
  if (!rows) return;
  if (std::string const problem = impossible(*rows); !problem.empty()) {
    section.problems().add(section.place_of("inertia"), section.name_of("inertia") + " " + problem);
    return;
  }
  auto const& I = *rows;
  rigid.inertia = {I[0][0], I[1][1], I[2][2], I[0][1], I[1][2], I[0][2]};
}

}  // namespace piola
