// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/stability.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/nodal/particle_vectors.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace piola::nodal {
namespace {

constexpr int cycle = 4;          ///< right-hand sides of a cycle of Lanczos' method
constexpr int first_cycles = 12;  ///< at most, from a random start
constexpr int later_cycles = 3;   ///< at most, from the mode of the last measurement
/// Relative error of the squared frequency below which a measurement ends.
constexpr double accuracy = 0.05;
constexpr double shortest = 25, longest = 50;  ///< slow steps between measurements
constexpr double steady = 0.01;                ///< the interval grows where the frequency has changed by less
/// Or this change of a strain, but not within fewer steps unless it is much.
constexpr double change = 0.1, fewest = 4, much = 0.3;
/// Iterations come from below: this much is added.
constexpr double lift = 1.03;
/// Shares of the limit that are stable: in vibration and steady motion, and where strains change by 0.1 within few
/// steps, as in impacts: the frequency then rises between measurements.
constexpr double calm_share = 0.85, brisk_share = 0.75, violent_share = 0.45;
constexpr double brisk_pace = 20, violent_pace = 8;
/// At the start strains have not yet shown how fast they change.
constexpr double first_share = 0.15;
/// The energy error indicator costs two sums over particles and no right-hand side. It is evaluated in every step while
/// it limits the next one or strains change fast, else in every `glance`-th. Increases count at once. The largest value
/// is dropped after it was below a fraction of itself for `lasting` slow steps: steps that follow every change would
/// make the energy drift.
constexpr int glance = 4;
constexpr double lasting = 50, calmer = 0.7;
/// If a cell is crushed, halved steps are a better guide than the last measurement: each shortens the next ones, down
/// to a fraction, and successful steps lengthen them again.
constexpr double halved = 0.6, least_caution = 0.2, recovery = 1.004;

/// Reduction payload of the energy error indicator.
struct EnergyOscillationSums {
  exec::ReproducibleSums<3> of_particles;
  exec::ReproducibleSum held;
  void add(EnergyOscillationSums const& other) {
    of_particles.add(other.of_particles);
    held += other.held;
  }
};

/// Largest eigenvalue of a symmetric tridiagonal matrix, by bisection on the signs of the pivots of T - theta; and the
/// last component of its normalised eigenvector, with the vector.
double largest_eigenvalue(std::vector<double> const& diagonal, std::vector<double> const& beside,
                          std::vector<double>& vector) {
  std::size_t const n = diagonal.size();
  double low = diagonal[0], high = diagonal[0];
  for (std::size_t k = 0; k < n; ++k) {
    double const reach = (k > 0 ? std::abs(beside[k - 1]) : 0) + (k + 1 < n ? std::abs(beside[k]) : 0);
    low = std::max(low, diagonal[k]);
    high = std::max(high, diagonal[k] + reach);
  }
  auto const all_below = [&](double theta) {
    double pivot = 0;
    for (std::size_t k = 0; k < n; ++k) {
      pivot = diagonal[k] - theta - (k > 0 ? beside[k - 1] * beside[k - 1] / pivot : 0);
      if (!(pivot < 0)) return false;
    }
    return true;
  };
  constexpr int halvings = 60;
  for (int k = 0; k < halvings; ++k) {
    double const middle = 0.5 * (low + high);
    (all_below(middle) ? high : low) = middle;
  }
  // (T - theta) y = 0 from its first row on.
  vector.assign(n, 1);
  double size = 1;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    vector[k + 1] = beside[k] > 0
                        ? ((high - diagonal[k]) * vector[k] - (k > 0 ? beside[k - 1] * vector[k - 1] : 0)) / beside[k]
                        : 0;
    size += vector[k + 1] * vector[k + 1];
  }
  for (double& y : vector) y /= std::sqrt(size);
  return high;
}

}  // namespace

StabilityMonitor::StabilityMonitor(NodalBody& body, Backend const& backend)
    : body_(body), backend_(backend), interval_(shortest) {
  if (is_given()) return;
  mode_.resize(size_of_mode(body));
  measure(first_cycles, true);
  start_ = frequency_;
}

/// Accelerations by internal forces at the present positions.
StabilityMonitor::Vector StabilityMonitor::accelerations() {
  FailureSlot failure;
  BodyState trial = body_.state();
  trial.failure = &failure;
  backend_.accelerate(trial);
  return ParticleVectors(body_).values_of(trial.a);
}

