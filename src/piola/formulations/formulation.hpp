// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/load_balancer.hpp"
#include "piola/domain/redistribution_plan.hpp"
#include "piola/formulations/common/set_up_checks.hpp"
#include "piola/formulations/observables.hpp"
#include "piola/mechanics/resultants.hpp"
#include "piola/mechanics/rigid_state.hpp"
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace piola {

/// The contribution of one body to the quantities below.
struct BodyDiagnostics {
  std::string name;
  double kinetic_energy = 0, strain_energy = 0;  ///< J
  std::array<double, 3> linear_momentum{};       ///< kg m/s
};

/// Surface points that have passed through another surface since the start: they were deep behind it and left at its
/// far side.
struct Passage {
  std::string of, through;  ///< surface of the points, and the surface passed, e.g. body "plate"
  std::int64_t points = 0;
};

/// Particles of a body that have lost their surface points and that nothing keeps apart from others.
struct UncoveredParticles {
  std::string of, from;  ///< the body, and the others, e.g. body "plate", rigid shapes
  std::int64_t particles = 0;
};

/// Integral quantities of the whole system at one time, SI units.
struct Diagnostics {
  double kinetic_energy = 0;                 ///< J
  double strain_energy = 0;                  ///< J
  double stabilisation_loss = 0;             ///< J, energy removed by the stabilisation since the start
  double projection_loss = 0;                ///< J, energy removed by the momentum projections since the start
  double external_work = 0;                  ///< J, work of loads and driven supports since the start
  double damping_loss = 0;                   ///< J, energy removed by damping since the start
  std::array<double, 3> linear_momentum{};   ///< kg m/s
  std::array<double, 3> angular_momentum{};  ///< kg m2/s, about the origin
  double jacobian_min = 0, jacobian_max = 0;
  double pressure_min = 0, pressure_max = 0;         ///< Pa, positive in tension
  double pressure_oscillation = 0;                   ///< 1 for a checkerboard, O(dx^2) for a smooth field
  std::vector<std::pair<std::string, double>> more;  ///< columns of this formulation only
  std::vector<BodyDiagnostics> bodies;
  std::vector<Action> actions;
  std::vector<RigidState> rigids;  ///< free or rotating shapes
  std::vector<Passage> passages;
  std::vector<UncoveredParticles> uncovered;
  double total_energy() const { return kinetic_energy + strain_energy; }
};

/// The first particle at which the physics left its admissible range.
struct Failure {
  std::string what;            ///< e.g. "is inverted", "has a stress that is not a number"
  std::int64_t particle = -1;  ///< Id
  std::string body;
  std::array<double, 3> X{}, x{};                      ///< reference and current position, m
  std::vector<std::pair<std::string, double>> values;  ///< e.g. {"det F", -0.02}, {"neighbours", 27}
};

/// Estimate of the step lengths of a run.
struct StepEstimate {
  double stable = 0;   ///< s, the step that the current state allows after the first, shorter steps
  double settled = 0;  ///< s, the step once the run has settled
  double first = 0;    ///< s
  double growth = 1;   ///< a step may be longer than the one before by this factor; 1: no bound
  std::string limit;   ///< what limits the step, in words
};

/// State and progress of an energy minimisation in one iteration.
struct Descent {
  double unbalanced = 0;  ///< sqrt(sum m |a|^2) of free accelerations at its start [N/kg^0.5]
  double released = 0;    ///< fall of the potential energy [J]
};

/// Cost of a formulation and quality of its set-up, for the summary, estimates and benchmarks.
struct RunStatistics {
  int stages_per_step = 1;                              ///< right-hand sides per step
  std::vector<std::pair<std::string, double>> seconds;  ///< wall time since construction by part of the work [s]
  std::size_t memory_bytes = 0;
  std::vector<SetUpCheck> set_up_checks;
  std::optional<RepartitionStatistics> repartition;  ///< empty if the formulation cannot repartition
};

/// Receives the evolved state by name, in Id order, as bit-exact doubles. On several ranks all members are collective.
class StateWriter {
 public:
  virtual ~StateWriter() = default;
  /// Saves values that all ranks know. Those of rank 0 are saved.
  virtual void put(std::string_view name, std::span<double const> values) = 0;
  /// Saves values whose number the reader does not know: `count` names that number.
  void put_sized(std::string_view count, std::string_view name, std::span<double const> values);
  /// Saves a distributed table. `values`: the rows of this rank. The default gathers all rows on rank 0 and calls put()
  /// there.
  virtual void put_rows(std::string_view name, DistributedRows const& rows, std::span<double const> values);
  virtual void end_rows() {}  ///< called after the last value
};

/// Counts the saved values.
class StateSize : public StateWriter {
 public:
  void put(std::string_view, std::span<double const> values) override { numbers_ += values.size(); }
  void put_rows(std::string_view, DistributedRows const& rows, std::span<double const>) override {
    numbers_ += value_count(rows);
  }
  std::size_t numbers() const { return numbers_; }

 private:
  std::size_t numbers_ = 0;
};

/// Location of a contiguous array in a file, in the byte order of memory.
struct FileExtent {
  std::string path;
  std::uint64_t at;  ///< [bytes]
};
class StateReader {
 public:
  virtual ~StateReader() = default;
  /// Throws FileError if the name or the length does not fit.
  virtual void get(std::string_view name, std::span<double> values) = 0;
  /// Inverse of StateWriter::put_sized(). Throws as get().
  std::vector<double> get_sized(std::string_view count, std::string_view name);
  /// As get(), for data that rank 0 scatters afterwards: rank 0 passes a buffer of the full length, other ranks pass an
  /// empty span.
  virtual void get_on_root(std::string_view name, std::span<double> values) { get(name, values); }
  /// Inverse of put_rows(). `values`: the rows of this rank. Collective. The default reads all rows on rank 0 and
  /// scatters them.
  virtual void get_rows(std::string_view name, DistributedRows const& rows, std::span<double> values);
  /// Returns the location of `count` values if other processes can read the file; else empty. Throws as get().
  virtual std::optional<FileExtent> place(std::string_view /*name*/, std::size_t /*count*/) { return std::nullopt; }
};

class CoupledParticles;

/// Interface of every formulation: called at most a few times per step, holds no data. Particles are addressed in Id
/// order (the order of the ParticleSet), whatever the internal order. A class that wraps formulations must forward each
/// function, so none has a default but descend(), which throws.
class Formulation {
 public:
  virtual ~Formulation() = default;

  virtual double stable_time_step() const = 0;  ///< s, the step to take from the current state
  virtual StepEstimate step_estimate() const = 0;
  virtual void step(double time, double dt) = 0;  ///< from time to time + dt
  /// Multiplies the velocities that are not prescribed by `factor`, from 0 to 1. The lost kinetic energy is added to
  /// the damping loss. Called between steps.
  virtual void damp(double factor) = 0;

  /// Moves the bodies, which stay at rest, towards the least potential energy, with loads from `time` to time + dt.
  /// Collective. Only with Assembly::minimises, which no other formulation than nodal has; else throws.
  virtual Descent descend(double /*time*/, double /*dt*/) { throw std::logic_error("no minimisation of the energy"); }

  virtual std::optional<Failure> failure() const = 0;  ///< set once the state is inadmissible
  virtual double kinetic_energy() const = 0;           ///< [J], equal on all ranks; collective
  /// Equal on all ranks. Collective, like save(), load() and the functions of observables().
  virtual Diagnostics diagnose() const = 0;
  virtual Observables const& observables() const = 0;  ///< lives as long as the formulation
  virtual RunStatistics statistics() const = 0;        ///< of this rank

  virtual void save(StateWriter& writer) const = 0;
  virtual void load(StateReader& reader) = 0;

  /// The particles that contact and ties may move between steps. Only if Assembly::coupled; nullptr if they cannot
  /// (FormulationInfo::can_be_coupled). Lives as long as the formulation.
  virtual CoupledParticles* coupled_particles() = 0;
};

}  // namespace piola
