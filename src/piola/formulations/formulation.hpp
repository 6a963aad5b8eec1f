// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/actions.hpp"
#include "piola/mechanics/rigid_state.hpp"
#include "piola/parallel/bisection.hpp"
#include "piola/parallel/row_plan.hpp"
#include "piola/parallel/work_balance.hpp"
#include "piola/particles/ordering.hpp"
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

/// That of this name. Throws std::invalid_argument if there is none.
FieldInfo const& info_of(std::span<FieldInfo const> fields, std::string_view name);

/// What one body has of the quantities below.
struct BodyShare {
  std::string name;
  double kinetic_energy = 0, strain_energy = 0;  ///< J
  std::array<double, 3> linear_momentum{};       ///< kg m/s
};

/// Surface points that went through another surface since the start: they were deep behind it, and left at its far
/// side.
struct Passage {
  std::string of, through;  ///< of what, through what, e.g. body "plate"
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
  std::vector<BodyShare> bodies;
  std::vector<Action> actions;
  std::vector<RigidState> rigids;  ///< shapes that are free or turn
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

/// How long the steps of a run will be, for estimates and for words.
struct StepRule {
  double settled = 0;       ///< s, the step once the run has settled
  double first = 0;         ///< s
  double growth = 1;        ///< a step may be longer than the one before by this factor; 1: no bound
  double late_growth = 0;   ///< the same once a step is longer than `late_from`; 0: as before
  double late_from = 0;     ///< s
  std::string limit;        ///< what limits the step, in words
  double more_stages = 0;   ///< right-hand sides a step on average besides stages_per_step
  double setup_stages = 0;  ///< right-hand sides before the first step
};

/// What particles of a body tell their neighbours, those of other ranks too: for estimates.
struct Talk {
  /// So many numbers per particle, to those who read them.
  struct Told {
    double reach;  ///< m, as the particles stood at the start
    int numbers;
  };
  std::vector<std::vector<Told>> messages;  ///< of a right-hand side, to each rank that reads any of it
  /// What is told of particles that are near others in space, to each rank that reads any of it (CellMarks), after all
  /// have told all of their cells.
  struct Near {
    struct Numbers {
      int any, flow, touch;  ///< per particle, whatever is read of it and by kind of reading
    };
    std::vector<Numbers> messages;    ///< of a step
    std::size_t group = 0;            ///< bodies with the same one have common cells, whose edge is the largest of all
    double cell = 0;                  ///< edge [m]
    bool touching = false;            ///< bodies of the group can touch
    std::vector<std::uint8_t> flows;  ///< per particle of the body, or one for all
  };
  std::optional<Near> near{};
  double stages = 0;             ///< right-hand sides of a step; 0: as step_rule() says of all bodies
  double collectives = 0;        ///< per step: what all ranks add, or take the largest of, or are told
  double more_if_shortened = 0;  ///< of these in steps that others make shorter than the formulation would
  double to_all = 0;             ///< per step: numbers that all ranks are told of the particles of the body
  /// Of which each of so many ranks has its share.
  SlotOrder (*order)(ParticleSet const&, Body const&, int ranks) = &bisected_pencils;

  /// The formulation would take steps `own`, all take `step` [s].
  void take_shorter_steps(double own, double step) {
    if (step < own) collectives += std::exchange(more_if_shortened, 0.0);
  }
  /// What pushes bodies reads so many of its particles in every step: positions and velocities, at once.
  void read_motion_of(std::size_t particles) {
    collectives += particles > 0 ? 1 : 0;
    to_all += 6 * static_cast<double>(particles);
  }
};

/// Receives or returns the evolved state by name, in Id order; bit-exact doubles.
class StateWriter {
 public:
  virtual ~StateWriter() = default;
  virtual void put(std::string_view name, std::span<double const> values) = 0;
  /// Of what ranks have rows of: `values` are those of this rank, row by row. Collective; here rank 0 gets all of them
  /// and puts them.
  virtual void put_rows(std::string_view name, RowsOfRanks const& rows, std::span<double const> values);
  /// What put_rows() does with the rows of other ranks: brings them to rank 0; writes them into one file, end_rows()
  /// following then; nothing, since only the size matters.
  enum class Rows { to_first, to_file, counted };
  virtual Rows rows() const { return Rows::to_first; }
  virtual void end_rows() {}  ///< collective
};

/// Counts what is saved.
class StateSize : public StateWriter {
 public:
  void put(std::string_view, std::span<double const> values) override { numbers_ += values.size(); }
  void put_rows(std::string_view, RowsOfRanks const& rows, std::span<double const>) override {
    numbers_ += numbers_of(rows);
  }
  Rows rows() const override { return Rows::counted; }
  std::size_t numbers() const { return numbers_; }

