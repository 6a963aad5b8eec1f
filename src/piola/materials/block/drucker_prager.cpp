// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block/own_laws.hpp"
#include "piola/materials/block/rate_form.hpp"
#include "piola/materials/elastic_constants.hpp"
#include "piola/math/root.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

/// Soil, rock, concrete and powder: strength that grows with the pressure p (positive in compression). In rate form,
/// with isotropic elasticity. With the von Mises stress q and the mean stress I1/3 = -p:
///   cone        sqrt(J2) + alpha I1 = k, that is q = A + B p with A = sqrt(3) k, B = 3 sqrt(3) alpha
///               (Drucker, Prager, Q. Appl. Math. 10, 1952); plastic flow with a dilation of its own
///   cut-off     p >= -T, T at most k / (3 alpha); flow without shear
///   cap         ((p - L)/(X - L))^2 + (q/F(L))^2 = 1 for p >= L, F(L) = A + B L, X = L + R F(L); associated flow;
///               X = X0 - ln(1 - e/W)/D of the plastic compaction e by the cap
///               (DiMaggio, Sandler, J. Eng. Mech. Div. ASCE 97, 1971; Sandler, Rubin, Int. J. Numer. Anal. Meth.
///               Geomech. 3, 1979)
/// Dilation on the cone does not move the cap. The return is implicit: closed form but for the cap, whose compaction is
/// found between bounds.
namespace piola::block_laws {
namespace drucker_prager_law {
namespace {

constexpr std::array<std::string_view, 3> cones{"compression", "plane_strain", "alpha_k"};
constexpr std::array<std::string_view, 2> caps{"none", "elliptic"};
constexpr std::array choices{
    Choice{"cone",
           "how the strength is given: by Mohr-Coulomb's friction_angle and cohesion, which the cone has in triaxial "
           "compression or at failure in plane strain; or by alpha_k, sqrt(J2) + alpha I1 = k",
           cones},
    Choice{"cap", "limit of pressure, which moves with plastic compaction", caps}};

constexpr Interval angle{0, std::numbers::pi / 2, false, true};
constexpr Condition by_angles{"cone", "compression", "plane_strain"}, by_numbers{"cone", "alpha_k"},
    capped{"cap", "elliptic"};
constexpr double most_alpha = 0.28867513459481287;  // 1/sqrt(12): plane strain has no failure stress beyond
constexpr std::array parameters{
    ElasticConstants::parameters[0],
    ElasticConstants::parameters[1],
    ElasticConstants::parameters[2],
    Parameter{"friction_angle", "rad", "Mohr-Coulomb's angle of friction, as \"30 degree\"", angle, no_default, "",
              by_angles},
    Parameter{"cohesion", "Pa", "Mohr-Coulomb's cohesion", not_negative, no_default, "", by_angles},
    Parameter{"dilation_angle", "rad", "angle of dilation, at most friction_angle", angle, 0, "", by_angles},
    Parameter{"alpha", "1", "alpha of the cone", Interval{0, most_alpha, false, true}, no_default, "", by_numbers},
    Parameter{"k", "Pa", "k of the cone, strength in pure shear", not_negative, no_default, "", by_numbers},
    Parameter{"alpha_dilation", "1", "alpha of the plastic potential, at most alpha",
              Interval{0, most_alpha, false, true}, 0, "", by_numbers},
    Parameter{"tension_cutoff", "Pa", "largest mean tension; at most that of the apex", not_negative, unbounded,
              "the apex of the cone"},
    Parameter{"cap_ratio", "1", "R, half axis of the cap along p over that along q", positive, no_default, "", capped},
    Parameter{"cap_start", "Pa", "X0, pressure at which hydrostatic compaction starts", positive, no_default, "",
              capped},
    Parameter{"cap_strain", "1", "W, plastic volumetric strain of full compaction", positive, no_default, "", capped},
    Parameter{"cap_rate", "1/Pa", "D of the compaction W (1 - exp(-D (X - X0))), X a pressure", positive, no_default,
              "", capped}};

enum Value {
  friction = 2,
  cohesion,
  dilation,
  alpha,
  k,
  alpha_dilation,
  cutoff,
  ratio,
  start,
  strain,
  rate,
  cone,
  cap
};
static_assert(parameters.size() == cone + 1);
enum History { plastic_strain, volumetric, compaction };
constexpr std::array<piola_history, 3> history{
    {{"EquivalentPlasticStrain", "1", 0}, {"VolumetricPlasticStrain", "1", 0}, {"CapCompaction", "1", 0}}};

/// alpha of the cone and of the potential, and k [Pa].
struct Cone {
  double alpha, k, dilation;
};

Cone in_compression(double const* v) {
  double const s = std::sin(v[friction]), below = std::sqrt(3.0) * (3 - s), d = std::sin(v[dilation]);
  return {2 * s / below, 6 * v[cohesion] * std::cos(v[friction]) / below, 2 * d / (std::sqrt(3.0) * (3 - d))};
}
/// Has Mohr-Coulomb's stresses where plastic flow has no strain along one axis.
Cone in_plane_strain(double const* v) {
  double const s = std::sin(v[friction]), d = std::sin(v[dilation]), potential = d / std::sqrt(9 + 3 * d * d);
  double const n = std::sqrt(1 - 3 * potential * potential) + potential * s;
  return {s / (3 * n), v[cohesion] * std::cos(v[friction]) / n, potential};
}
Cone cone_of(double const* v) {
  int const word = static_cast<int>(v[cone]);
  return word == 0 ? in_compression(v) : word == 1 ? in_plane_strain(v) : Cone{v[alpha], v[k], v[alpha_dilation]};
}

/// Stress and plastic strains of a point after the return; `strain` is that of shear, `volume` of expansion.
struct Returned {
  double pressure, mises, strain = 0, volume = 0, compaction = 0;
};

class DruckerPrager {
 public:
  DruckerPrager(double density, double const* v) : elastic_(std::array{density, v[0], v[1]}.data()), v_(v) {
    Cone const c = cone_of(v);
    A_ = std::sqrt(3.0) * c.k;
    B_ = 3 * std::sqrt(3.0) * c.alpha;
    dilation_ = 3 * std::sqrt(3.0) * c.dilation;
    tension_ = std::min(v[cutoff], B_ > 0 ? A_ / B_ : unbounded);
  }
  ElasticConstants const& elastic() const { return elastic_; }

