// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/point_passes.hpp"
#include "piola/formulations/adaptle/step_limits.hpp"

/// The second half of a step, from the sums of half time.
namespace piola::adaptle::inline PIOLA_MACHINE {

/// What the particles of a block say: sums and extrema, in the order of Measures.
struct BlockMeasures {
  static constexpr int contact = 0, hourglass = 1, rigid = 2, held = 3, load = 4, viscous = 5, sums = 6, dt = 6,
                       overlap = 7, wishes = 8, size = 9;
};

/// Equivalent strain sqrt(2/3 E':E') of the Green-Lagrange strain, eq. (18); in two dimensions with the strain across
/// the plane of plane stress, -nu/E (s_xx + s_yy), eq. (19).
template <int D>
PIOLA_FN double equivalent_strain(double const* F, SymMat<3> const& stress, BodyConstants const& b) {
  SymMat<3> E{};
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) {
      double sum = i == j ? -1 : 0;
      for (int k = 0; k < D; ++k) sum += F[3 * k + i] * F[3 * k + j];
      E(i, j) = 0.5 * sum;
    }
  if (D == 2) E(2, 2) = -b.poisson / b.young * (stress.c[0] + stress.c[1]);
  double const mean = (E.c[0] + E.c[1] + E.c[2]) / 3;
  double square = 0;
  for (int c = 0; c < 6; ++c) square += c < 3 ? (E.c[c] - mean) * (E.c[c] - mean) : 2 * E.c[c] * E.c[c];
  return std::sqrt(2.0 / 3.0 * square);
}

/// Kick, second drift, and update of density, stress, energy and history; stable step and wishes to convert.
template <int D, class Law>
struct Finish {
  Law law;
  BodyConstants body;
  Settings settings;
  double dt;
  System s;  ///< views of all particles
  double const* rigid_power;
  double* partial;

  PIOLA_FN void operator()(Range block, Index number) const {
    double* m = partial + static_cast<std::ptrdiff_t>(number) * BlockMeasures::size;
    for (int c = 0; c < BlockMeasures::size; ++c) m[c] = 0;
    StepLimits limits;
    for (Index i = block.first; i < block.last; ++i) visit(i, m, limits);
    m[BlockMeasures::dt] = limits.shortest(settings.cfl, body.h);
  }

 private:
  PIOLA_FN void visit(Index i, double* m, StepLimits& limits) const {
    State& p = s.state[i];
    Rates& k = s.rates[i];
    Half const& h = s.half[i];
    Sums const& sum = s.sums[i];
    double const mass = s.reference[i].mass;
    kick(i, p, k, sum, mass, m);
    Mat<3> const F_inverse = p.phi < 1 ? inverse(matrix_of(s.deformation[i].F)) : identity<3>();
    Mat<3> L = velocity_gradient(i, p, sum, F_inverse);
    if (settings.plane_stress) L(2, 2) = across(i, p, h, sum, L, mass);
    SymMat<3> const S_half = symmetric_of(h.S);
    bool const bears = p.alive > 0 && p.released < 1;
    SymMat<3> const S_rate = bears ? law.deviator_rate(S_half, L) : SymMat<3>{};
    double const trace_L = trace(L);
    k.rho = -h.rho * trace_L;
    p.rho = p.phi > 0 ? p.rho + dt * k.rho : h.rho;
    if (p.phi > 0) stay_in_kernel(p, k);
    k.thickness = h.thickness * L(2, 2);
    if (settings.plane_stress) p.thickness += dt * k.thickness;
    k.energy = (p.alive > 0 ? stress_power(h, S_half, L) : 0) + sum.heat;
    if (settings.viscosity == Viscosity::riemann) k.energy = sum.heat;
    p.energy += dt * k.energy;
    SymMat<3> trial;
    for (int c = 0; c < 6; ++c) {
      k.S[c] = S_rate.c[c];
      trial.c[c] = p.S[c] + dt * S_rate.c[c];
    }
    SolidHistory history = history_of(p, p.S, s.own, i);
    if (bears) {
      double const flow = law.update(history, trial, h.pressure, h.rho, dt, k.flow);
      if (flow > 0) k.flow = flow;
      if (body.releases && history.damage >= 1) release(p, history, h.rho);
    }
    for (int c = 0; c < 6; ++c) p.S[c] = bears ? history.S.c[c] : 0;
    p.plastic_strain = history.plastic_strain;
    p.temperature = history.temperature;
    p.damage = history.damage;
    p.plastic_work = history.plastic_work;
    p.bulking = history.bulking;
    switch_viscosity(p, k, h, L, trace_L);
    s.half[i].divergence = trace_L;
    m[BlockMeasures::contact] += sum.contact;
    m[BlockMeasures::hourglass] += sum.hourglass;
    m[BlockMeasures::viscous] += sum.heat;
    if (rigid_power != nullptr) m[BlockMeasures::rigid] += rigid_power[i];
    m[BlockMeasures::overlap] = sum.overlap > m[BlockMeasures::overlap] ? sum.overlap : m[BlockMeasures::overlap];
    limit_step(p, k, h, sum, mass, F_inverse, trace_L, limits);
    s.wish[i] = wish_of(i, p, h, S_half, F_inverse);
    m[BlockMeasures::wishes] += s.wish[i] != 0 ? 1 : 0;
    check(i, p);
  }

