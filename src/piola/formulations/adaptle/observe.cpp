// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/observe.hpp"
#include "piola/formulations/adaptle/point_passes.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/formulations/observation.hpp"
#include <algorithm>
#include <array>
#include <stdexcept>

namespace piola::adaptle {
namespace {

/// Everything an output formula may need of one particle. Pressure is positive in tension, as everywhere in output.
struct Point {
  State const& s;
  Reference const& r;
  double pressure, rho0, body, neighbours, id;
};

struct Observed {
  char const* name;
  char const* unit;
  int components;
  void (*put)(Point const&, double*);
};

void put_stress(Point const& p, double* out) {
  for (int c = 0; c < 6; ++c) out[c] = p.s.S[c] + (c < 3 ? p.pressure : 0);
}

constexpr std::array table{
    Observed{"Displacement", "m", 3,
             [](Point const& p, double* out) {
               for (int c = 0; c < 3; ++c) out[c] = p.s.x[c] - p.r.X[c];
             }},
    Observed{"Position", "m", 3, [](Point const& p, double* out) { std::copy_n(p.s.x, 3, out); }},
    Observed{"Velocity", "m/s", 3, [](Point const& p, double* out) { std::copy_n(p.s.v, 3, out); }},
    Observed{"Momentum", "kg/(m2 s)", 3,
             [](Point const& p, double* out) {
               for (int c = 0; c < 3; ++c) out[c] = p.s.rho * p.s.v[c];
             }},
    Observed{"Pressure", "Pa", 1, [](Point const& p, double* out) { *out = p.pressure; }},
    Observed{"CauchyStress", "Pa", 6, put_stress},
    Observed{"Jacobian", "1", 1, [](Point const& p, double* out) { *out = p.rho0 / p.s.rho; }},
    Observed{"VonMisesStress", "Pa", 1, [](Point const& p, double* out) { *out = von_mises(symmetric_of(p.s.S)); }},
    Observed{"EquivalentPlasticStrain", "1", 1, [](Point const& p, double* out) { *out = p.s.plastic_strain; }},
    Observed{"Damage", "1", 1, [](Point const& p, double* out) { *out = p.s.damage; }},
    Observed{"Temperature", "K", 1, [](Point const& p, double* out) { *out = p.s.temperature; }},
    Observed{"InternalEnergy", "J/kg", 1, [](Point const& p, double* out) { *out = p.s.energy / p.r.mass; }},
    Observed{"Density", "kg/m3", 1, [](Point const& p, double* out) { *out = p.s.rho; }},
    Observed{"KernelType", "1", 1, [](Point const& p, double* out) { *out = p.s.phi; }},
    Observed{"Neighbours", "1", 1, [](Point const& p, double* out) { *out = p.neighbours; }},
    Observed{"Body", "1", 1, [](Point const& p, double* out) { *out = p.body; }},
    Observed{"Id", "1", 1, [](Point const& p, double* out) { *out = p.id; }}};

/// f(i, pressure positive in tension) for every particle.
template <class F>
void each_particle(System const& s, F const& f) {
  for (int b = 0; b < s.bodies; ++b)
    with_solid(s.body[b].material, [&](auto const& law) {
      for (Index i = s.body[b].first; i < s.body[b].last; ++i) {
        State const& p = s.state[i];
        double const specific = p.energy / s.reference[i].mass;
        f(i, -acting_pressure(law, s.body[b], p, s.initial_pressure, i, p.rho, specific));
      }
    });
}

}  // namespace

std::vector<FieldInfo> observed_fields() {
  std::vector<FieldInfo> r;
  r.reserve(std::size(table));
  for (auto const& f : table) r.push_back({f.name, f.unit, f.components});
  return r;
}

void sample(Particles const& particles, std::string_view field, std::span<double> values) {
  auto const found = std::find_if(table.begin(), table.end(), [&](auto const& f) { return field == f.name; });
  if (found == table.end()) throw std::invalid_argument("no field is named '" + std::string(field) + "'");
  System const& s = particles.system();
  std::vector<int> const spatial = particles.spatial().neighbours_by_slot(s);
  each_particle(s, [&](Index i, double pressure) {
    int const body = s.body_of[i];
    Point const p{s.state[i],
                  s.reference[i],
                  pressure,
                  s.body[body].rho0,
                  static_cast<double>(body),
                  static_cast<double>(s.state[i].phi > 0 ? spatial[at(i)] : particles.reference_neighbours(i)),
                  static_cast<double>(i)};
    found->put(p, &values[at(i) * static_cast<std::size_t>(found->components)]);
  });
}

Diagnostics observe(Particles const& particles, ParticleSet const& set) {
  System const& s = particles.system();
  Books const& books = particles.books();
  Observation o;
  std::vector<double> pressures(at(s.particles));
  double internal = 0, plastic = 0, eulerian = 0, failed = 0, hottest = 0;
  each_particle(s, [&](Index i, double pressure) {
    State const& p = s.state[i];
    Reference const& r = s.reference[i];
    if (i == s.body[s.body_of[i]].first) o.open_body(set.bodies[at(s.body_of[i])].name);
    double const rho0 = s.body[s.body_of[i]].rho0;
    pressures[at(i)] = pressure;
    o.add_motion({p.x[0], p.x[1], p.x[2]}, {p.v[0], p.v[1], p.v[2]}, r.mass);
    o.add_state(rho0 / p.rho, pressure, r.volume);
    internal += p.energy;
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
  d.actions = particles.actions().report();
  d.strain_energy = internal + books.contact_energy;
  d.external_work = books.external_work;
  d.damping_loss = books.damping_loss;
  d.more = {{"internal_energy", internal},
            {"contact_energy", books.contact_energy},
            {"plastic_work", plastic},
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
