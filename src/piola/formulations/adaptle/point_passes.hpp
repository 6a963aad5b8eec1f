// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/material_pairs.hpp"
#include "piola/formulations/adaptle/point_fields.hpp"
#include "piola/math/embedding.hpp"

/// What happens at one particle between the sweeps, a group of lanes at a time. The scheme drifts half a step,
/// evaluates everything once at half time with predicted rates, kicks, and drifts the other half. What does not ask for
/// the law of a body is a struct without it, so that it is compiled once.
namespace piola::adaptle::inline PIOLA_MACHINE {

/// Factor of the viscosity, never zero: its sign tells descriptions apart.
PIOLA_FN Lanes positive_factor(Lanes const& viscosity) { return maximum(viscosity, Lanes(1e-300)); }

/// To half time; what the first sweep reads of neighbours, and sums that begin with zero.
template <int D>
struct Drift {
  double dt;
  Components X, volume, v, a, viscosity, phi, alive, thickness, thickness_rate;
  OwnComponents x, v_half, thickness_half, force, heat, hourglass, compression, contact;
  double* position;
  MaterialTable material;
  bool published;  ///< material sums
  FailureSlot* failure;

  Drift(System const& s, MaterialTable const& table, double step)
      : dt(step),
        X(read(s.field.X)),
        volume(read(s.field.volume)),
        v(read(s.field.v)),
        a(read(s.field.a)),
        viscosity(read(s.field.viscosity)),
        phi(read(s.field.phi)),
        alive(read(s.field.alive)),
        thickness(read(s.field.thickness)),
        thickness_rate(read(s.field.thickness_rate)),
        x(write(s.field.x)),
        v_half(write(s.field.v_half)),
        thickness_half(write(s.field.thickness_half)),
        force(write(s.field.force)),
        heat(write(s.field.heat)),
        hourglass(write(s.field.hourglass)),
        compression(write(s.field.compression)),
        contact(write(s.field.contact)),
        position(s.position),
        material(table),
        published(s.settings.published),
        failure(s.failure) {}

  PIOLA_FN void operator()(Range block) const {
    each_group(block, [&](Group g) { move(g); });
  }

 private:
  PIOLA_FN void move(Group g) const {
    Index const i = g.first;
    double const step = 0.5 * dt;
    Vec<3, Lanes> place, speed;
    double places[3][lane_count];
    auto finite = g.mask();
    for (int c = 0; c < 3; ++c) {
      Lanes const before = v.scalar<Lanes>(i, c);
      speed[c] = before + step * a.scalar<Lanes>(i, c);
      place[c] = x.seen().scalar<Lanes>(i, c) + step * before;
      v_half.put(g, speed[c], c);
      x.put(g, place[c], c);
      store(place[c], places[c]);
      finite = finite && magnitude(place[c]) < 1e30 && magnitude(speed[c]) < 1e30;
    }
    for (int l = 0; l < g.count; ++l)
      for (int c = 0; c < 3; ++c) position[3 * (i + l) + c] = places[c][l];
    if (any(g.mask() && !finite)) report(g, places);
    if (thickness_half.data != nullptr)
      thickness_half.put(g, thickness.scalar<Lanes>(i) + step * thickness_rate.scalar<Lanes>(i));
    clear(g);
    if (material.used) write_record(g, place, speed);
  }

  PIOLA_FN void report(Group g, double const (&places)[3][lane_count]) const {
    for (int l = 0; l < g.count; ++l)
      for (int c = 0; c < 3; ++c)
        if (!(std::fabs(places[c][l]) < 1e30 && std::fabs(v_half.at(g.first + l, c)) < 1e30))
          exec::record(failure, g.first + l, not_a_number);
  }

  PIOLA_FN void clear(Group g) const {
    for (int c = 0; c < 3 && force.data != nullptr; ++c) force.put(g, Lanes(0.0), c);
    for (int c = 0; c < ContactSum::size && contact.data != nullptr; ++c) contact.put(g, Lanes(0.0), c);
    if (heat.data == nullptr) return;
    heat.put(g, Lanes(0.0));
    hourglass.put(g, Lanes(0.0));
    compression.put(g, Lanes(0.0));
  }

  /// Deleted particles have no volume; the rest of what they say does not matter.
  PIOLA_FN void write_record(Group g, Vec<3, Lanes> const& place, Vec<3, Lanes> const& speed) const {
    using R = MaterialRecord<D>;
    Lanes r[R::A];
    for (int c = 0; c < D; ++c) {
      r[R::X + c] = X.scalar<Lanes>(g.first, c);
      r[R::u + c] = place[c] - r[R::X + c];
      r[R::v + c] = speed[c];
    }
    auto const there = alive.scalar<Lanes>(g.first) > 0.0;
    r[R::volume] = select(there, volume.scalar<Lanes>(g.first), Lanes(0.0));
    Lanes const factor = positive_factor(viscosity.scalar<Lanes>(g.first));
    r[R::viscosity] = select(phi.scalar<Lanes>(g.first) > 0.0 && there, -factor, factor);
    store_in_records<D>(material, published, g, 0, r);
  }
};

/// Drifts to half time and predicts there with the rates of the step before. S is brought back to the yield surface
/// without a change of history.
template <int D, class Law>
struct Predict {
  Law law;
  Drift<D> drift;
  PointFields point;
  Components S_rate, flow;
  OwnComponents S_half;

