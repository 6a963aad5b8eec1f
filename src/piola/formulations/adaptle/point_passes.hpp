// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/material_pairs.hpp"
#include "piola/materials/solids.hpp"

/// What happens at one particle between the sweeps. The scheme drifts half a step, evaluates everything once at half
/// time with predicted rates, kicks, and drifts the other half.
namespace piola::adaptle::inline PIOLA_MACHINE {

PIOLA_FN SymMat<3> symmetric_of(double const* c) { return {{c[0], c[1], c[2], c[3], c[4], c[5]}}; }
PIOLA_FN Mat<3> matrix_of(double const* c) {
  Mat<3> m;
  for (int k = 0; k < 9; ++k) m.c[k] = c[k];
  return m;
}
PIOLA_FN SolidHistory history_of(State const& s, double const* S, OwnFactors const& own, Index i) {
  return {symmetric_of(S),
          s.plastic_strain,
          s.temperature,
          s.damage,
          s.plastic_work,
          s.bulking,
          own.burnt != nullptr ? own.burnt[i] : 1,
          own.toughness != nullptr ? own.toughness[i] : 1};
}

/// The pressure that a particle bears, positive in compression [Pa]: of the equation of state, without the tension that
/// a failed particle has released, with what the case adds. e: specific energy [J/kg].
template <class Law>
PIOLA_FN double acting_pressure(Law const& law, State const& s, OwnFactors const& own, Index i, double rho, double e) {
  if (!(s.alive > 0)) return 0;
  double p = law.pressure(history_of(s, s.S, own, i), rho, e);
  if (p < 0) p *= 1 - s.released;
  return own.initial_pressure != nullptr ? p - own.initial_pressure[i] : p;
}

/// Drifts to half time and predicts there with the rates of the step before. S is brought back to the yield surface
/// without a change of history.
template <int D, class Law>
struct Predict {
  Law law;
  double dt;
  Reference const* reference;
  State* state;
  Rates const* rates;
  Half* half;
  Sums* sums;
  double* position;
  MaterialTable material;
  bool published;  ///< material sums
  OwnFactors own;
  FailureSlot* failure;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index i = block.first; i < block.last; ++i) visit(i);
  }

 private:
  PIOLA_FN void visit(Index i) const {
    State& s = state[i];
    Rates const& k = rates[i];
    Half& out = half[i];
    double const step = 0.5 * dt;
    bool finite = true;
    for (int c = 0; c < 3; ++c) {
      out.v[c] = s.v[c] + step * k.a[c];
      s.x[c] += step * s.v[c];
      position[3 * i + c] = s.x[c];
      finite = finite && std::fabs(s.x[c]) < 1e30 && std::fabs(out.v[c]) < 1e30;
    }
    if (!finite) exec::record(failure, i, not_a_number);
    SymMat<3> trial;
    for (int c = 0; c < 6; ++c) trial.c[c] = s.S[c] + step * k.S[c];
    bool const bears = s.alive > 0 && s.released < 1;
    SymMat<3> const S = bears ? law.predicted(history_of(s, s.S, own, i), trial, k.flow, step) : SymMat<3>{};
    for (int c = 0; c < 6; ++c) out.S[c] = S.c[c];
    out.energy = s.energy + step * k.energy;
    out.thickness = s.thickness + step * k.thickness;
    out.rho = s.rho + step * k.rho;
    sums[i] = Sums{};
    if (material.used) write_record(i, s, out);
  }

  /// Deleted particles have no volume; the rest of what they say does not matter.
  PIOLA_FN void write_record(Index i, State const& s, Half const& h) const {
    using R = MaterialRecord<D>;
    RecordPlace const record = record_of<D>(material, published, i);
    for (int c = 0; c < D; ++c) {
      double const X = reference[i].X[c];
      record[R::u + c] = s.x[c] - X;
      record[R::v + c] = h.v[c];
      record[R::X + c] = X;
    }
    record[R::volume] = s.alive > 0 ? reference[i].volume : 0;
    double const factor = s.viscosity > 1e-300 ? s.viscosity : 1e-300;
    record[R::viscosity] = s.phi > 0 && s.alive > 0 ? -factor : factor;
  }
};

