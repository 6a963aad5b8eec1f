// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/body.hpp"
#include "piola/base/errors.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/materials/laws.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/particles/ordering.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace piola::taylor_sph {
namespace {

/// Slots of a range are a multiple of every lane count.
constexpr Index alignment = 16;
Index aligned(Index n) { return (n + alignment - 1) / alignment * alignment; }

/// Position of slots without particles: so far away that every kernel vanishes.
constexpr double far_away = 1e20;

}  // namespace

bool is_whole_lattice(ParticleSet const& set, Body const& body) {
  std::int64_t full = 1, doubled = 0;
  for (int const n : body.lattice) full *= n;
  for (std::int64_t id = body.first; id < body.last && !set.crack_side.empty(); ++id)
    doubled += set.crack_side[static_cast<std::size_t>(id)] < 0 ? 1 : 0;
  return body.last - body.first - doubled == full;
}

TaylorBody::TaylorBody(Assembly const& assembly, std::size_t body, Options const& options, Backend const& backend)
    : body_(assembly.particles.bodies[body]), options_(options), backend_(&backend), boundary_(assembly, body) {
  auto const& set = assembly.particles;
  auto const part = [&](auto const& all) {
    return std::decay_t<decltype(all)>(all.begin() + body_.first, all.begin() + body_.last);
  };
  X_ = part(set.X);
  kernel_volume_ = part(set.kernel_volume);
  if (!set.crack_side.empty()) crack_side_ = part(set.crack_side);
  for (auto const& crack : set.cracks)
    if (crack.body == static_cast<int>(body)) cracks_.push_back(crack);
  state_.dimension = set.dimension;
  of_support_.resize(assembly.supports.size());
  of_load_.resize(assembly.loads.size());
  set_constants(assembly, body);
  double widest = 0;
  for (int c = 0; c < D(); ++c) widest = std::max(widest, body_.spacing[static_cast<std::size_t>(c)]);
  // The circumradius of a simplex in a box of the lattice is 0.5 sqrt(D) spacings; jitter makes some larger.
  largest_radius_ = (0.6 + 0.35 * D()) * widest;
  cells_ = first_cells(set);
  if (D() > 1 && options_.hourglass > 0) boxes_ = lattice_cells(set, body_);
  if (options_.adjoint)
    weigh_cells(assembly);
  else if (!assembly.initial_displacement.empty())
    weigh_displaced(assembly);
  place_initially(assembly);
}

