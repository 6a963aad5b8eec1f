// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/eulerian_cells.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/common/pair_viscosity.hpp"
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/kernels/wendland_c2.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/mechanics/contact/bounding_box.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

using Kernel = WendlandC2;
/// Coefficients of the artificial viscosity, eq. (6).
constexpr double alpha = 1, beta = 2;
/// Largest frequency of a cell, in units of the speed of sound over the spacing.
constexpr double frequency_factor = 2.2;
/// Largest frequency by viscosity, in units of the rate at which a particle slows down.
constexpr double viscous_factor = 1.5;
/// Least volume ratio of a cell that follows its gradients, as a neighbour.
constexpr double least_beside = 0.05;

/// Smoothing length, in spacings.
double smoothing_length(int D) { return D == 3 ? 1.2 : 1.4; }

/// Sums over the neighbours of a particle in the undeformed lattice of a body.
struct LatticeSumsOfKernel {
  double gradient = 0;  ///< mean gradient of a field whose gradient is 1
  double square = 0;    ///< number of neighbours times the sum of (volume times gradient of the kernel)^2 [1/m2]
};
LatticeSumsOfKernel sums_in_lattice(std::array<double, 3> const& spacing, int D, double h) {
  double volume = 1, neighbours = 0;
  std::array<int, 3> steps{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) {
    volume *= spacing[c];
    steps[c] = static_cast<int>(Kernel::support * h / spacing[c]);
  }
  LatticeSumsOfKernel sums;
  for (int i = -steps[0]; i <= steps[0]; ++i)
    for (int j = -steps[1]; j <= steps[1]; ++j)
      for (int k = -steps[2]; k <= steps[2]; ++k) {
        double const r = std::hypot(i * spacing[0], j * spacing[1], k * spacing[2]);
        if (!(r > 0 && r < Kernel::support * h)) continue;
        double const slope = -volume * Kernel::sigma(D) / std::pow(h, D + 1) * Kernel::dw(D, r / h);
        sums.gradient += slope * r / D;
        sums.square += slope * slope;
        neighbours += 1;
      }
  sums.square *= neighbours / (sums.gradient * sums.gradient);
  return sums;
}

double volume_of_support(int D, double radius) {
  constexpr double pi = 3.14159265358979323846;
  return D == 1 ? 2 * radius : D == 2 ? pi * radius * radius : 4 * pi / 3 * radius * radius * radius;
}

bool is_local(NodalBody const& body, Index slot) { return slot >= body.own().first && slot < body.own().last; }

/// Replicates values of the members, which are zero on all ranks but that of the particle. Collective.
void share(std::vector<double>& values) {
  if (comm::is_parallel()) comm::allreduce_or(values);
}

}  // namespace

void EulerianCells::add(Index slot) { added_.push_back(slot); }

void EulerianCells::read_positions(Positions& to) const {
  to.resize(static_cast<std::size_t>(body_.slots()));
  exec_host::parallel_for(body_.own(), [&](Index i) { to[static_cast<std::size_t>(i)] = body_.x(i); });
  if (body_.shared())
    DistributedSlots{body_.slots(), body_.particles()}.complete({to.front().data(), 3 * to.size()}, 3);
}

/// The particles of the cells, and those within the support radius of the box around them.
void EulerianCells::find_members() {
  contact::BoundingBox box;
  for (Index const slot : slots_) box.add(vector_of(x_[static_cast<std::size_t>(slot)]));
  std::size_t count = 0;
  auto cell = slots_.begin();
  for (Index i = 0; i < body_.particles(); ++i) {
    Vec<3> const x = vector_of(x_[static_cast<std::size_t>(i)]);
    bool const converted = cell != slots_.end() && *cell == i;
    if (converted) ++cell;
    if (!converted && !box.holds(x, Kernel::support * h_)) continue;
    if (count == members_.size()) members_.emplace_back();
    Member& m = members_[count++];
    m.slot = i;
    m.converted = converted;
    m.V0 = V0_[static_cast<std::size_t>(i)];
    m.x = x;
    m.stress = {};
  }
  members_.resize(count);
}

