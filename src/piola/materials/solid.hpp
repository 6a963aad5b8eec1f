// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/damage/johnson_cook.hpp"
#include "piola/materials/damage/scatter.hpp"
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
  double bulking = 0;         ///< pressure of broken material that wants more room [Pa]
  double burnt = 1;           ///< part of an explosive that has become gas
  double toughness = 1;       ///< the point's own factor on what it bears before it fails; never changes
};

/// Where the parameters of a solid with this strength lie in MaterialParameters::value: elastic constants, strength,
/// heat, equations of state, damage, spall, scatter.
template <class Strength>
struct SolidLayout {
  static constexpr int strength = static_cast<int>(ElasticConstants::parameters.size());
  static constexpr int heat = strength + static_cast<int>(Strength::parameters.size());
  static constexpr int eos = heat + (Strength::yields ? Heat::size : 0);
  static constexpr int damage = eos + static_cast<int>(EosValues::parameters.size());
  static constexpr int spall = damage + (Strength::yields ? static_cast<int>(JohnsonCookDamage::parameters.size()) : 0);
  static constexpr int scatter = spall + 1;
  static constexpr int size = scatter + (Strength::yields ? Scatter::size : 0);
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
  static constexpr bool pressed = Strength::pressed;  ///< the strength asks for the pressure
  static constexpr bool brittle = Strength::brittle;  ///< what is broken still bears shear under pressure

  double rho0;            ///< density at rest [kg/m^3]
  double mu;              ///< shear modulus [Pa]
  double kappa;           ///< bulk modulus at rest, of the equation of state [Pa]
  double spall_pressure;  ///< largest tension [Pa]; infinity: no limit
  bool damages;           ///< whether damage grows, or spall is a failure
  Scatter scatter;        ///< of what its particles bear

  explicit Solid(MaterialParameters const& material)
      : Solid(ElasticConstants(material.value), material,
              Heat(Strength::yields ? material.value + Layout::heat : nullptr)) {}

  /// Pressure, positive in compression, not below -spall_pressure [Pa]. rho: density [kg/m^3], e: specific energy
  /// [J/kg].
  PIOLA_FN double pressure(double rho, double e) const { return pressure(SolidHistory{}, rho, e); }
  /// The same of a point with a history: with its bulking, and with the tension that it bears.
  PIOLA_FN double pressure(SolidHistory const& h, double rho, double e) const {
    double const p = h.burnt * eos_.pressure(rho, e) + h.bulking;
    double most = spall_pressure * h.toughness;
    if constexpr (Strength::brittle) most = minimum(most, strength_.largest_tension(h.damage));
    return p < -most ? -most : p;
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
  /// Energy at the start, of explosives [J/kg].
  PIOLA_FN double initial_energy() const {
    if constexpr (requires { eos_.initial_energy; }) return eos_.initial_energy;
    return 0;
  }
  /// Speed of the detonation front [m/s]; 0: not an explosive.
  PIOLA_FN double front_speed() const {
    if constexpr (requires { eos_.front_speed; }) return eos_.front_speed;
    return 0;
  }
  /// [K]
  PIOLA_FN double initial_temperature() const { return heat_.initial; }
  /// Yield stress of a state at a plastic strain rate [1/s] and a pressure [Pa]; infinity for an elastic solid [Pa].
  PIOLA_FN double yield_stress(SolidHistory const& h, double rate, double pressure = 0) const {
    return strength_.yield_stress(flow_state(h, pressure), rate);
  }

  /// Rate of the deviator, 2 mu dev D + W S - S W [Pa/s], D and W the parts of the velocity gradient L [1/s].
  PIOLA_FN SymMat<3> deviator_rate(SymMat<3> const& S, Mat<3> const& L) const {
    double const mean = (L(0, 0) + L(1, 1) + L(2, 2)) / 3;
    // W S - S W with the three components of W: x = W_xy, y = W_xz, z = W_yz.
    double const x = 0.5 * (L(0, 1) - L(1, 0)), y = 0.5 * (L(0, 2) - L(2, 0)), z = 0.5 * (L(1, 2) - L(2, 1));
    double const xy = S(0, 1), xz = S(0, 2), yz = S(1, 2);
    SymMat<3> rate;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) rate(i, j) = mu * (L(i, j) + L(j, i)) - (i == j ? 2 * mu * mean : 0);
    rate(0, 0) += 2 * (x * xy + y * xz);
    rate(1, 1) += 2 * (z * yz - x * xy);
    rate(2, 2) -= 2 * (y * xz + z * yz);
    rate(0, 1) += x * (S(1, 1) - S(0, 0)) + y * yz + z * xz;
    rate(0, 2) += y * (S(2, 2) - S(0, 0)) + x * yz - z * xy;
    rate(1, 2) += z * (S(2, 2) - S(1, 1)) - x * xz - y * xy;
    return rate;
  }

