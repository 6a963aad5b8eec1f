// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/rigid_history.hpp"
#include "piola/math/quaternion.hpp"
#include "piola/output/history.hpp"
#include <algorithm>
#include <cmath>
#include <optional>

namespace piola {
namespace {

Quaternion turn_of(RigidState const& state) { return turn_by({{state.turn[0], state.turn[1], state.turn[2]}}); }

/// Interpolates between two states by a fraction.
RigidState between(RigidState const& a, RigidState const& b, double share) {
  RigidState state = a;
  for (std::size_t c = 0; c < 3; ++c) state.centre[c] += share * (b.centre[c] - a.centre[c]);
  Quaternion const p = turn_of(a), q = turn_of(b);
  double const along = (p.w * q.w + dot(p.v, q.v) < 0 ? -1 : 1) * share;
  Vec<3> const turn =
      rotation_vector(of_unit_length({(1 - share) * p.w + along * q.w, (1 - share) * p.v + along * q.v}));
  state.turn = {turn[0], turn[1], turn[2]};
  return state;
}

}  // namespace

RigidHistory::RigidHistory(std::filesystem::path const& history, std::vector<RigidSpec> const& rigids) {
  std::vector<RigidState> shapes;
  for (RigidSpec const& rigid : rigids)
    if (rigid.turns()) shapes.emplace_back().name = rigid.name;
  if (shapes.empty()) return;
  HistoryTable const table = read_history(history);
  std::erase_if(shapes, [&](RigidState const& shape) { return !table.find(shape.name + ".rotation_z"); });
  auto const number = [](std::vector<double> const& row, std::optional<std::size_t> column) {
    double const value = column ? row[*column] : 0;
    return std::isfinite(value) ? value : 0;
  };
  std::vector<std::optional<std::size_t>> columns;  // centre and turn of each shape, component by component
  for (RigidState const& shape : shapes)
    for (char const letter : {'x', 'y', 'z'})
      for (char const* const what : {".", ".rotation_"}) columns.push_back(table.find(shape.name + what + letter));
  auto const time = table.find("time");
  for (auto const& row : table.rows) {
    auto column = columns.begin();
    for (RigidState& shape : shapes)
      for (std::size_t c = 0; c < 3; ++c) {
        shape.centre[c] = number(row, *column++);
        shape.turn[c] = number(row, *column++);
      }
    rows_.push_back({number(row, time), shapes});
  }
}

std::vector<RigidState> RigidHistory::at(double time) const {
  if (rows_.empty()) return {};
  auto const after = std::find_if(rows_.begin(), rows_.end(), [&](Row const& row) { return row.time >= time; });
  if (after == rows_.end()) return rows_.back().states;
  if (after == rows_.begin()) return after->states;
  auto const before = after - 1;
  std::vector<RigidState> states;
  double const share = (time - before->time) / (after->time - before->time);
  for (std::size_t k = 0; k < after->states.size(); ++k)
    states.push_back(between(before->states[k], after->states[k], share));
  return states;
}

}  // namespace piola
