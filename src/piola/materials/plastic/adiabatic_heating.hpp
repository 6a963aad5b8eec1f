// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/base/parameter.hpp"
#include <array>
#include <cmath>

namespace piola::inline PIOLA_BACKEND {

/// State on which the flow stress of a point may depend, in addition to the plastic strain rate.
struct FlowState {
  double plastic_strain = 0;  ///< equivalent
  double temperature = 0;     ///< [K]
  double pressure = 0;        ///< positive in compression [Pa]
  double damage = 0;          ///< 0 to 1
  double compression = 1;     ///< density over that at rest
};

/// Heating by plastic work, conduction of heat, and the reference temperatures and rate of Johnson and Cook.
struct Heat {
  static constexpr int size = 7;
  /// `always`: the flow stress itself depends on temperature and rate; else only the damage of Johnson and Cook does.
  static constexpr std::array<Parameter, size> parameters_for(bool always) {
    Condition const when = always ? Condition{} : Condition{"damage", "johnson_cook"};
    return {Parameter{"specific_heat", "J/(kg K)", "heat capacity per mass", positive, unbounded, "no heating"},
            Parameter{"heat_fraction", "1", "part of the plastic work that becomes heat", Interval{0, 1}, 1},
            Parameter{"initial_temperature", "K", "temperature at the start", positive, 0, "reference_temperature"},
            Parameter{"reference_temperature", "K", "Tr, where T* = 0", positive, 293},
            Parameter{"melting_temperature", "K", "Tm, where T* = 1", positive, always ? no_default : unbounded,
                      always ? "" : "none (T* = 0)", when},
            Parameter{"reference_rate", "1/s", "plastic strain rate above which rate counts", positive, 1, {}, when},
            Parameter{"conductivity", "W/(m K)", "heat conductivity; 0: heat stays where it arises", not_negative, 0}};
  }

  double specific_heat;       ///< [J/(kg K)]
  double fraction;            ///< of the plastic work
  double initial;             ///< [K]
  double reference, melting;  ///< [K]
  double reference_rate;      ///< [1/s]
  double conductivity;        ///< [W/(m K)]

  PIOLA_FN Heat() : Heat(nullptr) {}
  /// v: values in the order of `parameters_for`; null: cold for ever.
  PIOLA_FN explicit Heat(double const* v)
      : specific_heat(v ? v[0] : unbounded),
        fraction(v ? v[1] : 0),
        initial(v && v[2] > 0 ? v[2]
                : v           ? v[3]
                              : 293),
        reference(v ? v[3] : 293),
        melting(v ? v[4] : unbounded),
        reference_rate(v ? v[5] : 1),
        conductivity(v ? v[6] : 0) {}

  /// T* = (T - Tr)/(Tm - Tr), between 0 and 1.
  PIOLA_FN double homologous(double temperature) const {
    if (temperature <= reference) return 0;
    if (temperature >= melting) return 1;
    return (temperature - reference) / (melting - reference);
  }
  /// ln max(rate/rate0, 1).
  PIOLA_FN double log_rate(double rate) const { return rate > reference_rate ? std::log(rate / reference_rate) : 0; }
};

}  // namespace piola::inline PIOLA_BACKEND
