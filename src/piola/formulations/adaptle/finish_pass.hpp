// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/kick_pass.hpp"
#include "piola/formulations/adaptle/plane_stress.hpp"
#include "piola/formulations/adaptle/step_limits.hpp"

/// The second half of a step, from the sums at half time.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Equivalent strain sqrt(2/3 E':E') of the Green-Lagrange strain, eq. (18); in two dimensions with the strain across
/// the plane of plane stress, -nu/E (s_xx + s_yy), eq. (19).
template <int D, class V>
PIOLA_FN V equivalent_strain(Mat<3, V> const& F, SymMat<3, V> const& stress, BodyConstants const& b) {
  SymMat<3, V> E;
  for (V& c : E.c) c = V(0.0);
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) {
      V sum(i == j ? -1.0 : 0.0);
      for (int k = 0; k < D; ++k) sum += F(k, i) * F(k, j);
      E(i, j) = 0.5 * sum;
    }
  if (D == 2 && b.axisymmetric)
    E(2, 2) = 0.5 * (F(2, 2) * F(2, 2) - 1.0);
  else if (D == 2)
    E(2, 2) = -b.poisson / b.young * (stress.c[0] + stress.c[1]);
  V const mean = (E.c[0] + E.c[1] + E.c[2]) / 3.0;
  V square(0.0);
  for (int c = 0; c < 6; ++c) square += c < 3 ? (E.c[c] - mean) * (E.c[c] - mean) : 2.0 * E.c[c] * E.c[c];
  return square_root(2.0 / 3.0 * square);
}

/// Law-independent end of a step: switch of the viscosity, stable step, conversion requests, admissibility.
template <int D>
struct StepEnd {
  BodyConstants body;
  Settings settings;
  bool damages;  ///< whether the law has damage
  double dt;
  MaterialTable material;
  FilledKernel filled;
  Components x, thickness, mass, S, rho, energy, v, a, phi, active, damage, S_half, pressure, rho_half, c, F, gap,
      hourglass, contact;
  OwnComponents viscosity;
  double const* rigid_power;
  std::int8_t* conversion_request;
  FailureSlot* failure;

  PIOLA_SHARED inline StepEnd(System const& s, BodyConstants const& of, MaterialTable const& table, bool law_damages,
                              double step)
      : body(of),
        settings(s.settings),
        damages(law_damages),
        dt(step),
        material(table),
        filled(s, of),
        x(read(s.field.x)),
        thickness(read(s.field.thickness)),
        mass(read(s.field.mass)),
        S(read(s.field.S)),
        rho(read(s.field.rho)),
        energy(read(s.field.energy)),
        v(read(s.field.v)),
        a(read(s.field.a)),
        phi(read(s.field.phi)),
        active(read(s.field.active)),
        damage(read(s.field.damage)),
        S_half(read(s.field.S_half)),
        pressure(read(s.field.pressure)),
        rho_half(read(s.field.rho_half)),
        c(read(s.field.c)),
        F(read(s.field.F)),
        gap(read(s.field.gap)),
        hourglass(read(s.field.hourglass)),
        contact(read(s.field.contact)),
        viscosity(write(s.field.viscosity)),
        rigid_power(s.rigid.count > 0 ? s.rigid.power : nullptr),
        conversion_request(s.description.request),
        failure(s.failure) {}

