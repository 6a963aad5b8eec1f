// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/observe.hpp"
#include "piola/base/contracts.hpp"
#include "piola/formulations/common/output_fields.hpp"
#include "piola/materials/laws.hpp"
#include <array>

namespace piola::taylor_sph {
namespace {

double pressure_of(SymMat<3> const& s) { return (s.c[0] + s.c[1] + s.c[2]) / 3; }

double stored_energy(TaylorBody const& body, SymMat<3> const& s) {
  double energy = 0;
  with_law(body.state().material, [&](auto const& law) {
    if constexpr (RateForm<std::decay_t<decltype(law)>>) energy = law.energy_of_stress(s);
  });
  return energy;
}

constexpr std::array<std::string_view, 13> offered{
    "Displacement", "Position",    "Velocity",   "Momentum", "Pressure", "CauchyStress", "Jacobian", "VonMisesStress",
    "Density",      "StrainDrift", "Neighbours", "Body",     "Id"};

}  // namespace

void add_diagnostics(TaylorBody const& body, ParticleSet const& set, DiagnosticsSum& o) {
  std::vector<double> pressure;
  auto const& k = body.state().k;
  Particles const& particles = body.particles();
  double const of_particles = k.adjoint ? 1 - k.stress_retention : 1;
  o.begin_body(body.body().name);
  for (Index i = 0; i < particles.count(); ++i) {
    SymMat<3> const s = particles.stress(i);
    double const J = particles.volume_ratio(i), V = particles.mass(i) / k.rho0;
    pressure.push_back(pressure_of(s));
    o.add_state(J, pressure.back(), V);
    o.add_motion(particles.x(i), particles.v(i), particles.mass(i));
    o.add_strain_energy(of_particles * V * J * stored_energy(body, s));
  }
  CellEnergy const cells = body.cell_energy();
  o.add_strain_energy(k.stress_retention * cells.stored + cells.hourglass);
  o.totals.external_work += body.external_work();
  o.totals.damping_loss += body.damping_loss();
  o.add_oscillation(set, body.body(), pressure);
}

std::vector<FieldInfo> output_field_names() { return field_infos(offered); }

void sample(TaylorBody const& body, int body_number, std::string_view field, std::span<double> values) {
  PIOLA_EXPECTS(body_number >= 0);
  OutputField const& found = find_output_field(field, offered);
  Particles const& particles = body.particles();
  std::vector<double> drift(static_cast<std::size_t>(particles.count()));
  if (field == "StrainDrift") drift = strain_drift(body);
  for (Index i = 0; i < particles.count(); ++i) {
    ParticleOutput p;
    p.id = static_cast<double>(body.body().first + i);
    p.body = body_number;
    p.neighbours = body.neighbours(i);
    p.displacement = particles.displacement(i);
    p.x = particles.x(i);
    p.v = particles.v(i);
    p.cauchy = particles.stress(i);
    p.pressure = pressure_of(p.cauchy);
    p.J = particles.volume_ratio(i);
    p.inertia = p.density = body.state().k.rho0 / p.J;
    p.strain_drift = drift[static_cast<std::size_t>(i)];
    put(found, p, values);
  }
}

}  // namespace piola::taylor_sph