void EulerianCells::find_neighbours() {
  int const D = body_.state().dimension;
  double const support = Kernel::support * h_, scale = gradient_scale_ * Kernel::sigma(D) / std::pow(h_, D + 1);
  Positions x(members_.size());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = x_[static_cast<std::size_t>(members_[k].slot)];
  CellGrid const grid(x, support);
  exec_host::parallel_for(static_cast<Index>(x.size()), [&](Index k) {
    Member& a = members_[static_cast<std::size_t>(k)];
    a.neighbours.clear();
    grid.visit(x[static_cast<std::size_t>(k)], [&](Index n) {
      Member const& b = members_[static_cast<std::size_t>(n)];
      if (n == k || !(a.converted || b.converted)) return;
      double const square = square_of_distance(x[static_cast<std::size_t>(k)], x[static_cast<std::size_t>(n)]);
      if (!(square > 0 && square < support * support)) return;
      double const r = std::sqrt(square);
      a.neighbours.push_back({static_cast<std::size_t>(n), -scale * Kernel::dw(D, r / h_) / r * (b.x - a.x)});
    });
  });
}

/// Volumes of the members now, by the stored states.
void EulerianCells::read_volumes() {
  std::vector<double> ratio(members_.size());
  for (std::size_t k = 0; k < ratio.size(); ++k) {
    Index const slot = members_[k].slot;
    if (!is_local(body_, slot)) continue;
    ratio[k] = members_[k].converted ? body_.failure_value(slot, FailureLayout::volume_factor)
                                     : std::max(volume_ratio_at(body_.state(), slot), least_beside);
  }
  share(ratio);
  for (std::size_t k = 0; k < ratio.size(); ++k) members_[k].volume = ratio[k] * members_[k].V0;
}

/// Sum over the neighbours of volume times displacement relative to the member times gradient.
Mat<3> EulerianCells::relative_motion(Member const& of) const {
  Mat<3> sum{};
  for (Neighbour const& n : of.neighbours) {
    Member const& b = members_[n.member];
    sum = sum + b.volume * outer(b.moved - of.moved, n.gradient);
  }
  return sum;
}

/// Calls act(member, step of its cell) for the members that have a cell. `steps` in the order of slots.
template <class F>
void EulerianCells::each_cell(std::vector<EulerianStep>& steps, F const& act) {
  std::vector<std::size_t> of_cell;
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (members_[k].converted) of_cell.push_back(k);
  exec_host::parallel_for_chunks(static_cast<Index>(of_cell.size()), static_cast<Index>(members_.size()), [&](Index k) {
    auto const n = static_cast<std::size_t>(k);
    act(members_[of_cell[n]], steps[n]);
  });
}

/// Displacements of the members since the positions `before`.
void EulerianCells::read_moved(Positions const& before) {
  for (Member& m : members_) {
    auto const slot = static_cast<std::size_t>(m.slot);
    m.moved = vector_of(x_[slot]) - vector_of(before[slot]);
  }
}

