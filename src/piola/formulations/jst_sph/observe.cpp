// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/observe.hpp"
#include "piola/materials/solids.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace piola::jst_sph {
namespace {

using Point = std::array<double, 3>;

bool evolves_volume(JstBody const& body) { return jst_sph::evolves_volume(body.options().variables); }

/// Where the volumetric energy is filtered: the pressure that acts; with the biharmonic term, whose total pressure is
/// the less accurate one, the smooth pressure (kappa / kappa_f) q.
template <class Law>
double observed_pressure(JstBody const& body, Law const& law, Mat<3> const& F, Index i) {
  if constexpr (Law::volumetric_split) {
    auto const& k = body.state().constants;
    if (k.hourglass.modulus > 0 && k.kappa_filtered > 0)
      return k.kappa_local * (law.volume_ratio(F) - 1) + JstBody::value(body.state().filtered_pressure, i);
    if (k.kappa_filtered > 0) return law.kappa / k.kappa_filtered * JstBody::value(body.state().filtered_pressure, i);
    if (evolves_volume(body)) return law.kappa * (body.J(i) - 1);
  }
  if (evolves_volume(body)) return contract(law.stress(F, body.H(i), body.J(i)), F) / (3 * determinant(F));
  return law.pressure(F);
}

/// The filtered volume ratio, of the state as it is.
double seen_volume_ratio(JstBody const& body, Index i) {
  auto const& s = body.state();
  return JstBody::value(s.seen_ratio.data != nullptr ? s.seen_ratio : s.filtered_ratio, i);
}

/// P of the momentum equation.
template <class Law>
Mat<3> acting_stress(JstBody const& body, Law const& law, Mat<3> const& F, Index i) {
  auto const& state = body.state();
  if constexpr (Law::volumetric_split) {
    if (state.constants.kappa_filtered > 0) {
      double const p =
          state.constants.kappa_local * (law.volume_ratio(F) - 1) + JstBody::value(state.filtered_pressure, i);
      return law.stress_with_pressure(F, body.H(i), determinant(F), p);
    }
  }
  return evolves_volume(body) ? law.stress(F, body.H(i), body.J(i)) : law.first_piola(F);
}

template <class Law>
double stored_energy(JstBody const& body, Law const& law, Mat<3> const& F, Index i) {
  if constexpr (Law::volumetric_split) {
    auto const& k = body.state().constants;
    if (k.kappa_filtered > 0) {
      double const local = law.volume_ratio(F) - 1, filtered = seen_volume_ratio(body, i) - 1;
      return law.isochoric_energy(F) + 0.5 * k.kappa_local * local * local +
             0.5 * k.kappa_filtered * filtered * filtered;
    }
  }
  return evolves_volume(body) ? law.energy(F, body.H(i), body.J(i)) : law.energy(F);
}

double history(JstBody const& body, Index i, int c) { return JstBody::value(body.state().history, i, c); }

/// A solid in rate form, whose state the last step has left.
struct SolidState {
  double rho0;
};

double observed_pressure(JstBody const& body, SolidState const&, Mat<3> const&, Index i) {
  return -history(body, i, SolidFields::pressure);
}

Mat<3> acting_stress(JstBody const& body, SolidState const&, Mat<3> const& F, Index i) {
  SymMat<3> S;
  for (int c = 0; c < 6; ++c) S.c[c] = history(body, i, SolidFields::S + c);
  Mat<3> const pressed = history(body, i, SolidFields::pressure) * identity<3>();
  return (identity<3>() * S - pressed) * cofactor(F);
}

/// Internal energy, with that of plastic work.
double stored_energy(JstBody const& body, SolidState const& law, Mat<3> const&, Index i) {
  return law.rho0 * history(body, i, SolidFields::energy);
}

/// f(law) for hyperelastic laws, f(SolidState) for solids in rate form.
template <class F>
void with_observed_law(MaterialParameters const& material, F const& f) {
  with_law(material, f);
  if (is_solid(material)) with_any_law(material, [&](auto const& law) { f(SolidState{law.rho0}); });
}

/// det F minus the volume ratio that the volumetric energy sees, where that is another one.
double volume_mismatch(JstBody const& body, double J, Index i) {
  if (body.state().constants.kappa_filtered > 0) return J - seen_volume_ratio(body, i);
  return evolves_volume(body) ? J - body.J(i) : 0;
}

}  // namespace

