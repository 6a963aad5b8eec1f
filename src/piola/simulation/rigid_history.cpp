// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/rigid_history.hpp"
#include "piola/math/quaternion.hpp"
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace piola {
namespace {

std::vector<std::string> cells(std::string const& line) {
  std::vector<std::string> all;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) all.push_back(cell);
  return all;
}

double number_of(std::vector<std::string> const& row, std::size_t column) {
  double value = 0;
  if (column < row.size()) std::istringstream(row[column]) >> value;
  return value;
}

Quaternion turn_of(RigidState const& state) { return turn_by({{state.turn[0], state.turn[1], state.turn[2]}}); }

/// A share of the way from one to another.
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
  std::ifstream file(history);
  std::string line;
  if (shapes.empty() || !std::getline(file, line)) return;
  std::vector<std::string> const names = cells(line);
  auto const column = [&](std::string const& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  std::erase_if(shapes, [&](RigidState const& shape) { return column(shape.name + ".turn_z") == names.size(); });
  while (std::getline(file, line)) {
    auto const row = cells(line);
    for (RigidState& shape : shapes)
      for (std::size_t c = 0; c < 3; ++c) {
        std::string const letter(1, "xyz"[c]);
        shape.centre[c] = number_of(row, column(shape.name + "." + letter));
        shape.turn[c] = number_of(row, column(shape.name + ".turn_" + letter));
      }
    rows_.push_back({number_of(row, column("time")), shapes});
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