/// Particles start at the initial displacement, free of stress and with the given density: masses follow the cells.
void TaylorBody::weigh_displaced(Assembly const& assembly) {
  Points x = X_;
  for (Index i = 0; i < particles(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      x[at(i)][c] += assembly.initial_displacement[static_cast<std::size_t>(body_.first + i)][c];
  std::vector<double> before(X_.size(), 0), after(X_.size(), 0);
  for (Index cell = 0; cell < cells_.count(); ++cell)
    for (Index const corner : cells_.of(cell)) {
      before[at(corner)] += volume_of(cells_, cell, X_);
      after[at(corner)] += volume_of(cells_, cell, x);
    }
  for (std::size_t i = 0; i < X_.size(); ++i) mass_[i] *= after[i] / before[i];
}

/// With the adjoint exchange masses are parts of the cells at the initial positions, m_i = rho0 sum V_J / n.
void TaylorBody::weigh_cells(Assembly const& assembly) {
  Points x = X_;
  for (Index i = 0; i < particles() && !assembly.initial_displacement.empty(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      x[at(i)][c] += assembly.initial_displacement[static_cast<std::size_t>(body_.first + i)][c];
  mass_.assign(X_.size(), 0);
  for (Index cell = 0; cell < cells_.count(); ++cell)
    for (Index const corner : cells_.of(cell))
      mass_[at(corner)] += state_.k.rho0 * volume_of(cells_, cell, x) / cells_.corners;
  auto const lost = std::find_if(mass_.begin(), mass_.end(), [](double m) { return !(m > 0); });
  if (lost == mass_.end()) return;
  auto const& X = X_[static_cast<std::size_t>(lost - mass_.begin())];
  throw InputError(
      fmt::format("taylor_sph: the particle of body '{}' at ({:.4g}, {:.4g}, {:.4g}) m is the corner of no "
                  "cell - use smaller spacings, or a shape without lone particles",
                  body_.name, X[0], X[1], X[2]));
}

void TaylorBody::set_constants(Assembly const& assembly, std::size_t body) {
  state_.material = assembly.materials[body];
  auto& k = state_.k;
  with_law(state_.material, [&](auto const& law) {
    if constexpr (RateForm<std::decay_t<decltype(law)>>) {
      k.rho0 = law.rho0;
      // The strain rate across for which the stress across does not change.
      double const free = D() == 1 ? law.lambda / (2 * (law.lambda + law.mu)) : law.lambda / (law.lambda + 2 * law.mu);
      k.lateral = options_.stress_free ? free : 0;
      k.modulus = law.lambda + 2 * law.mu - (3 - D()) * law.lambda * k.lateral;
    }
  });
  k.kernel_volume = kernel_volume_.front();
  k.hourglass = options_.hourglass;
  k.form = options_.form;
  k.kernel = options_.kernel;
  k.moving = options_.moving;
  k.loaded = boundary_.has_accelerations() || (options_.adjoint && boundary_.has_tractions());
  k.adjoint = options_.adjoint;
  k.memory = options_.adjoint ? options_.memory : 0;
  k.hourglass_stiffness = options_.hourglass_stiffness;
  if (k.adjoint) kernel_volume_.assign(X_.size(), k.kernel_volume);
  for (Index i = 0; i < particles(); ++i)
    mass_.push_back(k.rho0 * assembly.particles.volume[static_cast<std::size_t>(body_.first + i)]);
}

/// A lattice is triangulated with alternating diagonals: all triangulations of its squares are Delaunay's.
Cells TaylorBody::first_cells(ParticleSet const& set) const {
  if (options_.lattice_cells) return lattice_cells(set, body_);
  if (is_whole_lattice(set, body_) && (body_.regular || !cracks_.empty()))
    // Under the adjoint exchange masses are those of the cells: as many around each particle.
    return split_alternately(lattice_cells(set, body_), set, body_,
                             !options_.adjoint ? Diagonals::by_box
                             : cracks_.empty() ? Diagonals::by_row
                                               : Diagonals::by_column);
  return delaunay(X_, D(), largest_radius_);
}

void TaylorBody::place_initially(Assembly const& assembly) {
  Snapshot s;
  auto const D = static_cast<std::size_t>(this->D());
  for (Index i = 0; i < particles(); ++i) {
    auto const id = static_cast<std::size_t>(body_.first + i);
    for (std::size_t c = 0; c < D; ++c) {
      double const u = assembly.initial_displacement.empty() ? 0 : assembly.initial_displacement[id][c];
      s.x.push_back(X_[at(i)][c] + u);
      s.v.push_back(assembly.initial_velocity.empty() ? 0 : assembly.initial_velocity[id][c]);
    }
    s.volume.push_back(kernel_volume_[at(i)]);
  }
  s.stress.assign(X_.size() * D * (D + 1) / 2, 0);
  s.across.assign(X_.size(), 0);
  s.drift = s.v;
  s.displacement.assign(s.v.size(), 0);
  s.x_of_lists = s.x_of_cells = s.x;
  for (Index const corner : cells_.corner) s.corners.push_back(corner);
  s.energy_totals.assign(16, 0);
  restore(s);
  start_ = positions();
  free_ = !boundary_.holds();
  double now[MotionSums::size];
  backend_->motion(state_, now);
  for (std::size_t k = 0; k < 6; ++k) momentum_[k] = now[MotionSums::v + k];
}

void TaylorBody::order_slots(std::vector<Index> const& on_boundary) {
  std::vector<bool> outer(X_.size());
  for (Index const i : on_boundary) outer[at(i)] = true;
  state_.boundary_count = static_cast<Index>(on_boundary.size());
  state_.interior_count = particles() - state_.boundary_count;
  state_.interior = {0, aligned(state_.interior_count)};
  state_.boundary = {state_.interior.last, state_.interior.last + aligned(state_.boundary_count)};
  slot_of_.assign(X_.size(), 0);
  local_of_.assign(at(state_.boundary.last), -1);
  std::vector<Index> inner;
  for (Index i = 0; i < particles(); ++i)
    if (!outer[at(i)]) inner.push_back(i);
  auto const put = [&](Index slot, Index i) {
    slot_of_[at(i)] = slot;
    local_of_[at(slot)] = i;
  };
  Index slot = 0;
  for (Index const i : inner) put(slot++, i);
  slot = state_.boundary.first;
  for (Index const i : on_boundary) put(slot++, i);
  id_in_slot_.assign(local_of_.size(), SlotOrder::no_particle);
  for (Index i = 0; i < particles(); ++i) id_in_slot_[at(slot_of_[at(i)])] = body_.first + i;
  failure_.id = id_in_slot_.data();
}

void TaylorBody::order_cells() {
  constexpr std::size_t most = std::numeric_limits<Index>::max();
  if (cells_.corner.size() > most)
    throw InputError(
        fmt::format("taylor_sph: body '{}' has {} corners of cells (allowed: {} in one process) - use "
                    "larger spacings, or virtual_particles = \"lattice_cells\"",
                    body_.name, cells_.corner.size(), most));
  state_.virtual_count = cells_.count();
  state_.virtuals = {0, aligned(cells_.count())};
}

void TaylorBody::arrange(Points const& x_of_cells) {
  x_of_cells_ = x_of_cells;
  // Corners near each other belong to cells near each other.
  Index const n = cells_.count();
  std::vector<Index> order(at(n)), first(at(n));
  std::iota(order.begin(), order.end(), 0);
  for (Index c = 0; c < n; ++c) first[at(c)] = std::ranges::min(cells_.of(c));
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return first[at(a)] < first[at(b)]; });
  Cells sorted = cells_;
  for (Index c = 0; c < n; ++c)
    std::ranges::copy(cells_.of(order[at(c)]), sorted.corner.begin() + static_cast<std::ptrdiff_t>(c) * cells_.corners);
  cells_ = sorted;
  order_slots(boundary_.arrange(surface_of(cells_, x_of_cells), x_of_cells));
  order_cells();
  int const stride = record_stride(D());
  auto const records = [&](Index slots) {
    Memory memory(static_cast<std::size_t>(slots + 1) * static_cast<std::size_t>(stride));
    for (Index i = 0; i <= slots; ++i)
      for (int c = 0; c < D(); ++c) memory.data()[i * stride + c] = far_away;
    return memory;
  };
  real_ = records(state_.boundary.last);
  virtual_ = records(state_.virtuals.last);
  state_.real = real_.data();
  state_.virtual_ = virtual_.data();
  Index const slots = state_.boundary.last;
  for (Field* field : {&across_, &drift_, &displacement_, &acceleration_, &slot_mass_})
    field->allocate(slots, alignment);
  state_.out_of_plane = across_.ref();
  state_.drift = drift_.ref();
  state_.displacement = displacement_.ref();
  state_.acceleration = acceleration_.ref();
  state_.mass = slot_mass_.ref();
  for (Index i = 0; i < particles(); ++i) slot_mass_.at(slot_of_[at(i)]) = mass_[at(i)];
  partial_.assign(MotionSums::size * (at(std::max(slots, state_.virtuals.last) / 64) + 2), 0);
  state_.partial = partial_.data();
  state_.failure = &failure_;
  state_.items = boundary_.items();
  fill_cell_tables(x_of_cells);
  fill_hourglass_tables();
  fill_cell_memory();
}

void TaylorBody::fill_cell_tables(Points const& x) {
  int const lanes = backend_->lanes;
  corner_.assign(at(state_.virtuals.last) * cells_.corners, 0);
  reference_quality_.assign(at(state_.virtuals.last), 1);
  double factorial = 1;
  for (int c = 2; c <= D() && cells_.corners == D() + 1; ++c) factorial *= c;
  for (Index v = 0; v < state_.virtuals.last; ++v) {
    Index const cell = cell_in_slot(v);
    auto const corners = cells_.of(cell);
    double longest = 0;
    for (std::size_t a = 0; a < corners.size(); ++a) {
      corner_[(at(v / lanes) * cells_.corners + a) * lanes + v % lanes] = slot_of_[at(corners[a])];
      for (std::size_t b = a + 1; b < corners.size(); ++b) {
        auto const &p = x[at(corners[a])], &q = x[at(corners[b])];
        longest = std::max(longest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
    }
    reference_quality_[at(v)] = factorial * volume_of(cells_, cell, x) / std::pow(longest, D());
  }
  state_.cells.corners = cells_.corners;
  state_.cells.simplices = cells_.corners == D() + 1;
  state_.cells.corner = corner_.data();
  state_.cells.reference_quality = reference_quality_.data();
  state_.cells.adjoint = options_.adjoint;
}

/// Allocates the cell data of the adjoint exchange, and the cells around each particle, in their order.
void TaylorBody::fill_cell_memory() {
  if (!options_.adjoint) return;
  int const corners = cells_.corners;
  around_begin_.assign(at(state_.boundary.last) + 1, 0);
  for (Index const corner : cells_.corner) ++around_begin_[at(slot_of_[at(corner)]) + 1];
  std::partial_sum(around_begin_.begin(), around_begin_.end(), around_begin_.begin());
  around_.assign(cells_.corner.size(), 0);
  std::vector<Index> next(around_begin_.begin(), around_begin_.end() - 1);
  for (Index c = 0; c < cells_.count(); ++c)
    for (int k = 0; k < corners; ++k)
      around_[at(next[at(slot_of_[at(cells_.of(c)[static_cast<std::size_t>(k)])])]++)] = c * corners + k;
  state_.around = {around_begin_.data(), around_.data()};
  std::size_t const slots = at(state_.virtuals.last), D = at(this->D());
  int const patterns = D == 1 || corners == this->D() + 1 ? 0 : D == 2 ? 1 : 4;
  cell_across_.assign(slots, 0);
  cell_force_.assign(slots * at(corners) * D, 0);
  cell_gradient_.assign(slots * D * D, 0);
  cell_hourglass_.assign(slots * at(patterns) * D, 0);
  state_.memory = {cell_across_.data(), cell_force_.data(), cell_gradient_.data(), cell_hourglass_.data(), patterns};
}

void TaylorBody::fill_hourglass_tables() {
  if (boxes_.count() == 0) return;
  int const lanes = backend_->lanes, corners = boxes_.corners;
  Index const boxes = aligned(boxes_.count());
  box_corner_.assign(at(boxes) * corners, 0);
  box_of_.assign(at(state_.boundary.last) * corners, -1);
  for (Index b = 0; b < boxes; ++b)
    for (int k = 0; k < corners; ++k) {
      Index const slot = slot_of_[at(boxes_.of(std::min(b, boxes_.count() - 1))[static_cast<std::size_t>(k)])];
      box_corner_[(at(b / lanes) * corners + k) * lanes + b % lanes] = slot;
      if (b >= boxes_.count()) continue;
      // A particle is the opposite corner of each of its boxes: corner k of one box only.
      box_of_[at(slot) * corners + k] = b * corners + k;
    }
  int const patterns = D() == 2 ? 1 : 4, fields = D() + D() * (D() + 1) / 2;
  pattern_.assign(at(boxes) * patterns * fields, 0);
  state_.hourglass = {boxes, box_corner_.data(), pattern_.data(), box_of_.data()};
}

/// Everything from outside enters as a force, at half time, or as a prescribed speed: no stress is imposed.
void TaylorBody::step_adjoint(Impulse const& before, double time, double dt) {
  std::vector<Push> pushes;
  if (surface_positions_.size() != X_.size()) surface_positions_ = X_;
  for (Index const i : boundary_.particles()) {
    auto const here = x(i), speed = v(i);
    for (std::size_t c = 0; c < 3; ++c)
      surface_positions_[at(i)][c] = here[c] + (state_.k.moving ? 0.5 * dt * speed[c] : 0);
  }
  boundary_.prepare_speeds(time, dt, surface_positions_, [&](Index i) { return v(i); });
  if (state_.k.loaded) {
    prepare_loads(time + 0.5 * dt);
    for (double const t : {time, time + dt})
      boundary_.each_traction(t, [&](std::size_t load, Index i, std::array<double, 3> const& f) {
        pushes.push_back({load, i, {0.5 * dt * f[0], 0.5 * dt * f[1], 0.5 * dt * f[2]}});
        for (int c = 0; c < D(); ++c)
          acceleration_.at(slot_of_[at(i)], c) += 0.5 * f[static_cast<std::size_t>(c)] / mass_[at(i)];
      });
  }
  backend_->adjoint_step(state_, dt);
  work_ += state_.work;
  add_impulses(time, dt, &pushes);
  find_reactions(before, dt);
  last_step_ = dt;
  ++steps_since_triangulation_;
  if (state_.k.moving) follow_motion();
}

void TaylorBody::step(double time, double dt) {
  Impulse const before_step = momentum();
  if (options_.adjoint) return step_adjoint(before_step, time, dt);
  if (state_.k.loaded) prepare_loads(time + 0.5 * dt);
  prepare_boundary(time, dt, 0.5 * dt);
  backend_->half_step(state_, dt);
  backend_->full_step(state_, dt);
  if (options_.hourglass > 0 && boxes_.count() > 0) backend_->filter(state_);
  // Normals of the end of the step.
  if (state_.k.moving) prepare_boundary(time, dt, 0);
  backend_->impose(state_);
  add_impulses(time, dt);
  if (free_ && state_.k.moving && options_.conserve) conserve_momentum();
  find_reactions(before_step, dt);
  double const before = power_;
  power_ = boundary_power();
  work_ += 0.5 * dt * (before + power_);
  ++steps_since_triangulation_;
  if (state_.k.moving) follow_motion();
}

double TaylorBody::boundary_power() const {
  return boundary_.power([&](Index i) { return v(i); }, [&](Index i) { return record_stress(i); });
}

void TaylorBody::damp(double factor) {
  double const before = kinetic_energy();
  std::vector<std::array<double, 3>> kept;
  for (std::size_t k = 0; k < boundary_.particles().size(); ++k) {
    BoundaryItem const& item = state_.items[k];
    auto const velocity = v(boundary_.particles()[k]);
    kept.push_back({});
    for (int h = 0; h < item.held; ++h) {
      double along = 0;
      for (std::size_t c = 0; c < 3; ++c) along += item.direction[h][c] * velocity[c];
      for (std::size_t c = 0; c < 3; ++c) kept.back()[c] += (1 - factor) * along * item.direction[h][c];
    }
  }
  for (Index i = 0; i < particles(); ++i)
    for (int c = 0; c < D(); ++c) {
      record(i)[D() + 1 + c] *= factor;
      drift_.at(slot_of_[at(i)], c) *= factor;
    }
  for (std::size_t k = 0; k < kept.size(); ++k)
    for (int c = 0; c < D(); ++c) record(boundary_.particles()[k])[D() + 1 + c] += kept[k][static_cast<std::size_t>(c)];
  for (double& p : momentum_) p *= factor;  // of a body without supports
  power_ = boundary_power();
  damping_loss_ += before - kinetic_energy();
}

double TaylorBody::kinetic_energy() const {
  return exec_host::parallel_sum(particles(), [&](Index i) {
    auto const velocity = v(i);
    return 0.5 * mass_[at(i)] * dot(velocity, velocity);
  });
}

/// `ahead`: how far the surface has drifted on when its normals are taken [s].
void TaylorBody::prepare_boundary(double time, double dt, double ahead) {
  if (surface_positions_.size() != X_.size()) surface_positions_ = X_;
  for (Index const i : boundary_.particles()) surface_positions_[at(i)] = place_at(i, state_.k.moving ? ahead : 0);
  boundary_.prepare(
      time, dt, surface_positions_, [&](Index i) { return v(i); }, [&](Index i) { return record_stress(i); });
  state_.items = boundary_.items();
}

/// Position of a particle after drifting for a time; negative: its earlier position.
std::array<double, 3> TaylorBody::place_at(Index i, double ahead) const {
  auto r = x(i);
  for (int c = 0; c < D(); ++c) r[static_cast<std::size_t>(c)] += ahead * drift_.at(slot_of_[at(i)], c);
  return r;
}

void TaylorBody::prepare_loads(double time) {
  for (Index i = 0; i < state_.boundary.last; ++i)
    for (int c = 0; c < D(); ++c) acceleration_.at(i, c) = 0;
  boundary_.each_acceleration(time, [&](std::size_t, Index i, std::array<double, 3> const& a) {
    for (int c = 0; c < D(); ++c) acceleration_.at(slot_of_[at(i)], c) += a[static_cast<std::size_t>(c)];
  });
}

double TaylorBody::stable_time_step() const {
  auto const& k = state_.k;
  double const c = std::sqrt(k.modulus / k.rho0 * std::max(measures_.dilation, 0.0));
  return options_.cfl * measures_.spacing / c;
}

double* TaylorBody::record(Index i) const {
  return state_.real + static_cast<std::ptrdiff_t>(slot_of_[at(i)]) * record_stride(D());
}

std::array<double, 3> TaylorBody::x(Index i) const {
  std::array<double, 3> r{};
  std::copy_n(record(i), D(), r.begin());
  return r;
}

std::array<double, 3> TaylorBody::v(Index i) const {
  std::array<double, 3> r{};
  std::copy_n(record(i) + D() + 1, D(), r.begin());
  return r;
}

std::array<double, 3> TaylorBody::displacement(Index i) const {
  std::array<double, 3> u = x(i);
  for (std::size_t c = 0; c < 3; ++c)
    u[c] = state_.k.moving ? u[c] - X_[at(i)][c] : displacement_.at(slot_of_[at(i)], static_cast<int>(c));
  return u;
}

std::array<double, 6> TaylorBody::record_stress(Index i) const {
  std::array<double, 6> r{};
  std::copy_n(record(i) + stress_place(), D() * (D() + 1) / 2, r.begin());
  return r;
}

SymMat<3> TaylorBody::stress(Index i) const {
  auto const own = record_stress(i);
  SymMat<3> s{};
  if (D() == 1) s(0, 0) = own[0];
  if (D() == 2) {
    s(0, 0) = own[0];
    s(1, 1) = own[1];
    s(0, 1) = own[2];
    s(2, 2) = across_.at(slot_of_[at(i)]);
  }
  if (D() == 3) std::copy(own.begin(), own.end(), s.c);
  return s;
}

double TaylorBody::volume_ratio(Index i) const { return record(i)[D()] / kernel_volume_[at(i)]; }

int TaylorBody::neighbours(Index i) const {
  if (!options_.adjoint) return to_real_.count(i);
  std::size_t const slot = at(slot_of_[at(i)]);
  return around_begin_[slot + 1] - around_begin_[slot];
}

CellEnergy TaylorBody::cell_energy() const {
  if (!options_.adjoint) return {};
  BodyState state = state_;
  return backend_->cell_energy(state);
}

double TaylorBody::staggering_energy() const { return last_step_ * last_step_ / 8 * cell_energy().square; }

Points TaylorBody::positions() const {
  Points r(X_.size());
  for (Index i = 0; i < particles(); ++i) r[at(i)] = x(i);
  return r;
}

std::size_t TaylorBody::bytes() const {
  return real_.bytes() + virtual_.bytes() + across_.bytes() + drift_.bytes() + displacement_.bytes() +
         acceleration_.bytes() + slot_mass_.bytes() + to_virtual_.bytes() + to_real_.bytes() +
         sizeof(double) * (cell_across_.size() + cell_force_.size() + cell_gradient_.size() + cell_hourglass_.size()) +
         sizeof(Index) * (around_begin_.size() + around_.size()) +
         sizeof(double) * (reference_square_.size() + reference_quality_.size() + pattern_.size() + partial_.size()) +
         sizeof(Index) * (slot_of_.size() + local_of_.size()) + sizeof(std::int64_t) * id_in_slot_.size() +
         sizeof(Index) * (corner_.size() + box_corner_.size() + box_of_.size() + cells_.corner.size());
}

}  // namespace piola::taylor_sph