  /// A particle fills its kernel at most: what flies apart further has no neighbours left, and two such particles would
  /// see each other's volume grow without bound.
  PIOLA_FN void stay_in_kernel(State& p, Rates& k) const {
    if (!(p.rho < body.least_rho)) return;
    p.rho = body.least_rho;
    if (k.rho < 0) k.rho = 0;
  }

  /// A failed particle loses its deviator over the time in which shear waves cross its support, 2h/c_s, so that it
  /// sends no shock. The elastic energy of what is lost is not given back: it becomes heat, and counts as plastic work.
  PIOLA_FN void release(State& p, SolidHistory& history, double rho) const {
    double const before = 1 - p.released;
    p.released += dt * law.s_wave_speed() / (2 * body.h);
    if (!(p.released < 1)) p.released = 1;
    double const factor = (1 - p.released) / before;
    double square = 0;
    for (int c = 0; c < 6; ++c) square += (c < 3 ? 1 : 2) * history.S.c[c] * history.S.c[c];
    history.plastic_work += square * (1 - factor * factor) / (4 * law.mu) * body.rho0 / rho;
    for (double& S : history.S.c) S *= factor;
  }

  PIOLA_FN void kick(Index i, State& p, Rates& k, Sums const& sum, double mass, double* m) const {
    double const per_mass = 1 / mass;
    for (int c = 0; c < D; ++c) {
      double a = sum.force[c] * per_mass;
      double const before = p.v[c];
      if (s.load != nullptr) {
        double const push = s.load[3 * i + c];
        a += push;
        m[BlockMeasures::load] += mass * push * (before + 0.5 * dt * a);
      }
      if (s.held != nullptr) s.reaction[3 * i + c] = 0;
      if (s.held != nullptr && s.held[3 * i + c] != 0 && !(dt > 0)) {
        a = 0;  // before the first step: velocities are as they were given
      } else if (s.held != nullptr && s.held[3 * i + c] != 0) {
        double const wanted = (s.held_velocity[3 * i + c] - before) / dt;
        s.reaction[3 * i + c] = mass * (wanted - a);
        m[BlockMeasures::held] += mass * (wanted - a) * (before + 0.5 * dt * wanted);
        a = wanted;
        p.v[c] = s.held_velocity[3 * i + c];
      } else {
        p.v[c] = before + dt * a;
      }
      k.a[c] = a;
      p.x[c] += 0.5 * dt * p.v[c];
    }
  }

  /// phi (spatial) + (1 - phi) (material), in three dimensions.
  PIOLA_FN Mat<3> velocity_gradient(Index i, State const& p, Sums const& sum, Mat<3> const& F_inverse) const {
    Mat<3> L = matrix_of(sum.L);
    if (!(p.phi < 1)) return L;
    Mat<3> const material = matrix_of(s.deformation[i].rate) * F_inverse;
    for (int c = 0; c < 9; ++c) L.c[c] = p.phi * L.c[c] + (1 - p.phi) * material.c[c];
    return L;
  }

  /// V sigma : L, with the volume that carries the stress.
  PIOLA_FN double stress_power(Half const& h, SymMat<3> const& S, Mat<3> const& L) const {
    double power = 0;
    for (int a = 0; a < 3; ++a) power += (S(a, a) - h.pressure) * L(a, a);
    power += S(0, 1) * (L(0, 1) + L(1, 0)) + S(0, 2) * (L(0, 2) + L(2, 0)) + S(1, 2) * (L(1, 2) + L(2, 1));
    return h.volume * h.thickness * power;
  }

