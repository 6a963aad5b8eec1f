// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/point_passes.hpp"
#include "piola/math/embedding.hpp"

/// Stress at half time, and the data that neighbours read of it.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Neighbour data derived from the stress at half time.
template <int D, bool Corrected>
struct WriteRecords {
  BodyConstants body;
  Settings settings;
  HalfVolume half;
  OwnComponents section_stress;
  double smallest_radius;
  Components X, x, v_half, volume, viscosity, active, S_half, pressure, rho_half, volume_half, F_rate, gap, K, N,
      gradient_mean;
  SpatialTable spatial;    ///< records null: not needed
  MaterialTable material;  ///< records null: not needed

  PIOLA_SHARED inline WriteRecords(System const& s, BodyConstants const& of, MaterialTable const& table, double dt)
      : body(of),
        settings(s.settings),
        half(s, of, table, dt),
        section_stress(write(s.field.section_stress)),
        smallest_radius(s.smallest_radius),
        X(read(s.field.X)),
        x(read(s.field.x)),
        v_half(read(s.field.v_half)),
        volume(read(s.field.volume)),
        viscosity(read(s.field.viscosity)),
        active(read(s.field.active)),
        S_half(read(s.field.S_half)),
        pressure(read(s.field.pressure)),
        rho_half(read(s.field.rho_half)),
        volume_half(read(s.field.volume_half)),
        F_rate(read(s.field.F_rate)),
        gap(read(s.field.gap)),
        K(read(s.field.K)),
        N(read(s.field.N)),
        gradient_mean(read(s.field.gradient_mean)),
        spatial(s.spatial),
        material(table) {}

  PIOLA_SHARED PIOLA_FN void operator()(Range block) const {
    each_group(block, [&](Group g) {
      Index const i = g.first;
      Lanes const p = pressure.scalar<Lanes>(i);
      SymMat<3, Lanes> const S = S_half.symmetric<Lanes>(i);
      SymMat<D, Lanes> stress;
      for (int a = 0; a < D; ++a)
        for (int b = a; b < D; ++b) stress(a, b) = a == b ? S(a, b) - p : S(a, b);
      // On the axis, where the stretch of the circle is that of the radius, one force serves both.
      if (D == 2 && settings.axisymmetric)
        stress(0, 0) = stress(0, 0) + select(X.scalar<Lanes>(i) < smallest_radius, S(2, 2) - p, Lanes(0.0));
      Here const here{half.phi.scalar<Lanes>(i),    active.scalar<Lanes>(i), rho_half.scalar<Lanes>(i),
                      volume_half.scalar<Lanes>(i), half.thickness_at(i),    stress};
      if (spatial.record != nullptr) write_spatial(g, here);
      if (!material.used) return;
      if (settings.equations.records_deformation())
        write_deformation(g, here);
      else
        write_material(g, here);
    });
  }

 private:
  /// A group of particles at half time.
  struct Here {
    Lanes phi, active, rho, volume, thickness;
    SymMat<D, Lanes> stress;
  };
  using R = MaterialRecord<D>;

  /// The D dimensions of F.
  PIOLA_FN Mat<D, Lanes> deformation(Index i) const { return restrict_to<D>(half.F.matrix<Lanes>(i)); }

  PIOLA_FN void clear_section_stress(Group g) const {
    for (int p = 0; p < 4 && section_stress.data != nullptr; ++p) section_stress.put(g, Lanes(0.0), p);
  }
  PIOLA_FN void put_section_stress(Group g, Lanes const& weight, Mat<D, Lanes> const& F, Here const& here) const {
    if (section_stress.data == nullptr) return;
    Mat<D, Lanes> const inverse_F = inverse(F);
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        section_stress.put(g, weight * (here.stress(p, 0) * inverse_F(q, 0) + here.stress(p, 1) * inverse_F(q, 1)),
                           2 * p + q);
  }