/// Density, pressure and volume of half time, and what neighbours read.
template <int D, bool Corrected, class Law>
struct HalfState {
  Law law;
  BodyConstants body;
  Settings settings;
  double dt;
  Reference const* reference;
  State const* state;
  Half* half;
  Deformation* deformation;
  OwnFactors own;
  SpatialTable spatial;    ///< records null: none are needed
  MaterialTable material;  ///< records null: none are needed
  FailureSlot* failure;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index i = block.first; i < block.last; ++i) visit(i);
  }

 private:
  PIOLA_FN void visit(Index i) const {
    State const& s = state[i];
    Half& h = half[i];
    double J = 1;
    if (material.used && s.phi < 1) {
      J = determinant(matrix_of(deformation[i].F));
      if (!(J > 0)) exec::record(failure, i, inverted);
    }
    if (!(s.phi > 0)) h.rho = body.rho0 / J;
    if (!(h.rho > 0)) exec::record(failure, i, negative_density);
    h.volume = reference[i].mass / (h.rho * h.thickness);
    double const specific = h.energy / reference[i].mass;
    h.pressure = acting_pressure(law, s, own, i, h.rho, specific);
    if constexpr (Law::pressed) {
      SolidHistory const history = history_of(s, h.S, own, i);
      SymMat<3> const S = law.returned(history, history.S, 0.5 * dt, h.pressure, h.rho / law.rho0);
      for (int c = 0; c < 6; ++c) h.S[c] = S.c[c];
    }
    h.c = law.sound_speed(h.rho, specific);
    SymMat<3> stress = symmetric_of(h.S);
    for (int c = 0; c < 3; ++c) stress.c[c] -= h.pressure;
    SymMat<D> plane;
    for (int p = 0; p < D; ++p)
      for (int q = p; q < D; ++q) plane(p, q) = stress(p, q);
    if (spatial.record != nullptr && (spatial.near == nullptr || spatial.near[i] != 0)) write_spatial(i, s, h, plane);
    if (!material.used) return;
    if (settings.published)
      write_published(i, s, h, plane, J);
    else
      write_record(i, s, h, plane, J);
  }

  /// The halves of damping and springs that A carries, per unit of dF/dt and of F - I: of total-Lagrangian particles.
  PIOLA_FN void add_hourglass(Index i, State const& s, RecordPlace const& A) const {
    if (s.phi > 0) return;
    Deformation const& d = deformation[i];
    double const share = 0.5 * reference[i].volume, damping = share * damping_of(body),
                 stiffness = settings.published ? 0 : share * stiffness_of(body);
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q)
        A[p * D + q] -= damping * d.rate[3 * p + q] + stiffness * (d.F[3 * p + q] - (p == q ? 1 : 0));
  }

  /// A = (1 - phi) V0 P K, with V0 P F^T = V sigma: with the current volume, which follows from the density where that
  /// is evolved.
  PIOLA_FN void write_record(Index i, State const& s, Half const& h, SymMat<D> const& stress, double J) const {
    RecordPlace const record = record_of<D>(material, false, i),
                      A{record.value + MaterialRecord<D>::A * record.step, record.step};
    if (!(s.phi < 1 && s.alive > 0)) {
      for (int c = 0; c < D * D; ++c) A[c] = 0;
      return;
    }
    double const* K = material.moments[i].K;
    Mat<D> F, N;
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q) {
        F(p, q) = deformation[i].F[3 * p + q];
        N(p, q) = K[SymMat<D>::at(p, q)];
      }
    double const weight = (1 - s.phi) * (s.phi > 0 ? h.volume * h.thickness : J * reference[i].volume);
    Mat<D> const FN = transpose(inverse(F)) * N;
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q) {
        double sum = 0;
        for (int l = 0; l < D; ++l) sum += stress(p, l) * FN(l, q);
        A[p * D + q] = weight * sum;
      }
    add_hourglass(i, s, A);
  }

  PIOLA_FN void write_spatial(Index i, State const& s, Half const& h, SymMat<D> const& stress) const {
    using R = SpatialRecord<D, Corrected>;
    double* r = spatial.record + static_cast<std::ptrdiff_t>(spatial.sorted[i]) * spatial.stride;
    for (int c = 0; c < D; ++c) {
      r[R::x + c] = s.x[c];
      r[R::v + c] = h.v[c];
    }
    double const rho = h.rho * h.thickness;
    r[R::volume] = h.volume;
    r[R::rho] = rho;
    r[R::c] = body.c;
    double const factor = s.viscosity > 1e-300 ? s.viscosity : 1e-300;
    r[R::viscosity] = s.phi > 0 ? factor : -factor;
    double const weight = settings.interface_form == Interface::printed ? 1 : s.phi;
    for (int c = 0; c < SymMat<D>::size; ++c) r[R::M + c] = weight * h.volume * h.thickness * stress.c[c];
    if (settings.artificial_stress) {
      SymMat<D> const R_a = piola::adaptle::artificial_stress<D>(stress, h.rho, body.artificial_stress);
      for (int c = 0; c < SymMat<D>::size; ++c) r[R::R + c] = R_a.c[c] / h.thickness;
    }
    if constexpr (Corrected)
      for (int c = R::M + SymMat<D>::size; c < R::R; ++c) r[c] = 0;
  }

  /// Of set (2): A, a, F^-T N, F^-T n and 1/J, which is also the density over that of the start.
  PIOLA_FN void write_published(Index i, State const& s, Half const& h, SymMat<D> const& stress, double J) const {
    using R = MaterialRecord<D>;
    RecordPlace const r = record_of<D>(material, true, i);
    bool const printed = settings.interface_form == Interface::printed;
    double const weight = s.alive > 0 ? (printed ? 1 : 1 - s.phi) : 0;
    // Eulerian particles of the printed interface have a deformation gradient only near total-Lagrangian ones.
    if (weight == 0 || (s.phi == 1 && !(deformation[i].gap >= 0))) {
      for (int c = R::A; c < R::inverse_J; ++c) r[c] = 0;
      r[R::inverse_J] = 1;
      return;
    }
    FoldedCorrection const& k = material.correction[i];
    if (s.phi == 1) J = determinant(matrix_of(deformation[i].F));
    Mat<D> F, N;
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q) {
        F(p, q) = deformation[i].F[3 * p + q];
        N(p, q) = k.N[3 * p + q];
      }
    Mat<D> const FN = transpose(inverse(F)) * N;
    // V sigma = V0 P F^T: with the current volume, which follows from the density where that is evolved.
    double const volume = weight * (s.phi > 0 && !printed ? h.volume * h.thickness : J * reference[i].volume);
    for (int p = 0; p < D; ++p) {
      double a = 0, n = 0;
      for (int q = 0; q < D; ++q) {
        double A = 0;
        for (int l = 0; l < D; ++l) A += stress(p, l) * FN(l, q);
        r[R::A + p * D + q] = volume * A;
        r[R::N + p * D + q] = FN(p, q);
        a += volume * A * k.G[q];
        n += FN(p, q) * k.G[q];
      }
      r[R::a + p] = a;
      r[R::n + p] = n;
    }
    r[R::inverse_J] = h.rho * h.thickness / body.rho0;
    add_hourglass(i, s, {r.value + R::A * r.step, r.step});
  }
};

}  // namespace piola::adaptle::inline PIOLA_MACHINE
