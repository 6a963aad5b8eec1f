// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/body.hpp"
#include "piola/base/errors.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola::taylor_sph {
namespace {

/// Particles start at the initial displacement, free of stress and with the given density: masses follow the cells.
void scale_masses(Particles const& particles, Cells const& cells, std::vector<double>& mass) {
  std::vector<double> before(mass.size(), 0), after(mass.size(), 0);
  for (Index cell = 0; cell < cells.count(); ++cell)
    for (Index const corner : cells.of(cell)) {
      before[at(corner)] += volume_of(cells, cell, particles.X());
      after[at(corner)] += volume_of(cells, cell, particles.start());
    }
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] *= after[i] / before[i];
}

/// With the adjoint exchange masses are parts of the cells at the initial positions, m_i = rho0 sum V_J / n.
std::vector<double> masses_of_cells(Particles const& particles, Cells const& cells, double rho0) {
  std::vector<double> mass(particles.X().size(), 0);
  for (Index cell = 0; cell < cells.count(); ++cell)
    for (Index const corner : cells.of(cell))
      mass[at(corner)] += rho0 * volume_of(cells, cell, particles.start()) / cells.corners;
  auto const lone = std::find_if(mass.begin(), mass.end(), [](double m) { return !(m > 0); });
  if (lone == mass.end()) return mass;
  auto const& X = particles.X()[static_cast<std::size_t>(lone - mass.begin())];
  throw InputError(
      fmt::format("taylor_sph: the particle of body '{}' at ({:.4g}, {:.4g}, {:.4g}) m is the corner of no "
                  "cell - use smaller spacings, or a shape without lone particles",
                  particles.body().name, X[0], X[1], X[2]));
}

/// All but what the loads require.
Constants constants_of(MaterialParameters const& material, Options const& options, int dimension,
                       double kernel_volume) {
  Constants k{};
  with_law(material, [&](auto const& law) {
    if constexpr (RateForm<std::decay_t<decltype(law)>>) {
      k.rho0 = law.rho0;
      // The strain rate across for which the stress across does not change.
      double const free =
          dimension == 1 ? law.lambda / (2 * (law.lambda + law.mu)) : law.lambda / (law.lambda + 2 * law.mu);
      k.lateral = options.stress_free ? free : 0;
      k.modulus = law.lambda + 2 * law.mu - (3 - dimension) * law.lambda * k.lateral;
    }
  });
  k.kernel_volume = kernel_volume;
  k.hourglass = options.hourglass;
  k.form = options.form;
  k.kernel = options.kernel;
  k.moving = options.moving;
  k.adjoint = options.adjoint;
  k.stress_retention = options.adjoint ? options.stress_retention : 0;
  k.hourglass_stiffness = options.hourglass_stiffness;
  return k;
}

/// Masses of the particles [kg]: of their volumes; with the adjoint exchange, of their parts of the cells. Throws
/// InputError for a particle without a cell.
std::vector<double> masses_at_start(Assembly const& assembly, Particles const& particles, Cells const& cells,
                                    Constants const& constants) {
  if (constants.adjoint) return masses_of_cells(particles, cells, constants.rho0);
  std::vector<double> mass;
  for (std::int64_t id = particles.body().first; id < particles.body().last; ++id)
    mass.push_back(constants.rho0 * assembly.particles.volume[static_cast<std::size_t>(id)]);
  if (!assembly.initial_displacement.empty()) scale_masses(particles, cells, mass);
  return mass;
}

}  // namespace

TaylorBody::TaylorBody(Assembly const& assembly, std::size_t body, Options const& options, Backend const& backend)
    : options_(options),
      backend_(&backend),
      particles_(assembly, body, options),
      boundary_(assembly, body, particles_),
      mesh_(assembly, body, particles_, options),
      cell_fields_(particles_.dimension(), mesh_.cells().corners, options.adjoint),
      boxes_(assembly.particles, particles_.body(), options),
      lists_(assembly, body, options),
      actions_(assembly, particles_, boundary_, backend, state_) {
  state_.material = assembly.materials[body];
  state_.k = constants_of(state_.material, options, particles_.dimension(), particles_.kernel_volume(0));
  state_.k.loaded = boundary_.has_accelerations() || (options_.adjoint && boundary_.has_tractions());
  state_.failure = &failure_;
  particles_.set_masses(masses_at_start(assembly, particles_, mesh_.cells(), state_.k));
  arrange(mesh_.cells().corner, particles_.start());
  particles_.set_initial_state(assembly);
  build_lists(particles_.start());
  actions_.set_initial_momentum();
}

/// Sets memory, order of slots, and tables for cells that were made at these positions.
void TaylorBody::arrange(std::vector<Index> corners, Points const& x_of_cells) {
  mesh_.assign(std::move(corners), x_of_cells);
  particles_.arrange(boundary_.arrange(surface_of(mesh_.cells(), x_of_cells), x_of_cells));
  mesh_.make_tables(particles_, backend_->lanes);
  boxes_.make_tables(particles_, backend_->lanes);
  cell_fields_.allocate(aligned(mesh_.count()));
  particles_.set_views(state_);
  mesh_.set_views(state_);
  boxes_.set_views(state_);
  cell_fields_.set_views(state_);
  state_.items = boundary_.items();
  failure_.id = particles_.ids();
  Index const slots = std::max(state_.boundary.last, state_.virtuals.last);
  partial_.assign(MotionSums::size * (static_cast<std::size_t>(slots / 64) + 2), 0);
  state_.partial = partial_.data();
}

