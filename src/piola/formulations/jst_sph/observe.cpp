// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/observe.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/common/output_fields.hpp"
#include "piola/formulations/common/sample_local.hpp"
#include "piola/materials/finite_increment.hpp"
#include "piola/materials/laws.hpp"
#include <array>
#include <cmath>

namespace piola::jst_sph {
namespace {

bool evolves_volume(JstBody const& body) { return jst_sph::evolves_volume(body.options().variables); }

/// With filtered volumetric energy the smooth pressure (kappa / kappa_f) q: the acting one is less accurate.
template <class Law>
double observed_pressure(JstBody const& body, Law const& law, Mat<3> const& F, Index i) {
  if constexpr (Law::volumetric_split) {
    auto const& k = body.state().constants;
    if (k.kappa_filtered > 0) return law.kappa / k.kappa_filtered * JstBody::value(body.state().filtered_pressure, i);
    if (evolves_volume(body)) return law.kappa * (body.J(i) - 1);
  }
  if (evolves_volume(body)) return contract(law.stress(F, body.H(i), body.J(i)), F) / (3 * determinant(F));
  return law.pressure(F);
}

double filtered_ratio(JstBody const& body, Index i) { return JstBody::value(body.state().filtered_ratio, i); }

/// P of the momentum equation.
template <class Law>
Mat<3> acting_stress(JstBody const& body, Law const& law, Mat<3> const& F, Index i) {
  auto const& state = body.state();
  if constexpr (Law::volumetric_split) {
    if (state.constants.kappa_filtered > 0) {
      double const p =
          state.constants.kappa_local * (law.volume_ratio(F) - 1) + JstBody::value(state.filtered_pressure, i);
      return law.stress_with_pressure(F, cofactor(F), determinant(F), p);
    }
  }
  return evolves_volume(body) ? law.stress(F, body.H(i), body.J(i)) : law.first_piola(F);
}

template <class Law>
double stored_energy(JstBody const& body, Law const& law, Mat<3> const& F, Index i) {
  if constexpr (Law::volumetric_split) {
    auto const& k = body.state().constants;
    if (k.kappa_filtered > 0) {
      double const local = law.volume_ratio(F) - 1, filtered = filtered_ratio(body, i) - 1;
      return law.isochoric_energy(F) + 0.5 * k.kappa_local * local * local +
             0.5 * k.kappa_filtered * filtered * filtered;
    }
  }
  return evolves_volume(body) ? law.energy(F, body.H(i), body.J(i)) : law.energy(F);
}

/// det F minus the volume ratio that the volumetric energy sees, where that is another one.
double volume_mismatch(JstBody const& body, double J, Index i) {
  if (body.state().constants.kappa_filtered > 0) return J - filtered_ratio(body, i);
  return evolves_volume(body) ? J - body.J(i) : 0;
}

}  // namespace

void add_diagnostics(JstBody const& body, JstDiagnosticsSum& o) {
  auto& d = o.totals;
  LatticeLineHalo* const lines = body.lattice_line_halo();
  std::vector<double> pressure(lines != nullptr ? 0 : static_cast<std::size_t>(body.particles()));
  exec::ReproducibleSums<1> strain;
  o.begin_body(body.body().name);
  with_law(body.state().material, [&](auto const& law) {
    for (Index i = body.own().first; i < body.own().last; ++i) {
      Mat<3> const F = body.F(i);
      double const V = body.volume(i), J = determinant(F), p = observed_pressure(body, law, F, i),
                   energy = V * stored_energy(body, law, F, i), mismatch = volume_mismatch(body, J, i);
      double const square = V * mismatch * mismatch;
      strain.add(&energy);
      o.mismatch_square.add(&square);
      o.mismatch_max = maximum(o.mismatch_max, std::abs(mismatch));
      o.add_state(J, p, V);
      (lines != nullptr ? lines->pressure(i) : pressure[static_cast<std::size_t>(body.id(i) - body.body().first)]) = p;
      o.add_motion(body.x(i), body.v(i), V * law.rho0);
    }
  });
  if (body.shared()) comm::allreduce_sum(strain);
  o.add_strain_energy(strain.value());
  d.stabilisation_loss += body.state().totals.stabilisation_loss;
  d.projection_loss += body.state().totals.projection_loss;
  d.external_work += body.external_work().over_ranks();
  d.damping_loss += body.state().totals.damping_loss;
  if (lines != nullptr)
    lines->add_oscillation(o);
  else
    o.add_oscillation(body.set(), body.body(), pressure);
}

Diagnostics finish(JstDiagnosticsSum o) {
  if (comm::is_parallel()) {
    o.share();
    comm::allreduce_sum(o.mismatch_square);
    comm::allreduce_max(o.mismatch_max);
  }
  Diagnostics d = o.finish();
  d.more = {{"volume_mismatch_rms", std::sqrt(o.mismatch_square.value() / o.volume())},
            {"volume_mismatch_max", o.mismatch_max}};
  return d;
}

namespace {

constexpr std::array<std::string_view, 14> offered{
    "Displacement",        "Position", "Velocity",       "Momentum", "Pressure",   "CauchyStress", "FirstPiolaStress",
    "DeformationGradient", "Jacobian", "VonMisesStress", "Density",  "Neighbours", "Body",         "Id"};

ParticleOutput motion_of(JstBody const& body, Index i) {
  ParticleOutput p;
  p.id = static_cast<double>(body.id(i));
  p.x = body.x(i);
  p.v = body.v(i);
  auto const X = body.X(i);
  for (std::size_t c = 0; c < 3; ++c) p.displacement[c] = p.x[c] - X[c];
  return p;
}

}  // namespace

std::vector<FieldInfo> output_field_names() { return field_infos(offered); }

namespace {

/// f(slot, particle) of the particles of this rank.
template <class F>
void observe_each(JstBody const& body, int body_number, std::string_view field, F const& f) {
  Range const own = body.own();
  if (field == "Displacement" || field == "Position" || field == "Velocity") {  // frequently needed, and without stress
    for (Index i = own.first; i < own.last; ++i) f(i, motion_of(body, i));
    return;
  }
  with_law(body.state().material, [&](auto const& law) {
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
      f(i, p);
    }
  });
}

}  // namespace

void sample_local_slots(JstBody const& body, int body_number, std::string_view field, std::span<double> values) {
  piola::sample_local_slots(body, find_output_field(field, offered), values,
                            [&](auto const& f) { observe_each(body, body_number, field, f); });
}

void sample_on_root(JstBody const& body, int body_number, std::string_view field, std::span<double> values) {
  PIOLA_EXPECTS(body_number >= 0);
  gather_field_on_root(body, find_output_field(field, offered), values,
                       [&](auto const& f) { observe_each(body, body_number, field, f); });
}

}  // namespace piola::jst_sph
