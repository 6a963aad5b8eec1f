// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/load_balancer.hpp"
#include "piola/domain/redistribution_plan.hpp"
#include "piola/mechanics/resultants.hpp"
#include "piola/mechanics/rigid_state.hpp"
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace piola {

/// A particle field as it appears in frames, probes and the manual.
struct FieldInfo {
  std::string name;  ///< VTK style, e.g. "CauchyStress"
  std::string unit;  ///< SI, UDUNITS notation
  int components;    ///< 1 scalar, 3 vector, 6 symmetric tensor (XX YY ZZ XY YZ XZ), 9 tensor (row by row)
};

/// Returns the field of this name. Throws std::invalid_argument if there is none.
FieldInfo const& info_of(std::span<FieldInfo const> fields, std::string_view name);

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
  double settled = 0;  ///< s, the step once the run has settled
  double first = 0;    ///< s
  double growth = 1;   ///< a step may be longer than the one before by this factor; 1: no bound
  std::string limit;   ///< what limits the step, in words
};

/// Receives the evolved state by name, in Id order, as bit-exact doubles.
class StateWriter {
 public:
  virtual ~StateWriter() = default;
  virtual void put(std::string_view name, std::span<double const> values) = 0;
  /// Saves a distributed table. `values`: the rows of this rank. Collective. The default gathers all rows on rank 0 and
  /// calls put() there.
  virtual void put_rows(std::string_view name, DistributedRows const& rows, std::span<double const> values);
  /// Destination of the rows in put_rows(): rank 0; one file, then followed by end_rows(); or nowhere, since only the
  /// size is needed.
  enum class Rows { to_root, to_file, counted };
  virtual Rows rows() const { return Rows::to_root; }
  virtual void end_rows() {}  ///< collective
};

/// Counts the saved values.
class StateSize : public StateWriter {
 public:
  void put(std::string_view, std::span<double const> values) override { numbers_ += values.size(); }
  void put_rows(std::string_view, DistributedRows const& rows, std::span<double const>) override {
    numbers_ += value_count(rows);
  }
  Rows rows() const override { return Rows::counted; }
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
  /// As get(), for data that rank 0 scatters afterwards: rank 0 passes a buffer of the full length, other ranks pass an
  /// empty span.
  virtual void get_on_root(std::string_view name, std::span<double> values) { get(name, values); }
  /// Inverse of put_rows(). `values`: the rows of this rank. Collective. The default reads all rows on rank 0 and
  /// scatters them.
  virtual void get_rows(std::string_view name, DistributedRows const& rows, std::span<double> values);
  /// Returns the location of `count` values if other processes can read the file; else empty. Throws as get().
  virtual std::optional<FileExtent> place(std::string_view /*name*/, std::size_t /*count*/) { return std::nullopt; }
};

/// Interface of every formulation: called at most a few times per step, holds no data. Particles are addressed in Id
/// order (the order of the ParticleSet), whatever the internal order.
class Formulation {
 public:
  virtual ~Formulation() = default;

  virtual double stable_time_step() const = 0;  ///< s, the step to take from the current state
  /// For estimates: the step after the first, shorter steps [s].
  virtual double steady_time_step() const { return stable_time_step(); }
  virtual StepEstimate step_estimate_of_run() const {
    StepEstimate rule;
    rule.settled = rule.first = steady_time_step();
    rule.limit = "the formulation";
    return rule;
  }
  virtual void step(double time, double dt) = 0;  ///< from time to time + dt
  /// Multiplies the velocities that are not prescribed by `factor`, from 0 to 1. The lost kinetic energy is added to
  /// the damping loss. Called between steps.
  virtual void damp(double factor) = 0;
  virtual double kinetic_energy() const { return diagnose().kinetic_energy; }  ///< [J]
  /// Contact and ties change velocities between steps, when all formulations are at the same time. The three functions
  /// below are their interface. Only if FormulationInfo::can_be_coupled and Assembly::coupled. All ranks pass the same
  /// ids and get the same values.
  virtual void read_motion(std::span<std::int64_t const> /*ids*/, std::span<std::array<double, 3>> /*x*/,
                           std::span<std::array<double, 3>> /*v*/) const {}                          ///< [m], [m/s]
  virtual void read_masses(std::span<std::int64_t const> /*ids*/, std::span<double> /*m*/) const {}  ///< [kg]
  /// Adds to velocities, also to prescribed ones [m/s].
  virtual void add_velocities(std::span<std::int64_t const> /*ids*/,
                              std::span<std::array<double, 3> const> /*change*/) {}

  /// Current state of free and rotating rigid shapes; driven ones without rotation follow from the case.
  virtual std::vector<RigidState> rigids() const { return {}; }

  virtual std::optional<Failure> failure() const = 0;  ///< set once the state is inadmissible
  /// Collective, like sample(), save() and load(), if the body is distributed over ranks; the result is on rank 0.
  virtual Diagnostics diagnose() const = 0;

  virtual std::vector<FieldInfo> fields() const = 0;
  /// The fields of one body of coupled formulations; bodies without a field show zero.
  virtual std::vector<FieldInfo> fields_of(std::size_t /*body*/) const { return fields(); }
  /// Samples one field: values[id * components + c]. Ranks other than 0 pass an empty span.
  virtual void sample(std::string_view field, std::span<double> values) const = 0;
  /// Ids of the particles that this rank evaluates for observers: each particle is on exactly one rank. Valid until the
  /// next repartition. Empty: all particles, in Id order.
  virtual std::optional<std::vector<std::int64_t>> local_particles() const;
  /// Samples one field of local_particles(): values[k * components + c] for the k-th. Collective.
  virtual void sample_local(std::string_view field, std::span<double> values) const { sample(field, values); }

  virtual void save(StateWriter& writer) const = 0;
  virtual void load(StateReader& reader) = 0;

  virtual int stages_per_step() const = 0;  ///< right-hand sides per step
  /// Wall time since construction by part of the work [s], for the summary.
  virtual std::vector<std::pair<std::string, double>> timings() const { return {}; }
  virtual std::size_t memory_bytes() const = 0;

  /// Number of repartitions; empty if the formulation cannot repartition.
  virtual std::optional<RepartitionStatistics> repartition_statistics() const { return std::nullopt; }
};

}  // namespace piola
