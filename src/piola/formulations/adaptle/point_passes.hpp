// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/viscosity.hpp"
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
    if (!material.used) return;
    if (material.record != nullptr)
      write_record(i, s, out);
    else
      write_published(i, s, out);
  }

  /// Deleted particles have no volume; the rest of what they say does not matter.
  PIOLA_FN void write_record(Index i, State const& s, Half const& h) const {
    using R = MaterialRecord<D>;
    double* record = material.record + static_cast<std::ptrdiff_t>(i) * R::stride;
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

  PIOLA_FN void write_published(Index i, State const& s, Half const& h) const {
    using R = MotionRecord<D>;
    double* record = material.motion + static_cast<std::ptrdiff_t>(i) * R::stride;
    for (int c = 0; c < D; ++c) {
      record[R::X + c] = reference[i].X[c];
      record[R::u + c] = s.x[c] - reference[i].X[c];
      record[R::v + c] = h.v[c];
    }
    record[R::volume] = s.alive > 0 ? reference[i].volume : 0;
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
    if (material.record != nullptr)
      write_record(i, s, h, plane, J);
    else
      write_published(i, s, h, plane, J);
  }

  /// A = (1 - phi) V0 P K, with V0 P F^T = V sigma: with the current volume, which follows from the density where that
  /// is evolved.
  PIOLA_FN void write_record(Index i, State const& s, Half const& h, SymMat<D> const& stress, double J) const {
    using R = MaterialRecord<D>;
    double* A = material.record + static_cast<std::ptrdiff_t>(i) * R::stride + R::A;
    if (!(s.phi < 1 && s.alive > 0)) {
      for (int c = 0; c < D * D; ++c) A[c] = 0;
      return;
    }
    double const* K = material.moments[i].K;
    Deformation const& d = deformation[i];
    Mat<D> F, N;
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q) {
        F(p, q) = d.F[3 * p + q];
        N(p, q) = K[SymMat<D>::at(p, q)];
      }
    double const V0 = reference[i].volume, weight = (1 - s.phi) * (s.phi > 0 ? h.volume * h.thickness : J * V0),
                 share = s.phi > 0 ? 0 : 0.5 * V0, damping = share * damping_of(body),
                 stiffness = share * stiffness_of(body);
    Mat<D> const FN = transpose(inverse(F)) * N;
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q) {
        double sum = 0;
        for (int l = 0; l < D; ++l) sum += stress(p, l) * FN(l, q);
        A[p * D + q] = weight * sum - damping * d.rate[3 * p + q] - stiffness * (d.F[3 * p + q] - (p == q ? 1 : 0));
      }
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

  PIOLA_FN void write_published(Index i, State const& s, Half const& h, SymMat<D> const& stress, double J) const {
    using R = ForceRecord<D>;
    using V = ViscousRecord<D>;
    double *r = material.force + static_cast<std::ptrdiff_t>(i) * R::stride,
           *v = material.viscous + static_cast<std::ptrdiff_t>(i) * V::stride;
    Reference const& ref = reference[i];
    for (int c = 0; c < D; ++c) {
      r[R::X + c] = ref.X[c];
      r[R::x + c] = s.x[c];
      r[R::v + c] = h.v[c];
    }
    bool const printed = settings.interface_form == Interface::printed;
    r[R::phi] = s.alive > 0 ? s.phi : 1;
    r[R::volume] = s.alive > 0 ? ref.volume : 0;
    double const weight = s.alive > 0 ? (printed ? 1 : 1 - s.phi) : 0;
    // Eulerian particles of the printed interface have a deformation gradient only near total-Lagrangian ones.
    if (weight == 0 || (s.phi == 1 && !(deformation[i].gap >= 0))) {
      for (int c = R::A; c < R::volume; ++c) r[c] = 0;
      for (int c = 0; c < V::inverse_J; ++c) v[c] = 0;
      v[V::inverse_J] = v[V::rho] = 1;
      v[V::c] = body.c;
      v[V::viscosity] = s.viscosity;
      return;
    }
    Correction const& k = material.correction[i];
    if (s.phi == 1) J = determinant(matrix_of(deformation[i].F));
    Mat<D> F, N;
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q) {
        F(p, q) = deformation[i].F[3 * p + q];
        N(p, q) = k.K[3 * p + q] / k.S;
      }
    Mat<D> const F_inverse_transposed = transpose(inverse(F)), FN = F_inverse_transposed * N;
    // V sigma = V0 P F^T: with the current volume, which follows from the density where that is evolved.
    double const volume = s.phi > 0 && !printed ? h.volume * h.thickness : J * ref.volume;
    for (int p = 0; p < D; ++p) {
      r[R::a + p] = v[V::n + p] = 0;
      for (int q = 0; q < D; ++q) {
        double A = 0;
        for (int l = 0; l < D; ++l) A += stress(p, l) * FN(l, q);
        r[R::A + p * D + q] = weight * volume * A;
        v[V::N + p * D + q] = FN(p, q);
        r[R::a + p] += weight * volume * A * k.G[q] / k.S;
        v[V::n + p] += FN(p, q) * k.G[q] / k.S;
      }
    }
    v[V::inverse_J] = h.thickness / J;
    v[V::rho] = h.rho * h.thickness;
    v[V::c] = body.c;
    v[V::viscosity] = s.viscosity;
  }
};

}  // namespace piola::adaptle::inline PIOLA_MACHINE