  /// The halves of damping and springs contained in A, per unit of dF/dt and of F - I, for total-Lagrangian particles.
  PIOLA_FN void add_hourglass(Index i, Here const& here, Mat<D, Lanes> const& F, Lanes* A) const {
    Lanes const share = select(here.phi > 0.0, Lanes(0.0), 0.5 * volume.scalar<Lanes>(i));
    Lanes const damping = share * damping_of(body);
    Mat<D, Lanes> const rate = restrict_to<D>(F_rate.matrix<Lanes>(i));
    Lanes const stiffness = share * (settings.equations.has_hourglass_stiffness() ? stiffness_of(body) : 0);
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q)
        A[p * D + q] = A[p * D + q] - (damping * rate(p, q) + stiffness * (F(p, q) - (p == q ? 1.0 : 0.0)));
  }

  /// A = (1 - phi) V0 P K, with V0 P F^T = V sigma: with the current volume, which follows from an evolved density.
  PIOLA_FN void write_material(Group g, Here const& here) const {
    Index const i = g.first;
    Lanes A[D * D];
    auto const bears = here.phi < 1.0 && here.active > 0.0;
    if (any(bears)) {
      Mat<3, Lanes> const full = half.F.matrix<Lanes>(i);
      Mat<D, Lanes> const F = restrict_to<D>(full);
      SymMat<D, Lanes> correction;
      for (int c = 0; c < SymMat<D>::size; ++c) correction.c[c] = K.scalar<Lanes>(i, c);
      Lanes const weight = (1.0 - here.phi) * select(here.phi > 0.0, here.volume * here.thickness,
                                                     determinant(full) * volume.scalar<Lanes>(i));
      Mat<D, Lanes> const FN = transpose(inverse(F)) * correction;
      for (int p = 0; p < D; ++p)
        for (int q = 0; q < D; ++q) {
          Lanes sum(0.0);
          for (int l = 0; l < D; ++l) sum += here.stress(p, l) * FN(l, q);
          A[p * D + q] = weight * sum;
        }
      put_section_stress(g, select(bears, weight, Lanes(0.0)), F, here);
      add_hourglass(i, here, F, A);
    }
    for (Lanes& value : A) value = select(bears, value, Lanes(0.0));
    if (!any(bears)) clear_section_stress(g);
    store_in_records<D>(material, settings.equations, g, R::A, A);
  }

  /// For set (2): A, a, F^-T N, F^-T n and 1/J, which is also the density over the initial one.
  PIOLA_FN void write_deformation(Group g, Here const& here) const {
    Index const i = g.first;
    constexpr int first = R::A;
    Lanes r[R::inverse_J + 1 - first];
    auto bears = here.phi < 1.0;
    if (settings.equations.deforms_eulerian()) bears = bears || gap.scalar<Lanes>(i) >= 0.0;
    bears = bears && here.active > 0.0;
    for (Lanes& value : r) value = Lanes(0.0);
    if (any(bears)) {
      Mat<3, Lanes> const full = half.F.matrix<Lanes>(i);
      Mat<D, Lanes> const F = restrict_to<D>(full), FN = transpose(inverse(F)) * restrict_to<D>(N.matrix<Lanes>(i));
      // V sigma = V0 P F^T: with the current volume, which follows from an evolved density.
      Lanes const at_rest = determinant(full) * volume.scalar<Lanes>(i);
      Lanes const share = settings.equations.splits_stress()
                              ? (1.0 - here.phi) * select(here.phi > 0.0, here.volume * here.thickness, at_rest)
                              : at_rest;
      for (int p = 0; p < D; ++p) {
        Lanes a(0.0), n(0.0);
        for (int q = 0; q < D; ++q) {
          Lanes A(0.0);
          for (int l = 0; l < D; ++l) A += here.stress(p, l) * FN(l, q);
          Lanes const G = gradient_mean.scalar<Lanes>(i, q);
          r[p * D + q] = share * A;
          r[R::N - first + p * D + q] = FN(p, q);
          a += share * A * G;
          n += FN(p, q) * G;
        }
        r[R::a - first + p] = a;
        r[R::n - first + p] = n;
      }
      // In the plane.
      put_section_stress(g, select(bears, share, Lanes(0.0)), F, here);
      r[R::inverse_J - first] = here.rho * (settings.axisymmetric ? full(2, 2) : here.thickness) / body.rho0;
      add_hourglass(i, here, F, r);
    }
    if (!any(bears)) clear_section_stress(g);
    for (int c = 0; c < R::inverse_J - first; ++c) r[c] = select(bears, r[c], Lanes(0.0));
    r[R::inverse_J - first] = select(bears, r[R::inverse_J - first], Lanes(1.0));
    store_in_records<D>(material, settings.equations, g, first, r);
  }

  PIOLA_FN void write_spatial(Group g, Here const& here) const {
    using Q = SpatialRecord<D, Corrected>;
    Index const i = g.first;
    double* to[lane_count];
    bool wanted = false;
    for (int l = 0; l < lane_count; ++l) {
      bool const near = l < g.count && (spatial.near == nullptr || spatial.near[i + l] != 0);
      to[l] = near ? spatial.record + static_cast<std::ptrdiff_t>(spatial.sorted[i + l]) * spatial.stride : nullptr;
      wanted = wanted || near;
    }
    if (!wanted) return;
    Lanes r[Q::M + SymMat<D>::size];
    for (int c = 0; c < D; ++c) {
      r[Q::x + c] = x.scalar<Lanes>(i, c);
      r[Q::v + c] = v_half.scalar<Lanes>(i, c);
    }
    r[Q::volume] = here.volume;
    r[Q::rho] = here.rho * here.thickness;
    r[Q::c] = Lanes(body.c);
    Lanes const factor = positive_factor(viscosity.scalar<Lanes>(i));
    r[Q::viscosity] = select(here.phi > 0.0, factor, -factor);
    Lanes const weight = settings.equations.splits_stress() ? here.phi : Lanes(1.0);
    for (int c = 0; c < SymMat<D>::size; ++c) r[Q::M + c] = weight * here.volume * here.thickness * here.stress.c[c];
    store_records(to, 0, r);
    if (settings.artificial_stress) {
      SymMat<D, Lanes> stress = artificial_stress<D>(here.stress, here.rho, body.artificial_stress);
      for (Lanes& c : stress.c) c = c / here.thickness;
      store_records(to, Q::R, stress.c);
    }
    if constexpr (Corrected)
      for (int l = 0; l < lane_count; ++l)
        for (int c = Q::M + SymMat<D>::size; c < Q::R && to[l] != nullptr; ++c) to[l][c] = 0;
  }
};

