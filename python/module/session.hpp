// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/build.hpp"
#include "piola/simulation/run_case.hpp"
#include "callbacks.hpp"
#include <map>
#include <memory>
#include <optional>

namespace piola::python {

/// What Python functions give instead of the case file.
struct Given {
  std::map<std::string, Table> initial_velocity, initial_displacement;  ///< by body: (n, 3)
  std::map<std::string, py::function> support_velocity;                 ///< by name of the support
};

/// Keeps warnings until Python asks for them.
class Warned : public Listener {
 public:
  void warning(std::string const& text) override { texts_.push_back(text); }
  std::vector<std::string> take() { return std::exchange(texts_, {}); }

 private:
  std::vector<std::string> texts_;
};

/// A case that runs, with what Python hooked into it. The GIL is held when its functions are called.
class Session {
 public:
  /// An empty folder: nothing is written. Throws InputError, FileError.
  Session(ReadCase const& from, std::string const& folder, bool resume, bool force, Given const& given);
  /// To `until` [s] or for so many steps (negative: any number). Whether the end is reached. Raises what observers
  /// raised, and PhysicsError after the last state was written.
  bool advance(double until, std::int64_t steps, bool exactly);
  /// Ends the output where the run stands.
  CaseOutcome const& finish();
  void observe(py::function call, double every);

  /// (n) or (n, components) values in the order of ids; `out` is filled if it is given.
  Table field(std::string const& name, std::optional<Table> out) const;
  std::vector<py::tuple> fields() const;             ///< (name, unit, components)
  std::map<std::string, py::tuple> history() const;  ///< name -> (unit, values)
  std::map<std::string, py::array_t<double>> state() const;
  void load(std::map<std::string, Table> const& arrays, TimeState const& at);

  Simulation const& simulation() const { return *simulation_; }
  TimeState const& moment() const { return run_->moment(); }
  std::vector<std::string> take_warnings() { return warned_.take(); }

 private:
  void put(Given const& given, CaseSpec& spec, ParticleSet const& particles);
  void move_support(SupportSpec& support, py::function const& call, ParticleSet const& particles);

  Wishes wishes_;
  SignalObserver signals_{wishes_};
  Warned warned_;
  std::vector<std::unique_ptr<SupportFunction>> functions_;
  std::vector<std::unique_ptr<CallObserver>> calls_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<CaseRun> run_;
  std::optional<CaseOutcome> finished_;
  bool written_;
};

}  // namespace piola::python