  /// Plane stress: the rate of strain across the plane for which the stress there vanishes at the end of the step, by
  /// the secant method.
  PIOLA_FN double across(Index i, State const& p, Half const& h, Sums const& sum, Mat<3> L, double mass) const {
    auto const stress = [&](double rate) {
      L(2, 2) = rate;
      SymMat<3> const r = law.deviator_rate(symmetric_of(h.S), L);
      SymMat<3> trial;
      for (int c = 0; c < 6; ++c) trial.c[c] = p.S[c] + dt * r.c[c];
      SymMat<3> const S = law.returned(history_of(p, p.S, s.own, i), trial, dt, h.pressure, h.rho / law.rho0);
      double const energy = p.energy + dt * (stress_power(h, symmetric_of(h.S), L) + sum.heat);
      // A total-Lagrangian density follows from the thickness that the step will end with.
      double const end = p.thickness + dt * h.thickness * rate;
      double const rho =
          p.phi > 0 ? p.rho - dt * h.rho * trace(L) : h.rho * (1 - 0.5 * dt * (L(0, 0) + L(1, 1))) * h.thickness / end;
      return S.c[2] - acting_pressure(law, p, s.own, i, rho, energy / mass);
    };
    double const bulk = law.kappa, inverse = 1 / (dt * (bulk + 4.0 / 3.0 * law.mu));
    double a = -(bulk - 2.0 / 3.0 * law.mu) / (bulk + 4.0 / 3.0 * law.mu) * (L(0, 0) + L(1, 1)), f_a = stress(a);
    if (!(dt > 0)) return a;
    double b = a - f_a * inverse;
    for (int k = 0; k < 12; ++k) {
      double const f_b = stress(b);
      if (!(std::fabs(f_b) > 1e-9 * bulk * 1e-3) || f_b == f_a) break;
      double const next = b - f_b * (b - a) / (f_b - f_a);
      a = b;
      f_a = f_b;
      b = next;
    }
    return b;
  }

  PIOLA_FN void switch_viscosity(State& p, Rates& k, Half const& h, Mat<3> const& L, double divergence) const {
    if (settings.viscosity == Viscosity::compression)
      p.viscosity = compression_factor(L, h.c, body.h, p.phi > 0 ? eulerian_floor : compression_floor);
    if (settings.viscosity == Viscosity::balsara) p.viscosity = balsara_factor(L, h.c, body.h);
    if (settings.viscosity == Viscosity::morris_monaghan) {
      // d alpha/dt = -(alpha - 0.1) / tau + max(-div v, 0), tau = h / (0.2 c); alpha stays at or below its full value.
      double const least = 0.1 / (body.alpha > 0.1 ? body.alpha : 0.1), tau = body.h / (0.2 * h.c);
      k.viscosity = -(p.viscosity - least) / tau + (divergence < 0 ? -divergence / body.alpha : 0);
      double const next = p.viscosity + dt * k.viscosity;
      p.viscosity = next < least ? least : (next > 1 ? 1 : next);
    }
  }

  PIOLA_FN void limit_step(State const& p, Rates const& k, Half const& h, Sums const& sum, double mass,
                           Mat<3> const& F_inverse, double divergence, StepLimits& limits) const {
    double const length = p.phi < 1 ? minimum(body.h, body.material_h) : body.h;
    double const rate = std::fabs(divergence) > sum.closing ? std::fabs(divergence) : sum.closing;
    limits.add(p.phi < 1 && p.alive > 0 ? &F_inverse : nullptr, length, h.c + 0.6 * body.beta * sum.compression, k.a,
               mass, sum.stiffness, rate);
  }

  /// 1: convert with the neighbours, 2: alone, 0: stay.
  PIOLA_FN std::int8_t wish_of(Index i, State const& p, Half const& h, SymMat<3> const& S,
                               Mat<3> const& inverse_F) const {
    if (p.phi > 0 && p.phi < 1) {
      // Blended: wholly Eulerian once the deformation gradient is of no use.
      double const J = determinant(matrix_of(s.deformation[i].F));
      return J >= body.jacobian_min && J <= body.jacobian_max ? 0 : 2;
    }
    if (!(body.adaptive || body.deletes) || p.phi > 0 || !(p.alive > 0)) return 0;
    double const J = body.rho0 / h.rho;
    SymMat<3> stress = S;
    for (int c = 0; c < 3; ++c) stress.c[c] -= h.pressure;
    double const* F = s.deformation[i].F;
    if (law.damages && p.damage >= body.convert_damage) return 1;
    if (body.convert_strain < 1e300 && equivalent_strain<D>(F, stress, body) >= body.convert_strain) return 1;
    bool const outside = !(J >= body.jacobian_min && J <= body.jacobian_max);
    double size = 0, inverse_size = 0;
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) {
        size += F[3 * a + b] * F[3 * a + b];
        inverse_size += inverse_F(a, b) * inverse_F(a, b);
      }
    double const most = body.jacobian_max * body.jacobian_max * D;
    if (outside || !(size <= most) || !(inverse_size <= most)) return 2;
    if (body.tether > 0 && s.deformation[i].gap > body.tether) return 2;
    return 0;
  }

  PIOLA_FN void check(Index i, State const& p) const {
    double sum = p.energy + p.rho + p.S[0] + p.S[1] + p.S[3];
    for (int c = 0; c < D; ++c) sum += p.v[c];
    if (!(std::fabs(sum) < 1e300)) exec::record(s.failure, i, not_a_number);
    if (!(p.rho > 0)) exec::record(s.failure, i, negative_density);
  }
};

}  // namespace piola::adaptle::inline PIOLA_MACHINE