  PIOLA_SHARED PIOLA_FN void operator()(Range block, BlockScratch const& scratch, double* m) const {
    Lanes least(1e300), overlap(0.0), sums[BlockMeasures::sums];
    for (Lanes& sum : sums) sum = Lanes(0.0);
    each_group(block, [&](Group g) {
      Index const i = g.first;
      auto const real = g.mask();
      auto const add = [&](int which, Lanes const& value) { sums[which] += select(real, value, Lanes(0.0)); };
      Mat<3, Lanes> const L = scratch.gradient(g);
      switch_viscosity(g, L);
      Lanes const artificial = scratch.artificial_at(g);
      add(BlockMeasures::viscous, scratch.heat_at(g) - artificial);
      add(BlockMeasures::artificial, artificial);
      if (hourglass.data != nullptr) add(BlockMeasures::hourglass, hourglass.scalar<Lanes>(i));
      if (contact.data != nullptr) {
        add(BlockMeasures::contact, contact.scalar<Lanes>(i, ContactSum::power));
        overlap = maximum(overlap, select(real, contact.scalar<Lanes>(i, ContactSum::overlap), Lanes(0.0)));
      }
      if (rigid_power != nullptr) add(BlockMeasures::rigid, load<Lanes>(rigid_power + i));
      Mat<3, Lanes> inverse_F = identity<3, Lanes>();
      if (material.used && any(phi.scalar<Lanes>(i) < 1.0)) inverse_F = inverse(F.matrix<Lanes>(i));
      if (settings.axisymmetric) inverse_F(2, 2) = Lanes(1.0);  // lengths in the section
      Lanes const step = limit(g, scratch, L, inverse_F);
      least = StepLimit::shorter(least, select(real, step, Lanes(1e300)));
      m[BlockMeasures::conversion_requests] += make_requests(g, inverse_F);
      check(g);
    });
    for (int k = 0; k < BlockMeasures::sums; ++k) m[k] += sum_of_lanes(sums[k]);
    m[BlockMeasures::dt] = -largest_of(-least);
    m[BlockMeasures::overlap] = largest_of(overlap);
  }

 private:
  PIOLA_FN void switch_viscosity(Group g, Mat<3, Lanes> const& L) const {
    Index const i = g.first;
    Lanes const sound = c.scalar<Lanes>(i);
    if (settings.viscosity == Viscosity::compression)
      viscosity.put(
          g, compression_factor(L, sound, body.h,
                                select(phi.scalar<Lanes>(i) > 0.0, Lanes(eulerian_floor), Lanes(compression_floor))));
    if (settings.viscosity == Viscosity::balsara) viscosity.put(g, balsara_factor(L, sound, body.h));
    if (settings.viscosity == Viscosity::morris_monaghan) {
      // d alpha/dt = -(alpha - 0.1) / tau + max(-div v, 0), tau = h / (0.2 c); alpha stays at or below its full value.
      double const least = 0.1 / (body.alpha > 0.1 ? body.alpha : 0.1);
      Lanes const tau = body.h / (0.2 * sound), divergence = trace(L), before = viscosity.seen().scalar<Lanes>(i);
      Lanes const next =
          before + dt * (select(divergence < 0.0, -divergence / body.alpha, Lanes(0.0)) - (before - least) / tau);
      viscosity.put(g, select(next < least, Lanes(least), select(next > 1.0, Lanes(1.0), next)));
    }
  }

 public:
  /// The stable step [s]. L: velocity gradient; inverse_F: identity where there is no material pair.
  PIOLA_FN Lanes limit(Group g, BlockScratch const& scratch, Mat<3, Lanes> const& L,
                       Mat<3, Lanes> const& inverse_F) const {
    Index const i = g.first;
    Lanes const one(1.0), none(0.0);
    Lanes divergence = magnitude(trace(L));
    if (settings.axisymmetric) divergence = select(fills_kernel(i), none, divergence);
    auto const lagrangian = phi.scalar<Lanes>(i) < 1.0;
    Vec<3, Lanes> const acceleration = a.vector<3, Lanes>(i);
    bool const touching = contact.data != nullptr;
    Lanes const closing = touching ? contact.scalar<Lanes>(i, ContactSum::closing) : none;
    StepLimit const limits{
        select(lagrangian && active.scalar<Lanes>(i) > 0.0, StepLimit::stretch_squared(inverse_F), one),
        select(lagrangian, Lanes(minimum(body.h, body.reference_h)), Lanes(body.h)),
        sheared_cfl(i),
        c.scalar<Lanes>(i) + 0.6 * body.beta * scratch.compression_at(g),
        dot(acceleration, acceleration),
        mass.scalar<Lanes>(i),
        touching ? contact.scalar<Lanes>(i, ContactSum::stiffness) : none,
        select(divergence > closing, divergence, closing)};
    return limits.step(settings.cfl, body.h);
  }

  /// Courant number of the compressed length. Nearly `body.sheared_cfl` in shear, where the viscosity has almost no
  /// effect, and settings.cfl where all of it acts.
  PIOLA_FN Lanes sheared_cfl(Index i) const {
    return body.sheared_cfl - (body.sheared_cfl - settings.cfl) * viscosity.seen().scalar<Lanes>(i);
  }

