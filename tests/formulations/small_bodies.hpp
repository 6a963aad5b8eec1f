// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "exec/thread_count.hpp"
#include "particles/lattices.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

/// Small bodies for tests of formulations, by default under JST-SPH. Tests use the interface Formulation only.
namespace piola::testing {

using Point = std::array<double, 3>;
using Values = std::vector<double>;

inline MaterialParameters material(std::string_view law, double rho0, double youngs_modulus, double poissons_ratio) {
  MaterialParameters m;
  m.law = find_law(law).value().index;
  m.value[0] = rho0;
  m.value[1] = youngs_modulus;
  m.value[2] = poissons_ratio;
  return m;
}

/// The soft rubber of the paper's examples.
inline MaterialParameters rubber(std::string_view law = "neo_hookean", double poissons_ratio = 0.3) {
  return material(law, 1100, 17e6, poissons_ratio);
}

/// One JST-SPH body of rubber at rest.
inline Assembly assemble(ParticleSet set, MaterialParameters const& m = rubber()) {
  Assembly a;
  a.materials.assign(set.bodies.size(), m);
  // The Runge-Kutta scheme, whose orders and balances most tests state, with a compact gradient.
  a.formulations.assign(set.bodies.size(),
                        FormulationSpec{"jst_sph", {{"gradient_support", 0.8}}, {{"scheme", "paper"}}});
  a.particles = std::move(set);
  return a;
}
inline void choose(Assembly& a, std::string const& key, std::string const& word) {
  for (auto& f : a.formulations) f.words[key] = word;
}
inline void choose(Assembly& a, std::string const& key, double number) {
  for (auto& f : a.formulations) f.numbers[key] = number;
}

/// Sets the initial velocity f(X).
template <class F>
void give_velocity(Assembly& a, F const& f) {
  a.initial_velocity.clear();
  for (auto const& X : a.particles.X) a.initial_velocity.push_back(f(X));
}
/// Sets the initial displacement f(X).
template <class F>
void displace(Assembly& a, F const& f) {
  a.initial_displacement.clear();
  for (auto const& X : a.particles.X) a.initial_displacement.push_back(f(X));
}
/// Ids of the particles with where(X).
template <class F>
std::vector<std::int64_t> select(Assembly const& a, F const& where) {
  std::vector<std::int64_t> chosen;
  for (std::int64_t id = 0; id < a.particles.size(); ++id)
    if (where(a.particles.X[static_cast<std::size_t>(id)])) chosen.push_back(id);
  return chosen;
}
/// Adds a support that fixes the components `fix` of the particles with where(X).
template <class F>
Support& support(Assembly& a, std::array<bool, 3> fix, F const& where) {
  Support s;
  s.fix = fix;
  s.particles = select(a, where);
  a.supports.push_back(s);
  return a.supports.back();
}
inline std::array<Expression, 3> formulas(std::array<std::string, 3> const& text) {
  return {Expression(text[0]), Expression(text[1]), Expression(text[2])};
}
/// Adds a load: acceleration value(X, t) of the particles with where(X).
template <class F>
Load& load(Assembly& a, std::array<std::string, 3> const& value, F const& where) {
  Load l;
  l.particles = select(a, where);
  l.factor.assign(l.particles.size(), 1);
  l.value = formulas(value);
  a.loads.push_back(l);
  return a.loads.back();
}
inline bool everywhere(Point const&) { return true; }

inline Values sample(Formulation const& f, std::string_view field, std::size_t particles) {
  for (auto const& info : f.observables().fields())
    if (info.name == field) {
      Values values(particles * static_cast<std::size_t>(info.components));
      f.observables().sample(field, values);
      return values;
    }
  ADD_FAILURE() << "no field is named " << field;
  return {};
}

/// Message of the error that make_formulation() throws; "" if it throws none.
inline std::string refusal(Assembly const& a) {
  try {
    (void)make_formulation(a);
  } catch (InputError const& e) {
    return e.what();
  }
  return "";
}

/// Advances by n steps of dt [s] from time 0.
inline void advance(Formulation& f, double dt, int n) {
  for (int k = 0; k < n; ++k) f.step(k * dt, dt);
}

/// Advances by `steps` stable steps from the time `from` [s]. Returns the time reached [s].
inline double advance_by_itself(Formulation& f, double from, int steps) {
  double time = from;
  for (int k = 0; k < steps; ++k) {
    double const dt = f.stable_time_step();
    f.step(time, dt);
    time += dt;
  }
  return time;
}

/// Relative change of the total energy over `time` [s], in `steps` steps.
inline double energy_change(Assembly const& a, double time, int steps) {
  auto const f = make_formulation(a);
  double const before = f->diagnose().total_energy();
  advance(*f, time / steps, steps);
  EXPECT_FALSE(f->failure().has_value());
  return std::fabs(f->diagnose().total_energy() / before - 1);
}

inline double largest(Values const& a) {
  double most = 0;
  for (double const v : a) most = std::isfinite(v) ? std::max(most, std::fabs(v)) : v;
  return most;
}
inline double largest_difference(Values const& a, Values const& b) {
  Values d = a;
  for (std::size_t k = 0; k < d.size(); ++k) d[k] -= b[k];
  return largest(d);
}

/// Back ends that the program contains and this processor can run.
inline std::vector<std::string> backends() {
  std::vector<std::string> r;
  for (auto names = jst_sph::backend_names(); *names != nullptr; ++names) r.push_back(*names);
  return r;
}

/// A checkpoint in memory.
struct SavedState : StateWriter, StateReader {
  std::map<std::string, Values, std::less<>> values;
  void put(std::string_view name, std::span<double const> v) override {
    values[std::string(name)].assign(v.begin(), v.end());
  }
  void get(std::string_view name, std::span<double> v) override {
    auto const at = values.find(name);
    ASSERT_NE(at, values.end()) << name;
    ASSERT_EQ(at->second.size(), v.size()) << name;
    std::copy(at->second.begin(), at->second.end(), v.begin());
  }
};
inline SavedState saved(Formulation const& f) {
  SavedState s;
  f.save(s);
  return s;
}

/// Six steps of the body that make() returns end with the same bits when repeated, on other numbers of threads and when
/// each step continues from a checkpoint.
template <class Make>
void expect_same_bits_of_runs(Make const& make) {
  std::vector<Values> ends;
  for (int const threads : {1, 1, 2, 3, 7}) {
    Threads const keep(threads);
    Assembly const a = make();
    auto f = make_formulation(a);
    for (int k = 0; k < 6; ++k) {
      f->step(0, f->stable_time_step());
      if (ends.size() < 2) continue;  // without a pause; then with one thread and with more
      SavedState s = saved(*f);
      f = make_formulation(a);
      f->load(s);
    }
    ends.push_back(sample(*f, "Velocity", a.particles.X.size()));
    EXPECT_EQ(ends.back(), ends.front());
  }
}

/// The unit box, tumbling and stretching, so that no term of a step vanishes.
inline Assembly tumbling_box(int dimension, int n, double jitter = 0) {
  Assembly a = assemble(unit_box(dimension, n, jitter));
  give_velocity(a, [&](Point const& X) {
    Point v{3 * X[0] + 8 * X[0] * X[0], 0, 0};
    if (dimension > 1) v = {20 * X[1] + 8 * X[0] * X[0], -20 * X[0] + 5 * X[1], 0};
    if (dimension > 2) v[2] = 6 * X[0] * X[2] - 10 * X[1];
    return v;
  });
  return a;
}

}  // namespace piola::testing
