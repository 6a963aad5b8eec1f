// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/damage/johnson_cook.hpp"
#include "piola/materials/elastic_constants.hpp"
#include "piola/materials/eos/values.hpp"
#include "piola/materials/plastic/heat.hpp"
#include "piola/materials/registry.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include "piola/math/tensor.hpp"
#include <cmath>

namespace piola::inline PIOLA_MACHINE {

/// The word `spall` of a solid: what follows where tension reaches spall_pressure.
inline constexpr std::array<std::string_view, 3> spall_words{"limit", "hydrostatic", "principal"};

/// What a point of a solid remembers besides density and energy.
struct SolidHistory {
  SymMat<3> S{};              ///< deviatoric Cauchy stress [Pa]
  double plastic_strain = 0;  ///< equivalent plastic strain
  double temperature = 0;     ///< [K]; starts at Solid::initial_temperature
  double damage = 0;          ///< 0 to 1
  double plastic_work = 0;    ///< per reference volume [J/m^3]
};

/// Where the parameters of a solid with this strength lie in MaterialParameters::value: elastic constants, strength,
/// heat, equations of state, damage, spall.
template <class Strength>
struct SolidLayout {
  static constexpr int strength = static_cast<int>(ElasticConstants::parameters.size());
  static constexpr int heat = strength + static_cast<int>(Strength::parameters.size());
  static constexpr int eos = heat + (Strength::yields ? Heat::size : 0);
  static constexpr int damage = eos + static_cast<int>(EosValues::parameters.size());
  static constexpr int spall = damage + (Strength::yields ? static_cast<int>(JohnsonCookDamage::parameters.size()) : 0);
  static constexpr int size = spall + 1;
  static constexpr int eos_word = 0, damage_word = 1, spall_word = 2;
};

/// von Mises stress sqrt(3/2 S:S) of a deviator [Pa].
PIOLA_FN double von_mises(SymMat<3> const& S) {
  double const diagonal = S.c[0] * S.c[0] + S.c[1] * S.c[1] + S.c[2] * S.c[2];
  return std::sqrt(1.5 * (diagonal + 2 * (S.c[3] * S.c[3] + S.c[4] * S.c[4] + S.c[5] * S.c[5])));
}

/// An isotropic solid in rate form: Cauchy stress S - p I, the deviator S by its Jaumann rate and radial return to the
/// yield surface of von Mises (Wilkins 1964; Simo, Hughes, Computational Inelasticity, 1998, box 3.1), the pressure p
/// by an equation of state of density and energy. Heating is adiabatic. Pure: the history is the caller's.
template <class Strength, class Eos>
class Solid {
 public:
  using Layout = SolidLayout<Strength>;

  double rho0;            ///< density at rest [kg/m^3]
  double mu;              ///< shear modulus [Pa]
  double kappa;           ///< bulk modulus at rest, of the equation of state [Pa]
  double spall_pressure;  ///< largest tension [Pa]; infinity: no limit
  bool damages;           ///< whether damage grows, or spall is a failure

  explicit Solid(MaterialParameters const& material)
      : Solid(ElasticConstants(material.value), material,
              Heat(Strength::yields ? material.value + Layout::heat : nullptr)) {}

  /// Pressure, positive in compression, not below -spall_pressure [Pa]. rho: density [kg/m^3], e: specific energy
  /// [J/kg].
  PIOLA_FN double pressure(double rho, double e) const {
    double const p = eos_.pressure(rho, e);
    return p < -spall_pressure ? -spall_pressure : p;
  }
  /// Speed of pressure waves in the current state [m/s]: c^2 = dp/drho + (p/rho^2) dp/de + 4 mu / (3 rho). The part of
  /// the pressure is never below a ten-thousandth of the one at rest; the limit of tension does not lower it.
  PIOLA_FN double sound_speed(double rho, double e) const {
    double const bulk = eos_.sound_speed_squared(rho, e), least = 1e-4 * kappa / rho0;
    return std::sqrt((bulk > least ? bulk : least) + 4 * mu / (3 * rho));
  }
  /// sqrt(kappa/rho0) [m/s].
  PIOLA_FN double bulk_sound_speed() const { return std::sqrt(kappa / rho0); }
  /// Speed of pressure waves at rest [m/s].
  PIOLA_FN double p_wave_speed() const { return std::sqrt((kappa + 4 * mu / 3) / rho0); }
  /// Speed of shear waves at rest [m/s].
  PIOLA_FN double s_wave_speed() const { return std::sqrt(mu / rho0); }
  /// [K]
  PIOLA_FN double initial_temperature() const { return heat_.initial; }
  /// Yield stress of a state at a plastic strain rate [1/s]; infinity for an elastic solid [Pa].
  PIOLA_FN double yield_stress(SolidHistory const& h, double rate) const {
    return strength_.yield_stress(h.plastic_strain, rate, h.temperature);
  }

