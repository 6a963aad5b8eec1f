// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/damage/fracture.hpp"
#include "piola/materials/damage/johnson_cook.hpp"
#include "piola/materials/damage/scatter.hpp"
#include "piola/materials/elastic_constants.hpp"
#include "piola/materials/eos/list.hpp"
#include "piola/materials/plastic/adiabatic_heating.hpp"
#include "piola/materials/registry.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include "piola/math/tensor.hpp"
#include <cmath>
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// The word `spall` of a solid: consequence of tension reaching spall_pressure.
inline constexpr std::array<std::string_view, 3> spall_words{"limit", "hydrostatic", "principal"};

/// History of a point of a solid, without density and energy; V: one point, or one per lane.
template <class V>
struct SolidHistoryOf {
  SymMat<3, V> S{};           ///< deviatoric Cauchy stress [Pa]
  V plastic_strain = V(0.0);  ///< equivalent plastic strain
  V temperature = V(0.0);     ///< [K]; starts at Solid::initial_temperature
  V damage = V(0.0);          ///< 0 to 1
  V plastic_work = V(0.0);    ///< per reference volume [J/m^3]
  V bulking = V(0.0);         ///< pressure by bulking of broken material [Pa]
  V burnt = V(1.0);           ///< burnt fraction of an explosive by the time since its ignition
  V toughness = V(1.0);       ///< the point's own factor on the failure strength; constant
};
using SolidHistory = SolidHistoryOf<double>;

/// Offsets of the parameters of a solid with this strength in MaterialParameters::value: elastic constants, strength,
/// heat, equations of state, damage, spall, fracture, scatter.
template <class Strength>
struct SolidLayout {
  static constexpr int strength = static_cast<int>(ElasticConstants::parameters.size());
  static constexpr int heat = strength + static_cast<int>(Strength::parameters.size());
  static constexpr int eos = heat + (Strength::yields ? Heat::size : 0);
  static constexpr int damage = eos + static_cast<int>(eos_parameters.size());
  static constexpr int spall = damage + (Strength::yields ? static_cast<int>(JohnsonCookDamage::parameters.size()) : 0);
  static constexpr int fracture = spall + 1;
  static constexpr int scatter = fracture + (Strength::brittle ? 0 : Fracture::size);
  static constexpr int size = scatter + Scatter::size;
  static constexpr int eos_word = 0, damage_word = 1, spall_word = 2;
};

/// Tag of a law of the registry by its strength. Solids carry its part `Runs`, if it names one, so that laws share the
/// types of their solids.
template <class Strength>
struct SolidOf {
  using Runs = Strength;
};
template <class Strength>
  requires requires { typename Strength::Runs; }
struct SolidOf<Strength> {
  using Runs = typename Strength::Runs;
};

/// The strength of a material.
template <class Strength>
PIOLA_SHARED inline Strength made_strength(MaterialParameters const& material, Heat const& heat) {
  double const* const values = material.value + SolidLayout<Strength>::strength;
  if constexpr (requires { Strength::table; })
    return Strength(values, heat, material.table);
  else
    return Strength(values, heat);
}

/// von Mises stress sqrt(3/2 S:S) of a deviator [Pa].
template <class V>
PIOLA_FN V von_mises(SymMat<3, V> const& S) {
  V const diagonal = S.c[0] * S.c[0] + S.c[1] * S.c[1] + S.c[2] * S.c[2];
  return square_root(1.5 * (diagonal + 2.0 * (S.c[3] * S.c[3] + S.c[4] * S.c[4] + S.c[5] * S.c[5])));
}

/// An isotropic solid in rate form: Cauchy stress S - p I, the deviator S by its Jaumann rate and radial return to the
/// yield surface of von Mises (Wilkins 1964; Simo, Hughes, Computational Inelasticity, 1998, box 3.1), the pressure p
/// by an equation of state of density and energy. Heating within a step is adiabatic. Pure functions: the caller owns
/// the history. V is `double` or a pack of lanes; strengths that solve for the flow stress are evaluated lane by lane,
/// only for lanes that may yield.
template <class Strength, class Eos>
class Solid {
 public:
  using Layout = SolidLayout<Strength>;
  static constexpr bool yields = Strength::yields;
  static constexpr bool pressed = Strength::pressed;  ///< the strength depends on the pressure
  static constexpr bool brittle = Strength::brittle;  ///< broken material still carries shear under pressure

