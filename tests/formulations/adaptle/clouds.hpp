// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/particles.hpp"
#include "formulations/small_bodies.hpp"
#include "materials/solid_samples.hpp"
#include "math/random.hpp"
#include <functional>
#include <memory>

/// Access to the particles of AdapTLE: tests write any state and read the sums of a step.
namespace piola::testing {

using adaptle::System;

/// The components of one particle in a field.
struct Components {
  double* first;
  std::ptrdiff_t step;
  int count;
  struct Iterator {
    double* at;
    std::ptrdiff_t step;
    double& operator*() const { return *at; }
    Iterator& operator++() {
      at += step;
      return *this;
    }
    bool operator!=(Iterator const& other) const { return at != other.at; }
  };
  double& operator[](int c) const { return first[c * step]; }
  Iterator begin() const { return {first, step}; }
  Iterator end() const { return {first + count * step, step}; }
};

/// References to the state of one particle inside the fields, for reading and writing.
struct State {
  Components x, v, S;
  double &rho, &energy, &plastic_strain, &plastic_work, &damage, &viscosity, &phi, &active, &released, &energy_rate;

  State(adaptle::Fields const& f, Index i)
      : x(part(f.x, i, 3)),
        v(part(f.v, i, 3)),
        S(part(f.S, i, 6)),
        rho(value_at(f.rho, i)),
        energy(value_at(f.energy, i)),
        plastic_strain(value_at(f.plastic_strain, i)),
        plastic_work(value_at(f.plastic_work, i)),
        damage(value_at(f.damage, i)),
        viscosity(value_at(f.viscosity, i)),
        phi(value_at(f.phi, i)),
        active(value_at(f.active, i)),
        released(value_at(f.released, i)),
        energy_rate(value_at(f.energy_rate, i)) {}

 private:
  static Components part(FieldRef const& f, Index i, int count) { return {&value_at(f, i), f.component_stride, count}; }
};

/// Half-time values, sums and deformation of one particle after a step. Quantities that the case lacks are zero.
struct Half {
  double v[3], S[6], volume, rho, pressure, c;
};
struct Sums {
  double force[3], heat, L[9], contact, hourglass, stiffness, overlap, closing, compression;
};
struct Deformation {
  double F[9], rate[9], gap;
};

inline std::vector<std::string> adaptle_machines() {
  std::vector<std::string> r;
  for (auto names = adaptle::backend_names(); *names != nullptr; ++names) r.push_back(*names);
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
  for (FormulaInfo const& formula : adaptle::info().formulas)
    for (auto const v : formula.variables) names.variables.emplace_back(v);
  for (auto& f : a.formulations) f.formulas.insert_or_assign(key, Expression(text, names));
}

/// Advances by `steps` stable steps from `time` [s]. Returns the time reached [s].
inline double take_steps(Formulation& f, double time, int steps) {
  for (int k = 0; k < steps; ++k) {
    double const dt = f.stable_time_step();
    f.step(time, dt);
    time += dt;
  }
  EXPECT_FALSE(f.failure());
  return time;
}

/// Particles of an assembly and access to their fields.
struct Cloud {
  explicit Cloud(Assembly const& a)
      : particles(std::make_unique<adaptle::Particles>(a, adaptle::read_options(a),
                                                       *adaptle::find_backend(a.backend.c_str()))),
        state{&particles->system().field} {}
  Index size() const { return system().particles; }
  System const& system() const { return particles->system(); }
  double mass(Index i) const { return value_at(system().field.mass, i); }
  double volume(Index i) const { return value_at(system().field.volume, i); }
  Point X(Index i) const { return point_at(system().field.X, i, 3); }

  /// Sums of particle i over spatial, reference and contact sweeps.
  Sums sums(Index i) const {
    adaptle::Fields const& f = system().field;
    using R = adaptle::SpatialResult;
    using C = adaptle::ContactSum;
    adaptle::SpatialTable const& spatial = system().spatial;
    double none[R::stride]{};
    double const* const own = spatial.result != nullptr ? spatial.result + spatial.result_of[i] * R::stride : none;
    Sums r{};
    for (int c = 0; c < 3; ++c) r.force[c] = own[R::force + c] + of(f.force, i, c);
    for (int c = 0; c < 9; ++c) r.L[c] = own[R::L + c];
    r.heat = own[R::heat] + of(f.heat, i);
    r.compression = std::max(own[R::compression], of(f.compression, i));
    r.hourglass = of(f.hourglass, i);
    r.contact = of(f.contact, i, C::power);
    r.stiffness = of(f.contact, i, C::stiffness);
    r.overlap = of(f.contact, i, C::overlap);
    r.closing = of(f.contact, i, C::closing);
    return r;
  }
  Half half(Index i) const {
    adaptle::Fields const& f = system().field;
    Half r{};
    for (int c = 0; c < 3; ++c) r.v[c] = of(f.v_half, i, c);
    for (int c = 0; c < 6; ++c) r.S[c] = of(f.S_half, i, c);
    r.volume = of(f.volume_half, i);
    r.rho = of(f.rho_half, i);
    r.pressure = of(f.pressure, i);
    r.c = of(f.c, i);
    return r;
  }
  Deformation deformation(Index i) const {
    adaptle::Fields const& f = system().field;
    Deformation r{};
    for (int c = 0; c < 9; ++c) {
      r.F[c] = of(f.F, i, c);
      r.rate[c] = of(f.F_rate, i, c);
    }
    r.gap = of(f.gap, i);
    return r;
  }

  /// Updates lists and particle types. Required after `state` was written.
  void changed() { particles->resumed(); }
  /// Evaluates all sums of a step; dt = 1e-25 s leaves positions unchanged.
  void evaluate() { particles->step(0, 1e-25); }

  /// Velocity gradient of particle i [1/s]: spatial and reference part, blended by its kernel type phi.
  Mat<3> velocity_gradient(Index i) const {
    Mat<3> L, F, rate;
    for (int c = 0; c < 9; ++c) L.c[c] = sums(i).L[c];
    if (state[i].phi == 1) return L;
    Deformation const d = deformation(i);
    for (int c = 0; c < 9; ++c) {
      F.c[c] = d.F[c];
      rate.c[c] = d.rate[c];
    }
    double const phi = state[i].phi;
    Mat<3> const material = rate * inverse(F);
    for (int c = 0; c < 9; ++c) L.c[c] = phi * L.c[c] + (1 - phi) * material.c[c];
    return L;
  }

  std::unique_ptr<adaptle::Particles> particles;
  struct {
    adaptle::Fields const* field;
    State operator[](Index i) const { return {*field, i}; }
  } state;

 private:
  static double of(FieldRef const& f, Index i, int c = 0) { return f.data != nullptr ? value_at(f, i, c) : 0; }
};

/// Sets random velocities, stresses, densities, energies and viscosity factors. Shears and stretches positions and adds
/// random displacements up to `shake` [m].
inline void shake_up(Cloud& cloud, int dimension, double shake, std::uint32_t seed = 7) {
  Random random(seed);
  for (Index i = 0; i < cloud.size(); ++i) {
    State const s = cloud.state[i];
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