  Predict(Law const& of_body, System const& s, MaterialTable const& table, double dt)
      : law(of_body),
        drift(s, table, dt),
        point(s.field, s.own),
        S_rate(read(s.field.S_rate)),
        flow(read(s.field.flow)),
        S_half(write(s.field.S_half)) {}

  PIOLA_FN void operator()(Range block, Index) const {
    drift(block);
    each_group(block, [&](Group g) {
      Index const i = g.first;
      double const step = 0.5 * drift.dt;
      SymMat<3, Lanes> const before = point.S.symmetric<Lanes>(i);
      SymMat<3, Lanes> trial;
      for (int c = 0; c < 6; ++c) trial.c[c] = before.c[c] + step * S_rate.scalar<Lanes>(i, c);
      auto const bears = point.bears<Lanes>(i);
      SymMat<3, Lanes> const S = law.predicted(point.history<Lanes>(i, before), trial, flow.scalar<Lanes>(i), step);
      for (int c = 0; c < 6; ++c) S_half.put(g, select(bears, S.c[c], Lanes(0.0)), c);
    });
  }
};

/// Density and volume of half time.
struct HalfVolume {
  double rho0, step;  ///< step: half of a time step [s]
  MaterialTable material;
  Components mass, rho, rho_rate, thickness_half, phi, F;
  OwnComponents rho_half, volume_half;
  FailureSlot* failure;

  HalfVolume(System const& s, BodyConstants const& body, MaterialTable const& table, double dt)
      : rho0(body.rho0),
        step(0.5 * dt),
        material(table),
        mass(read(s.field.mass)),
        rho(read(s.field.rho)),
        rho_rate(read(s.field.rho_rate)),
        thickness_half(read(s.field.thickness_half)),
        phi(read(s.field.phi)),
        F(read(s.field.F)),
        rho_half(write(s.field.rho_half)),
        volume_half(write(s.field.volume_half)),
        failure(s.failure) {}

  PIOLA_FN Lanes thickness_at(Index i) const { return thickness_half.scalar_or<Lanes>(i, 1.0); }

  PIOLA_FN void operator()(Range block) const {
    each_group(block, [&](Group g) {
      Index const i = g.first;
      Lanes const blend = phi.scalar<Lanes>(i);
      Lanes density = rho.scalar<Lanes>(i) + step * rho_rate.scalar<Lanes>(i);
      if (material.used) {
        Lanes const J = determinant(F.matrix<Lanes>(i));
        fail(g, blend < 1.0 && !(J > 0.0), inverted);
        density = select(blend > 0.0, density, rho0 / J);
      }
      fail(g, !(density > 0.0), negative_density);
      rho_half.put(g, density);
      volume_half.put(g, mass.scalar<Lanes>(i) / (density * thickness_at(i)));
    });
  }

 private:
  template <class Mask>
  PIOLA_FN void fail(Group g, Mask const& where, int code) const {
    record_where(failure, g, where, code);
  }
};

/// What neighbours read: of the stress of half time.
template <int D, bool Corrected>
struct WriteRecords {
  BodyConstants body;
  Settings settings;
  HalfVolume half;
  Components x, v_half, volume, viscosity, alive, S_half, pressure, rho_half, volume_half, F_rate, gap, K, N,
      gradient_mean;
  SpatialTable spatial;    ///< records null: none are needed
  MaterialTable material;  ///< records null: none are needed

  WriteRecords(System const& s, BodyConstants const& of, MaterialTable const& table, double dt)
      : body(of),
        settings(s.settings),
        half(s, of, table, dt),
        x(read(s.field.x)),
        v_half(read(s.field.v_half)),
        volume(read(s.field.volume)),
        viscosity(read(s.field.viscosity)),
        alive(read(s.field.alive)),
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

  PIOLA_FN void operator()(Range block) const {
    each_group(block, [&](Group g) {
      Index const i = g.first;
      Lanes const p = pressure.scalar<Lanes>(i);
      SymMat<3, Lanes> const S = S_half.symmetric<Lanes>(i);
      SymMat<D, Lanes> stress;
      for (int a = 0; a < D; ++a)
        for (int b = a; b < D; ++b) stress(a, b) = a == b ? S(a, b) - p : S(a, b);
      Here const here{half.phi.scalar<Lanes>(i),    alive.scalar<Lanes>(i), rho_half.scalar<Lanes>(i),
                      volume_half.scalar<Lanes>(i), half.thickness_at(i),   stress};
      if (spatial.record != nullptr) write_spatial(g, here);
      if (!material.used) return;
      if (settings.published)
        write_published(g, here);
      else
        write_material(g, here);
    });
  }

 private:
  /// A group at half time.
  struct Here {
    Lanes phi, alive, rho, volume, thickness;
    SymMat<D, Lanes> stress;
  };
  using R = MaterialRecord<D>;

