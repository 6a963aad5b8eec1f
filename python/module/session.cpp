// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"
#include "piola/base/errors.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/output/field_cache.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <pybind11/stl.h>

namespace piola::python {
namespace {

using Point = std::array<double, 3>;
using Formulas = std::array<Expression, 3>;

/// Rows that Python gave for the particles of a body, as formulas that look them up.
Formulas formulas_of(Table const& rows, std::string const& what, Body const& body, ParticleSet const& particles) {
  if (rows.ndim() != 2 || rows.shape(0) != body.last - body.first || rows.shape(1) != 3)
    throw InputError(
        fmt::format("{} of body '{}' must be an array of shape ({}, 3)", what, body.name, body.last - body.first));
  auto const values = std::make_shared<std::map<Point, Point>>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    Point& value = (*values)[particles.X[static_cast<std::size_t>(body.first + i)]];
    for (std::size_t c = 0; c < 3; ++c) {
      value[c] = *rows.data(i, c);
      if (!std::isfinite(value[c]) || (value[c] != 0 && c >= static_cast<std::size_t>(particles.dimension)))
        throw InputError(
            fmt::format("{} of body '{}' is {} in component {} of its particle {} (finite numbers are "
                        "needed, and 0 in directions that do not exist) - correct the function",
                        what, body.name, value[c], c, i));
    }
  }
  auto const component = [&](std::size_t c) {
    return Expression("a Python function", [values, c](Point const& X, double) { return values->at(X)[c]; });
  };
  return {component(0), component(1), component(2)};
}

}  // namespace

Session::Session(ReadCase const& from, std::string const& folder, bool resume, bool force, Given const& given)
    : written_(!folder.empty()) {
  CaseSpec spec = from.spec;
  bool const has_functions =
      !given.initial_velocity.empty() || !given.initial_displacement.empty() || !given.support_velocity.empty();
  if (has_functions) spec.identity.run.clear();  // the text does not tell what they are
  put(given, spec, from.particles);
  py::gil_scoped_release const others_may_run;
  simulation_ = std::make_unique<Simulation>(build(std::move(spec), from.particles));
  RunOptions const options{.folder = folder, .resume = resume, .force = force, .case_file = from.file};
  run_ = std::make_unique<CaseRun>(*simulation_, options, warned_, wishes_.stop);
  run_->also(signals_);
}

bool Session::advance(double until, std::int64_t steps, bool exactly) {
  if (finished_) throw py::value_error("the run is finished - make a new one");
  std::int64_t const last = steps < 0 ? std::numeric_limits<std::int64_t>::max() : run_->moment().step + steps;
  LoopResult end;
  {
    py::gil_scoped_release const others_may_run;
    end = run_->advance({.time = until, .step = last, .exactly = exactly});
  }
  if (end.ending == RunStatus::failed) {
    std::string const why = finish().failure;
    wishes_.raise();
    throw PhysicsError(why);
  }
  wishes_.raise();
  return end.ending == RunStatus::completed && !end.paused;
}

CaseOutcome const& Session::finish() {
  if (!finished_) {
    py::gil_scoped_release const others_may_run;
    finished_ = run_->finish();
  }
  return *finished_;
}

void Session::observe(py::function call, double every) {
  calls_.push_back(std::make_unique<CallObserver>(std::move(call), every, wishes_));
  calls_.back()->observe(*simulation_->formulation, run_->moment());
  run_->also(*calls_.back());
  wishes_.raise();
}

Table Session::field(std::string const& name, std::optional<Table> out) const {
  FieldCache cache(*simulation_->formulation, simulation_->particles);
  if (!cache.knows(name)) throw py::key_error(fmt::format("there is no field '{}': see Run.fields", name));
  int const components = cache.info(name).components;
  std::vector<py::ssize_t> shape{simulation_->particles.size()};
  if (components > 1) shape.push_back(components);
  Table values = out ? *out : Table(shape);
  if (!std::equal(shape.begin(), shape.end(), values.shape(), values.shape() + values.ndim()))
    throw py::value_error(fmt::format("field '{}' needs an array of shape ({},{})", name, shape[0],
                                      components > 1 ? fmt::format(" {}", components) : ""));
  std::span<double> const room(values.mutable_data(), static_cast<std::size_t>(values.size()));
  py::gil_scoped_release const others_may_run;
  auto const own = cache.observables().fields();
  if (std::any_of(own.begin(), own.end(), [&](FieldInfo const& info) { return info.name == name; })) {
    cache.observables().sample(name, room);
  } else {
    auto const made = cache.values(name);
    std::copy(made.begin(), made.end(), room.begin());
  }
  return values;
}

std::vector<py::tuple> Session::fields() const {
  FieldCache const cache(*simulation_->formulation, simulation_->particles);
  std::vector<py::tuple> list;
  for (FieldInfo const& info : cache.fields()) list.push_back(py::make_tuple(info.name, info.unit, info.components));
  return list;
}

std::map<std::string, py::tuple> Session::history() const {
  HistoryTable const& table = run_->history();
  std::map<std::string, py::tuple> columns;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    py::array_t<double> values(static_cast<py::ssize_t>(table.rows.size()));
    for (std::size_t r = 0; r < table.rows.size(); ++r) values.mutable_at(r) = table.rows[r][c];
    columns[table.columns[c].name] = py::make_tuple(table.columns[c].unit, values);
  }
  return columns;
}

std::map<std::string, py::array_t<double>> Session::state() const {
  NamedState kept;
  simulation_->formulation->save(kept);
  std::map<std::string, py::array_t<double>> arrays;
  for (auto const& [name, values] : kept.arrays())
    arrays[name] = py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  return arrays;
}

void Session::load(std::map<std::string, Table> const& arrays, TimeState const& at) {
  if (written_) throw py::value_error("a run that writes results cannot take another state - make it with out=None");
  NamedState kept;
  for (auto const& [name, values] : arrays) kept.put(name, {values.data(), static_cast<std::size_t>(values.size())});
  simulation_->formulation->load(kept);
  run_->put_moment(at);
}

void Session::put(Given const& given, CaseSpec& spec, ParticleSet const& particles) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    BodySpec& to = spec.bodies[b];
    Body const& body = particles.bodies[b];
    if (auto const rows = given.initial_velocity.find(to.name); rows != given.initial_velocity.end())
      to.initial_velocity = formulas_of(rows->second, "initial_velocity", body, particles);
    if (auto const rows = given.initial_displacement.find(to.name); rows != given.initial_displacement.end())
      to.initial_displacement = formulas_of(rows->second, "initial_displacement", body, particles);
  }
  for (SupportSpec& support : spec.supports)
    if (auto const call = given.support_velocity.find(support.name); call != given.support_velocity.end())
      move_support(support, call->second, particles);
}

void Session::move_support(SupportSpec& support, py::function const& call, ParticleSet const& particles) {
  std::vector<Point> X;
  for (auto const id : supported_particles(particles, *body_named(particles, support.body), support))
    X.push_back(particles.X[static_cast<std::size_t>(id)]);
  functions_.push_back(std::make_unique<SupportFunction>(call, support.name, std::move(X), wishes_));
  auto const along = [function = functions_.back().get()](std::size_t c) {
    return Expression("a Python function",
                      [function, c](Point const& point, double t) { return function->velocity(point, t, c); });
  };
  support.velocity = Formulas{along(0), along(1), along(2)};
}

}  // namespace piola::python