  Returned operator()(double p, double q, double compacted) const {
    double const L = has_cap() ? centre(compacted) : unbounded;
    if (p > L) return miss(compacted, p, q) > 0 ? on_cap(p, q, compacted) : Returned{p, q};
    double const over = q - strength(p);
    if (over <= 0) return p < -tension_ ? cut_off(p, q) : Returned{p, q};
    double const x = over / (3 * elastic_.mu + elastic_.kappa * B_ * dilation_);
    double const pressure = p + elastic_.kappa * dilation_ * x;
    if (pressure < -tension_) return cut_off(p, q);
    if (pressure > L) return {L, strength(L), (q - strength(L)) / (3 * elastic_.mu), (L - p) / elastic_.kappa};
    return {pressure, q - 3 * elastic_.mu * x, x, dilation_ * x};
  }

 private:
  bool has_cap() const { return v_[cap] > 0; }
  double strength(double p) const { return A_ + B_ * p; }
  /// X [Pa].
  double end(double compacted) const { return v_[start] - std::log1p(-compacted / v_[strain]) / v_[rate]; }
  /// L [Pa], from X = L + R F(L).
  double centre(double compacted) const { return (end(compacted) - v_[ratio] * A_) / (1 + v_[ratio] * B_); }

  Returned cut_off(double p, double q) const {
    double const left = std::min(q, std::max(strength(-tension_), 0.0));
    return {-tension_, left, (q - left) / (3 * elastic_.mu), (-tension_ - p) / elastic_.kappa};
  }

