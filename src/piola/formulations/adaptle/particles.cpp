// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/adaptle/contact.hpp"
#include "piola/formulations/adaptle/records.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

namespace piola::adaptle {
namespace {

template <int D>
int spatial_stride(Settings const& s) {
  return s.corrected ? SpatialRecord<D, true>::stride(s.artificial_stress)
                     : SpatialRecord<D, false>::stride(s.artificial_stress);
}

/// Acceleration of particle k of a load [m/s2].
Direction load_on(Load const& load, std::size_t k, Direction const& X, double time) {
  return acceleration_by(load.value, load.pressure ? std::optional(load.normal_of(k)) : std::nullopt, load.factor[k], X,
                         time);
}

/// Sets the constants of a body from its law. kernel_volume: of spatial sums, in volumes of a particle.
template <class Law>
void take_constants(Law const& law, BodyOptions const& o, double kernel_volume, BodyConstants& b) {
  b.releases = o.releases && !law.brittle;  // broken material still carries shear under pressure
  b.rho0 = law.rho0;
  b.least_rho = law.rho0 / kernel_volume;
  b.bulk_modulus = law.kappa;
  b.shear_modulus = law.mu;
  b.yield_stress = law.yield_stress({{}, 0, law.initial_temperature(), 0, 0}, 0);
  b.burst_pressure = law.rho0 * law.front_speed() * law.front_speed() / 4;  // Chapman-Jouguet with gamma = 3
  b.c = o.bulk_speed ? law.bulk_sound_speed() : law.p_wave_speed();
  b.shear_share = std::max(0.01, law.s_wave_speed() / law.p_wave_speed());
  b.young = 9 * law.kappa * law.mu / (3 * law.kappa + law.mu);
  b.poisson = (3 * law.kappa - 2 * law.mu) / (2 * (3 * law.kappa + law.mu));
}

/// Adds the wall time of its life to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  Stopwatch(Stopwatch const&) = delete;
  Stopwatch& operator=(Stopwatch const&) = delete;
  ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::vector<double> EnergyTotals::state() const {
  return std::apply([](auto const&... value) { return std::vector<double>{value...}; }, listed(*this));
}

void EnergyTotals::restore(std::span<double const> values) {
  PIOLA_EXPECTS(values.size() == state().size());
  std::size_t k = 0;
  std::apply([&](auto&... value) { ((value = values[k++]), ...); }, listed(*this));
}

Particles::Particles(Assembly const& assembly, Options const& options, Backend const& backend)
    : options_(options),
      backend_(&backend),
      supports_(assembly.supports),
      loads_(assembly.loads),
      actions_(assembly.supports, assembly.loads, assembly.rigid_shapes),
      shapes_(assembly.rigid_shapes),
      balance_(assembly.repartition),
      set_(assembly.particles) {
  PIOLA_EXPECTS(options.bodies.size() == assembly.particles.bodies.size());
  system_.dimension = assembly.particles.dimension;
  system_.settings = options_.settings;
  system_.shared = comm::is_parallel();
  set_bodies(assembly);
  set_contact(assembly);
  allocate(assembly);
  set_descriptions();
  std::vector<Partition> equal;
  for (BodyConstants const& b : body_) equal.emplace_back(Range{b.first, b.last});
  take(std::move(equal));
  set_particles(assembly);
  set_boundaries();
  double dt = std::numeric_limits<double>::infinity();
  for (auto const& b : body_)
    with_solid(b.material, [&](auto const& law) {
      dt = std::min(dt, options_.settings.cfl * std::min(b.h, b.reference_h) / law.p_wave_speed());
    });
  energy_totals_.next_dt = dt;
  start();
}

/// Computes lists, contact energy, rates and the stable step of the initial state. Without rates the first prediction
/// would ignore bodies that collide, or one that is torn apart, in the first step.
void Particles::start() {
  prepare_supports(0);
  prepare_loads(0);
  prepare_rigid(0, 0);
  make_lists(exchanges_ ? exchanges_->before_lists(system_) : SpatialLists::RemoteParticles{});
  energy_totals_.contact_energy = contact_energy(system_);
  // A pressure that acts for one step is an impulse of the step that waves allow.
  for (BodyOptions const& o : options_.bodies)
    if (o.initial_pressure && !o.initial_pressure_lasts) return;
  backend_->predict(system_, 0);
  if (exchanges_) exchanges_->after_prediction(system_);
  sweep(0);
  energy_totals_.next_dt = std::min(energy_totals_.next_dt, backend_->finish(system_, 0).dt);
  seconds_ = {};
  balance_.busy() = 0;
}

void Particles::set_bodies(Assembly const& assembly) {
  auto const& set = assembly.particles;
  for (std::size_t k = 0; k < set.bodies.size(); ++k) {
    Body const& from = set.bodies[k];
    BodyOptions const& o = options_.bodies[k];
    BodyConstants b;
    b.material = assembly.materials[k];
    b.first = static_cast<Index>(from.first);
    b.last = static_cast<Index>(from.last);
    for (std::size_t c = 0; c < static_cast<std::size_t>(set.dimension); ++c)
      b.spacing = c == 0 ? from.spacing[c] : std::max(b.spacing, from.spacing[c]);
    b.h = o.smoothing_length * b.spacing;
    double const reach = set.dimension == 2 ? std::numbers::pi * std::pow(2 * o.smoothing_length, 2)
                                            : 4 * std::numbers::pi / 3 * std::pow(2 * o.smoothing_length, 3);
    b.reference_h = o.material_smoothing_length * b.spacing;
    b.alpha = o.alpha;
    b.beta = o.beta;
    b.artificial_stress = o.artificial_stress;
    b.hourglass = o.hourglass;
    b.hourglass_stiffness = o.hourglass_stiffness;
    b.convert_strain = o.convert_strain;
    b.convert_damage = o.convert_damage;
    b.jacobian_min = o.jacobian_min;
    b.jacobian_max = o.jacobian_max;
    b.tether = o.tether;
    b.adaptive = o.description == Description::adaptive || o.description == Description::patch;
    if (o.description == Description::patch) b.tether = b.adaptive = false;
    b.deletes = o.deletes;
    with_solid(b.material, [&](auto const& law) { take_constants(law, o, reach, b); });
    body_.push_back(b);
  }
  own_.resize(body_.size());
}

/// Sets the evolved fields of the local particles.
void Particles::set_particles(Assembly const& assembly) {
  for (std::size_t k = 0; k < body_.size(); ++k)
    with_solid(body_[k].material, [&](auto const& law) {
      for (Index slot = own_[k].first; slot < own_[k].last; ++slot) {
        std::size_t const i = at(slot);
        for (int c = 0; c < 3; ++c) {
          double const moved = assembly.initial_displacement.empty() ? 0 : assembly.initial_displacement[i][at(c)];
          fields_.x.at(slot, c) = position_[3 * at(slot) + at(c)] = set_.X[i][at(c)] + moved;
          fields_.v.at(slot, c) = assembly.initial_velocity.empty() ? 0 : assembly.initial_velocity[i][at(c)];
        }
        fields_.rho.at(slot) = body_[k].rho0;
        fields_.viscosity.at(slot) = 1;
        if (fields_.holds(fields_.thickness)) fields_.thickness.at(slot) = 1;
        fields_.temperature.at(slot) = law.initial_temperature();
        fields_.energy.at(slot) = fields_.mass.at(slot) * law.initial_energy();
      }
    });
}

void Particles::set_contact(Assembly const& assembly) {
  std::vector<std::array<double, 3>> mean(body_.size());
  for (std::size_t b = 0; b < body_.size() && !assembly.initial_velocity.empty(); ++b)
    for (std::size_t c = 0; c < 3; ++c) {
      Index const first = body_[b].first, n = body_[b].last - first;
      auto const& velocity = assembly.initial_velocity;
      mean[b][c] = exec_host::parallel_sum(n, [&](Index k) { return velocity[at(first + k)][c]; }) / n;
    }
  contact_pairs_ = contact_pairs(system_.dimension, assembly.contact, body_, mean);
  exclude_tied_pairs(assembly.ties, body_.size(), contact_pairs_);
  if (mark_surface_contact(assembly, contact_pairs_)) lost_ = LostSurfaces(set_);
  system_.contact.lost = lost_.by_slot().data();
  system_.contact.pair = contact_pairs_.data();
  system_.contact.as_published = assembly.contact.stiffness;
  system_.contact.scale = assembly.contact.scale;
  using Law = ContactRule::Law;
  system_.contact.law = assembly.contact.law == Law::kernel         ? 1
                        : assembly.contact.law == Law::linear       ? 2
                        : assembly.contact.law == Law::as_published ? 3
                                                                    : 0;
}

/// Arrays have the length of the whole run; pages are allocated on first write. Every rank writes phi and active of all
/// particles; other fields only of local particles and ghosts.
void Particles::allocate(Assembly const& assembly) {
  auto const n = static_cast<std::size_t>(assembly.particles.size());
  System& s = system_;
  Fields::FieldRequirements needs;
  needs.lagrangian = std::any_of(options_.bodies.begin(), options_.bodies.end(),
                                 [](BodyOptions const& o) { return o.description != Description::eulerian; });
  needs.published = options_.settings.published;
  needs.plane_stress = options_.settings.plane_stress;
  needs.touching = body_.size() > 1 || !shapes_.empty();
  fields_.allocate(static_cast<Index>(n), needs);
  for (std::size_t b = 0; b < body_.size(); ++b)
    body_of_.insert(body_of_.end(), at(body_[b].last - body_[b].first), static_cast<int>(b));
  conversion_requests_ = LazyZeroArray<std::int8_t>(n);
  if (options_.settings.corrected) correction_ = LazyZeroArray<Correction>(n);
  position_ = LazyZeroArray<double>(3 * n);
  s.bodies = static_cast<int>(body_.size());
  s.particles = static_cast<Index>(n);
  s.body = body_.data();
  s.part = own_.data();
  s.body_of = body_of_.data();
  s.field = fields_.refs();
  s.correction = correction_.data();
  s.conversion_request = conversion_requests_.data();
  s.position = position_.data();
  for (Index i = 0; i < s.particles; ++i) fields_.active.at(i) = 1;
  s.spatial.stride = s.dimension == 2 ? spatial_stride<2>(s.settings) : spatial_stride<3>(s.settings);
  partial_.resize(16 * (n / 64 + 2));
  s.partial = partial_.data();
  s.failure = &failure_;
}

/// Sets the initial kernel types, and the blending at the border of a patch.
void Particles::set_descriptions() {
  for (std::size_t k = 0; k < body_.size(); ++k) {
    BodyOptions const& o = options_.bodies[k];
    std::vector<Index> outside;
    for (Index i = body_[k].first; i < body_[k].last; ++i) {
      bool const inside = o.description == Description::patch && (*o.eulerian_where)(X(i)) != 0;
      fields_.phi.at(i) = o.description == Description::eulerian || inside ? 1 : 0;
      if (o.description == Description::patch && !inside) outside.push_back(i);
    }
    double const width = o.blend * body_[k].spacing;
    if (o.description != Description::patch || width == 0 ||
        options_.settings.interface_form == Interface::as_published)
      continue;
    for (Index i = body_[k].first; i < body_[k].last; ++i) {
      if (fields_.phi.at(i) == 0) continue;
      double nearest = width;
      for (Index const j : outside) {
        auto const &p = X(i), &q = X(j);
        nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
      double const z = nearest / width;
      fields_.phi.at(i) = z * z * (3 - 2 * z);
    }
  }
  lagrangian_ = any_of([&](Index i) { return fields_.phi.at(i) < 1; });
}

/// Sets the reference data of the local particles and, if they have any, of their reference neighbours.
void Particles::set_reference() {
  System& s = system_;
  auto const set_point = [&](Index slot) {
    std::size_t const i = at(slot);
    for (int c = 0; c < 3; ++c) fields_.X.at(slot, c) = set_.X[i][at(c)];
    fields_.volume.at(slot) = set_.volume[i];
  };
  for (std::size_t b = 0; b < body_.size(); ++b)
    for (Index i = own_[b].first; i < own_[b].last; ++i) {
      set_point(i);
      fields_.mass.at(i) = body_[b].rho0 * set_.volume[at(i)];
      bool const deforms = fields_.holds(fields_.F) && fields_.active.at(i) > 0;  // deleted particles keep theirs
      for (int c = 0; c < 9 && deforms; ++c) fields_.F.at(i, c) = c % 4 == 0 ? 1 : 0;
    }
  set_point(0);            // where cells of space begin
  if (s.contact.law == 3)  // data of both sides for the potential of the published law
    for (Index i = 0; i < s.particles; ++i) set_point(i);
  if (!lagrangian_ && !material_.built()) return;
  material_.build(set_, body_, own_, fields_, options_.settings, backend_->lanes);
  if (!material_.needs_records()) return;
  using Flat = MaterialRecord<2>;
  using Deep = MaterialRecord<3>;
  bool const flat = s.dimension == 2, published = options_.settings.published;
  int const stride = flat ? Flat::stride(published) : Deep::stride(published);
  material_records_ = Memory((at(s.particles) + 1) * at(stride));
  double* filler = material_records_.data() + std::ptrdiff_t{s.particles} * stride;
  filler[flat ? Flat::viscosity : Deep::viscosity] = 1;
  if (published) filler[flat ? Flat::inverse_J : Deep::inverse_J] = 1;
  s.material.record = material_records_.data();
}

void Particles::choose_material() {
  eulerian_.resize(at(system_.particles));
  for (Index i = 0; i < system_.particles; ++i) eulerian_[at(i)] = fields_.phi.at(i) > 0 ? 1 : 0;
  system_.eulerian = eulerian_.data();
  system_.eulerians = static_cast<Index>(std::count(eulerian_.begin(), eulerian_.end(), std::uint8_t{1}));
  lagrangian_ = any_of([&](Index i) { return fields_.phi.at(i) < 1; });
  if (!material_.built()) return;
  material_.choose(fields_, options_.settings.interface_form == Interface::as_published);
  material_.put_into(system_.material);
  system_.material.used = lagrangian_;
}

void Particles::set_factors() {
  factors_.build(body_, options_.bodies, own_, set_, energy_totals_.time);
  system_.own = factors_.view();
}

void Particles::set_boundaries() {
  std::size_t const n = at(system_.particles);
  if (!supports_.empty()) {
    held_ = LazyZeroArray<std::int8_t>(3 * n);
    held_velocity_ = LazyZeroArray<double>(3 * n);
    holder_ = LazyZeroArray<std::size_t>(3 * n);
    reaction_ = LazyZeroArray<double>(3 * n);
    system_.reaction = reaction_.data();
    system_.held = held_.data();
    system_.held_velocity = held_velocity_.data();
  }
  if (!loads_.empty()) {
    load_ = LazyZeroArray<double>(3 * n);
    system_.load = load_.data();
  }
  if (shapes_.empty()) return;
  rigid_power_ = LazyZeroArray<double>(n + 16);  // loops read whole lanes
  rigid_.resize(shapes_.size());
  system_.rigid = rigid_.data();
  system_.rigids = static_cast<int>(rigid_.size());
  system_.rigid_power = rigid_power_.data();
  Index blocks = 0;
  for (BodyConstants const& b : body_) blocks += exec::block_count({b.first, b.last});
  rigid_action_.resize(at(blocks) * 6 * shapes_.size());
  system_.rigid_action = rigid_action_.data();
  for (RigidShape const& shape : shapes_)
    rigid_centre_.insert(rigid_centre_.end(), shape.centre.begin(), shape.centre.end());
}

void Particles::prepare_supports(double time) {
  if (supports_.empty()) return;
  for (Range const& own : own_)
    std::fill(held_.begin() + std::ptrdiff_t{3} * own.first, held_.begin() + std::ptrdiff_t{3} * own.last, 0);
  for (std::size_t number = 0; number < supports_.size(); ++number) {
    Support const& support = supports_[number];
    if (has_ended(support.until, time)) continue;
    for (auto const id : support.particles)
      for (std::size_t c = 0; c < static_cast<std::size_t>(system_.dimension); ++c) {
        if (!support.fix[c] || !is_local(static_cast<Index>(id))) continue;
        std::size_t const k = 3 * at(id) + c;
        held_[k] = 1;
        holder_[k] = number;
        held_velocity_[k] = support.velocity ? (*support.velocity)[c](set_.X[static_cast<std::size_t>(id)], time) : 0;
      }
  }
}

void Particles::prepare_loads(double time) {
  if (loads_.empty()) return;
  for (Range const& own : own_)
    std::fill(load_.begin() + std::ptrdiff_t{3} * own.first, load_.begin() + std::ptrdiff_t{3} * own.last, 0);
  for (Load const& load : loads_) {
    if (has_ended(load.until, time)) continue;
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
      auto const slot = static_cast<Index>(load.particles[k]);
      if (!is_local(slot)) continue;
      auto const a = load_on(load, k, X(slot), time);
      for (std::size_t c = 0; c < static_cast<std::size_t>(system_.dimension); ++c) load_[3 * at(slot) + c] += a[c];
    }
  }
}

/// Rigid shapes where they are at half time; `time` is the start of the step.
void Particles::prepare_rigid(double time, double dt) {
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    RigidShape const& from = shapes_[k];
    RigidPoseAtHalfTime& to = rigid_[k];
    to.kind = static_cast<int>(from.kind);
    to.radius = from.radius;
    for (std::size_t c = 0; c < 3; ++c) {
      to.velocity[c] = from.velocity[c]({}, time + 0.5 * dt);
      to.centre[c] = rigid_centre_[3 * k + c] + 0.5 * dt * to.velocity[c];
      to.axis[c] = from.axis[c];
      to.half[c] = from.half_lengths[c];
      rigid_centre_[3 * k + c] += dt * to.velocity[c];
    }
  }
}

double Particles::stable_time_step() const { return energy_totals_.next_dt; }

double Particles::next_end_time() const {
  double next = std::numeric_limits<double>::infinity();
  for (Support const& s : supports_)
    if (!has_ended(s.until, energy_totals_.time)) next = std::min(next, s.until);
  for (Load const& l : loads_)
    if (!has_ended(l.until, energy_totals_.time)) next = std::min(next, l.until);
  return next;
}

void Particles::step(double time, double dt) {
  PIOLA_EXPECTS(dt > 0);
  if (exchanges_ && balance_.due()) rebalance();
  prepare_supports(time + dt);
  prepare_loads(time + 0.5 * dt);
  prepare_rigid(time, dt);
  factors_.go_to(time + 0.5 * dt);
  energy_totals_.time = time + dt;
  evaluate(dt);
  sum_actions(time, dt);
  factors_.end_of_step();
  if (exchanges_ && (failure_.index != FailureSlot::none || neighbour_overflow_)) broadcast_failure();
}

/// Forces act at half time and at the places of then, for the whole step: impulses of the supports, then of the loads,
/// on the slots of this rank.
std::vector<ImpulseSum> Particles::impulses(double time, double dt) const {
  std::vector<ImpulseSum> sums(supports_.size() + loads_.size());
  auto const place = [&](std::size_t slot) {
    return std::array{position_[3 * slot], position_[3 * slot + 1], position_[3 * slot + 2]};
  };
  for (std::size_t s = 0; s < supports_.size(); ++s)
    for (auto const particle : supports_[s].particles) {
      std::size_t const slot = at(particle);
      if (!is_local(static_cast<Index>(particle))) continue;
      std::array<double, 3> impulse{};
      for (std::size_t c = 0; c < 3; ++c)
        if (holder_[3 * slot + c] == s) impulse[c] = dt * reaction_[3 * slot + c];
      sums[s].add(place(slot), impulse);
    }
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    if (loads_[l].name.empty() || has_ended(loads_[l].until, time + 0.5 * dt)) continue;
    for (std::size_t k = 0; k < loads_[l].particles.size(); ++k) {
      auto const slot = static_cast<Index>(loads_[l].particles[k]);
      if (!is_local(slot)) continue;
      std::array<double, 3> impulse{};
      for (std::size_t c = 0; c < static_cast<std::size_t>(system_.dimension); ++c)
        impulse[c] = dt * fields_.mass.at(slot) * load_on(loads_[l], k, X(slot), time + 0.5 * dt)[c];
      sums[supports_.size() + l].add(place(at(slot)), impulse);
    }
  }
  return sums;
}