 private:
  /// Whether a limit of FilledKernel holds for a ring, which then changes no volume.
  PIOLA_FN auto fills_kernel(Index i) const {
    constexpr double rounding = 1 + 1e-12;
    Lanes const density = rho.scalar<Lanes>(i);
    return phi.scalar<Lanes>(i) > 0.0 && (density <= rounding * filled.least_density(i, x.scalar<Lanes>(i)) ||
                                          thickness.scalar<Lanes>(i) <= rounding * filled.least_thickness(i, density));
  }

  /// Sets conversion requests: 1: with the neighbours, 2: alone, 0: none. Returns the number of requests.
  PIOLA_FN int make_requests(Group g, Mat<3, Lanes> const& inverse_F) const {
    Lanes const blend = phi.scalar<Lanes>(g.first);
    auto const blended = blend > 0.0 && blend < 1.0;
    for (int l = 0; l < g.count; ++l) conversion_request[g.first + l] = 0;
    bool const may = body.adaptive || body.deletes;
    if (!may && !any(g.mask() && blended)) return 0;
    if (!material.used) return 0;
    Lanes r(0.0);
    if (may) r = select(!(blend > 0.0) && active.scalar<Lanes>(g.first) > 0.0, request_of(g.first, inverse_F), r);
    // Blended particles become fully Eulerian once the deformation gradient is unusable.
    Lanes const J = determinant(F.matrix<Lanes>(g.first));
    r = select(blended && !(J >= body.jacobian_min && J <= body.jacobian_max), Lanes(2.0), r);
    int conversion_requests = 0;
    for (int l = 0; l < g.count; ++l) {
      conversion_request[g.first + l] = static_cast<std::int8_t>(lane(r, l));
      conversion_requests += conversion_request[g.first + l] != 0 ? 1 : 0;
    }
    return conversion_requests;
  }

  PIOLA_FN Lanes request_of(Index i, Mat<3, Lanes> const& inverse_F) const {
    Mat<3, Lanes> const gradient = F.matrix<Lanes>(i);
    Lanes const J = body.rho0 / rho_half.scalar<Lanes>(i);
    Lanes size(0.0), inverse_size(0.0);
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q) {
        size += gradient(p, q) * gradient(p, q);
        inverse_size += inverse_F(p, q) * inverse_F(p, q);
      }
    double const most = body.jacobian_max * body.jacobian_max * D;
    auto alone = !(J >= body.jacobian_min && J <= body.jacobian_max) || !(size <= most) || !(inverse_size <= most);
    if (body.tether > 0) alone = alone || gap.scalar<Lanes>(i) > body.tether;
    Lanes r = select(alone, Lanes(2.0), Lanes(0.0));
    if (body.convert_strain < 1e300) {
      SymMat<3, Lanes> stress = S_half.symmetric<Lanes>(i);
      for (int k = 0; k < 3; ++k) stress.c[k] -= pressure.scalar<Lanes>(i);
      r = select(equivalent_strain<D>(gradient, stress, body) >= body.convert_strain, Lanes(1.0), r);
    }
    if (damages) r = select(damage.scalar<Lanes>(i) >= body.convert_damage, Lanes(1.0), r);
    return r;
  }

  PIOLA_FN void check(Group g) const {
    Index const i = g.first;
    Lanes const density = rho.scalar<Lanes>(i);
    Lanes sum =
        energy.scalar<Lanes>(i) + density + S.scalar<Lanes>(i, 0) + S.scalar<Lanes>(i, 1) + S.scalar<Lanes>(i, 3);
    for (int k = 0; k < D; ++k) sum += v.scalar<Lanes>(i, k);
    record_where(failure, g, !(magnitude(sum) < 1e300), not_a_number);
    record_where(failure, g, !(density > 0.0), negative_density);
  }
};

/// Update of density, stress, energy and history to the end of the step.
template <class Law>
struct FinishStress {
  Law law;
  double dt;
  Balance balance;
  PointFields point;
  double release_rate;  ///< see release [1/s]; 0: failed particles keep their stress
  OwnComponents S, S_rate, plastic_strain, temperature, damage, plastic_work, bulking, released, flow;

