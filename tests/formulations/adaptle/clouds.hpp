// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/particles.hpp"
#include "formulations/small_bodies.hpp"
#include "materials/solid_samples.hpp"
#include "math/random.hpp"
#include <functional>
#include <memory>

/// Bodies of AdapTLE, through its particles: tests may write any state and see the sums of a step.
namespace piola::testing {

using adaptle::Deformation;
using adaptle::Half;
using adaptle::Rates;
using adaptle::State;
using adaptle::Sums;
using adaptle::System;

inline std::vector<std::string> adaptle_machines() {
  std::vector<std::string> r;
  for (auto names = adaptle::machine_names(); *names != nullptr; ++names) r.push_back(*names);
  return r;
}

inline Assembly adaptle_assembly(ParticleSet set, MaterialParameters const& m = sample_metal("elastic", "elastic")) {
  Assembly a;
  a.materials.assign(set.bodies.size(), m);
  a.formulations.assign(set.bodies.size(), FormulationSpec{"adaptle", {}, {}});
  a.particles = std::move(set);
  return a;
}

inline void choose_formula(Assembly& a, std::string const& key, std::string const& text) {
  Names names;
  for (auto const v : adaptle::conversion_variables()) names.variables.emplace_back(v);
  for (auto& f : a.formulations) f.formulas.insert_or_assign(key, Expression(text, names));
}

/// Goes on by stable steps from a time [s]; the time after them.
inline double take_steps(Formulation& f, double time, int steps) {
  for (int k = 0; k < steps; ++k) {
    double const dt = f.stable_time_step();
    f.step(time, dt);
    time += dt;
  }
  EXPECT_FALSE(f.failure());
  return time;
}

/// Particles and the arrays of their state.
struct Cloud {
  explicit Cloud(Assembly const& a)
      : particles(std::make_unique<adaptle::Particles>(a, adaptle::read_options(a),
                                                       *adaptle::find_machine(a.machine.c_str()))) {
    particles->each_array([&](std::string_view name, double* first, int) {
      if (name == "state") state = reinterpret_cast<State*>(first);
      if (name == "rates") rates = reinterpret_cast<Rates*>(first);
    });
  }
  Index size() const { return system().particles; }
  System const& system() const { return particles->system(); }
  Sums const& sums(Index i) const { return system().sums[i]; }
  Half const& half(Index i) const { return system().half[i]; }
  double mass(Index i) const { return system().reference[i].mass; }
  Deformation const& deformation(Index i) const { return system().deformation[i]; }

  /// Lists who is what after `state` has been written.
  void changed() { particles->resumed(); }
  /// Everything of a step, without that anything moves.
  void evaluate() { particles->step(0, 1e-25); }

  /// The velocity gradient that particle i feels.
  Mat<3> velocity_gradient(Index i) const {
    Mat<3> L, F, rate;
    for (int c = 0; c < 9; ++c) L.c[c] = sums(i).L[c];
    if (state[i].phi == 1) return L;
    for (int c = 0; c < 9; ++c) {
      F.c[c] = deformation(i).F[c];
      rate.c[c] = deformation(i).rate[c];
    }
    double const phi = state[i].phi;
    Mat<3> const material = rate * inverse(F);
    for (int c = 0; c < 9; ++c) L.c[c] = phi * L.c[c] + (1 - phi) * material.c[c];
    return L;
  }

  std::unique_ptr<adaptle::Particles> particles;
  State* state = nullptr;
  Rates* rates = nullptr;
};

/// Gives particles of a cloud random velocities, stresses, densities, energies and switches of the viscosity, and
/// places that are sheared, stretched and shaken by `shake` (in m).
inline void shake_up(Cloud& cloud, int dimension, double shake, std::uint32_t seed = 7) {
  Random random(seed);
  for (Index i = 0; i < cloud.size(); ++i) {
    State& s = cloud.state[i];
    double const x = s.x[0], y = s.x[1], z = s.x[2];
    s.x[0] = 1.04 * x + 0.1 * y + 0.03 * z;
    s.x[1] = 0.97 * y - 0.05 * x;
    s.x[2] = dimension == 3 ? z - 0.06 * x : 0;
    for (int c = 0; c < dimension; ++c) {
      s.x[c] += random.in(-shake, shake);
      s.v[c] = random.in(-100, 100);
    }
    s.S[0] = random.in(-1e8, 1e8);
    s.S[1] = random.in(-1e8, 1e8);
    s.S[2] = -s.S[0] - s.S[1];
    s.S[3] = random.in(-1e8, 1e8);
    if (dimension == 3) {
      s.S[4] = random.in(-1e8, 1e8);
      s.S[5] = random.in(-1e8, 1e8);
    }
    s.rho *= random.in(0.9, 1.1);
    s.energy = random.in(-1e3, 1e3);
    s.viscosity = random.in(0.1, 1);
  }
  cloud.changed();
}

}  // namespace piola::testing
