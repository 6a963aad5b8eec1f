// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/observers/run_log.hpp"
#include "piola/observers/stop_request.hpp"
#include "piola/observers/time_state.hpp"
#include "piola/output/checkpoint.hpp"
#include <filesystem>
#include <optional>
#include <vector>

namespace piola {

/// Extracts data from a run. Read access only, so that a run with and without output is bit-identical.
class Observer {
 public:
  virtual ~Observer() = default;
  /// Called at the start of a new run and after each step.
  virtual void observe(Formulation const& formulation, TimeState const& moment) = 0;
  /// Called before a last step that is shortened to the end of the run; the moment is that of the step before. A run
  /// with a later end would take another step.
  virtual void before_shortened_step(Formulation const&, TimeState const&) {}
  /// Called once, after the last step of this part of the run.
  virtual void finish(Formulation const&, TimeState const&, RunStatus) {}
  /// Called before a checkpoint that refers to written data; afterwards these are on disk.
  virtual void sync() {}
  /// Set when the result is no longer reliable: the run then stops as failed.
  virtual std::optional<StopRequest> stop_request() const { return std::nullopt; }
  /// Files of the results folder that this run wrote, or found when resumed, and that must exist at the end.
  virtual std::vector<std::filesystem::path> files() const { return {}; }
  /// Saves the state that a resumed run needs; names are unique among observers.
  virtual void save(StateWriter&) const {}
  virtual void load(NamedState&, TimeState const&) {}
};

/// Common data of all observers: the results folder, the case and its particles, the log of the run. The references
/// outlive the observers.
struct Results {
  std::filesystem::path folder;
  CaseSpec const& spec;
  ParticleSet const& particles;
  RunLog& journal;
};

}  // namespace piola
