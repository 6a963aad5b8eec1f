// SPDX-License-Identifier: Apache-2.0
// Snapshots of a body: for checkpoints, and for new cells.
#include "piola/base/errors.hpp"
#include "piola/formulations/common/field_list.hpp"
#include "piola/formulations/taylor_sph/body.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <type_traits>

namespace piola::taylor_sph {
namespace {

std::vector<double> flattened(Points const& points, int D) {
  std::vector<double> r;
  for (auto const& p : points) r.insert(r.end(), p.begin(), p.begin() + D);
  return r;
}

Points points_of(std::vector<double> const& values, int D) {
  Points r(values.size() / static_cast<std::size_t>(D));
  for (std::size_t k = 0; k < values.size(); ++k)
    r[k / static_cast<std::size_t>(D)][k % static_cast<std::size_t>(D)] = values[k];
  return r;
}

Index same_slot(Index cell) { return cell; }

void take_mean_of_corners(Field& of_cells, Field const& of_particles, Cells const& cells, Particles const& particles) {
  for (Index cell = 0; cell < cells.count(); ++cell)
    for (int k = 0; k < of_cells.components(); ++k) {
      double mean = 0;
      for (Index const corner : cells.of(cell)) mean += of_particles.at(particles.slot(corner), k) / cells.corners;
      of_cells.at(cell, k) = mean;
    }
}

/// Calls f(name, values) for the arrays of a snapshot in the order of the checkpoint.
template <class S, class F>
void each_array(TaylorBody const& body, std::size_t number, S& snapshot, F const& f) {
  auto const each_field = [&](auto const& set, auto& all) {
    auto values = all.begin();
    each_evolved(set,
                 [&](Field const& of) { f(fmt::format("body{}_{}", number, checkpoint_name(of.name())), *values++); });
  };
  each_field(body.particles().fields(), snapshot.fields);
  f(fmt::format("body{}_position_of_lists", number), snapshot.x_of_lists);
  f(fmt::format("body{}_position_of_cells", number), snapshot.x_of_cells);
  f(fmt::format("body{}_cells", number), snapshot.corners);
  each_field(body.cell_fields(), snapshot.cell_fields);
  f(fmt::format("body{}_books", number), snapshot.totals);
}

/// Numbers of particles are used as places in memory.
void expect_number_below(double number, double bound, std::size_t body) {
  if (number >= 0 && number < bound && number == std::floor(number)) return;
  throw FileError(
      fmt::format("checkpoint: the cells of body {} have a corner {} (allowed: whole numbers below {}) - it "
                  "was written by another version; run the case again",
                  body, number, bound));
}

}  // namespace

/// Calls f(value) for the evolved values of a body as a whole.
template <class Self, class F>
void TaylorBody::each_total(Self& self, F const& f) {
  f(self.actions_.totals.work);
  f(self.actions_.totals.power);
  f(self.state_.filter_loss);
  f(self.counts_.list_updates);
  f(self.counts_.triangulations);
  f(self.counts_.steps_since_triangulation);
  f(self.counts_.successive_list_updates);
  for (auto& component : self.actions_.totals.momentum) f(component);
  f(self.state_.exchange_loss);
  f(self.last_step_);
  f(self.damping_loss_);
}

Snapshot TaylorBody::snapshot() const {
  Snapshot s;
  s.fields = evolved_values(particles_.fields(), particles_.count(), [&](Index i) { return particles_.slot(i); });
  s.x_of_lists = flattened(lists_.x(), particles_.dimension());
  s.x_of_cells = flattened(mesh_.x(), particles_.dimension());
  s.corners.assign(mesh_.cells().corner.begin(), mesh_.cells().corner.end());
  s.cell_fields = evolved_values(cell_fields_, mesh_.count(), same_slot);
  each_total(*this, [&](auto const& value) { s.totals.push_back(static_cast<double>(value)); });
  return s;
}

void TaylorBody::restore(Snapshot const& s) {
  std::vector<Index> corners;
  for (double const corner : s.corners) corners.push_back(static_cast<Index>(corner));
  arrange(std::move(corners), points_of(s.x_of_cells, particles_.dimension()));
  set_evolved(particles_.fields(), s.fields, [&](Index i) { return particles_.slot(i); });
  auto total = s.totals.begin();
  each_total(*this, [&](auto& value) { value = static_cast<std::remove_reference_t<decltype(value)>>(*total++); });
  if (options_.adjoint && s.cell_fields.front().empty()) {
    take_mean_of_corners(cell_fields_.stress, particles_.fields().stress, mesh_.cells(), particles_);
    take_mean_of_corners(cell_fields_.out_of_plane, particles_.fields().out_of_plane, mesh_.cells(), particles_);
  }
  set_evolved(cell_fields_, s.cell_fields, same_slot);
  build_lists(points_of(s.x_of_lists, particles_.dimension()));
}

void save_body(TaylorBody const& body, std::size_t number, StateWriter& writer) {
  Snapshot const snapshot = body.snapshot();
  writer.put(fmt::format("body{}_cell_corners", number), std::array{static_cast<double>(snapshot.corners.size())});
  each_array(body, number, snapshot,
             [&](std::string const& name, std::vector<double> const& values) { writer.put(name, values); });
}

void load_body(TaylorBody& body, std::size_t number, StateReader& reader) {
  Snapshot snapshot = body.snapshot();
  std::array<double, 1> cells{};
  reader.get(fmt::format("body{}_cell_corners", number), cells);
  expect_number_below(cells[0], std::pow(2.0, 32), number);
  std::size_t const now = snapshot.corners.size(), then = static_cast<std::size_t>(cells[0]);
  snapshot.corners.resize(then);
  for (auto& values : snapshot.cell_fields) values.resize(values.size() * then / std::max<std::size_t>(now, 1));
  each_array(body, number, snapshot,
             [&](std::string const& name, std::vector<double>& values) { reader.get(name, values); });
  auto const points = static_cast<double>(body.particles().count());
  for (double const corner : snapshot.corners) expect_number_below(corner, points, number);
  body.restore(snapshot);
}

}  // namespace piola::taylor_sph