void TaylorBody::step(double time, double dt) {
  Impulse const before = actions_.momentum();
  if (options_.adjoint)
    step_by_adjoint_exchange(before, time, dt);
  else
    step_by_kernel_sums(before, time, dt);
  ++counts_.steps_since_triangulation;
  if (state_.k.moving) remesh_if_needed();
}

/// Everything from outside enters as a force, at half time, or as a prescribed speed: no stress is imposed.
void TaylorBody::step_by_adjoint_exchange(Impulse const& before, double time, double dt) {
  boundary_.move_surface([&](Index i) {
    auto x = particles_.x(i), v = particles_.v(i);
    for (std::size_t c = 0; c < 3; ++c) x[c] = x[c] + (state_.k.moving ? 0.5 * dt * v[c] : 0);
    return x;
  });
  boundary_.prescribe_velocities(time, dt);
  std::vector<ExternalActions::HalfImpulse> tractions;
  if (state_.k.loaded) {
    set_accelerations(time + 0.5 * dt);
    Field& acceleration = particles_.fields().acceleration;
    for (double const t : {time, time + dt})
      boundary_.each_traction(t, [&](std::size_t load, Index i, std::array<double, 3> const& f) {
        tractions.push_back({load, i, {0.5 * dt * f[0], 0.5 * dt * f[1], 0.5 * dt * f[2]}});
        for (int c = 0; c < particles_.dimension(); ++c)
          acceleration.at(particles_.slot(i), c) += 0.5 * f[static_cast<std::size_t>(c)] / particles_.mass(i);
      });
  }
  backend_->adjoint_step(state_, dt);
  actions_.totals.work += state_.work;
  actions_.add_loads(time, dt, &tractions);
  actions_.find_reactions(before, dt);
  last_step_ = dt;
}

void TaylorBody::step_by_kernel_sums(Impulse const& before, double time, double dt) {
  if (state_.k.loaded) set_accelerations(time + 0.5 * dt);
  prescribe_boundary(time, dt, 0.5 * dt);
  backend_->half_step(state_, dt);
  backend_->full_step(state_, dt);
  if (!boxes_.empty()) backend_->filter(state_);
  // Normals of the end of the step.
  if (state_.k.moving) prescribe_boundary(time, dt, 0);
  backend_->impose(state_);
  actions_.add_loads(time, dt, nullptr);
  if (!boundary_.has_supports() && state_.k.moving && options_.conserve) actions_.conserve_momentum();
  actions_.find_reactions(before, dt);
  actions_.add_boundary_work(dt);
}

/// `ahead`: time for which the surface has drifted when its normals are taken [s].
void TaylorBody::prescribe_boundary(double time, double dt, double ahead) {
  boundary_.move_surface([&](Index i) { return particles_.drifted(i, state_.k.moving ? ahead : 0); });
  boundary_.prescribe(time, dt);
}

/// Accelerations of loads, except those of tractions.
void TaylorBody::set_accelerations(double time) {
  Field& acceleration = particles_.fields().acceleration;
  for (Index i = 0; i < state_.boundary.last; ++i)
    for (int c = 0; c < particles_.dimension(); ++c) acceleration.at(i, c) = 0;
  boundary_.each_acceleration(time, [&](std::size_t, Index i, std::array<double, 3> const& a) {
    for (int c = 0; c < particles_.dimension(); ++c)
      acceleration.at(particles_.slot(i), c) += a[static_cast<std::size_t>(c)];
  });
}

void TaylorBody::damp(double factor) {
  double const before = kinetic_energy();
  std::vector<std::array<double, 3>> kept;
  for (std::size_t k = 0; k < boundary_.particles().size(); ++k) {
    BoundaryItem const& item = boundary_.item(k);
    auto const velocity = particles_.v(boundary_.particles()[k]);
    kept.push_back({});
    for (int h = 0; h < item.held; ++h) {
      double along = 0;
      for (std::size_t c = 0; c < 3; ++c) along += item.direction[h][c] * velocity[c];
      for (std::size_t c = 0; c < 3; ++c) kept.back()[c] += (1 - factor) * along * item.direction[h][c];
    }
  }
  particles_.scale_velocities(factor);
  for (std::size_t k = 0; k < kept.size(); ++k) particles_.add_velocity(boundary_.particles()[k], kept[k]);
  for (double& p : actions_.totals.momentum) p *= factor;  // of a body without supports
  actions_.update_power();
  damping_loss_ += before - kinetic_energy();
}

void TaylorBody::add_velocities(Index i, std::array<double, 3> const& change) {
  particles_.add_velocity(i, change);
  actions_.add_momentum(i, change);
}

double TaylorBody::stable_time_step() const {
  auto const& k = state_.k;
  double const c = std::sqrt(k.modulus / k.rho0 * std::max(measures_.dilation, 0.0));
  return options_.cfl * measures_.spacing / c;
}

int TaylorBody::neighbours(Index i) const {
  return options_.adjoint ? mesh_.cells_around(particles_.slot(i)) : lists_.count(i);
}

CellEnergy TaylorBody::cell_energy() const {
  if (!options_.adjoint) return {};
  BodyState state = state_;
  return backend_->cell_energy(state);
}

std::size_t TaylorBody::bytes() const {
  return particles_.bytes() + mesh_.bytes() + cell_fields_.bytes() + boxes_.bytes() + lists_.bytes() +
         sizeof(double) * partial_.size();
}

}  // namespace piola::taylor_sph
