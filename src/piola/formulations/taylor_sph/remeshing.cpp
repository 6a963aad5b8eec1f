// SPDX-License-Identifier: Apache-2.0
// Updates of the neighbour lists and cells of a moving body.
#include "piola/base/errors.hpp"
#include "piola/formulations/taylor_sph/body.hpp"
#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace piola::taylor_sph {
namespace {

/// Largest change of squared distances between two updates of lists: 10 % in length, half of what lists reach further
/// than the kernels.
constexpr double largest_strain = 0.2;
/// Cells are rebuilt when the quality of one falls below this fraction of its value at construction.
constexpr double least_quality = 0.3;
constexpr long least_steps = 10;  ///< between two triangulations

struct Stopwatch {
  double& seconds;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  explicit Stopwatch(double& s) : seconds(s) {}
  Stopwatch(Stopwatch const&) = delete;
  Stopwatch& operator=(Stopwatch const&) = delete;
  ~Stopwatch() { seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
};

}  // namespace

/// Builds lists for these positions, and measures the cells.
void TaylorBody::build_lists(Points const& x) {
  {
    Stopwatch const watch(seconds_.lists);
    lists_.build(x, particles_, mesh_, boundary_, backend_->lanes);
  }
  lists_.set_views(state_);
  measures_ = backend_->place(state_);
  if (!(first_spacing_ > 0)) first_spacing_ = measures_.spacing;
}

void TaylorBody::remesh_if_needed() {
  measures_ = backend_->place(state_);
  // A cell that doubled since its lists were made, or was crushed to a fiftieth, is as invalid as one turned inside
  // out.
  constexpr double doubled = 3, crushed = 0.02;
  bool const invalid_lists = !options_.adjoint && !(measures_.strain < doubled);
  if (invalid_lists || !(measures_.spacing > crushed * first_spacing_)) measures_.inverted = true;
  // Distances that change by 10 % in every step, or cells that are spoilt in no time, are no motion that steps resolve.
  constexpr long most_successive = 25;
  if (counts_.successive_list_updates > most_successive) measures_.inverted = true;
  if (measures_.inverted || failure_.index != FailureSlot::none) return;
  try {
    update_lists_or_cells();
  } catch (InputError const& error) {  // at the start this is an input error, later a body that came apart
    detached_ = {worst_corner(), fmt::format("is in a body whose cells or lists cannot be rebuilt ({})", error.what())};
  }
}

void TaylorBody::update_lists_or_cells() {
  bool const bad_cells = measures_.quality < least_quality && counts_.steps_since_triangulation >= least_steps;
  if ((bad_cells && triangulate()) || detached_) return;
  if (options_.adjoint || measures_.strain < largest_strain) {
    if (counts_.steps_since_triangulation > least_steps) counts_.successive_list_updates = 0;
    return;
  }
  build_lists(particles_.positions());
  ++counts_.list_updates;
  ++counts_.successive_list_updates;
}

/// Replaces the cells by a triangulation of the current positions. False if nothing changes.
bool TaylorBody::triangulate() {
  constexpr long early = 5;  // a triangulation at the earliest possible time counts as this number of lists
  if (counts_.triangulations > 0 && counts_.steps_since_triangulation <= least_steps)
    counts_.successive_list_updates += early;
  counts_.steps_since_triangulation = 0;
  Points const now = particles_.positions();
  std::optional<Cells> cells;
  {
    Stopwatch const watch(seconds_.triangulation);
    cells = mesh_.triangulate(now);
  }
  if (!cells) return false;
  std::vector<bool> has_cell(now.size());
  for (Index const corner : cells->corner) has_cell[static_cast<std::size_t>(corner)] = true;
  auto const lone = std::find(has_cell.begin(), has_cell.end(), false);
  if (lone != has_cell.end()) {
    detached_ = {static_cast<Index>(lone - has_cell.begin()), "has no cell left around it"};
    return false;
  }
  ++counts_.triangulations;
  Snapshot s = snapshot();
  s.x_of_lists = s.x_of_cells = s.fields.front();  // Position
  s.corners.assign(cells->corner.begin(), cells->corner.end());
  for (auto& values : s.cell_fields) values.clear();
  restore(s);
  return true;
}

}  // namespace piola::taylor_sph