void Particles::sum_actions(double time, double dt) {
  actions_.begin(dt);
  action_sums_.emplace(ResultantSums{dt, impulses(time, dt), std::vector<exec::ReproducibleSums<6>>(shapes_.size())});
  for (std::size_t block = 0; block < rigid_action_.size(); block += 6)
    action_sums_->rigids[block / 6 % shapes_.size()].add(&rigid_action_[block]);
  for (std::size_t k = 0; k < shapes_.size(); ++k) std::copy_n(rigid_[k].centre, 3, actions_.rigid_about[k].begin());
  if (exchanges_) return;
  actions_ = actions();
  action_sums_.reset();
}

/// Computes sums over neighbours and their inputs.
void Particles::sweep(double dt) {
  Stopwatch const watch(seconds_.sweeps);
  WorkTimer const work(balance_.busy());
  System& s = system_;
  if (lagrangian_) backend_->deform(s);
  backend_->half_state(s, dt);
  if (exchanges_) exchanges_->after_half_state(s);
  if (s.settings.corrected) {
    if (s.spatial.targets > 0) backend_->correct(s);
    if (exchanges_) exchanges_->after_correction(s);
  }
  backend_->sweep(s);
}

/// Builds the spatial neighbour lists of this step.
void Particles::make_lists(SpatialLists::RemoteParticles const& others) {
  spatial_.build(system_, others, *backend_, balance_.busy());
  spatial_.put_into(system_);
  if (exchanges_) exchanges_->after_lists(system_);
}

