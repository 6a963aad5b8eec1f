// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field_view.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/materials/finite_increment.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include "piola/math/embedding.hpp"

/// Solids in rate form under a total-Lagrangian scheme: stress is a function of the state after the last step and of
/// the present deformation gradient. Theory: docs/theory/jst-sph.md, "Solids in rate form".
namespace piola::jst_sph::inline PIOLA_BACKEND {

/// State of a particle of a solid at the end of the last step. `pressure` [Pa]: positive in compression; `energy`:
/// specific internal energy [J/kg].
struct SolidPoint {
  Mat<3> F;
  SolidHistory history;
  double pressure, energy;
};

/// An increment from the end of the last step. `elastic`: without yield, for trial steps that measure the stiffness.
struct SolidIncrement {
  double dt = 0;  ///< [s]
  bool elastic = false;
};

/// Advances a particle from the end of the last step to the deformation gradient F; returns P there [Pa]. The energy
/// grows by the mean of the stresses before and after, e += (P_n + P) : (F - F_n) / (2 rho0), which is the work that
/// the kinetic energy loses in a Verlet step; the pressure includes that energy.
template <class Law>
PIOLA_FN Mat<3> advance_solid(Law const& law, SolidPoint& point, Mat<3> const& F, SolidIncrement const& step) {
  Mat<3> const dF = F - point.F, H = cofactor(F);
  double const rho = law.rho0 / determinant(F), before = point.energy;
  double const old_work = 0.5 * contract(first_piola_of(point.history.S, point.pressure, point.F), dF) / law.rho0;
  SymMat<3> const trial = trial_deviator(point.history.S, law.mu, point.F, F);
  if (step.elastic)
    point.history.S = trial;
  else
    law.update(point.history, trial, law.pressure(point.history, rho, before), rho, step.dt);
  double const shear_work = 0.5 * contract(first_piola_of(point.history.S, 0.0, F), dF) / law.rho0;
  double const volume = 0.5 * contract(H, dF) / law.rho0;
  auto const energy = [&](double pressure) { return before + old_work + shear_work - pressure * volume; };
  for (int k = 0; k < 3; ++k) point.pressure = law.pressure(point.history, rho, energy(point.pressure));
  point.energy = energy(point.pressure);
  point.F = F;
  return first_piola_of(point.history.S, point.pressure, F);
}

/// Interface of a solid for passes that expect a stress as a function of F. The law is hidden behind two functions, so
/// that passes are compiled once for all solids. Lanes are processed one by one.
class SolidStress {
 public:
  static constexpr bool small_strain = false, volumetric_split = false;

  /// `law` must outlive this. `as_left`: the stress at the end of the last step. `commit`: F is that of the end of a
  /// step, whose state is stored.
  template <class Law>
  SolidStress(Law const& law, BodyState const& body, SolidIncrement const& step, bool as_left, bool commit)
      : law_(&law),
        advance_(&advance<Law>),
        sound_speed_(&sound_speed<Law>),
        rho0_(law.rho0),
        step_(step),
        as_left_(as_left),
        commit_(commit),
        last_F_(read(body.last_F)),
        history_(read(body.history)),
        last_F_out_(write(body.last_F)),
        history_out_(write(body.history)) {}

  PIOLA_FN Mat<3, Lanes> first_piola(Index i, Mat<3, Lanes> const& F) const {
    double P[9][lane_count];
    for (int l = 0; l < lane_count; ++l) {
      Mat<3> const at_lane = of_lane(i + l, F, l);
      for (int c = 0; c < 9; ++c) P[c][l] = at_lane.c[c];
    }
    Mat<3, Lanes> r;
    for (int c = 0; c < 9; ++c) r.c[c] = load<Lanes>(P[c]);
    return r;
  }

