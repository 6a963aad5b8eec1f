// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/observe.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace piola::taylor_sph {
namespace {

double pressure_of(SymMat<3> const& s) { return (s.c[0] + s.c[1] + s.c[2]) / 3; }

double von_mises(SymMat<3> const& s) {
  double const p = pressure_of(s);
  double sum = 0;
  for (int c = 0; c < 6; ++c) sum += c < 3 ? (s.c[c] - p) * (s.c[c] - p) : 2 * s.c[c] * s.c[c];
  return std::sqrt(1.5 * sum);
}

double stored_energy(TaylorBody const& body, SymMat<3> const& s) {
  double energy = 0;
  with_law(body.state().material, [&](auto const& law) {
    if constexpr (RateForm<std::decay_t<decltype(law)>>) energy = law.energy_of_stress(s);
  });
  return energy;
}

/// Everything an output formula may need of one particle.
struct Particle {
  std::array<double, 3> u, x, v;
  SymMat<3> stress;
  double J, rho0, body, neighbours, id, parting;
};

struct Observed {
  char const* name;
  char const* unit;
  int components;
  void (*put)(Particle const&, double*);
};

constexpr std::array table{
    Observed{"Displacement", "m", 3, [](Particle const& p, double* out) { std::copy(p.u.begin(), p.u.end(), out); }},
    Observed{"Position", "m", 3, [](Particle const& p, double* out) { std::copy(p.x.begin(), p.x.end(), out); }},
    Observed{"Velocity", "m/s", 3, [](Particle const& p, double* out) { std::copy(p.v.begin(), p.v.end(), out); }},
    Observed{"Momentum", "kg/(m2 s)", 3,
             [](Particle const& p, double* out) {
               for (std::size_t c = 0; c < 3; ++c) out[c] = p.rho0 / p.J * p.v[c];
             }},
    Observed{"Pressure", "Pa", 1, [](Particle const& p, double* out) { *out = pressure_of(p.stress); }},
    Observed{"CauchyStress", "Pa", 6,
             [](Particle const& p, double* out) { std::copy(p.stress.c, p.stress.c + 6, out); }},
    Observed{"Jacobian", "1", 1, [](Particle const& p, double* out) { *out = p.J; }},
    Observed{"VonMisesStress", "Pa", 1, [](Particle const& p, double* out) { *out = von_mises(p.stress); }},
    Observed{"Density", "kg/m3", 1, [](Particle const& p, double* out) { *out = p.rho0 / p.J; }},
    Observed{"Parting", "1", 1, [](Particle const& p, double* out) { *out = p.parting; }},
    Observed{"Neighbours", "1", 1, [](Particle const& p, double* out) { *out = p.neighbours; }},
    Observed{"Body", "1", 1, [](Particle const& p, double* out) { *out = p.body; }},
    Observed{"Id", "1", 1, [](Particle const& p, double* out) { *out = p.id; }}};

}  // namespace

void observe(TaylorBody const& body, ParticleSet const& set, Observation& o) {
  std::vector<double> pressure;
  auto const& k = body.state().k;
  double const of_particles = k.adjoint ? 1 - k.memory : 1;
  o.open_body(body.body().name);
  for (Index i = 0; i < body.particles(); ++i) {
    SymMat<3> const s = body.stress(i);
    double const J = body.volume_ratio(i), V = body.volume(i);
    pressure.push_back(pressure_of(s));
    o.add_state(J, pressure.back(), V);
    o.add_motion(body.x(i), body.v(i), body.mass(i));
    o.add_strain_energy(of_particles * V * J * stored_energy(body, s));
  }
  CellEnergy const cells = body.cell_energy();
  o.add_strain_energy(k.memory * cells.stored + cells.hourglass);
  o.totals.external_work += body.external_work();
  o.totals.damping_loss += body.damping_loss();
  o.add_oscillation(set, body.body(), pressure);
}

std::vector<FieldInfo> observed_fields() {
  std::vector<FieldInfo> r;
  r.reserve(std::size(table));
  for (auto const& f : table) r.push_back({f.name, f.unit, f.components});
  return r;
}

void sample(TaylorBody const& body, int body_number, std::string_view field, std::span<double> values) {
  auto const found = std::find_if(table.begin(), table.end(), [&](auto const& f) { return field == f.name; });
  if (found == table.end()) throw std::invalid_argument("no field is named '" + std::string(field) + "'");
  std::vector<double> const parting =
      field == "Parting" ? body.parting() : std::vector<double>(static_cast<std::size_t>(body.particles()));
  for (Index i = 0; i < body.particles(); ++i) {
    auto const id = body.body().first + i;
    Particle const p{body.displacement(i),
                     body.x(i),
                     body.v(i),
                     body.stress(i),
                     body.volume_ratio(i),
                     body.state().k.rho0,
                     static_cast<double>(body_number),
                     static_cast<double>(body.neighbours(i)),
                     static_cast<double>(id),
                     parting[static_cast<std::size_t>(i)]};
    found->put(p, &values[static_cast<std::size_t>(id * found->components)]);
  }
}

}  // namespace piola::taylor_sph
