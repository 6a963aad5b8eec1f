// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/backend.hpp"
#include "piola/materials/eos/bulk_sound_speed.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <string_view>
#include <type_traits>

namespace piola::inline PIOLA_BACKEND {

/// Mie-Grueneisen with the cubic relation of shock and particle speed (LS-DYNA keyword manual, EOS_GRUNEISEN).
/// m = rho/rho0 - 1, E = rho0 e energy per reference volume:
///   m > 0:  p = rho0 c0^2 m (1 + (1 - g/2) m - a/2 m^2) / D^2 + (g + a m) E,
///           D = 1 - (s1 - 1) m - s2 m^2/(m + 1) - s3 m^3/(m + 1)^2
///   m <= 0: p = rho0 c0^2 m + (g + a m) E
/// The fit of the first term has a pole (D = 0) and may have a maximum at strong compression. From where it is no
/// longer a stiffening curve (D < 1/5, or slope below a quarter of the one at rest) it goes on along its tangent.
class MieGrueneisen {
 public:
  static constexpr std::string_view name = "mie_grueneisen";
  static constexpr std::array parameters{
      bulk_sound_speed_parameter,
      Parameter{"grueneisen_gamma", "1", "Grueneisen's gamma0 at rest", not_negative},
      Parameter{"grueneisen_slope", "1", "a, change of gamma0 with rho/rho0 - 1", any_value, 0},
      Parameter{"hugoniot_s1", "1", "s1, slope of shock speed over particle speed", not_negative},
      Parameter{"hugoniot_s2", "1", "s2, quadratic coefficient of the shock speed", any_value, 0},
      Parameter{"hugoniot_s3", "1", "s3, cubic coefficient of the shock speed", any_value, 0}};

  PIOLA_FN MieGrueneisen(double density, double bulk_modulus, double const* v)
      : rho0_(density), g_(v[1]), a_(v[2]), s1_(v[3]), s2_(v[4]), s3_(v[5]) {
    double const c0 = bulk_sound_speed(v[0], density, bulk_modulus);
    kappa_ = density * c0 * c0;
    constexpr double step = 1.0 / 128;
    while (last_ < most && divisor(last_ + step).value > 0.2 && fit(last_ + step).slope > kappa_ / 4) last_ += step;
    end_ = fit(last_);
  }
  /// Pressure, positive in compression [Pa]. rho: density [kg/m^3], e: specific energy [J/kg].
  template <class V = double>
  PIOLA_FN V pressure(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    V const m = rho / rho0_ - 1.0;
    return cold(m).value + (g_ + a_ * m) * (rho0_ * e);
  }
  /// dp/drho + (p/rho^2) dp/de, the square of the isentropic sound speed [m^2/s^2].
  template <class V = double>
  PIOLA_FN V sound_speed_squared(std::type_identity_t<V> const& rho, std::type_identity_t<V> const& e) const {
    V const m = rho / rho0_ - 1.0;
    return cold(m).slope / rho0_ + a_ * e + pressure<V>(rho, e) / (rho * rho) * rho0_ * (g_ + a_ * m);
  }
  /// Bulk modulus at rest [Pa].
  PIOLA_FN double bulk_modulus() const { return kappa_; }

 private:
  static constexpr double most = 10;  ///< no solid is pressed beyond eleven times its density

  template <class V>
  struct Curve {
    V value, slope;  ///< and d/dm
  };

  template <class V>
  PIOLA_FN Curve<V> divisor(V const& m) const {
    V const q = m / (m + 1.0), dq = 1.0 / ((m + 1.0) * (m + 1.0));
    return {1.0 - (s1_ - 1) * m - s2_ * m * q - s3_ * m * q * q,
            1 - s1_ - s2_ * (q + m * dq) - s3_ * (q * q + 2.0 * m * q * dq)};
  }
  template <class V>
  PIOLA_FN Curve<V> fit(V const& m) const {
    V const n = m * (1.0 + (1 - g_ / 2) * m - a_ / 2 * m * m);
    V const dn = 1.0 + 2 * (1 - g_ / 2) * m - 1.5 * a_ * m * m;
    Curve<V> const d = divisor(m);
    V const d2 = d.value * d.value;
    return {kappa_ * n / d2, kappa_ * (dn / d2 - 2.0 * n * d.slope / (d2 * d.value))};
  }
  /// The part of the pressure without the energy.
  template <class V>
  PIOLA_FN Curve<V> cold(V const& m) const {
    auto const pressed = m > 0.0;
    Curve<V> r{kappa_ * m, V(kappa_)};
    if (!any(pressed)) return r;
    Curve<V> const fitted = fit(m);
    auto const beyond = m > last_;
    r.value = select(pressed, select(beyond, end_.value + end_.slope * (m - last_), fitted.value), r.value);
    r.slope = select(pressed, select(beyond, V(end_.slope), fitted.slope), r.slope);
    return r;
  }

  double rho0_, kappa_, g_, a_, s1_, s2_, s3_;
  double last_ = 0;  ///< largest m of the fit
  Curve<double> end_{};
};

}  // namespace piola::inline PIOLA_BACKEND