/// Drift, sums of half time, kick, drift.
void Particles::evaluate(double dt) {
  System& s = system_;
  {
    Stopwatch const watch(seconds_.points);
    WorkTimer const work(balance_.busy());
    backend_->predict(s, dt);
  }
  SpatialLists::RemoteParticles const others =
      exchanges_ ? exchanges_->before_lists(s) : SpatialLists::RemoteParticles{};
  if (failure_.index != FailureSlot::none) return;
  if (exchanges_) exchanges_->after_prediction(s);
  {
    Stopwatch const watch(seconds_.lists);
    make_lists(others);
  }
  sweep(dt);
  StepSums m;
  {
    Stopwatch const watch(seconds_.points);
    WorkTimer const work(balance_.busy());
    m = backend_->finish(s, dt);
  }
  energy_totals_.contact_energy += dt * m.contact_power;
  energy_totals_.hourglass_energy += dt * m.hourglass_power;
  energy_totals_.viscous_loss += dt * m.viscous_power;
  energy_totals_.artificial_work += dt * m.artificial_power;
  energy_totals_.external_work += dt * (m.held_power + m.load_power + m.rigid_power);
  energy_totals_.overlap = std::max(energy_totals_.overlap, m.overlap);
  energy_totals_.next_dt = m.dt;
  neighbour_overflow_ = m.neighbour_overflow;
  Stopwatch const watch(seconds_.conversion);
  bool const by_formula = requests_by_formula();
  if (by_formula || m.conversion_requests > 0) convert(dt);
}

