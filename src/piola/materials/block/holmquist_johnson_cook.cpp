// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block/own_laws.hpp"
#include "piola/materials/block/rate_form.hpp"
#include "piola/materials/elastic_constants.hpp"
#include "piola/math/root.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

/// Concrete under impact (Holmquist, Johnson, Cook, 14th Int. Symp. Ballistics, 1993). P is positive in compression,
/// m = rho/rho0 - 1, P* = P/fc, T* = T/fc, q the von Mises stress:
///   strength  q/fc <= (A (1 - D) + B P*^N) (1 + C ln rate/rate0), at most Smax; P < 0: A (1 - D) + A P/T for the
///             first factor
///   damage    dD = (plastic strain + plastic part of m) / max(D1 (P* + T*)^D2, ef_min)
///   pressure  elastic up to Pcrush at m_crush; crushing along a line up to Plock; then K1 x + K2 x^2 + K3 x^3,
///             x = (m - m_lock)/(1 + m_lock). Unloading: by Pcrush/m_crush before crushing, K1 at Plock, between them
///             in proportion to the largest m; locked material along its curve. Tension: at most T (1 - D)
/// The rate is that of the deviatoric strain of the step; D counts in the next step.
namespace piola::block_laws {
namespace holmquist_johnson_cook_law {
namespace {

constexpr std::array parameters{
    ElasticConstants::parameters[0],
    Parameter{"shear_modulus", "Pa", "G", positive},
    Parameter{"compressive_strength", "Pa", "fc, quasi-static uniaxial, scale of stresses", positive},
    Parameter{"tensile_strength", "Pa", "T, largest hydrostatic tension of intact material", positive},
    Parameter{"cohesive_strength", "1", "A", not_negative},
    Parameter{"pressure_hardening", "1", "B", not_negative},
    Parameter{"pressure_exponent", "1", "N", not_negative},
    Parameter{"rate_coefficient", "1", "C", not_negative, 0},
    Parameter{"reference_rate", "1/s", "rate0, strain rate above which rate counts", positive, 1},
    Parameter{"largest_strength", "1", "Smax, largest q/fc", positive, unbounded, "no limit"},
    Parameter{"fracture_coefficient", "1", "D1 of the plastic strain to fracture", positive},
    Parameter{"fracture_exponent", "1", "D2 of the plastic strain to fracture", not_negative, 1},
    Parameter{"least_fracture_strain", "1", "ef_min, least plastic strain to fracture", not_negative, 0.01},
    Parameter{"crush_pressure", "Pa", "Pcrush, where crushing starts", positive},
    Parameter{"crush_compression", "1", "m_crush, rho/rho0 - 1 at Pcrush", positive},
    Parameter{"lock_pressure", "Pa", "Plock, where all air voids are closed", positive},
    Parameter{"lock_compression", "1", "m_lock, density of the grains over rho0, less 1", positive},
    Parameter{"k1", "Pa", "K1 of locked material", positive},
    Parameter{"k2", "Pa", "K2", any_value, 0},
    Parameter{"k3", "Pa", "K3", not_negative, 0}};

enum Value {
  shear,
  fc,
  tension,
  A,
  B,
  N,
  C,
  rate0,
  most,
  D1,
  D2,
  least_strain,
  p_crush,
  m_crush,
  p_lock,
  m_lock,
  k1,
  k2,
  k3
};
static_assert(parameters.size() == k3 + 2);
enum History { plastic_strain, damage, largest };
constexpr std::array<piola_history, 3> history{
    {{"EquivalentPlasticStrain", "1", 0}, {"Damage", "1", 0}, {"LargestCompression", "1", 0}}};

/// The pressure by m and the largest m so far.
class Compaction {
 public:
  explicit Compaction(double const* v) : v_(v), elastic_(v[p_crush] / v[m_crush]) {
    double high = v[p_lock] / v[k1];
    auto const miss = [&](double x) { return Sloped{v[p_lock] - locked(x), -slope(x)}; };
    while (miss(high).value > 0) high *= 2;
    end_ = v[m_lock] + (1 + v[m_lock]) * falling_root(miss, 0, high, 1e-15 * v[p_lock]);
    crushing_ = (v[p_lock] - v[p_crush]) / (end_ - v[m_crush]);
  }
  /// m at Plock.
  double end() const { return end_; }
  /// dP/dm before, while and after crushing [Pa].
  double elastic() const { return elastic_; }
  double crushing() const { return crushing_; }

  /// Largest elastic pressure of material that was compressed to `most` [Pa].
  double first_loading(double most) const {
    if (most <= v_[m_crush]) return elastic_ * most;
    return most < end_ ? v_[p_crush] + crushing_ * (most - v_[m_crush]) : locked(strain(most));
  }
  /// dP/dm of unloading from `most` [Pa].
  double unloading(double most) const {
    double const part = std::clamp((most - v_[m_crush]) / (end_ - v_[m_crush]), 0.0, 1.0);
    return (1 - part) * elastic_ + part * v_[k1];
  }
  double pressure(double m, double most) const {
    if (most >= end_) return locked(strain(m));
    return first_loading(most) - unloading(most) * (most - m);
  }
  double tangent(double m, double most) const {
    return most >= end_ ? slope(strain(m)) / (1 + v_[m_lock]) : unloading(most);
  }
  /// Part of m that stays without pressure.
  double plastic(double most) const { return most >= end_ ? v_[m_lock] : most - first_loading(most) / unloading(most); }