  /// Shear stress of the cap's flow rule where the compaction grew by e, and the square that is 1 on the cap.
  struct OnCap {
    double pressure, mises, square;
  };
  OnCap cap_state(double p, double q, double compacted, double e) const {
    double const L = centre(compacted + e), along = p - elastic_.kappa * e - L;
    if (!(along > 0)) return {L, 0, 0};
    double const F = strength(L), a = v_[ratio] * F, reach = along / a;
    double const mises = q / (1 + 3 * elastic_.mu * e * a * a / (along * F * F));
    return {along + L, mises, reach * reach + mises * mises / (F * F)};
  }
  double miss(double compacted, double p, double q) const { return cap_state(p, q, compacted, 0).square - 1; }
  Returned on_cap(double p, double q, double compacted) const {
    double const most = std::min((p - centre(compacted)) / elastic_.kappa, v_[strain] - compacted);
    auto const f = [&](double e) { return cap_state(p, q, compacted, e).square - 1; };
    constexpr double round_off = 1e-14;
    double const e = falling_root(f, 0, miss(compacted, p, q), most, -1, round_off);
    OnCap const now = cap_state(p, q, compacted, e);
    return {now.pressure, now.mises, (q - now.mises) / (3 * elastic_.mu), -e, e};
  }

  ElasticConstants elastic_;
  double const* v_;
  double A_, B_, dilation_, tension_;
};

int update(piola_points const* points) {
  piola_points const& at = *points;
  DruckerPrager const law(at.density, at.parameters);
  ElasticConstants const& c = law.elastic();
  auto const value = [&](int h, int p) -> double& { return at.history[h * at.stride + p]; };
  for (int p = 0; p < at.count; ++p) {
    SplitStress const trial = elastic_trial(at, p, c.mu, c.kappa);
    put_sound_speed(c.lambda + 2 * c.mu, at, p);
    // Without time the answer is elastic: moduli at rest of soil without cohesion come from it.
    Returned const r =
        at.dt > 0 ? law(trial.pressure, trial.mises, value(compaction, p)) : Returned{trial.pressure, trial.mises};
    put_returned(trial, r.mises, r.pressure, at, p);
    value(plastic_strain, p) += r.strain;
    value(volumetric, p) += r.volume;
    value(compaction, p) += r.compaction;
  }
  return 0;
}

std::string problem_of(double const* v) {
  Cone const c = cone_of(v);
  if (c.dilation > c.alpha && v[cone] < 2)
    return fmt::format(
        "dilation_angle {:.4g} rad is above friction_angle {:.4g} rad, and plastic flow would give energy "
        "(0 to friction_angle is allowed)",
        v[dilation], v[friction]);
  if (c.dilation > c.alpha)
    return fmt::format(
        "alpha_dilation {:.4g} is above alpha {:.4g}, and plastic flow would give energy (0 to alpha is "
        "allowed)",
        v[alpha_dilation], v[alpha]);
  if (c.alpha == 0 && c.k == 0) return "it has neither friction nor cohesion, and so no strength: give one of them";
  double const least = v[ratio] * std::sqrt(3.0) * c.k;
  if (!(v[cap] > 0) || v[start] >= least) return {};
  return fmt::format(
      "the cap starts in tension: cap_start {:.4g} Pa is below cap_ratio times the strength without "
      "pressure, {:.4g} Pa (more is allowed)",
      v[start], least);
}

int check(double const* v, char* message, int size) { return put_message(problem_of(v), message, size); }

constexpr piola_material law =
    describe("drucker_prager", PIOLA_COROTATED_CAUCHY, PIOLA_YIELDS, history, &check, &update);

}  // namespace
}  // namespace drucker_prager_law

constinit LawInfo const drucker_prager{
    .name = "drucker_prager",
    .about = "soil, rock and powder: friction, dilation, tension cut-off, cap that hardens by compaction",
    .validity = "rate-independent; a gap that tension opened does not close before it carries pressure again",
    .parameters = drucker_prager_law::parameters,
    .choices = drucker_prager_law::choices,
    .block = &drucker_prager_law::law};

}  // namespace piola::block_laws