/// One cycle of Lanczos' method for -da/dx, which is symmetric in the product above, from the mode, which becomes the
/// best approximation of an eigenvector that it finds.
StabilityMonitor::Estimate StabilityMonitor::iterate(Vector const& x, Vector const& rest, double size) {
  ParticleVectors const vectors(body_);
  std::vector<Vector> basis;
  std::vector<double> diagonal, beside, y;
  Vector next = mode_;
  for (int k = 0; k < cycle; ++k) {
    auto const [square, most] = vectors.extent(next);
    double const length = std::sqrt(square);
    if (!(length > 0) || !std::isfinite(length)) break;
    if (k > 0) beside.push_back(length);
    vectors.each_number([&](std::size_t i) { next[i] /= length; });
    basis.push_back(next);
    double const scale = size / (most / length);
    vectors.put_moved(x, scale, next);
    next = accelerations();
    vectors.each_number([&](std::size_t i) { next[i] = (rest[i] - next[i]) / scale; });
    diagonal.push_back(vectors.product(next, basis.back()));
    vectors.each_number([&](std::size_t i) {
      next[i] -=
          diagonal.back() * basis.back()[i] + (k > 0 ? beside.back() * basis[static_cast<std::size_t>(k) - 1][i] : 0);
    });
  }
  if (basis.empty()) return {};
  beside.resize(basis.size() - 1);
  Estimate found;
  found.square = largest_eigenvalue(diagonal, beside, y);
  found.error = std::sqrt(vectors.product(next, next)) * std::abs(y.back());
  std::fill(mode_.begin(), mode_.end(), 0);
  vectors.each_number([&](std::size_t i) {
    for (std::size_t k = 0; k < basis.size(); ++k) mode_[i] += y[k] * basis[k][i];
  });
  return found;
}

bool StabilityMonitor::should_look(double dt) const {
  return dt < step() || measurement_spacing_ < brisk_pace || std::fmod(steps_, glance) == 0;
}

/// v.K.v = -sum m v.(da/dt) from the change over the last step dt, with the velocity at its middle, and a.M.a of free
/// components.
void StabilityMonitor::look_at_unrest(double dt) {
  auto const& s = body_.state();
  int const D = s.dimension;
  EnergyOscillationSums sums;
  sums.held = body_.boundary().square_of_held(s);
  sums.of_particles = sums_over_slots<3>(false, body_.own(), [&](Index i, double* x) {
    double stiff = 0, fast = 0;
    for (int c = 0; c < D; ++c) {
      double const a = value_at(s.a, i, c);
      stiff += (value_at(s.x, i, c) - value_at(s.kept, i, c)) * (value_at(s.kept, i, 2 * D + c) - a);
      fast += a * a;
    }
    x[0] = body_.mass(i) * stiff;
    x[1] = body_.mass(i) * fast;
    x[2] = body_.kinetic_energy_of(i);
  });
  if (body_.shared()) comm::allreduce_sum(sums);
  auto const& of = sums.of_particles;
  double const held =
      body_.boundary().square_of_surface(s) + sums.held.value() + body_.boundary().square_of_absorbed(s);
  double const now = 0.125 * (std::abs(of.value(0)) / (dt * dt) + of.value(1) - held);
  energy_oscillation_ = std::max(energy_oscillation_, now);
  recent_max_ = std::max(recent_max_, now);
  energy_ = std::max(energy_, of.value(2));  // a body at rest at the last measurement may have been hit
}

/// From the velocities alone: accelerations have yet to come. `size` [m]: of the trial displacement.
double StabilityMonitor::unrest_at_start(Vector const& x, Vector const& rest, double size) {
  ParticleVectors const vectors(body_);
  Vector const v = vectors.values_of(body_.state().v);
  double const most = global_max_norm(body_, v);
  if (!(most > 0)) return 0;
  vectors.put_moved(x, size / most, v);
  Vector change = accelerations();
  vectors.each_number([&](std::size_t i) { change[i] = rest[i] - change[i]; });
  return 0.125 * most / size * std::abs(vectors.product(v, change));
}

void StabilityMonitor::measure(int cycles, bool at_start) {
  backend_.keep(body_.state());
  backend_.update_output_fields(body_.state());
  energy_ = std::max(energy_, body_.kinetic_energy() + body_.strain_energy());
  refresh_mode(body_, mode_);
  for (Index k = 0; k < body_.state().boundary.mirrored_count; ++k) {  // nothing moves across its mirror plane
    MirroredParticle const& p = body_.state().boundary.mirrored[k];
    for (int c = 0; c < body_.state().dimension; ++c)
      if ((p.axes >> c & 1) != 0) mode_[mode_place(body_, p.slot, c)] = 0;
  }
  auto const x = ParticleVectors(body_).values_of(body_.state().x);
  body_.state().marks = true;
  auto const rest = accelerations();
  body_.state().marks = false;
  auto const spacing = body_.body().spacing;
  // Small relative to changes of the tangent, large relative to round-off.
  double const size = 1e-6 * *std::min_element(spacing.begin(), spacing.begin() + body_.state().dimension);
  if (at_start) energy_oscillation_ = unrest_at_start(x, rest, size);
  for (int k = 0; k < cycles; ++k) {
    Estimate const found = iterate(x, rest, size);
    if (!(found.square > 0) || !std::isfinite(found.square)) break;
    frequency_ = std::sqrt(found.square + std::min(found.error, accuracy * found.square));
    if (found.error < accuracy * found.square) break;
  }
  backend_.restore(body_.state());
  steps_ = steps_since_measurement_ = gradients_changed_ = 0;
}