void observe(JstBody const& body, JstObservation& o) {
  auto& d = o.totals;
  std::vector<double> pressure(static_cast<std::size_t>(body.particles()));
  bool const solid = is_solid(body.state().material);
  double strain = 0;
  o.open_body(body.body().name);
  with_observed_law(body.state().material, [&](auto const& law) {
    for (Index i = 0; i < body.particles(); ++i) {
      Mat<3> const F = body.F(i);
      double const V = body.volume(i), J = determinant(F), p = observed_pressure(body, law, F, i);
      strain += V * stored_energy(body, law, F, i);
      if (solid) o.plastic_work += V * history(body, i, SolidFields::plastic_work);
      double const mismatch = volume_mismatch(body, J, i);
      o.mismatch_square += V * mismatch * mismatch;
      o.mismatch_max = std::max(o.mismatch_max, std::abs(mismatch));
      o.add_state(J, p, V);
      pressure[static_cast<std::size_t>(body.id(i) - body.body().first)] = p;
      o.add_motion(body.x(i), body.v(i), V * law.rho0);
    }
  });
  o.add_strain_energy(strain + body.hourglass_energy());
  o.hourglass_energy += body.hourglass_energy();
  if (body.options().hourglass())
    d.stabilisation_loss += body.state().totals.viscous_work - body.hourglass_energy() - body.filtered_energy();
  d.stabilisation_loss += body.state().totals.stabilisation_loss;
  d.projection_loss += body.state().totals.projection_loss;
  d.external_work += body.state().totals.external_work;
  d.damping_loss += body.state().totals.damping_loss;
  o.add_oscillation(body.set(), body.body(), pressure);
}

Diagnostics finish(JstObservation const& o) {
  Diagnostics d = o.finish();
  d.more = {{"volume_mismatch_rms", std::sqrt(o.mismatch_square / o.volume)},
            {"volume_mismatch_max", o.mismatch_max},
            {"plastic_work", o.plastic_work},
            {"internal_energy", d.strain_energy},
            {"hourglass_energy", o.hourglass_energy}};
  return d;
}

namespace {

/// Everything an output formula may need of one particle.
struct Particle {
  Point X, x, v;
  Mat<3> F, P;
  double J, pressure, rho0, body, neighbours;
  double id;
  std::array<double, SolidFields::size> history;  ///< of solids in rate form; zeros else
};

Mat<3> cauchy(Particle const& p) { return (1.0 / p.J) * (p.P * transpose(p.F)); }

void put_symmetric(Mat<3> const& s, double* out) {
  static constexpr int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) out[k] = 0.5 * (s(row[k], column[k]) + s(column[k], row[k]));
}

double von_mises(Mat<3> const& s) {
  double const p = trace(s) / 3;
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double const dev = 0.5 * (s(i, j) + s(j, i)) - (i == j ? p : 0);
      sum += dev * dev;
    }
  return std::sqrt(1.5 * sum);
}

struct Observed {
  char const* name;
  char const* unit;
  int components;
  void (*put)(Particle const&, double*);
};

