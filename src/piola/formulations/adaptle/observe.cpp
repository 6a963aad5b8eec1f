// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/observe.hpp"
#include "piola/formulations/adaptle/point_fields.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/formulations/observation.hpp"
#include "piola/formulations/observed.hpp"
#include <algorithm>
#include <array>

namespace piola::adaptle {
namespace {

constexpr std::array<std::string_view, 17> offered{"Displacement",
                                                   "Position",
                                                   "Velocity",
                                                   "Momentum",
                                                   "Pressure",
                                                   "CauchyStress",
                                                   "Jacobian",
                                                   "VonMisesStress",
                                                   "EquivalentPlasticStrain",
                                                   "Damage",
                                                   "Temperature",
                                                   "InternalEnergy",
                                                   "Density",
                                                   "KernelType",
                                                   "Neighbours",
                                                   "Body",
                                                   "Id"};

/// f(i, pressure positive in tension) for every particle.
template <class F>
void each_particle(System const& s, F const& f) {
  for (int b = 0; b < s.bodies; ++b)
    with_solid(s.body[b].material, [&](auto const& law) {
      PointFields const point(s.field, s.own);
      for (Index i = s.body[b].first; i < s.body[b].last; ++i) {
        double const specific = value_at(s.field.energy, i) / value_at(s.field.mass, i);
        f(i, -point.pressure<double>(law, i, value_at(s.field.rho, i), specific));
      }
    });
}

}  // namespace

std::vector<FieldInfo> observed_fields() { return field_infos(offered); }

void sample(Particles const& particles, std::string_view field, std::span<double> values) {
  ObservedField const& found = find_observed(field, offered);
  System const& s = particles.system();
  Fields const& f = particles.fields();
  std::vector<int> const spatial = particles.spatial().neighbours_by_slot(s);
  each_particle(s, [&](Index i, double pressure) {
    ObservedParticle p;
    p.id = static_cast<double>(particles.order().id(i));
    p.body = s.body_of[i];
    p.kernel_type = f.phi.at(i);
    p.neighbours = p.kernel_type > 0 ? spatial[at(i)] : particles.reference_neighbours(i);
    p.x = point_at(s.field.x, i, 3);
    p.v = point_at(s.field.v, i, 3);
    for (int c = 0; c < 3; ++c) p.displacement[at(c)] = p.x[at(c)] - f.X.at(i, c);
    p.pressure = pressure;
    for (int c = 0; c < 6; ++c) p.cauchy.c[c] = f.S.at(i, c) + (c < 3 ? pressure : 0);
    p.inertia = p.density = f.rho.at(i);
    p.J = s.body[s.body_of[i]].rho0 / p.density;
    p.plastic_strain = f.plastic_strain.at(i);
    p.damage = f.damage.at(i);
    p.temperature = f.temperature.at(i);
    p.specific_energy = f.energy.at(i) / f.mass.at(i);
    put(found, p, values);
  });
}

Diagnostics observe(Particles const& particles, ParticleSet const& set) {
  System const& s = particles.system();
  Fields const& f = particles.fields();
  Books const& books = particles.books();
  Observation o;
  std::vector<double> pressures(at(s.particles));
  exec::ExactSum internal_sum, plastic;
  double eulerian = 0, failed = 0, hottest = 0;
  each_particle(s, [&](Index i, double pressure) {
    if (i == s.body[s.body_of[i]].first) o.open_body(set.bodies[at(s.body_of[i])].name);
    double const rho0 = s.body[s.body_of[i]].rho0, mass = f.mass.at(i), energy = f.energy.at(i);
    pressures[particles.order().id(i)] = pressure;
    o.add_motion(point_at(s.field.x, i, 3), point_at(s.field.v, i, 3), mass);
    o.add_state(rho0 / f.rho.at(i), pressure, f.volume.at(i));
    internal_sum += energy;
    o.add_strain_energy(energy);
    plastic += mass / rho0 * f.plastic_work.at(i);
    eulerian += f.phi.at(i) > 0 ? 1 : 0;
    failed += f.damage.at(i) >= 1 || !(f.alive.at(i) > 0) ? 1 : 0;
    hottest = std::max(hottest, f.temperature.at(i));
  });
  for (Body const& body : set.bodies) {
    std::vector<double> const p(pressures.begin() + body.first, pressures.begin() + body.last);
    o.add_oscillation(set, body, p);
  }
  Diagnostics d = o.finish();
  double const internal = internal_sum.value();
  d.actions = particles.actions().report();
  d.strain_energy = internal + books.contact_energy + books.hourglass_energy;
  d.external_work = books.external_work;
  d.damping_loss = books.damping_loss;
  d.more = {{"internal_energy", internal},
            {"contact_energy", books.contact_energy},
            {"hourglass_energy", books.hourglass_energy},
            {"plastic_work", plastic.value()},
            {"viscous_loss", books.viscous_loss},
            {"artificial_stress_work", books.artificial_work},
            {"eulerian_particles", eulerian},
            {"converted_particles", books.converted},
            {"guard_conversions", books.by_guard},
            {"converted_mass", books.converted_mass},
            {"conversion_energy_change", books.energy_change},
            {"conversion_momentum_change", books.momentum_change},
            {"failed_particles", failed},
            {"deleted_particles", books.deleted},
            {"contact_overlap", books.overlap},
            {"temperature_max", hottest}};
  return d;
}

}  // namespace piola::adaptle