  PIOLA_SHARED inline FinishStress(Law const& of_body, System const& s, BodyConstants const& body, double step)
      : law(of_body),
        dt(step),
        balance(s, body, step),
        point(s.field, s.own),
        release_rate(body.releases ? of_body.s_wave_speed() / (2 * body.h) : 0),
        S(write(s.field.S)),
        S_rate(write(s.field.S_rate)),
        plastic_strain(write(s.field.plastic_strain)),
        temperature(write(s.field.temperature)),
        damage(write(s.field.damage)),
        plastic_work(write(s.field.plastic_work)),
        bulking(write(s.field.bulking)),
        released(write(s.field.released)),
        flow(write(s.field.flow)) {}

  PIOLA_FN void operator()(Range block, BlockScratch& scratch) const {
    if (balance.settings.plane_stress)
      for (Index i = block.first; i < block.last; ++i)
        scratch.L[8][i - block.first] = RateAcross<Law>{law, point, balance, dt}(i, scratch);
    balance(block, scratch);
    each_group(block, [&](Group g) { strain(g, scratch.gradient(g)); });
  }

 private:
  /// Updates the deviator and its history to the end of the step.
  PIOLA_FN void strain(Group g, Mat<3, Lanes> const& L) const {
    Index const i = g.first;
    Lanes const none(0.0);
    SymMat<3, Lanes> const before = point.S.symmetric<Lanes>(i);
    SymMat<3, Lanes> rate = law.deviator_rate(balance.S_half.symmetric<Lanes>(i), L), trial;
    auto const bears = point.bears<Lanes>(i);
    for (int c = 0; c < 6; ++c) {
      rate.c[c] = select(bears, rate.c[c], none);
      trial.c[c] = before.c[c] + dt * rate.c[c];
    }
    S_rate.put_all(g, rate.c);
    SolidHistoryOf<Lanes> const old = point.history<Lanes>(i, before);
    SolidHistoryOf<Lanes> h = old;
    Lanes const rho = balance.rho_half.scalar<Lanes>(i), last = flow.seen().scalar<Lanes>(i);
    Lanes const yield = law.update(h, trial, balance.pressure.scalar<Lanes>(i), rho, dt, last);
    if constexpr (Law::yields) {
      flow.put(g, select(bears && yield > 0.0, yield, last));
      if (release_rate > 0) release(g, bears && h.damage >= 1.0, h, rho);
      plastic_strain.put(g, select(bears, h.plastic_strain, old.plastic_strain));
      temperature.put(g, select(bears, h.temperature, old.temperature));
      damage.put(g, select(bears, h.damage, old.damage));
      plastic_work.put(g, select(bears, h.plastic_work, old.plastic_work));
      if constexpr (Law::brittle) bulking.put(g, select(bears, h.bulking, old.bulking));
    }
    for (int c = 0; c < 6; ++c) S.put(g, select(bears, h.S.c[c], none), c);
  }

  /// A failed particle loses its deviator over the time in which shear waves cross its support, 2h/c_s, so that it
  /// emits no shock. The lost elastic energy becomes heat and counts as plastic work.
  template <class Mask>
  PIOLA_FN void release(Group g, Mask const& failed, SolidHistoryOf<Lanes>& h, Lanes const& rho) const {
    if (!any(failed)) return;
    Lanes const one(1.0), before = released.seen().scalar<Lanes>(g.first);
    Lanes const after = minimum(before + dt * release_rate, one);
    Lanes const factor = select(failed, (1.0 - after) / (1.0 - before), one);
    Lanes square(0.0);
    for (int c = 0; c < 6; ++c) square += (c < 3 ? 1.0 : 2.0) * h.S.c[c] * h.S.c[c];
    Lanes const heat = square * (1.0 - factor * factor) / (4 * law.mu) * law.rho0 / rho;
    h.plastic_work = select(failed, h.plastic_work + heat, h.plastic_work);
    for (Lanes& component : h.S.c) component = component * factor;
    released.put(g, select(failed, after, before));
  }
};

/// Kick, second drift, and update of density, stress, energy and history; stable step and conversion requests.
/// Stress: FinishStress, or a LawPart of it.
template <int D, class Stress>
struct Finish {
  Kick<D> kick;
  Stress stress;
  StepEnd<D> end;
  double* partial;

  PIOLA_FN void operator()(Range block, Index number) const {
    double* m = partial + static_cast<std::ptrdiff_t>(number) * BlockMeasures::size;
    for (int c = 0; c < BlockMeasures::size; ++c) m[c] = 0;
    BlockScratch scratch(block.first);
    kick(block, scratch, m);
    stress(block, scratch);
    end(block, scratch, m);
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