  /// The trial deviator brought back to the yield surface after dt [s], for predictions: the history stays as it is.
  /// pressure [Pa]; compression: rho/rho0.
  PIOLA_FN SymMat<3> returned(SolidHistory const& h, SymMat<3> const& trial, double dt, double pressure = 0,
                              double compression = 1) const {
    double const mises = von_mises(trial);
    return scaled(trial, mises, strength_.increment(mises, 3 * mu, flow_state(h, pressure, compression), dt));
  }

  /// The same from the flow stress of the last plastic step [Pa], 0 where there was none: laws whose yield stress asks
  /// for powers and logarithms are spared them, as it changes little from step to step. A strength that asks for the
  /// pressure waits until that is known: the trial itself.
  PIOLA_FN SymMat<3> predicted(SolidHistory const& h, SymMat<3> const& trial, double flow, double dt) const {
    if constexpr (pressed) return trial;
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
    FlowState const before = flow_state(h, pressure, rho / rho0);
    double const mises = von_mises(trial), strain = strength_.increment(mises, 3 * mu, before, dt, last_flow);
    h.S = scaled(trial, mises, strain);
    if (spalls(h.S, pressure, h.toughness)) h.damage = 1;
    if (!(strain > 0)) return 0;
    double const flow = mises - 3 * mu * strain, rate = dt > 0 ? strain / dt : 0;
    wear(h, before, flow, strain, rate, rho);
    double const work = (flow > 0 ? flow : 0) * strain * rho0 / rho;
    h.plastic_strain += strain;
    h.plastic_work += work;
    h.temperature += heat_.fraction * work / (rho0 * heat_.specific_heat);
    return flow > 0 ? flow : 0;
  }

  /// Whether tension tears the material: `hydrostatic`, when the mean stress reaches spall_pressure; `principal`, when
  /// the largest principal stress does. S: deviator; pressure: positive in compression [Pa].
  PIOLA_FN bool spalls(SymMat<3> const& S, double pressure, double toughness = 1) const {
    double const most = spall_pressure * toughness;
    if (spall_ == 0) return false;
    if (spall_ == 1) return !(pressure > -most);
    if (!(eigenvalue_bound(S) - pressure > most)) return false;  // most particles
    Eigen<3> const e = symmetric_eigen(S);
    double largest = e.value[0];
    for (double const value : e.value) largest = value > largest ? value : largest;
    return largest - pressure > most;
  }

 private:
  static constexpr double none[Scatter::size] = {unbounded, 0, 1};

  Solid(ElasticConstants const& elastic, MaterialParameters const& m, Heat const& heat)
      : rho0(elastic.rho0),
        mu(elastic.mu),
        kappa(0),
        spall_pressure(m.value[Layout::spall]),
        damages(false),
        scatter(Strength::yields ? m.value + Layout::scatter : none),
        wears_(Strength::brittle || (Strength::yields && m.word[Layout::damage_word] > 0)),
        spall_(Strength::yields ? m.word[Layout::spall_word] : 0),
        heat_(heat),
        strength_(m.value + Layout::strength, heat),
        eos_(EosValues(elastic.rho0, elastic.kappa, m.value + Layout::eos)),
        damage_(m.value + Layout::damage, heat) {
    kappa = eos_.bulk_modulus();
    damages = wears_ || spall_ > 0;
  }

  PIOLA_FN static FlowState flow_state(SolidHistory const& h, double pressure, double compression = 1) {
    return {h.plastic_strain, h.temperature, pressure, h.damage, compression};
  }
  /// Damage of a plastic step, and the bulking that follows from it.
  PIOLA_FN void wear(SolidHistory& h, FlowState const& before, double flow, double strain, double rate,
                     double rho) const {
    if (!wears_) return;
    if constexpr (Strength::brittle) {
      h.damage = JohnsonCookDamage::grown(h.damage, strain, h.toughness * strength_.fracture_strain(before.pressure));
      double const held = strength_.yield_stress(before, rate);
      h.bulking = strength_.bulked(h.bulking, held, strength_.yield_stress(flow_state(h, before.pressure), rate),
                                   rho / rho0 - 1, kappa, mu);
    } else {
      double const least = 1e-12 * mu;  // molten: no von Mises stress
      double const fracture =
          damage_.fracture_strain(-before.pressure / (flow > least ? flow : least), rate, h.temperature);
      h.damage = JohnsonCookDamage::grown(h.damage, strain, h.toughness * fracture);
    }
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