  /// The D dimensions of F.
  PIOLA_FN Mat<D, Lanes> deformation(Index i) const { return restrict_to<D>(half.F.matrix<Lanes>(i)); }

  /// The halves of damping and springs that A carries, per unit of dF/dt and of F - I: of total-Lagrangian particles.
  PIOLA_FN void add_hourglass(Index i, Here const& here, Mat<D, Lanes> const& F, Lanes* A) const {
    Lanes const share = select(here.phi > 0.0, Lanes(0.0), 0.5 * volume.scalar<Lanes>(i));
    Lanes const damping = share * damping_of(body);
    Mat<D, Lanes> const rate = restrict_to<D>(F_rate.matrix<Lanes>(i));
    Lanes const stiffness = share * (settings.published ? 0 : stiffness_of(body));
    for (int p = 0; p < D; ++p)
      for (int q = 0; q < D; ++q)
        A[p * D + q] = A[p * D + q] - (damping * rate(p, q) + stiffness * (F(p, q) - (p == q ? 1.0 : 0.0)));
  }

  /// A = (1 - phi) V0 P K, with V0 P F^T = V sigma: with the current volume, which follows from the density where that
  /// is evolved.
  PIOLA_FN void write_material(Group g, Here const& here) const {
    Index const i = g.first;
    Lanes A[D * D];
    auto const bears = here.phi < 1.0 && here.alive > 0.0;
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
      add_hourglass(i, here, F, A);
    }
    for (Lanes& value : A) value = select(bears, value, Lanes(0.0));
    store_in_records<D>(material, false, g, R::A, A);
  }

  /// Of set (2): A, a, F^-T N, F^-T n and 1/J, which is also the density over that of the start.
  PIOLA_FN void write_published(Group g, Here const& here) const {
    Index const i = g.first;
    constexpr int first = R::A;
    Lanes r[R::inverse_J + 1 - first];
    bool const printed = settings.interface_form == Interface::printed;
    // Eulerian particles of the printed interface have a deformation gradient only near total-Lagrangian ones.
    auto bears = here.phi < 1.0;
    if (printed) bears = bears || gap.scalar<Lanes>(i) >= 0.0;
    bears = bears && here.alive > 0.0;
    for (Lanes& value : r) value = Lanes(0.0);
    if (any(bears)) {
      Mat<3, Lanes> const full = half.F.matrix<Lanes>(i);
      Mat<D, Lanes> const F = restrict_to<D>(full), FN = transpose(inverse(F)) * restrict_to<D>(N.matrix<Lanes>(i));
      // V sigma = V0 P F^T: with the current volume, which follows from the density where that is evolved.
      Lanes const at_rest = determinant(full) * volume.scalar<Lanes>(i);
      Lanes const share =
          printed ? at_rest : (1.0 - here.phi) * select(here.phi > 0.0, here.volume * here.thickness, at_rest);
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
      r[R::inverse_J - first] = here.rho * here.thickness / body.rho0;
      add_hourglass(i, here, F, r);
    }
    for (int c = 0; c < R::inverse_J - first; ++c) r[c] = select(bears, r[c], Lanes(0.0));
    r[R::inverse_J - first] = select(bears, r[R::inverse_J - first], Lanes(1.0));
    store_in_records<D>(material, true, g, first, r);
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
    Lanes const weight = settings.interface_form == Interface::printed ? Lanes(1.0) : here.phi;
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

/// Density, pressure and volume of half time, and what neighbours read.
template <int D, bool Corrected, class Law>
struct HalfState {
  Law law;
  HalfVolume volume;
  WriteRecords<D, Corrected> records;
  PointFields point;
  Components energy, energy_rate;
  OwnComponents pressure, c, S_half;

  HalfState(Law const& of_body, System const& s, BodyConstants const& body, MaterialTable const& table, double dt)
      : law(of_body),
        volume(s, body, table, dt),
        records(s, body, table, dt),
        point(s.field, s.own),
        energy(read(s.field.energy)),
        energy_rate(read(s.field.energy_rate)),
        pressure(write(s.field.pressure)),
        c(write(s.field.c)),
        S_half(write(s.field.S_half)) {}

  PIOLA_FN void operator()(Range block, Index) const {
    volume(block);
    each_group(block, [&](Group g) {
      Index const i = g.first;
      Lanes const rho = records.rho_half.template scalar<Lanes>(i);
      Lanes const e =
          (energy.scalar<Lanes>(i) + volume.step * energy_rate.scalar<Lanes>(i)) / volume.mass.scalar<Lanes>(i);
      Lanes const p = point.pressure<Lanes>(law, i, rho, e);
      pressure.put(g, p);
      c.put(g, law.template sound_speed<Lanes>(rho, e));
      if constexpr (Law::pressed) {
        SymMat<3, Lanes> const trial = S_half.seen().symmetric<Lanes>(i);
        S_half.put_all(g, law.returned(point.history<Lanes>(i, trial), trial, volume.step, p, rho / law.rho0).c);
      }
    });
    records(block);
  }
};

}  // namespace piola::adaptle::inline PIOLA_MACHINE
