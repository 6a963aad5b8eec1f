// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/component_views.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/materials/hypoelastic_registry.hpp"

/// Inputs of the law at a point, read from fields. V is `double`, for observers, or a pack of lanes.
namespace piola::adaptle::inline PIOLA_BACKEND {

struct PointFields {
  Components S, plastic_strain, temperature, damage, plastic_work, bulking, active, released;
  LawFactors own;

  PIOLA_SHARED inline PointFields(Fields const& f, LawFactors const& factors)
      : S(read(f.S)),
        plastic_strain(read(f.plastic_strain)),
        temperature(read(f.temperature)),
        damage(read(f.damage)),
        plastic_work(read(f.plastic_work)),
        bulking(read(f.bulking)),
        active(read(f.active)),
        released(read(f.released)),
        own(factors) {}

  /// With a deviator S [Pa].
  template <class V>
  PIOLA_FN SolidHistoryOf<V> history(Index i, SymMat<3, V> const& deviator) const {
    return {deviator,
            plastic_strain.scalar<V>(i),
            temperature.scalar<V>(i),
            damage.scalar<V>(i),
            plastic_work.scalar<V>(i),
            bulking.scalar<V>(i),
            factor<V>(own.burnt, i),
            factor<V>(own.toughness, i)};
  }
  /// Whether a particle carries a deviator.
  template <class V>
  PIOLA_FN auto bears(Index i) const {
    return active.scalar<V>(i) > 0.0 && released.scalar<V>(i) < 1.0;
  }

  /// The pressure of a particle, positive in compression [Pa]: equation of state, without the released tension of a
  /// failed particle, with the initial pressure of the case. e: specific energy [J/kg].
  template <class V, class Law>
  PIOLA_FN V pressure(Law const& law, Index i, V const& rho, V const& e) const {
    V p = law.pressure(history<V>(i, {}), rho, e);
    p = select(p < 0.0, p * (1.0 - released.scalar<V>(i)), p);
    if (own.initial_pressure != nullptr) p = p - load<V>(own.initial_pressure + i);
    return select(active.scalar<V>(i) > 0.0, p, V(0.0));
  }

 private:
  template <class V>
  PIOLA_FN static V factor(double const* values, Index i) {
    return values != nullptr ? load<V>(values + i) : V(1.0);
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
