// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/machine.hpp"
#include "piola/materials/eos/values.hpp"

namespace piola::inline PIOLA_MACHINE {

/// Mie-Grueneisen with the cubic relation of shock and particle speed (LS-DYNA keyword manual, EOS_GRUNEISEN).
/// m = rho/rho0 - 1, E = rho0 e energy per reference volume:
///   m > 0:  p = rho0 c0^2 m (1 + (1 - g/2) m - a/2 m^2) / D^2 + (g + a m) E,
///           D = 1 - (s1 - 1) m - s2 m^2/(m + 1) - s3 m^3/(m + 1)^2
///   m <= 0: p = rho0 c0^2 m + (g + a m) E
/// The fit of the first term has a pole (D = 0) and may have a maximum at strong compression. From where it is no
/// longer a stiffening curve (D < 1/5, or slope below a quarter of the one at rest) it goes on along its tangent.
class MieGrueneisen {
 public:
  PIOLA_FN explicit MieGrueneisen(EosValues const& values)
      : rho0_(values.rho0),
        kappa_(values.rho0 * values.c0 * values.c0),
        g_(values.gamma),
        a_(values.slope),
        s1_(values.s1),
        s2_(values.s2),
        s3_(values.s3) {
    constexpr double step = 1.0 / 128;
    while (last_ < most && divisor(last_ + step).value > 0.2 && fit(last_ + step).slope > kappa_ / 4) last_ += step;
    end_ = fit(last_);
  }
  /// Pressure, positive in compression [Pa]. rho: density [kg/m^3], e: specific energy [J/kg].
  PIOLA_FN double pressure(double rho, double e) const {
    double const m = rho / rho0_ - 1;
    return cold(m).value + (g_ + a_ * m) * (rho0_ * e);
  }
  /// dp/drho + (p/rho^2) dp/de, the square of the isentropic sound speed [m^2/s^2].
  PIOLA_FN double sound_speed_squared(double rho, double e) const {
    double const m = rho / rho0_ - 1;
    return cold(m).slope / rho0_ + a_ * e + pressure(rho, e) / (rho * rho) * rho0_ * (g_ + a_ * m);
  }
  /// Bulk modulus at rest [Pa].
  PIOLA_FN double bulk_modulus() const { return kappa_; }

 private:
  static constexpr double most = 10;  ///< no solid is pressed beyond eleven times its density

  struct Curve {
    double value, slope;  ///< and d/dm
  };

  PIOLA_FN Curve divisor(double m) const {
    double const q = m / (m + 1), dq = 1 / ((m + 1) * (m + 1));
    return {1 - (s1_ - 1) * m - s2_ * m * q - s3_ * m * q * q,
            1 - s1_ - s2_ * (q + m * dq) - s3_ * (q * q + 2 * m * q * dq)};
  }
  PIOLA_FN Curve fit(double m) const {
    double const n = m * (1 + (1 - g_ / 2) * m - a_ / 2 * m * m);
    double const dn = 1 + 2 * (1 - g_ / 2) * m - 1.5 * a_ * m * m;
    Curve const d = divisor(m);
    double const d2 = d.value * d.value;
    return {kappa_ * n / d2, kappa_ * (dn / d2 - 2 * n * d.slope / (d2 * d.value))};
  }
  /// The part of the pressure without the energy.
  PIOLA_FN Curve cold(double m) const {
    if (m <= 0) return {kappa_ * m, kappa_};
    if (m <= last_) return fit(m);
    return {end_.value + end_.slope * (m - last_), end_.slope};
  }

  double rho0_, kappa_, g_, a_, s1_, s2_, s3_;
  double last_ = 0;  ///< largest m of the fit
  Curve end_{};
};

}  // namespace piola::inline PIOLA_MACHINE
