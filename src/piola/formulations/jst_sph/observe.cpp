// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/observe.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/common/output_fields.hpp"
#include "piola/formulations/common/sample_local.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <array>
#include <cmath>

namespace piola::jst_sph {
namespace {

bool evolves_volume(JstBody const& body) { return jst_sph::evolves_volume(body.options().variables); }

/// With filtered volumetric energy: the acting pressure; with the biharmonic term, whose total pressure is less
/// accurate, the smooth pressure (kappa / kappa_f) q.
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

/// State of a solid in rate form after the last step.
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
  if (is_hypoelastic(material)) with_any_law(material, [&](auto const& law) { f(SolidState{law.rho0}); });
}

/// det F minus the volume ratio that the volumetric energy sees, where that is another one.
double volume_mismatch(JstBody const& body, double J, Index i) {
  if (body.state().constants.kappa_filtered > 0) return J - seen_volume_ratio(body, i);
  return evolves_volume(body) ? J - body.J(i) : 0;
}

}  // namespace

void observe(JstBody const& body, JstObservation& o) {
  auto& d = o.totals;
  LatticeLineHalo* const lines = body.lines();
  std::vector<double> pressure(lines != nullptr ? 0 : static_cast<std::size_t>(body.particles()));
  bool const solid = is_hypoelastic(body.state().material);
  exec::ReproducibleSums<1> strain;
  o.begin_body(body.body().name);
  with_observed_law(body.state().material, [&](auto const& law) {
    for (Index i = body.own().first; i < body.own().last; ++i) {
      Mat<3> const F = body.F(i);
      double const V = body.volume(i), J = determinant(F), p = observed_pressure(body, law, F, i),
                   energy = V * stored_energy(body, law, F, i), mismatch = volume_mismatch(body, J, i);
      double const more[]{V * mismatch * mismatch, solid ? V * history(body, i, SolidFields::plastic_work) : 0};
      strain.add(&energy);
      o.mismatch_square_and_plastic_work.add(more);
      o.mismatch_max = maximum(o.mismatch_max, std::abs(mismatch));
      o.add_state(J, p, V);
      (lines != nullptr ? lines->pressure(i) : pressure[static_cast<std::size_t>(body.id(i) - body.body().first)]) = p;
      o.add_motion(body.x(i), body.v(i), V * law.rho0);
    }
  });
  if (body.shared()) comm::allreduce_sum(strain);
  double const hourglass_energy = body.hourglass_energy();
  o.add_strain_energy(strain.value() + hourglass_energy);
  o.hourglass_energy += hourglass_energy;
  if (body.options().hourglass())
    d.stabilisation_loss += body.state().totals.viscous_work - hourglass_energy - body.filtered_energy();
  d.stabilisation_loss += body.state().totals.stabilisation_loss;
  d.projection_loss += body.state().totals.projection_loss;
  d.external_work += body.external_work().over_ranks();
  d.damping_loss += body.state().totals.damping_loss;
  if (lines != nullptr)
    lines->add_oscillation(o);
  else
    o.add_oscillation(body.set(), body.body(), pressure);
}

Diagnostics finish(JstObservation o) {
  if (comm::is_parallel()) {
    o.share();
    comm::allreduce_sum(o.mismatch_square_and_plastic_work);
    comm::allreduce_max(o.mismatch_max);
  }
  Diagnostics d = o.finish();
  d.more = {{"volume_mismatch_rms", std::sqrt(o.mismatch_square_and_plastic_work.value(0) / o.volume())},
            {"volume_mismatch_max", o.mismatch_max},
            {"plastic_work", o.mismatch_square_and_plastic_work.value(1)},
            {"internal_energy", d.strain_energy},
            {"hourglass_energy", o.hourglass_energy}};
  return d;
}

namespace {

constexpr std::array<std::string_view, 18> offered{"Displacement",
                                                   "Position",
                                                   "Velocity",
                                                   "Momentum",
                                                   "Pressure",
                                                   "CauchyStress",
                                                   "FirstPiolaStress",
                                                   "DeformationGradient",
                                                   "Jacobian",
                                                   "VonMisesStress",
                                                   "Density",
                                                   "Neighbours",
                                                   "Body",
                                                   "Id",
                                                   "EquivalentPlasticStrain",
                                                   "Damage",
                                                   "Temperature",
                                                   "InternalEnergy"};
constexpr std::size_t of_every_law = 14;  ///< the others belong to solids in rate form

ParticleOutput motion_of(JstBody const& body, Index i) {
  ParticleOutput p;
  p.id = static_cast<double>(body.id(i));
  p.x = body.x(i);
  p.v = body.v(i);
  auto const X = body.X(i);
  for (std::size_t c = 0; c < 3; ++c) p.displacement[c] = p.x[c] - X[c];
  return p;
}

void add_history(JstBody const& body, Index i, ParticleOutput& p) {
  p.plastic_strain = history(body, i, SolidFields::plastic_strain);
  p.damage = history(body, i, SolidFields::damage);
  p.temperature = history(body, i, SolidFields::temperature);
  p.specific_energy = history(body, i, SolidFields::energy);
}

}  // namespace

std::vector<FieldInfo> output_field_names(bool solids) {
  return field_infos(std::span(offered).first(solids ? offered.size() : of_every_law));
}

namespace {

/// f(slot, particle) of the particles of this rank.
template <class F>
void observe_each(JstBody const& body, int body_number, std::string_view field, F const& f) {
  Range const own = body.own();
  if (field == "Displacement" || field == "Position" || field == "Velocity") {  // frequently needed, and without stress
    for (Index i = own.first; i < own.last; ++i) f(i, motion_of(body, i));
    return;
  }
  with_observed_law(body.state().material, [&](auto const& law) {
    for (Index i = own.first; i < own.last; ++i) {
      ParticleOutput p = motion_of(body, i);
      p.body = body_number;
      p.neighbours = body.pairs().corrections().neighbours_of(i);
      p.F = body.F(i);
      p.P = acting_stress(body, law, p.F, i);
      p.J = determinant(p.F);
      p.cauchy = cauchy_stress(p.P, p.F, p.J);
      p.pressure = observed_pressure(body, law, p.F, i);
      p.inertia = law.rho0;
      p.density = law.rho0 / p.J;
      if (is_hypoelastic(body.state().material)) add_history(body, i, p);
      f(i, p);
    }
  });
}

}  // namespace

void sample_local_slots(JstBody const& body, int body_number, std::string_view field, std::span<double> values) {
  piola::sample_local_slots(body, find_output_field(field, offered), values,
                            [&](auto const& f) { observe_each(body, body_number, field, f); });
}

void sample(JstBody const& body, int body_number, std::string_view field, std::span<double> values) {
  gather_field_on_root(body, find_output_field(field, offered), values,
                       [&](auto const& f) { observe_each(body, body_number, field, f); });
}

}  // namespace piola::jst_sph