void Particles::damp(double factor) {
  PIOLA_EXPECTS(std::abs(factor) <= 1);
  double const before = kinetic_energy();
  for (Range const& own : own_)
    for (Index i = own.first; i < own.last; ++i)
      for (int c = 0; c < 3; ++c)
        if (held_.empty() || held_[3 * at(i) + at(c)] == 0) fields_.v.at(i, c) *= factor;
  energy_totals_.damping_loss += before - kinetic_energy();
}

double Particles::kinetic_energy() const {
  exec::ReproducibleSums<1> sum;
  for (Range const& own : own_)
    sum.add(exec_host::parallel_sums<1>(own.last - own.first, [&](Index k, double* of_one) {
      Index const i = own.first + k;
      double const x = fields_.v.at(i, 0), y = fields_.v.at(i, 1), z = fields_.v.at(i, 2);
      *of_one = 0.5 * fields_.mass.at(i) * (x * x + y * y + z * z);
    }));
  if (exchanges_) comm::allreduce_sum(sum);
  return sum.value();
}

std::size_t Particles::bytes() const {
  return fields_.bytes() + sizeof(int) * body_of_.size() + sizeof(double) * position_.size() +
         correction_.size() * sizeof(Correction) + material_records_.bytes() + material_.bytes() + spatial_.bytes();
}

/// Whether some particle is.
bool Particles::deleted() const {
  return any_of([&](Index i) { return !(fields_.active.at(i) > 0); });
}

void Particles::resumed() {
  for (Index i = 0; i < system_.particles && lost_.used(); ++i)
    if (fields_.phi.at(i) == 1) lose_surface(i);
  set_factors();
  choose_material();
}

}  // namespace piola::adaptle