 private:
  double strain(double m) const { return (m - v_[m_lock]) / (1 + v_[m_lock]); }
  double locked(double x) const { return x > 0 ? x * (v_[k1] + x * (v_[k2] + x * v_[k3])) : v_[k1] * x; }
  double slope(double x) const { return x > 0 ? v_[k1] + x * (2 * v_[k2] + 3 * x * v_[k3]) : v_[k1]; }

  double const* v_;
  double elastic_, crushing_ = 0, end_ = 0;
};

/// Largest von Mises stress [Pa].
double strength(double const* v, double pressure, double lost, double rate) {
  double const cohesion = v[A] * (1 - lost), P = pressure / v[fc];
  double const part =
      P > 0 ? cohesion + v[B] * std::pow(P, v[N]) : std::max(cohesion + v[A] * pressure / v[tension], 0.0);
  double const factor = rate > v[rate0] ? 1 + v[C] * std::log(rate / v[rate0]) : 1;
  return v[fc] * std::min(part * factor, v[most]);
}

double fracture_strain(double const* v, double pressure) {
  double const P = (pressure + v[tension]) / v[fc];
  return std::max(P > 0 ? v[D1] * std::pow(P, v[D2]) : 0, v[least_strain]);
}

double strain_rate(piola_points const& at, int p) {
  double d[6], square = 0;
  piola_strain_increment(&at, p, d);
  double const mean = (d[0] + d[1] + d[2]) / 3;
  for (int c = 0; c < 6; ++c) square += (c < 3 ? 1 : 2) * (c < 3 ? (d[c] - mean) * (d[c] - mean) : d[c] * d[c]);
  return std::sqrt(2.0 / 3 * square) / at.dt;
}

int update(piola_points const* points) {
  piola_points const& at = *points;
  double const* const v = at.parameters;
  Compaction const law(v);
  for (int p = 0; p < at.count; ++p) {
    auto const value = [&](int h) -> double& { return at.history[h * at.stride + p]; };
    double const J = determinant(matrix_at(at.F_new, at, p)), m = 1 / J - 1, before = value(largest);
    if (!(J > 0)) return 1;
    SplitStress const trial = elastic_trial(at, p, v[shear], 0);
    // Without time the answer is elastic: trial displacements crush nothing.
    double const after = at.dt > 0 ? std::max(m, before) : before;
    double const pressure = std::max(law.pressure(m, after), -v[tension] * (1 - value(damage)));
    double mises = trial.mises;
    if (at.dt > 0) {
      mises = std::min(mises, strength(v, pressure, value(damage), strain_rate(at, p)));
      double const strain = (trial.mises - mises) / (3 * v[shear]), crushed = law.plastic(after) - law.plastic(before);
      double const broken = strain + std::max(crushed, 0.0), limit = fracture_strain(v, pressure);
      if (broken > 0) value(damage) = limit > 0 ? std::min(1.0, value(damage) + broken / limit) : 1;
      value(plastic_strain) += strain;
      value(largest) = after;
    }
    put_returned(trial, mises, pressure, at, p);
    put_sound_speed((1 + m) * std::max(law.tangent(m, after), law.elastic()) + 4.0 / 3 * v[shear], at, p);
  }
  return 0;
}

std::string problem_of(double const* v) {
  if (v[p_lock] <= v[p_crush])
    return fmt::format("lock_pressure {:.4g} Pa must be above crush_pressure, {:.4g} Pa", v[p_lock], v[p_crush]);
  if (v[k2] < 0 && v[k2] * v[k2] >= 3 * v[k1] * v[k3])
    return fmt::format(
        "the pressure of locked material falls with compression: k2^2 must be below 3 k1 k3, so k2 above "
        "{:.4g} Pa",
        -std::sqrt(3 * v[k1] * v[k3]));
  Compaction const law(v);
  if (v[m_crush] >= law.end())
    return fmt::format("crush_compression {:.4g} must be below the compression at lock_pressure, {:.4g}", v[m_crush],
                       law.end());
  double const stiffest = std::min(law.elastic(), v[k1]);
  if (law.crushing() < stiffest) return {};
  return fmt::format(
      "crushing is stiffer than unloading and would give energy: (lock_pressure - crush_pressure) over the "
      "compression between them is {:.4g} Pa, and must be below crush_pressure / crush_compression and "
      "k1, {:.4g} Pa",
      law.crushing(), stiffest);
}

int check(double const* v, char* message, int size) { return put_message(problem_of(v), message, size); }

constexpr piola_material law =
    describe("holmquist_johnson_cook", PIOLA_COROTATED_CAUCHY, PIOLA_YIELDS, history, &check, &update);

}  // namespace
}  // namespace holmquist_johnson_cook_law

constinit LawInfo const holmquist_johnson_cook{
    .name = "holmquist_johnson_cook",
    .about = "concrete under impact: strength by pressure, rate and damage; crushing and locking of voids",
    .validity =
        "compression and shear; tension is a limit of the mean stress alone, and nothing opens; the stress of "
        "damaged tension depends on the size of cells",
    .parameters = holmquist_johnson_cook_law::parameters,
    .block = &holmquist_johnson_cook_law::law};

}  // namespace piola::block_laws