  /// Rate of the deviator, 2 mu dev D + W S - S W [Pa/s], D and W the parts of the velocity gradient L [1/s].
  PIOLA_FN SymMat<3> deviator_rate(SymMat<3> const& S, Mat<3> const& L) const {
    double const mean = (L(0, 0) + L(1, 1) + L(2, 2)) / 3;
    SymMat<3> rate;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        double sum = mu * (L(i, j) + L(j, i)) - (i == j ? 2 * mu * mean : 0);
        for (int k = 0; k < 3; ++k) sum += 0.5 * ((L(i, k) - L(k, i)) * S(k, j) - S(i, k) * (L(k, j) - L(j, k)));
        rate(i, j) = sum;
      }
    return rate;
  }

  /// The trial deviator brought back to the yield surface after dt [s], for predictions: the history stays as it is.
  PIOLA_FN SymMat<3> returned(SolidHistory const& h, SymMat<3> const& trial, double dt) const {
    double const mises = von_mises(trial);
    return scaled(trial, mises, increment(h, mises, dt));
  }

  /// The same from the flow stress of the last plastic step [Pa], 0 where there was none: laws whose yield stress asks
  /// for powers and logarithms are spared them, as it changes little from step to step.
  PIOLA_FN SymMat<3> predicted(SolidHistory const& h, SymMat<3> const& trial, double flow, double dt) const {
    if (!Strength::thermal || !(flow > 0)) return returned(h, trial, dt);
    double const mises = von_mises(trial);
    return scaled(trial, mises, (mises - flow) / (3 * mu));
  }

  /// One step of dt [s] with the trial deviator [Pa]: radial return, plastic strain, plastic work, heat and damage.
  /// pressure [Pa] and rho [kg/m^3] are those of the end of the step; `last_flow` is what the last plastic step
  /// returned, from where the search starts. Returns the von Mises stress after plastic flow [Pa], 0 after an elastic
  /// step.
  PIOLA_FN double update(SolidHistory& h, SymMat<3> const& trial, double pressure, double rho, double dt,
                         double last_flow = 0) const {
    double const mises = von_mises(trial),
                 strain = strength_.increment(mises, 3 * mu, h.plastic_strain, h.temperature, dt, last_flow);
    h.S = scaled(trial, mises, strain);
    if (spalls(h.S, pressure)) h.damage = 1;
    if (!(strain > 0)) return 0;
    double const flow = mises - 3 * mu * strain, rate = dt > 0 ? strain / dt : 0;
    if (wears_) {
      double const least = 1e-12 * mu;  // molten: no von Mises stress
      double const fracture = damage_.fracture_strain(-pressure / (flow > least ? flow : least), rate, h.temperature);
      h.damage = JohnsonCookDamage::grown(h.damage, strain, fracture);
    }
    double const work = (flow > 0 ? flow : 0) * strain * rho0 / rho;
    h.plastic_strain += strain;
    h.plastic_work += work;
    h.temperature += heat_.fraction * work / (rho0 * heat_.specific_heat);
    return flow > 0 ? flow : 0;
  }

  /// Whether tension tears the material: `hydrostatic`, when the mean stress reaches spall_pressure; `principal`, when
  /// the largest principal stress does. S: deviator; pressure: positive in compression [Pa].
  PIOLA_FN bool spalls(SymMat<3> const& S, double pressure) const {
    if (spall_ == 0) return false;
    if (spall_ == 1) return !(pressure > -spall_pressure);
    if (!(eigenvalue_bound(S) - pressure > spall_pressure)) return false;  // most particles
    Eigen<3> const e = symmetric_eigen(S);
    double largest = e.value[0];
    for (double const value : e.value) largest = value > largest ? value : largest;
    return largest - pressure > spall_pressure;
  }

 private:
  Solid(ElasticConstants const& elastic, MaterialParameters const& m, Heat const& heat)
      : rho0(elastic.rho0),
        mu(elastic.mu),
        kappa(0),
        spall_pressure(m.value[Layout::spall]),
        damages(false),
        wears_(Strength::yields && m.word[Layout::damage_word] > 0),
        spall_(Strength::yields ? m.word[Layout::spall_word] : 0),
        heat_(heat),
        strength_(m.value + Layout::strength, heat),
        eos_(EosValues(elastic.rho0, elastic.kappa, m.value + Layout::eos)),
        damage_(m.value + Layout::damage, heat) {
    kappa = eos_.bulk_modulus();
    damages = wears_ || spall_ > 0;
  }

  PIOLA_FN double increment(SolidHistory const& h, double mises, double dt) const {
    return strength_.increment(mises, 3 * mu, h.plastic_strain, h.temperature, dt);
  }
  PIOLA_FN SymMat<3> scaled(SymMat<3> S, double mises, double strain) const {
    if (!(strain > 0)) return S;
    double const left = mises - 3 * mu * strain, factor = left > 0 ? left / mises : 0;
    for (double& s : S.c) s *= factor;
    return S;
  }

  bool wears_;  ///< damage grows with plastic strain
  int spall_;   ///< of spall_words
  Heat heat_;
  Strength strength_;
  Eos eos_;
  JohnsonCookDamage damage_;
};

}  // namespace piola::inline PIOLA_MACHINE
