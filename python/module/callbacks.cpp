// SPDX-License-Identifier: Apache-2.0
#include "callbacks.hpp"
#include <cmath>
#include <fmt/format.h>

namespace piola::python {

void Wishes::keep_exception() {
  std::scoped_lock const lock(guard);
  if (!raised) raised = std::current_exception();
  stop = 1;
}

void Wishes::raise() {
  std::exception_ptr const what = std::exchange(raised, nullptr);
  stop = 0;
  if (what) std::rethrow_exception(what);
}

CallObserver::CallObserver(py::function call, double every, Wishes& requests)
    : call_(std::move(call)), schedule_(every), each_step_(every == 0), wishes_(requests) {}

CallObserver::~CallObserver() {
  py::gil_scoped_acquire const python;
  call_ = {};
}

void CallObserver::observe(Formulation const&, TimeState const& moment) {
  if (!each_step_ && !schedule_.due(moment.time)) return;
  py::gil_scoped_acquire const python;
  try {
    py::object const answer = call_();
    if (answer.ptr() == Py_True) wishes_.stop = 1;
  } catch (py::error_already_set const&) {
    wishes_.keep_exception();
  }
}

void SignalObserver::observe(Formulation const&, TimeState const&) {
  auto const now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(50)) return;
  last_ = now;
  py::gil_scoped_acquire const python;
  if (PyErr_CheckSignals() == 0) return;
  try {
    throw py::error_already_set();
  } catch (py::error_already_set const&) {
    wishes_.keep_exception();
  }
}

SupportFunction::SupportFunction(py::function call, std::string name, std::vector<std::array<double, 3>> X,
                                 Wishes& requests)
    : call_(std::move(call)), name_(std::move(name)), X_(std::move(X)), wishes_(requests) {}

SupportFunction::~SupportFunction() {
  py::gil_scoped_acquire const python;
  call_ = {};
}

void SupportFunction::ask(std::vector<std::array<double, 3>> const& X, double t, Values& values) {
  py::gil_scoped_acquire const python;
  try {
    Table points({static_cast<py::ssize_t>(X.size()), py::ssize_t{3}});
    for (std::size_t i = 0; i < X.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) *points.mutable_data(i, c) = X[i][c];
    Table const answer = Table::ensure(call_(points, t));
    if (!answer) throw py::error_already_set();
    if (answer.ndim() != 2 || answer.shape(0) != points.shape(0) || answer.shape(1) != 3)
      throw py::value_error(
          fmt::format("the function of support '{}' must return an array of shape ({}, 3)", name_, X.size()));
    for (std::size_t i = 0; i < X.size(); ++i) {
      std::array<double, 3> v{};
      for (std::size_t c = 0; c < 3; ++c) v[c] = *answer.data(i, c);
      if (!std::isfinite(v[0] + v[1] + v[2]))
        throw py::value_error(
            fmt::format("the function of support '{}' returned a velocity that is not a number at "
                        "t = {} s",
                        name_, t));
      values[X[i]] = v;
    }
  } catch (...) {
    wishes_.keep_exception();
  }
}

double SupportFunction::velocity(std::array<double, 3> const& X, double t, std::size_t component) {
  std::scoped_lock const lock(one_);
  auto known = known_.find(t);
  if (known == known_.end()) {
    Values values = known_.empty() ? Values{} : known_.rbegin()->second;  // kept where the function fails
    if (!wishes_.stop) ask(X_, t, values);
    while (known_.size() > 3) known_.erase(known_.begin());
    known = known_.emplace(t, std::move(values)).first;
  }
  auto value = known->second.find(X);
  if (value == known->second.end()) {
    if (!wishes_.stop) ask({X}, t, known->second);
    value = known->second.emplace(X, std::array<double, 3>{}).first;
  }
  return value->second[component];
}

}  // namespace piola::python
