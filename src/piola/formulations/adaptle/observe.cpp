// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/observe.hpp"
#include "piola/formulations/adaptle/point_passes.hpp"
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
      for (Index i = s.body[b].first; i < s.body[b].last; ++i) {
        State const& p = s.state[i];
        double const specific = p.energy / s.reference[i].mass;
        f(i, -acting_pressure(law, p, s.own, i, p.rho, specific));
      }
    });
}

}  // namespace

std::vector<FieldInfo> observed_fields() { return field_infos(offered); }

void sample(Particles const& particles, std::string_view field, std::span<double> values) {
  ObservedField const& found = find_observed(field, offered);
  System const& s = particles.system();
  std::vector<int> const spatial = particles.spatial().neighbours_by_slot(s);
  each_particle(s, [&](Index i, double pressure) {
    State const& now = s.state[i];
    ObservedParticle p;
    p.id = static_cast<double>(particles.order().id(i));
    p.body = s.body_of[i];
    p.neighbours = now.phi > 0 ? spatial[at(i)] : particles.reference_neighbours(i);
    std::copy_n(now.x, 3, p.x.begin());
    std::copy_n(now.v, 3, p.v.begin());
    for (std::size_t c = 0; c < 3; ++c) p.displacement[c] = p.x[c] - s.reference[i].X[c];
    p.pressure = pressure;
    for (int c = 0; c < 6; ++c) p.cauchy.c[c] = now.S[c] + (c < 3 ? pressure : 0);
    p.J = s.body[s.body_of[i]].rho0 / now.rho;
    p.inertia = p.density = now.rho;
    p.plastic_strain = now.plastic_strain;
    p.damage = now.damage;
    p.temperature = now.temperature;
    p.specific_energy = now.energy / s.reference[i].mass;
    p.kernel_type = now.phi;
    put(found, p, values);
  });
}

Diagnostics observe(Particles const& particles, ParticleSet const& set) {
  System const& s = particles.system();
  Books const& books = particles.books();
  Observation o;
  std::vector<double> pressures(at(s.particles));
  exec::ExactSum internal_sum, plastic;
  double eulerian = 0, failed = 0, hottest = 0;
  each_particle(s, [&](Index i, double pressure) {
    State const& p = s.state[i];
    Reference const& r = s.reference[i];
    if (i == s.body[s.body_of[i]].first) o.open_body(set.bodies[at(s.body_of[i])].name);
    double const rho0 = s.body[s.body_of[i]].rho0;
    pressures[particles.order().id(i)] = pressure;
    o.add_motion({p.x[0], p.x[1], p.x[2]}, {p.v[0], p.v[1], p.v[2]}, r.mass);
    o.add_state(rho0 / p.rho, pressure, r.volume);
    internal_sum += p.energy;
    o.add_strain_energy(p.energy);
    plastic += r.mass / rho0 * p.plastic_work;
    eulerian += p.phi > 0 ? 1 : 0;
    failed += p.damage >= 1 || !(p.alive > 0) ? 1 : 0;
    hottest = std::max(hottest, p.temperature);
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