void StabilityMonitor::update(double dt, int halvings) {
  PIOLA_EXPECTS(dt > 0 && halvings >= 0);
  if (is_given()) return;
  ++steps_;
  steps_since_measurement_ += dt * frequency() / (2 * calm_share);
  if (halvings == 0 && should_look(dt)) look_at_unrest(dt);
  recent_max_age_ += dt * frequency() / (2 * calm_share);
  if (recent_max_age_ > lasting) {
    if (recent_max_ < calmer * energy_oscillation_) energy_oscillation_ = recent_max_;
    recent_max_ = recent_max_age_ = 0;
  }
  step_reduction_ =
      halvings > 0 ? std::max(least_caution, halved * step_reduction_) : std::min(1.0, recovery * step_reduction_);
  double const most = body_.largest_change();
  bool const strained = most >= (steps_ < fewest ? much : change) || (gradients_changed_ > 0 && steps_ >= brisk_pace);
  double const waited = measurement_spacing_ == 0 ? steps_ : steps_since_measurement_;
  if (waited < interval_ && !strained) return;
  double const before = frequency_;
  measurement_spacing_ = steps_;
  measure(later_cycles, false);
  bool const calm = !strained && std::abs(frequency_ - before) < steady * before;
  interval_ = calm ? std::min(2 * interval_, longest) : shortest;
}

double StabilityMonitor::frequency() const {
  double const of_body = lift * std::max(frequency_, start_);
  if (!(contact_frequency2_ > 0 || eulerian_frequency2_ > 0)) return of_body;
  return std::sqrt(std::max(of_body * of_body, eulerian_frequency2_) + contact_frequency2_);
}

double StabilityMonitor::step() const {
  return step_at(measurement_spacing_ == 0              ? first_share
                 : measurement_spacing_ >= brisk_pace   ? calm_share
                 : measurement_spacing_ >= violent_pace ? brisk_share
                                                        : violent_share);
}

double StabilityMonitor::calm_step() const { return step_at(calm_share); }

double StabilityMonitor::step_at(double fraction) const {
  PIOLA_EXPECTS(fraction > 0);
  if (is_given()) {
    double const given = body_.options().cfl * body_.state().constants.unit_step;
    return eulerian_frequency2_ > 0 ? std::min(given, fraction * 2 / std::sqrt(eulerian_frequency2_)) : given;
  }
  // Viscous forces of the last step reduce the limit: sqrt(1 + xi^2) - xi, with xi their fraction of critical damping.
  auto const& s = body_.state();
  double const xi = 0.5 * frequency() * s.viscosity.fluctuation / (s.constants.kappa_local + 4 * s.constants.mu / 3);
  return step_reduction_ * fraction * (std::sqrt(1 + xi * xi) - xi) * 2 / frequency();
}

std::vector<double> StabilityMonitor::state() const {
  std::vector<double> s{frequency_,
                        start_,
                        steps_,
                        measurement_spacing_,
                        step_reduction_,
                        interval_,
                        steps_since_measurement_,
                        energy_,
                        energy_oscillation_,
                        recent_max_,
                        recent_max_age_,
                        gradients_changed_};
  if (is_given()) return s;
  return with_mode(body_, std::move(s), mode_);
}

void StabilityMonitor::load(StateReader& reader, std::string const& name) {
  constexpr std::size_t numbers = 12;
  std::vector<double> state = this->state();
  if (is_given()) {
    reader.get(name, state);
  } else {
    reader.get_on_root(name, state);
    state = without_mode(body_, numbers, state, mode_);
  }
  frequency_ = state[0];
  start_ = state[1];
  steps_ = state[2];
  measurement_spacing_ = state[3];
  step_reduction_ = state[4];
  interval_ = state[5];
  steps_since_measurement_ = state[6];
  energy_ = state[7];
  energy_oscillation_ = state[8];
  recent_max_ = state[9];
  recent_max_age_ = state[10];
  gradients_changed_ = state[11];
}

}  // namespace piola::nodal
