// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/state.hpp"
#include "formulations/small_bodies.hpp"
#include "neighbours/cell_checks.hpp"

/// Small bodies under Taylor-SPH.
namespace piola::testing {

/// Young's modulus and density of the bodies below: round numbers, c = 10 m/s in a bar.
constexpr double youngs_modulus = 1e5, density = 1000;

inline MaterialParameters soft(double poissons_ratio = 0.3) {
  return material("linear_elastic", density, youngs_modulus, poissons_ratio);
}

/// One body at rest with the kernel sums of the paper (`exchange = "kernel_sums"`), to which most tests refer. Tests of
/// the adjoint exchange select it themselves.
inline Assembly assemble_taylor(ParticleSet set, MaterialParameters const& m = soft()) {
  Assembly a = assemble(std::move(set), m);
  a.formulations.assign(a.particles.bodies.size(), FormulationSpec{"taylor_sph", {}, {{"exchange", "kernel_sums"}}});
  return a;
}

/// Moduli of a body: plane strain in two dimensions, uniaxial stress in one.
struct Moduli {
  double lambda, mu, along;  ///< along: D_11
  explicit Moduli(int dimension, double nu = 0.3, double E = youngs_modulus)
      : lambda(E * nu / ((1 + nu) * (1 - 2 * nu))),
        mu(E / (2 * (1 + nu))),
        along(dimension == 1 ? E : lambda + 2 * mu) {}
  double speed() const { return std::sqrt(along / density); }
};

inline bool is_on_edge(Point const& X, int dimension) {
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c)
    if (X[c] < 1e-9 || X[c] > 1 - 1e-9) return true;
  return false;
}

/// Adds a support that prescribes the components `fix` of the velocity of the particles with where(X).
template <class F>
Support& drive(Assembly& a, std::array<bool, 3> fix, std::array<std::string, 3> const& velocity, F const& where) {
  Support& s = support(a, fix, where);
  s.velocity = formulas(velocity);
  return s;
}

/// Applies change(values) to the state of a run: saves it, changes it, loads it again.
template <class F>
void change_state(Formulation& f, F const& change) {
  SavedState s = saved(f);
  change(s.values);
  f.load(s);
}

/// Sets the stress value(X) of each particle, in the component order of SymMat<D>.
template <class F>
void give_stress(Formulation& f, Assembly const& a, F const& value) {
  change_state(f, [&](auto& values) {
    Values& stress = values.at("body0_stress");
    std::size_t const n = stress.size() / a.particles.X.size();
    for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
      auto const s = value(a.particles.X[k]);
      for (std::size_t c = 0; c < n; ++c) stress[n * k + c] = s[c];
    }
  });
}

/// All values of a checkpoint in one array.
inline Values whole_state(Formulation const& f) {
  Values all;
  for (auto const& [name, values] : saved(f).values) all.insert(all.end(), values.begin(), values.end());
  return all;
}

/// A diagnostic column that only this formulation has.
inline double more(Formulation const& f, std::string_view name) {
  for (auto const& [key, value] : f.diagnose().more)
    if (key == name) return value;
  ADD_FAILURE() << "no number is named " << name;
  return 0;
}

/// Advances by `steps` stable steps from `time` [s]. Returns the time reached [s].
inline double run(Formulation& f, int steps, double time = 0) {
  for (int k = 0; k < steps; ++k) {
    double const dt = f.stable_time_step();
    f.step(time, dt);
    time += dt;
  }
  return time;
}

/// A body that rotates, stretches and carries waves, so that no term of a step vanishes. `speed` scales the initial
/// velocities [m/s].
inline Assembly busy_body(int dimension, int n, double jitter = 0, double speed = 1) {
  Assembly a = assemble_taylor(unit_box(dimension, n, jitter));
  give_velocity(a, [&](Point const& X) {
    Point v{0.5 * X[0] + 0.3 * X[0] * X[0], 0, 0};
    if (dimension > 1) v = {v[0] + 2 * X[1], -2 * X[0] + X[1] * X[1], 0};
    if (dimension > 2) v[2] = X[0] * X[2] - X[1];
    for (double& c : v) c *= speed;
    return v;
  });
  return a;
}

}  // namespace piola::testing