void EulerianCells::advance(double dt) {
  if (slots_.empty()) return;
  Positions const before = std::move(x_);
  x_.clear();
  read_positions(x_);
  std::vector<EulerianStep> steps(slots_.size());
  read_moved(before);
  each_cell(steps, [&](Member const& m, EulerianStep& s) {
    s.before = relative_motion(m);
    s.viscous_work = viscous_work(m);
  });
  find_members();
  find_neighbours();
  read_volumes();
  read_moved(before);
  for (std::size_t i = 0; i < v_.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) v_[i][c] = (x_[i][c] - before[i][c]) / dt;
  double const most = volume_of_support(body_.state().dimension, Kernel::support * h_);
  each_cell(steps, [&](Member const& m, EulerianStep& s) {
    s.dt = dt;
    s.strain = 0.5 * (s.before + relative_motion(m));
    s.J = std::min(m.volume * std::exp(trace(s.strain)), most) / m.V0;
  });
  each_cell(steps, [&](Member& m, EulerianStep const& s) { m.volume = s.J * m.V0; });
  find_compression();
  each_cell(steps, [&](Member const& m, EulerianStep& s) {
    s.after = relative_motion(m);
    s.viscous_work += viscous_work(m);
    EulerianCell cell = eulerian_cell_at(body_.state(), m.slot, m.V0);
    piola::nodal::advance(cell, material(m), s);
    if (!std::isfinite(cell.J + cell.pressure + cell.energy)) exec::record(body_.state().failure, m.slot, 1);
    store(cell, body_.state(), m.slot);
  });
  find_forces();
}

void EulerianCells::join() {
  auto const& s = body_.state();
  if (V0_.empty()) {
    auto const& spacing = body_.body().spacing;
    spacing_ = *std::min_element(spacing.begin(), spacing.begin() + s.dimension);
    h_ = smoothing_length(s.dimension) * mean_spacing(body_.body(), s.dimension);
    LatticeSumsOfKernel const sums = sums_in_lattice(spacing, s.dimension, h_);
    gradient_scale_ = 1 / sums.gradient;
    square_in_lattice_ = sums.square;
    V0_.resize(static_cast<std::size_t>(body_.slots()));
    for (Index i = body_.own().first; i < body_.own().last; ++i) V0_[static_cast<std::size_t>(i)] = value_at(s.V, i);
    if (body_.shared()) DistributedSlots{body_.slots(), body_.particles()}.complete(V0_, 1);
    v_.resize(V0_.size());
  }
  if (body_.shared()) allgather_selected_slots(s.history, body_.own(), added_, s.history_values());
  slots_.insert(slots_.end(), added_.begin(), added_.end());
  std::sort(slots_.begin(), slots_.end());
  added_.clear();
  if (slots_.empty()) return;
  read_positions(x_);
  find_members();
  find_neighbours();
  read_volumes();
  find_compression();
  find_forces();
}

/// Velocities of the members in the last step, and how much of the motion around the cells is compression.
void EulerianCells::find_compression() {
  for (Member& m : members_) m.v = vector_of(v_[static_cast<std::size_t>(m.slot)]);
  exec_host::parallel_for(static_cast<Index>(members_.size()), [&](Index k) {
    Member& m = members_[static_cast<std::size_t>(k)];
    m.compression = 0;
    if (!m.converted) return;
    Mat<3> L{};
    for (Neighbour const& n : m.neighbours)
      L = L + members_[n.member].volume * outer(members_[n.member].v - m.v, n.gradient);
    Constants const& law = material(m).constants;
    m.compression = compression_factor(L, std::sqrt(law.kappa / law.rho0), h_, eulerian_floor);
  });
}

std::vector<double> EulerianCells::state() const {
  std::vector<double> velocities;
  for (Member const& m : members_) velocities.insert(velocities.end(), m.v.c, m.v.c + 3);
  return velocities;
}

void EulerianCells::load(std::vector<double> const& state) {
  join();
  PIOLA_EXPECTS(state.size() == 3 * members_.size());
  for (std::size_t k = 0; k < members_.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) v_[static_cast<std::size_t>(members_[k].slot)][c] = state[3 * k + c];
  join();
}