  double rho0;            ///< density at rest [kg/m^3]
  double mu;              ///< shear modulus [Pa]
  double kappa;           ///< bulk modulus at rest, of the equation of state [Pa]
  double spall_pressure;  ///< largest tension [Pa]; infinity: no limit
  bool damages;           ///< whether damage grows, or spall is a failure
  Fracture fracture;
  Scatter scatter;  ///< of the failure strength of particles

  /// The solid of a law of the registry, whose strength is this one or derives from it.
  template <class Law = Strength>
  PIOLA_SHARED inline explicit Solid(MaterialParameters const& material, SolidOf<Law> law = {})
      : Solid(ElasticConstants(material.value), material,
              Heat(Strength::yields ? material.value + SolidLayout<Law>::heat : nullptr), law) {}

  /// Pressure, positive in compression, not below -spall_pressure [Pa]. rho: density [kg/m^3], e: specific energy
  /// [J/kg].
  PIOLA_FN double pressure(double rho, double e) const { return pressure(SolidHistory{}, rho, e); }
  /// As above for a point with a history: with its bulking and its tension limit.
  template <class V = double>
  PIOLA_FN V pressure(SolidHistoryOf<V> const& h, std::type_identity_t<V> const& rho,
                      std::type_identity_t<V> const& e) const {
    V const p = burnt(h, rho) * eos_.template pressure<V>(rho, e) + h.bulking;
    V most = spall_pressure * h.toughness;
    if constexpr (Strength::brittle) most = minimum(most, strength_.largest_tension(h.damage));
    V const least = -most;
    return select(p < least, least, p);
  }
  /// Speed of pressure waves in the current state [m/s]: c^2 = dp/drho + (p/rho^2) dp/de + 4 mu / (3 rho). The part of
  /// the pressure is never below a ten-thousandth of the one at rest; the limit of tension does not lower it.
  template <class V = double>
  PIOLA_FN V sound_speed(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    V const bulk = eos_.template sound_speed_squared<V>(rho, e), least(1e-4 * kappa / rho0);
    return square_root(select(bulk > least, bulk, least) + 4 * mu / (3.0 * rho));
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
  PIOLA_FN Heat const& heat() const { return heat_; }
  /// [K]
  PIOLA_FN double initial_temperature() const { return heat_.initial; }
  /// Yield stress of a state at a plastic strain rate [1/s] and a pressure [Pa]; infinity for an elastic solid [Pa].
  PIOLA_FN double yield_stress(SolidHistory const& h, double rate, double pressure = 0) const {
    return strength_.yield_stress(flow_state(h, pressure), rate);
  }

  /// Rate of the deviator, 2 mu dev D + W S - S W [Pa/s], D and W the parts of the velocity gradient L [1/s].
  template <class V>
  PIOLA_FN SymMat<3, V> deviator_rate(SymMat<3, V> const& S, Mat<3, V> const& L) const {
    V const mean = (L(0, 0) + L(1, 1) + L(2, 2)) / 3.0;
    // W S - S W with the three components of W: x = W_xy, y = W_xz, z = W_yz.
    V const x = 0.5 * (L(0, 1) - L(1, 0)), y = 0.5 * (L(0, 2) - L(2, 0)), z = 0.5 * (L(1, 2) - L(2, 1));
    V const xy = S(0, 1), xz = S(0, 2), yz = S(1, 2);
    SymMat<3, V> rate;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        rate(i, j) = i == j ? mu * (L(i, j) + L(j, i)) - 2 * mu * mean : mu * (L(i, j) + L(j, i));
    rate(0, 0) += 2.0 * (x * xy + y * xz);
    rate(1, 1) += 2.0 * (z * yz - x * xy);
    rate(2, 2) -= 2.0 * (y * xz + z * yz);
    rate(0, 1) += x * (S(1, 1) - S(0, 0)) + y * yz + z * xz;
    rate(0, 2) += y * (S(2, 2) - S(0, 0)) + x * yz - z * xy;
    rate(1, 2) += z * (S(2, 2) - S(1, 1)) - x * xz - y * xy;
    return rate;
  }

  /// The trial deviator brought back to the yield surface after dt [s], for predictions: the history stays as it is.
  /// pressure [Pa]; compression: rho/rho0.
  template <class V>
  PIOLA_FN SymMat<3, V> returned(SolidHistoryOf<V> const& h, SymMat<3, V> const& trial, double dt,
                                 std::type_identity_t<V> const& pressure = V(0.0),
                                 std::type_identity_t<V> const& compression = V(1.0)) const {
    V const mises = von_mises(trial);
    return scaled(trial, mises, increment(mises, h, pressure, compression, dt, V(0.0)));
  }

  /// As above from the flow stress of the last plastic step [Pa], 0 if there was none. Saves powers and logarithms of
  /// the yield stress, which changes little from step to step. A strength that depends on the pressure returns the
  /// trial itself, because the pressure is not yet known.
  template <class V>
  PIOLA_FN SymMat<3, V> predicted(SolidHistoryOf<V> const& h, SymMat<3, V> const& trial,
                                  std::type_identity_t<V> const& flow, double dt) const {
    if constexpr (pressed) return trial;
    if constexpr (!Strength::thermal) return returned(h, trial, dt);
    V const mises = von_mises(trial);
    auto const known = flow > 0.0;
    V strain = (mises - flow) / (3 * mu);
    if (any(!known)) strain = select(known, strain, increment(mises, h, V(0.0), V(1.0), dt, V(0.0)));
    return scaled(trial, mises, strain);
  }

  /// One step of dt [s] with the trial deviator [Pa]: radial return, plastic strain, plastic work, heat and damage.
  /// pressure [Pa] and rho [kg/m^3] are those of the end of the step; `last_flow` is what the last plastic step
  /// returned, from where the search starts. Returns the von Mises stress after plastic flow [Pa], 0 after an elastic
  /// step.
  template <class V>
  PIOLA_FN V update(SolidHistoryOf<V>& h, SymMat<3, V> const& trial, std::type_identity_t<V> const& pressure,
                    std::type_identity_t<V> const& rho, double dt,
                    std::type_identity_t<V> const& last_flow = V(0.0)) const {
    V const mises = von_mises(trial), strain = increment(mises, h, pressure, rho / rho0, dt, last_flow);
    h.S = scaled(trial, mises, strain);
    if (spall_ != 0) tear(h, pressure);
    auto const flowing = strain > 0.0;
    if (!any(flowing)) return V(0.0);
    V const left = mises - 3 * mu * strain, flow = select(left > 0.0, left, V(0.0));
    if (wears_) wear(h, pressure, left, strain, rho, dt);
    V const work = flow * strain * rho0 / rho;
    h.plastic_strain = select(flowing, h.plastic_strain + strain, h.plastic_strain);
    h.plastic_work = select(flowing, h.plastic_work + work, h.plastic_work);
    h.temperature =
        select(flowing, h.temperature + heat_.fraction * work / (rho0 * heat_.specific_heat), h.temperature);
    return select(flowing, flow, V(0.0));
  }

  /// Whether tension fails the material: `hydrostatic`, when the mean stress reaches spall_pressure; `principal`, when
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
  static constexpr double no_fracture[Fracture::size] = {unbounded, 0, 0};

  template <class Law>
  Solid(ElasticConstants const& elastic, MaterialParameters const& m, Heat const& heat, SolidOf<Law>)
      : rho0(elastic.rho0),
        mu(elastic.mu),
        kappa(0),
        spall_pressure(m.value[SolidLayout<Law>::spall]),
        damages(false),
        fracture(Strength::brittle ? no_fracture : m.value + SolidLayout<Law>::fracture),
        scatter(m.value + SolidLayout<Law>::scatter),
        wears_(Strength::brittle || (Strength::yields && m.word[Layout::damage_word] > 0)),
        spall_(Strength::yields ? m.word[Layout::spall_word] : 0),
        heat_(heat),
        strength_(made_strength<Law>(m, heat)),
        eos_(make_eos<Eos>(elastic.rho0, elastic.kappa, m.value + SolidLayout<Law>::eos)),
        damage_(m.value + SolidLayout<Law>::damage, heat) {
    kappa = eos_.bulk_modulus();
    damages = wears_ || spall_ > 0;
  }

  template <class V>
  PIOLA_FN V burnt(SolidHistoryOf<V> const& h, V const& rho) const {
    if constexpr (requires { eos_.template burnt<V>(h.burnt, rho); }) return eos_.template burnt<V>(h.burnt, rho);
    return h.burnt;
  }
  PIOLA_FN static FlowState flow_state(SolidHistory const& h, double pressure, double compression = 1) {
    return {h.plastic_strain, h.temperature, pressure, h.damage, compression};
  }
  /// Plastic strain of a step from a trial stress with the von Mises stress `mises` [Pa].
  template <class V>
  PIOLA_FN V increment(V const& mises, SolidHistoryOf<V> const& h, V const& pressure, V const& compression, double dt,
                       V const& last_flow) const {
    if constexpr (!Strength::yields) {
      return V(0.0);
    } else {
      if constexpr (requires { strength_.increments(mises, mu, h.plastic_strain); })
        if (strength_.closed_form()) return strength_.increments(mises, 3 * mu, h.plastic_strain);
      V least(0.0);
      if constexpr (requires { strength_.least_yield_stress(h.temperature); })
        least = strength_.least_yield_stress(h.temperature);
      if (!any(mises > least)) return V(0.0);
      double strain[width<V>];
      for (int l = 0; l < width<V>; ++l)
        strain[l] = lane(mises, l) > lane(least, l)
                        ? strength_.increment(lane(mises, l), 3 * mu,
                                              flow_state(lane_of(h, l), lane(pressure, l), lane(compression, l)), dt,
                                              lane(last_flow, l))
                        : 0;
      return load<V>(strain);
    }
  }

  /// Inputs of the laws at one point, from the history of a lane.
  template <class V>
  PIOLA_FN static SolidHistory lane_of(SolidHistoryOf<V> const& h, int l) {
    SolidHistory one;
    one.plastic_strain = lane(h.plastic_strain, l);
    one.temperature = lane(h.temperature, l);
    one.damage = lane(h.damage, l);
    one.bulking = lane(h.bulking, l);
    one.toughness = lane(h.toughness, l);
    return one;
  }

  /// Applies spall failure by tension.
  template <class V>
  PIOLA_FN void tear(SolidHistoryOf<V>& h, V const& pressure) const {
    V const most = spall_pressure * h.toughness;
    if (spall_ == 1) {
      h.damage = select(pressure > -most, h.damage, V(1.0));
      return;
    }
    if (!any(eigenvalue_bound(h.S) - pressure > most)) return;  // most particles
    double damage[width<V>];
    for (int l = 0; l < width<V>; ++l) {
      SymMat<3> S;
      for (int c = 0; c < 6; ++c) S.c[c] = lane(h.S.c[c], l);
      damage[l] = spalls(S, lane(pressure, l), lane(h.toughness, l)) ? 1 : lane(h.damage, l);
    }
    h.damage = load<V>(damage);
  }

  /// Damage of a plastic step, and the resulting bulking, for the lanes that yield.
  template <class V>
  PIOLA_FN void wear(SolidHistoryOf<V>& h, V const& pressure, V const& flow, V const& strain, V const& rho,
                     double dt) const {
    double damage[width<V>], bulking[width<V>];
    for (int l = 0; l < width<V>; ++l) {
      SolidHistory one = lane_of(h, l);
      double const more = lane(strain, l);
      if (more > 0)
        wear_one(one, flow_state(one, lane(pressure, l), lane(rho, l) / rho0), lane(flow, l), more,
                 dt > 0 ? more / dt : 0, lane(rho, l));
      damage[l] = one.damage;
      bulking[l] = one.bulking;
    }
    h.damage = load<V>(damage);
    h.bulking = load<V>(bulking);
  }
  PIOLA_FN void wear_one(SolidHistory& h, FlowState const& before, double flow, double strain, double rate,
                         double rho) const {
    if constexpr (Strength::brittle) {
      h.damage = JohnsonCookDamage::grown(h.damage, strain, h.toughness * strength_.fracture_strain(before.pressure));
      double const held = strength_.yield_stress(before, rate);
      h.bulking = strength_.bulked(h.bulking, held, strength_.yield_stress(flow_state(h, before.pressure), rate),
                                   rho / rho0 - 1, kappa, mu);
    } else {
      double const least = 1e-12 * mu;  // molten: no von Mises stress
      double const fracture_strain =
          damage_.fracture_strain(-before.pressure / (flow > least ? flow : least), rate, h.temperature);
      h.damage = JohnsonCookDamage::grown(h.damage, strain, h.toughness * fracture_strain);
    }
  }
  template <class V>
  PIOLA_FN SymMat<3, V> scaled(SymMat<3, V> S, V const& mises, V const& strain) const {
    auto const flowing = strain > 0.0;
    if (!any(flowing)) return S;
    V const left = mises - 3 * mu * strain;
    V const factor = select(flowing, select(left > 0.0, left / mises, V(0.0)), V(1.0));
    for (V& s : S.c) s = s * factor;
    return S;
  }

  bool wears_;  ///< damage grows with plastic strain
  int spall_;   ///< of spall_words
  Heat heat_;
  Strength strength_;
  Eos eos_;
  JohnsonCookDamage damage_;
};

}  // namespace piola::inline PIOLA_BACKEND
