// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/observe.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/point_fields.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/formulations/common/diagnostics_sum.hpp"
#include "piola/formulations/common/output_fields.hpp"
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

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

/// f(i, pressure positive in tension) for every particle of this rank of a body.
template <class F>
void each_particle(System const& s, int body, F const& f) {
  with_solid(s.body[body].material, [&](auto const& law) {
    PointFields const point(s.field, s.own);
    for (Index i = s.part[body].first; i < s.part[body].last; ++i) {
      double const specific = value_at(s.field.energy, i) / value_at(s.field.mass, i);
      f(i, -point.pressure<double>(law, i, value_at(s.field.rho, i), specific));
    }
  });
}

/// f(particle) for those of this rank, body by body.
template <class F>
void observe_each(Particles const& particles, F const& f) {
  System const& s = particles.system();
  Fields const& of = particles.fields();
  LazyZeroArray<int> const spatial = particles.spatial().neighbours_by_slot(s);
  auto const put = [&](Index i, double pressure) {
    ParticleOutput p;
    p.id = static_cast<double>(i);
    p.body = s.body_of[i];
    p.kernel_type = of.phi.at(i);
    p.neighbours = p.kernel_type > 0 ? spatial[at(i)] : particles.reference_neighbours(i);
    p.x = point_at(s.field.x, i, 3);
    p.v = point_at(s.field.v, i, 3);
    for (int c = 0; c < 3; ++c) p.displacement[at(c)] = p.x[at(c)] - of.X.at(i, c);
    p.pressure = pressure;
    for (int c = 0; c < 6; ++c) p.cauchy.c[c] = of.S.at(i, c) + (c < 3 ? pressure : 0);
    p.inertia = p.density = of.rho.at(i);
    p.J = s.body[s.body_of[i]].rho0 / p.density;
    p.plastic_strain = of.plastic_strain.at(i);
    p.damage = of.damage.at(i);
    p.temperature = of.temperature.at(i);
    p.specific_energy = of.energy.at(i) / of.mass.at(i);
    f(p);
  };
  for (int b = 0; b < s.bodies; ++b) each_particle(s, b, put);
}

/// Sums that are reduced over ranks, and columns of this formulation.
struct LocalSums {
  std::vector<exec::ReproducibleSums<1>> internal;  ///< of each body [J]
  exec::ReproducibleSums<3> others;                 ///< plastic work [J]; how many are Eulerian, and have failed
  double hottest = 0;                               ///< [K]

  /// But for the first. Collective.
  void share() {
    comm::allreduce_sum(others);
    comm::allreduce_max(hottest);
  }
};

/// Sums over the particles of this rank of one body.
void observe_body(Particles const& particles, ParticleSet const& set, int number, DiagnosticsSum& o, LocalSums& sums) {
  System const& s = particles.system();
  Fields const& f = particles.fields();
  Body const& body = set.bodies[at(number)];
  LatticeLineHalo* const lines = particles.distribution().lines(number);
  double const rho0 = s.body[number].rho0;
  std::vector<double> pressures(lines != nullptr ? 0 : static_cast<std::size_t>(body.last - body.first));
  exec::ReproducibleSums<1>& internal = sums.internal.emplace_back();
  o.begin_body(body.name);
  o.axisymmetric = set.axisymmetric;
  each_particle(s, number, [&](Index i, double pressure) {
    double const mass = f.mass.at(i), energy = f.energy.at(i);
    if (lines != nullptr)
      lines->pressure(i - s.body[number].first) = pressure;
    else
      pressures[at(i - body.first)] = pressure;
    o.add_motion(point_at(s.field.x, i, 3), point_at(s.field.v, i, 3), mass);
    o.add_state(rho0 / f.rho.at(i), pressure, f.volume.at(i));
    internal.add(&energy);
    double const others[]{mass / rho0 * f.plastic_work.at(i), f.phi.at(i) > 0 ? 1.0 : 0.0,
                          f.damage.at(i) >= 1 || !(f.active.at(i) > 0) ? 1.0 : 0.0};
    sums.others.add(others);
    sums.hottest = std::max(sums.hottest, f.temperature.at(i));
  });
  if (lines != nullptr)
    lines->add_oscillation(o);
  else
    o.add_oscillation(set, body, pressures);
}

}  // namespace

std::vector<FieldInfo> output_field_names() { return field_infos(offered); }

void sample_local_slots(Particles const& particles, std::string_view field, std::span<double> values) {
  OutputField const& found = find_output_field(field, offered);
  double* to = values.data();
  observe_each(particles, [&](ParticleOutput const& p) {
    found.put(p, to);
    to += found.components;
  });
}

void sample(Particles const& particles, std::string_view field, std::span<double> values) {
  OutputField const& found = find_output_field(field, offered);
  if (!comm::is_parallel()) return observe_each(particles, [&](ParticleOutput const& p) { put(found, p, values); });
  auto const width = static_cast<std::size_t>(found.components);
  std::vector<double> mine(particles.distribution().partition().count(comm::rank()) * width);
  sample_local_slots(particles, field, mine);
  particles.distribution().partition().collect(width, std::move(mine), values);
}

Diagnostics observe(Particles const& particles, ParticleSet const& set) {
  EnergyTotals const& energy_totals = particles.energy_totals();
  DiagnosticsSum o;
  LocalSums sums;
  for (int b = 0; b < particles.system().bodies; ++b) {
    observe_body(particles, set, b, o, sums);
    if (comm::is_parallel()) comm::allreduce_sum(sums.internal.back());
    o.add_strain_energy(sums.internal.back().value());
  }
  if (comm::is_parallel()) {
    o.share();
    sums.share();
  }
  Diagnostics d = o.finish();
  exec::ReproducibleSums<1> all;
  for (auto const& of_body : sums.internal) all.add(of_body);
  double const internal = all.value();
  d.actions = particles.boundary().resultants().report();
  d.strain_energy = internal + energy_totals.contact_energy + energy_totals.hourglass_energy;
  d.external_work = energy_totals.external_work;
  d.damping_loss = energy_totals.damping_loss;
  d.more = {{"internal_energy", internal},
            {"contact_energy", energy_totals.contact_energy},
            {"hourglass_energy", energy_totals.hourglass_energy},
            {"plastic_work", sums.others.value(0)},
            {"viscous_loss", energy_totals.viscous_loss},
            {"artificial_stress_work", energy_totals.artificial_work},
            {"eulerian_particles", sums.others.value(1)},
            {"converted_particles", energy_totals.converted},
            {"guard_conversions", energy_totals.by_guard},
            {"converted_mass", energy_totals.converted_mass},
            {"conversion_energy_change", energy_totals.energy_change},
            {"conversion_momentum_change", energy_totals.momentum_change},
            {"failed_particles", sums.others.value(2)},
            {"deleted_particles", energy_totals.deleted},
            {"contact_overlap", energy_totals.overlap},
            {"axis_crossings", energy_totals.axis_crossings},
            {"temperature_max", sums.hottest}};
  return d;
}

}  // namespace piola::adaptle