  /// Speed of pressure waves in the current state with the energy of the end of the last step [m/s].
  PIOLA_FN Lanes sound_speed(Index i, Lanes const& J) const {
    double c[lane_count];
    for (int l = 0; l < lane_count; ++l)
      c[l] = sound_speed_(law_, rho0_ / lane(J, l), history_.scalar<double>(i + l, SolidFields::energy));
    return load<Lanes>(c);
  }

 private:
  template <class Law>
  static PIOLA_FN Mat<3> advance(void const* law, SolidPoint& point, Mat<3> const& F, SolidIncrement const& step) {
    return advance_solid(*static_cast<Law const*>(law), point, F, step);
  }
  template <class Law>
  static PIOLA_FN double sound_speed(void const* law, double rho, double e) {
    return static_cast<Law const*>(law)->sound_speed(rho, e);
  }

  PIOLA_FN Mat<3> of_lane(Index i, Mat<3, Lanes> const& F_lanes, int l) const {
    SolidPoint point = at(i);
    if (as_left_) return first_piola_of(point.history.S, point.pressure, point.F);
    Mat<3> F;
    for (int c = 0; c < 9; ++c) F.c[c] = lane(F_lanes.c[c], l);
    Mat<3> const P = advance_(law_, point, F, step_);
    if (commit_) keep(i, point);
    return P;
  }
  PIOLA_FN SolidPoint at(Index i) const {
    using At = SolidFields;
    auto const value = [&](int c) { return history_.scalar<double>(i, c); };
    return {last_F_.matrix<3, double>(i),
            {history_.symmetric<3, double>(i), value(At::plastic_strain), value(At::temperature), value(At::damage),
             value(At::plastic_work)},
            value(At::pressure),
            value(At::energy)};
  }
  PIOLA_FN void keep(Index i, SolidPoint const& point) const {
    using At = SolidFields;
    auto const& h = point.history;
    last_F_out_.matrix<3>(i, point.F);
    for (int c = 0; c < 6; ++c) history_out_.scalar(i, h.S.c[c], c);
    history_out_.scalar(i, h.plastic_strain, At::plastic_strain);
    history_out_.scalar(i, h.temperature, At::temperature);
    history_out_.scalar(i, h.damage, At::damage);
    history_out_.scalar(i, h.plastic_work, At::plastic_work);
    history_out_.scalar(i, point.pressure, At::pressure);
    history_out_.scalar(i, point.energy, At::energy);
  }

  void const* law_;
  Mat<3> (*advance_)(void const*, SolidPoint&, Mat<3> const&, SolidIncrement const&);
  double (*sound_speed_)(void const*, double, double);
  double rho0_;
  SolidIncrement step_;
  bool as_left_, commit_;
  View last_F_, history_;
  WriteView last_F_out_, history_out_;
};

/// Time of a stress evaluation within a step.
enum class StressAt {
  start,  ///< at the end of the last step
  stage,  ///< within a step
  end     ///< at the end of a step, whose state is stored
};

/// Calls f(law) with the law of a body, hyperelastic or SolidStress, for an increment of dt [s] since the last step.
/// Trial steps store no state and have no yield.
template <class F>
void with_stress_law(BodyState const& body, double dt, StressAt when, F const& f) {
  with_law(body.material, f);
  with_solid(body.material, [&](auto const& law) {
    f(SolidStress(law, body, {dt, body.trial}, when == StressAt::start, when == StressAt::end && !body.trial));
  });
}

/// Stores the state of a solid at the end of a step.
template <int D>
struct CommitSolid {
  SolidStress law;
  View F;
  PIOLA_FN void operator()(Index i) const { (void)law.first_piola(i, embed<D>(F.matrix<D, Lanes>(i))); }
};

/// Stores the state of the solid at the F of the body, dt [s] after the last; does nothing for other laws.
template <int D>
void commit_solid(BodyState const& body, double dt) {
  with_solid(body.material, [&](auto const& law) {
    exec::for_each(body.slots, CommitSolid<D>{SolidStress(law, body, {dt, false}, false, true), read(body.F)});
  });
}

}  // namespace piola::jst_sph::inline PIOLA_MACHINE