/// gamma of S_half = S + dt/2 ((1 + gamma) rate - gamma last rate), with the rate at half time. A shear wave with the
/// angular frequency omega then grows by (1 - gamma) (omega dt)^4 / 8 per step, and is stable to omega dt = gamma^-1/2.
/// The last rate alone, gamma = -1, lets it grow by (omega dt)^4 / 4.
inline constexpr double extrapolation = 0.7;

/// Predicts the deviator at half time and returns it to the yield surface, without a change of history. Bodies that
/// stay total-Lagrangian know their velocity gradient at half time. Other bodies, and plane stress, use the rate of the
/// last step.
template <class Law>
struct PredictStress {
  Law law;
  double step;      ///< half of a time step [s]
  bool lagrangian;  ///< whether the velocity gradient is known
  GradientAtHalfTime half;
  Components S_rate, flow;

  PIOLA_SHARED inline PredictStress(Law const& of_body, System const& s, BodyConstants const& body, double dt)
      : law(of_body),
        step(0.5 * dt),
        lagrangian(body.lagrangian && !s.settings.plane_stress),
        half(s),
        S_rate(read(s.field.S_rate)),
        flow(read(s.field.flow)) {}

  PIOLA_FN SymMat<3, Lanes> operator()(PointFields const& point, Index i) const {
    SymMat<3, Lanes> const before = point.S.symmetric<Lanes>(i);
    SymMat<3, Lanes> rate = S_rate.symmetric<Lanes>(i), trial;
    if (lagrangian) extrapolate(i, before, rate);
    for (int c = 0; c < 6; ++c) trial.c[c] = before.c[c] + step * rate.c[c];
    auto const bears = point.bears<Lanes>(i);
    SymMat<3, Lanes> S = law.predicted(point.history<Lanes>(i, before), trial, flow.scalar<Lanes>(i), step);
    for (Lanes& c : S.c) c = select(bears, c, Lanes(0.0));
    return S;
  }

 private:
  /// rate: in, that of the last step; out, that which leads to half time.
  PIOLA_FN void extrapolate(Index i, SymMat<3, Lanes> const& S, SymMat<3, Lanes>& rate) const {
    Mat<3, Lanes> L = half.of_material(i);
    half.turn_around_axis(i, L);
    SymMat<3, Lanes> const now = law.deviator_rate(S, L);
    for (int c = 0; c < 6; ++c) rate.c[c] = (1 + extrapolation) * now.c[c] - extrapolation * rate.c[c];
  }
};

/// Stress at half time, and the speed of sound.
template <class Law>
struct HalfStress {
  Law law;
  double step;  ///< half of a time step [s]
  PointFields point;
  PredictStress<Law> predict;
  Components mass, rho_half, energy, energy_rate;
  OwnComponents pressure, c, S_half;

  PIOLA_SHARED inline HalfStress(Law const& of_body, System const& s, BodyConstants const& body, double dt)
      : law(of_body),
        step(0.5 * dt),
        point(s.field, s.own),
        predict(of_body, s, body, dt),
        mass(read(s.field.mass)),
        rho_half(read(s.field.rho_half)),
        energy(read(s.field.energy)),
        energy_rate(read(s.field.energy_rate)),
        pressure(write(s.field.pressure)),
        c(write(s.field.c)),
        S_half(write(s.field.S_half)) {}

  PIOLA_FN void operator()(Range block) const {
    each_group(block, [&](Group g) {
      Index const i = g.first;
      Lanes const rho = rho_half.scalar<Lanes>(i);
      Lanes const e = (energy.scalar<Lanes>(i) + step * energy_rate.scalar<Lanes>(i)) / mass.scalar<Lanes>(i);
      Lanes const p = point.pressure<Lanes>(law, i, rho, e);
      pressure.put(g, p);
      c.put(g, law.template sound_speed<Lanes>(rho, e));
      SymMat<3, Lanes> S = predict(point, i);
      if constexpr (Law::pressed) S = law.returned(point.history<Lanes>(i, S), S, step, p, rho / law.rho0);
      S_half.put_all(g, S.c);
    });
  }
};

/// Density, pressure and volume at half time, and neighbour data. Stress: HalfStress, or a LawPart of it.
template <int D, bool Corrected, class Stress>
struct HalfState {
  HalfVolume volume;
  Stress stress;
  WriteRecords<D, Corrected> records;

  PIOLA_FN void operator()(Range block, Index) const {
    volume(block);
    stress(block);
    records(block);
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