constexpr std::array table{
    Observed{"Displacement", "m", 3,
             [](Particle const& p, double* out) {
               for (std::size_t c = 0; c < 3; ++c) out[c] = p.x[c] - p.X[c];
             }},
    Observed{"Position", "m", 3, [](Particle const& p, double* out) { std::copy(p.x.begin(), p.x.end(), out); }},
    Observed{"Velocity", "m/s", 3, [](Particle const& p, double* out) { std::copy(p.v.begin(), p.v.end(), out); }},
    Observed{"Momentum", "kg/(m2 s)", 3,
             [](Particle const& p, double* out) {
               for (std::size_t c = 0; c < 3; ++c) out[c] = p.rho0 * p.v[c];
             }},
    Observed{"Pressure", "Pa", 1, [](Particle const& p, double* out) { *out = p.pressure; }},
    Observed{"CauchyStress", "Pa", 6, [](Particle const& p, double* out) { put_symmetric(cauchy(p), out); }},
    Observed{"FirstPiolaStress", "Pa", 9, [](Particle const& p, double* out) { std::copy(p.P.c, p.P.c + 9, out); }},
    Observed{"DeformationGradient", "1", 9, [](Particle const& p, double* out) { std::copy(p.F.c, p.F.c + 9, out); }},
    Observed{"Jacobian", "1", 1, [](Particle const& p, double* out) { *out = p.J; }},
    Observed{"VonMisesStress", "Pa", 1, [](Particle const& p, double* out) { *out = von_mises(cauchy(p)); }},
    Observed{"Density", "kg/m3", 1, [](Particle const& p, double* out) { *out = p.rho0 / p.J; }},
    Observed{"Neighbours", "1", 1, [](Particle const& p, double* out) { *out = p.neighbours; }},
    Observed{"Body", "1", 1, [](Particle const& p, double* out) { *out = p.body; }},
    Observed{"Id", "1", 1, [](Particle const& p, double* out) { *out = p.id; }}};

constexpr std::array solid_table{
    Observed{"EquivalentPlasticStrain", "1", 1,
             [](Particle const& p, double* out) { *out = p.history[SolidFields::plastic_strain]; }},
    Observed{"Damage", "1", 1, [](Particle const& p, double* out) { *out = p.history[SolidFields::damage]; }},
    Observed{"Temperature", "K", 1, [](Particle const& p, double* out) { *out = p.history[SolidFields::temperature]; }},
    Observed{"InternalEnergy", "J/kg", 1,
             [](Particle const& p, double* out) { *out = p.history[SolidFields::energy]; }}};

Observed find_observed(std::string_view field) {
  for (auto const& f : table)
    if (field == f.name) return f;
  for (auto const& f : solid_table)
    if (field == f.name) return f;
  throw std::invalid_argument("no field is named '" + std::string(field) + "'");
}

std::array<double, SolidFields::size> all_history(JstBody const& body, Index i) {
  std::array<double, SolidFields::size> r{};
  for (int c = 0; is_solid(body.state().material) && c < SolidFields::size; ++c)
    r[static_cast<std::size_t>(c)] = history(body, i, c);
  return r;
}

}  // namespace

std::vector<FieldInfo> observed_fields(bool solids) {
  std::vector<FieldInfo> r;
  r.reserve(std::size(table));
  for (auto const& f : table) r.push_back({f.name, f.unit, f.components});
  for (auto const& f : solid_table)
    if (solids) r.push_back({f.name, f.unit, f.components});
  return r;
}

void sample(JstBody const& body, int body_number, std::string_view field, std::span<double> values) {
  Observed const found = find_observed(field);
  if (field == "Displacement" || field == "Position" || field == "Velocity") {  // asked for often, and without stress
    for (Index i = 0; i < body.particles(); ++i) {
      Particle p{};
      p.X = body.X(i);
      p.x = body.x(i);
      p.v = body.v(i);
      found.put(p, &values[static_cast<std::size_t>(body.id(i) * found.components)]);
    }
    return;
  }
  with_observed_law(body.state().material, [&](auto const& law) {
    for (Index i = 0; i < body.particles(); ++i) {
      Mat<3> const F = body.F(i);
      Particle const p{body.X(i),
                       body.x(i),
                       body.v(i),
                       F,
                       acting_stress(body, law, F, i),
                       determinant(F),
                       observed_pressure(body, law, F, i),
                       law.rho0,
                       static_cast<double>(body_number),
                       static_cast<double>(body.pairs().corrections().neighbours_of(i)),
                       static_cast<double>(body.id(i)),
                       all_history(body, i)};
      found.put(p, &values[static_cast<std::size_t>(body.id(i) * found.components)]);
    }
  });
}

}  // namespace piola::jst_sph