 private:
  std::size_t numbers_ = 0;
};

/// Where the numbers of a name stand, one after the other, as they are in memory.
struct PlaceInFile {
  std::string path;
  std::uint64_t at;  ///< [bytes]
};
class StateReader {
 public:
  virtual ~StateReader() = default;
  /// Throws FileError if the name or the length does not fit.
  virtual void get(std::string_view name, std::span<double> values) = 0;
  /// The same for what rank 0 alone has room for, because it deals it out then; other ranks give none.
  virtual void get_to_deal(std::string_view name, std::span<double> values) { get(name, values); }
  /// What put_rows() has put: `values` are those of this rank. Collective; here rank 0 gets all of them and hands out.
  virtual void get_rows(std::string_view name, RowsOfRanks const& rows, std::span<double> values);
  /// Of so many numbers, if they are in a file that other processes can read, too. Throws as get().
  virtual std::optional<PlaceInFile> place(std::string_view /*name*/, std::size_t /*count*/) { return std::nullopt; }
};

/// The narrow face of every formulation: called at most a few times per step, holds no data.
/// Particles are addressed in Id order (the order of the ParticleSet), whatever the formulation uses inside.
class Formulation {
 public:
  virtual ~Formulation() = default;

  virtual double stable_time_step() const = 0;  ///< s, the step to take from the current state
  /// The step that runs go at once they have settled, where the first steps are shorter: for estimates [s].
  virtual double settled_time_step() const { return stable_time_step(); }
  virtual StepRule step_rule() const {
    StepRule rule;
    rule.settled = rule.first = settled_time_step();
    rule.limit = "the formulation";
    return rule;
  }
  virtual void step(double time, double dt) = 0;  ///< from time to time + dt
  /// Multiplies the velocities that nothing prescribes by `factor`, from 0 to 1; the kinetic energy that they lose is
  /// the damping loss. Called between steps.
  virtual void damp(double factor) = 0;
  virtual double kinetic_energy() const { return diagnose().kinetic_energy; }  ///< [J]
  /// What acts between bodies pushes them between steps, when all stand at one instant. Only of formulations whose
  /// FormulationInfo says `pushable`, built from an Assembly that says `pushed`. On ranks all read, and push, the same.
  virtual void read_motion(std::span<std::int64_t const> /*ids*/, std::span<std::array<double, 3>> /*x*/,
                           std::span<std::array<double, 3>> /*v*/) const {}                          ///< [m], [m/s]
  virtual void read_masses(std::span<std::int64_t const> /*ids*/, std::span<double> /*m*/) const {}  ///< [kg]
  /// Adds to velocities, also to prescribed ones [m/s].
  virtual void push(std::span<std::int64_t const> /*ids*/, std::span<std::array<double, 3> const> /*change*/) {}

  /// Rigid shapes that are free or turn, as they stand; of the others the case tells where they are.
  virtual std::vector<RigidState> rigids() const { return {}; }

  virtual std::optional<Failure> failure() const = 0;  ///< set once the state is not admissible any more
  /// Where ranks share the particles, all of them call this, sample(), save() and load(), and rank 0 has what comes
  /// out.
  virtual Diagnostics diagnose() const = 0;

  virtual std::vector<FieldInfo> fields() const = 0;
  /// The fields that one body has, where several formulations run together; others show zero for it.
  virtual std::vector<FieldInfo> fields_of(std::size_t /*body*/) const { return fields(); }
  /// Values of one field, particle by particle: values[id * components + c]; ranks other than 0 give no room for them.
  virtual void sample(std::string_view field, std::span<double> values) const = 0;
  /// The particles that this rank looks at for observers, of which all ranks together have each once; the same
  /// until they are cut anew (recuts). Nothing: all of them, in Id order.
  virtual std::optional<std::vector<std::int64_t>> owned() const;
  /// Values of one field of those: values[k * components + c] of the k-th. All ranks call it.
  virtual void sample_owned(std::string_view field, std::span<double> values) const { sample(field, values); }

  virtual void save(StateWriter& writer) const = 0;
  virtual void load(StateReader& reader) = 0;

  virtual int stages_per_step() const = 0;  ///< right-hand sides per step
  /// Wall time by part of the work since the formulation was built [s], for the summary.
  virtual std::vector<std::pair<std::string, double>> costs() const { return {}; }
  virtual std::size_t memory_bytes() const = 0;

  /// Of one body, if the formulation runs on ranks.
  virtual std::optional<Talk> talk(std::size_t /*body*/) const { return std::nullopt; }
  /// How often ranks were cut anew, if the formulation can be.
  virtual std::optional<Recuts> recuts() const { return std::nullopt; }
};

}  // namespace piola
