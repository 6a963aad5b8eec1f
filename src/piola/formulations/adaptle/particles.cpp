// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/adaptle/contact.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace piola::adaptle {
namespace {

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

Particles::Particles(Assembly const& assembly, Options const& options, Backend const& backend)
    : options_(options),
      backend_(&backend),
      data_(assembly, options_),
      boundary_(assembly, data_.system()),
      conversion_(data_, options_.bodies, material_, energy_totals_),
      distribution_(assembly.repartition) {
  std::vector<Partition> equal;
  for (BodyConstants const& b : data_.bodies()) equal.emplace_back(Range{b.first, b.last});
  take(std::move(equal));
  data_.set_initial_state(assembly);
  double dt = std::numeric_limits<double>::infinity();
  for (BodyConstants const& b : data_.bodies())
    with_solid(b.material, [&](auto const& law) {
      dt = std::min(dt, options_.settings.cfl * std::min(b.h, b.reference_h) / law.p_wave_speed());
    });
  energy_totals_.next_dt = dt;
  start();
}

/// Computes lists, contact energy, rates and the stable step of the initial state. Without rates the first prediction
/// would ignore bodies that collide, or one that is torn apart, in the first step.
void Particles::start() {
  System& s = data_.system();
  StepHaloExchanges* const exchanges = distribution_.exchanges();
  boundary_.begin_step(0, 0);
  make_lists(exchanges != nullptr ? exchanges->before_lists(s) : SpatialLists::RemoteParticles{});
  energy_totals_.contact_energy = contact_energy(s);
  // A pressure that acts for one step is an impulse of the step that waves allow.
  for (BodyOptions const& o : options_.bodies)
    if (o.initial_pressure && !o.initial_pressure_lasts) return;
  backend_->predict(s, 0);
  if (exchanges != nullptr) exchanges->after_prediction(s);
  sweep(0);
  StepSums const m = backend_->finish(s, 0);
  if (m.dt <= energy_totals_.next_dt) energy_totals_.limiter = m.limiter;
  energy_totals_.next_dt = std::min(energy_totals_.next_dt, m.dt);
  seconds_ = {};
  distribution_.busy() = 0;
}

/// Builds the data of the local particles and, if they have any, of their reference neighbours.
void Particles::take(std::vector<Partition> cuts) {
  System& s = data_.system();
  boundary_.rigid_shapes().clear_actions();
  distribution_.assign(std::move(cuts), s);
  data_.set_reference();
  if (data_.has_lagrangian() || material_.built())
    material_.build(data_.set(), data_.bodies(), distribution_.partition().own(), data_.fields(), s.settings,
                    backend_->lanes);
  set_factors();
  choose_material();
  distribution_.connect(data_, material_);
}

void Particles::set_factors() {
  factors_.build(data_.bodies(), options_.bodies, distribution_.partition().own(), data_.set(), energy_totals_.time);
  data_.system().own = factors_.view();
}

void Particles::choose_material() {
  System& s = data_.system();
  data_.update_kernel_types();
  if (!material_.built()) return;
  material_.choose(data_.fields());
  material_.put_into(s.material);
  s.material.used = data_.has_lagrangian();
}

void Particles::step(double time, double dt) {
  PIOLA_EXPECTS(dt > 0);
  if (auto cuts = distribution_.plan(data_)) {
    // The fields of a checkpoint suffice for the new owner of a particle, as in a resumed run.
    std::vector<Partition> const before = distribution_.partition().cuts();
    take(std::move(*cuts));
    distribution_.migrate(data_, before);
  }
  boundary_.begin_step(time, dt);
  factors_.go_to(time + 0.5 * dt);
  energy_totals_.time = time + dt;
  evaluate(dt);
  boundary_.end_step(time, dt);
  factors_.end_of_step();
  bool const failed = failure().index != FailureSlot::none || neighbour_overflow_;
  if (distribution_.exchanges() != nullptr && failed) broadcast_failure();
}

/// Drift, sums of half time, kick, drift.
void Particles::evaluate(double dt) {
  System& s = data_.system();
  StepHaloExchanges* const exchanges = distribution_.exchanges();
  {
    Stopwatch const watch(seconds_.points);
    WorkTimer const work(distribution_.busy());
    backend_->predict(s, dt);
  }
  SpatialLists::RemoteParticles const others =
      exchanges != nullptr ? exchanges->before_lists(s) : SpatialLists::RemoteParticles{};
  if (failure().index != FailureSlot::none) return;
  if (exchanges != nullptr) exchanges->after_prediction(s);
  {
    Stopwatch const watch(seconds_.lists);
    make_lists(others);
  }
  sweep(dt);
  StepSums m;
  {
    Stopwatch const watch(seconds_.points);
    WorkTimer const work(distribution_.busy());
    m = backend_->finish(s, dt);
  }
  energy_totals_.add(m, dt);
  neighbour_overflow_ = m.neighbour_overflow;
  Stopwatch const watch(seconds_.conversion);
  bool const by_formula = conversion_.request_by_formula();
  if (!by_formula && m.conversion_requests == 0) return;
  conversion_.convert(dt);
  choose_material();
}

/// Builds the spatial neighbour lists of this step.
void Particles::make_lists(SpatialLists::RemoteParticles const& others) {
  System& s = data_.system();
  spatial_.build(s, others, *backend_, distribution_.busy());
  spatial_.put_into(s);
  if (StepHaloExchanges* const exchanges = distribution_.exchanges()) exchanges->after_lists(s);
}

/// Computes sums over neighbours and their inputs.
void Particles::sweep(double dt) {
  Stopwatch const watch(seconds_.sweeps);
  WorkTimer const work(distribution_.busy());
  System& s = data_.system();
  StepHaloExchanges* const exchanges = distribution_.exchanges();
  if (s.material.used) backend_->deform(s);
  backend_->half_state(s, dt);
  if (exchanges != nullptr) exchanges->after_half_state(s);
  if (s.settings.corrected) {
    if (s.spatial.targets > 0) backend_->correct(s);
    if (exchanges != nullptr) exchanges->after_correction(s);
  }
  backend_->sweep(s);
}

void Particles::damp(double factor) {
  PIOLA_EXPECTS(std::abs(factor) <= 1);
  double const before = kinetic_energy();
  for (Range const& own : system().local())
    for (Index i = own.first; i < own.last; ++i)
      for (int c = 0; c < 3; ++c)
        if (!boundary_.holds(i, c)) fields().v.at(i, c) *= factor;
  energy_totals_.damping_loss += before - kinetic_energy();
}

double Particles::kinetic_energy() const {
  Fields const& f = fields();
  exec::ReproducibleSums<1> sum;
  for (Range const& own : system().local())
    sum.add(exec_host::parallel_sums<1>(own.last - own.first, [&](Index k, double* of_one) {
      Index const i = own.first + k;
      double const x = f.v.at(i, 0), y = f.v.at(i, 1), z = f.v.at(i, 2);
      *of_one = 0.5 * f.mass.at(i) * (x * x + y * y + z * z);
    }));
  if (system().shared) comm::allreduce_sum(sum);
  return sum.value();
}

/// Replicates the values of the failed particle for its error message.
void Particles::broadcast_failure() {
  Index const slot = failure().index != FailureSlot::none ? failure().index : 0;
  Range const own = system().part[system().body_of[slot]];
  Fields& f = fields();
  for (Field* field : {&f.x, &f.v, &f.rho, &f.damage, &f.plastic_strain})
    allgather_selected_slots(field->ref(), own, std::array{slot}, field->components());
}

void Particles::read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                            std::span<std::array<double, 3>> v) const {
  PIOLA_EXPECTS(x.size() == ids.size() && v.size() == ids.size());
  std::vector<double> motion(6 * ids.size(), 0);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    auto const slot = static_cast<Index>(ids[k]);
    if (!is_local(slot)) continue;
    std::ranges::copy(point_at(fields().x.ref(), slot, 3), &motion[6 * k]);
    std::ranges::copy(point_at(fields().v.ref(), slot, 3), &motion[6 * k + 3]);
  }
  if (system().shared) comm::allreduce_or(motion);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    std::copy_n(&motion[6 * k], 3, x[k].begin());
    std::copy_n(&motion[6 * k + 3], 3, v[k].begin());
  }
}

void Particles::resumed() {
  conversion_.resumed();
  set_factors();
  choose_material();
}

}  // namespace piola::adaptle