/// Viscous force on `a` by a neighbour [N]. `rate` grows by the rate at which the pair slows down by it [1/s].
Vec<3> EulerianCells::viscous_force(Member const& a, Neighbour const& to, double& rate) const {
  Member const& b = members_[to.member];
  Vec<3> const apart = b.x - a.x;
  double const closing = dot(b.v - a.v, apart), square = dot(apart, apart);
  if (!(closing < 0)) return {};
  Constants const &law_a = material(a).constants, &law_b = material(b).constants;
  double const mass_a = law_a.rho0 * a.V0, mass_b = law_b.rho0 * b.V0;
  auto const pair = viscous_pair(alpha, beta, h_, closing, square,
                                 std::sqrt(law_a.kappa / law_a.rho0) + std::sqrt(law_b.kappa / law_b.rho0),
                                 mass_a / a.volume + mass_b / b.volume);
  double const share = (a.compression + b.compression) * (a.converted && b.converted ? 0.5 : 1.0);
  double const factor = -share * mass_a * mass_b * pair.pressure;
  rate += std::abs(factor / closing) * std::sqrt(dot(to.gradient, to.gradient) * square) *
          (1 / body_.replicated_mass(a.slot) + 1 / body_.replicated_mass(b.slot));
  return factor * to.gradient;
}

/// Work of the viscous forces on a cell in the last step by half of the present ones [J]: an Eulerian neighbour has the
/// other half of that of a pair.
double EulerianCells::viscous_work(Member const& of) const {
  double work = 0, unused = 0;
  for (Neighbour const& n : of.neighbours) {
    Member const& b = members_[n.member];
    work += (b.converted ? 0.25 : 0.5) * dot(viscous_force(of, n, unused), b.moved - of.moved);
  }
  return work;
}

/// Bound on the frequency of the motion that a cell resists: that of a lattice as dense as the cell, and in tension
/// that of the undeformed lattice times the root of how much stiffer the cell is by the present gradients and volumes,
/// each neighbour giving an equal part of its mass. Released material is softer than its speed of sound says.
double EulerianCells::largest_frequency(Member const& of, EulerianCell const& cell) const {
  double const in_lattice = frequency_factor * sound_speed_of(cell, material(of)) / spacing_,
               dense = in_lattice / std::min(1.0, std::pow(cell.J, 1.0 / body_.state().dimension));
  if (!(cell.pressure < 0)) return dense;
  double sum = 0;
  for (Neighbour const& n : of.neighbours) {
    Member const& b = members_[n.member];
    sum += b.volume * b.volume * dot(n.gradient, n.gradient) / body_.replicated_mass(b.slot);
  }
  sum *= material(of).constants.rho0 * of.V0 * static_cast<double>(of.neighbours.size());
  return std::max(dense, in_lattice * std::sqrt(sum / square_in_lattice_));
}

void EulerianCells::find_forces() {
  std::vector<double> frequency(members_.size());
  auto const n = static_cast<Index>(members_.size());
  exec_host::parallel_for(n, [&](Index k) {
    Member& m = members_[static_cast<std::size_t>(k)];
    if (!m.converted) return;
    EulerianCell const cell = eulerian_cell_at(body_.state(), m.slot, m.V0);
    m.stress = cell.stress();
    frequency[static_cast<std::size_t>(k)] = largest_frequency(m, cell);
  });
  exec_host::parallel_for(n, [&](Index k) {
    Member& a = members_[static_cast<std::size_t>(k)];
    a.force = {};
    double rate = 0;
    for (Neighbour const& to : a.neighbours) {
      Member const& b = members_[to.member];
      a.force = a.force + viscous_force(a, to, rate);
      double const volumes = a.volume * b.volume;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) a.force[i] += volumes * (a.stress(i, j) + b.stress(i, j)) * to.gradient[j];
    }
    double& f = frequency[static_cast<std::size_t>(k)];
    f = std::max(f, viscous_factor * rate);
  });
  double const most = *std::max_element(frequency.begin(), frequency.end());
  frequency2_ = most * most;
}

void EulerianCells::kick(double dt) const {
  auto const& s = body_.state();
  for (Member const& m : members_)
    if (is_local(body_, m.slot))
      for (int c = 0; c < s.dimension; ++c) value_at(s.v, m.slot, c) += dt * m.force[c] / body_.replicated_mass(m.slot);
}

}  // namespace piola::nodal
