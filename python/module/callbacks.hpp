// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/observers/output_schedule.hpp"
#include "piola/simulation/observers.hpp"
#include "case.hpp"
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <optional>

namespace piola::python {

/// What Python wants of a run: the first exception that one of its functions raised, and that the run is to stop.
struct Wishes {
  std::atomic<int> stop{0};
  std::mutex guard;
  std::exception_ptr raised;  ///< a Python exception, raised again once the run has stopped
  /// Keeps the exception that is being handled and asks the run to stop.
  void keep_exception();
  /// Raises what was kept, with the GIL held; the run may go on afterwards.
  void raise();
};

/// A Python function that is called at each due time; if it returns True, the run stops there.
class CallObserver : public Observer {
 public:
  CallObserver(py::function call, double every, Wishes& requests);
  ~CallObserver() override;
  CallObserver(CallObserver const&) = delete;
  CallObserver& operator=(CallObserver const&) = delete;
  void observe(Formulation const& formulation, TimeState const& moment) override;

 private:
  py::function call_;
  Schedule schedule_;
  bool each_step_;
  Wishes& wishes_;
};

/// Lets Ctrl-C end a run, looking about every 50 ms.
class SignalObserver : public Observer {
 public:
  explicit SignalObserver(Wishes& requests) : wishes_(requests) {}
  void observe(Formulation const& formulation, TimeState const& moment) override;

 private:
  Wishes& wishes_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The velocity of a support as a Python function of all its points and the time: called once for each time, its
/// values are looked up by the formulas of the support. Points that it was not asked for are asked for one by one.
class SupportFunction {
 public:
  /// X: the points of the support [m].
  SupportFunction(py::function call, std::string name, std::vector<std::array<double, 3>> X, Wishes& requests);
  ~SupportFunction();
  SupportFunction(SupportFunction const&) = delete;
  SupportFunction& operator=(SupportFunction const&) = delete;
  /// [m/s]; from any thread. What goes wrong is kept in the wishes, and the last good velocity is given.
  double velocity(std::array<double, 3> const& X, double t, std::size_t component);

 private:
  using Values = std::map<std::array<double, 3>, std::array<double, 3>>;
  void ask(std::vector<std::array<double, 3>> const& X, double t, Values& values);
  py::function call_;
  std::string name_;
  std::vector<std::array<double, 3>> X_;
  Wishes& wishes_;
  std::mutex one_;
  std::map<double, Values> known_;  ///< of the last times
};

}  // namespace piola::python
