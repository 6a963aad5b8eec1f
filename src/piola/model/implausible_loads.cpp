// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/plausibility.hpp"
#include "piola/model/body_properties.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/model/region_checks.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

using Components = std::array<Expression, 3>;

bool hold_anywhere(Components const& value) {
  return std::all_of(value.begin(), value.end(), [](Expression const& e) { return e.holds_anywhere(); });
}

/// Times at which formulas are evaluated [s]: 33 equal steps up to `last`, and halves of its first, for short pulses.
std::vector<double> times_until(double last) {
  constexpr int steps = 32, halves = 16;
  std::vector<double> times;
  for (int k = 0; k <= steps; ++k) times.push_back(last * k / steps);
  for (int k = 1; k <= halves; ++k) times.push_back(last / steps * std::ldexp(1.0, -k));
  return times;
}

/// Values of a vector at some of the particles, over the time that it acts.
struct LookedAt {
  double largest = 0;      ///< size, where it is finite
  std::string not_finite;  ///< the first value that is not: "is not a number at t = 2 ms, X = (0, 1) m"
};

LookedAt look_at_vector(Components const& value, ParticleSet const& particles, std::vector<std::int64_t> const& ids,
                        double last) {
  constexpr std::size_t most = 100;
  bool const moves = std::any_of(value.begin(), value.end(), [](auto const& v) { return v.depends_on_time(); });
  auto const times = moves ? times_until(last) : std::vector<double>{0};
  LookedAt looked;
  if (!hold_anywhere(value)) return looked;
  for (std::size_t k = 0; k < ids.size(); k += std::max<std::size_t>(1, ids.size() / most)) {
    auto const& X = particles.X[static_cast<std::size_t>(ids[k])];
    for (double const t : times) {
      double const x = value[0](X, t), y = value[1](X, t), z = value[2](X, t);
      double const size = std::sqrt(x * x + y * y + z * z);  // std::hypot loses what is not a number
      if (std::isfinite(size))
        looked.largest = std::max(looked.largest, size);
      else if (looked.not_finite.empty())
        looked.not_finite = std::string(std::isnan(size) ? "is not a number" : "is infinite") +
                            " at t = " + quantity_text(t, "s") + ", X = " + point_text(X, particles.dimension) +
                            ", where the run will stop - correct the formula, or give until";
    }
  }
  return looked;
}

/// Number of the body of this name among those of the case.
std::size_t number_of_body(CaseSpec const& spec, std::string const& name) {
  auto const named = [&](BodySpec const& body) { return body.name == name; };
  return static_cast<std::size_t>(std::find_if(spec.bodies.begin(), spec.bodies.end(), named) - spec.bodies.begin());
}

double density_of_body(BodyProperties const& body) { return body.modulus / (body.p_wave * body.p_wave); }

/// Compares a traction or a pressure with the modulus and the yield stress.
std::string odd_face_load(double size, BodyProperties const& body) {
  auto const odd = implausible(plausible_range("load"), size, body.modulus, "Pa");
  return odd.empty() ? implausible(plausible_range("load_on_metal"), size, body.yield, "Pa") : odd;
}

void compare_load(CaseSpec const& spec, LoadSpec const& load, ParticleSet const& particles, BodyProperties const& body,
                  Problems& slips) {
  Body const& loaded = *body_named(particles, load.body);
  auto const looked = look_at_vector(load.value, particles, loaded_particles(particles, loaded, load),
                                     std::min(spec.run.end, load.until));
  char const* const key = load.value_key();
  auto const note = [&](std::string const& odd) {
    if (!odd.empty()) slips.add(place_of(load.places, key), "body " + in_quotes(body.name) + ": " + key + ": " + odd);
  };
  if (!looked.not_finite.empty()) note("the load " + looked.not_finite);
  double const size = looked.largest;
  if (!(size > 0)) return;
  double const length = *std::max_element(body.size.begin(), body.size.end());
  double const density = load.kind == LoadSpec::Kind::acceleration ? density_of_body(body) : 1;
  note(load.kind == LoadSpec::Kind::non_reflecting
           ? implausible(plausible_range("driven_speed"), size, body.p_wave, "m/s")
       : load.on_face() ? odd_face_load(size, body)
                        : implausible(plausible_range("weight"), size * density * length, body.modulus, "Pa"));
}

/// Compares the speed of a driven support or rigid shape with the wave speed.
void check_drive(LookedAt const& looked, double wave, std::string const& subject, Place const& place, Problems& slips) {
  if (!looked.not_finite.empty()) slips.add(place, subject + "the velocity " + looked.not_finite);
  auto const odd = implausible(plausible_range("driven_speed"), looked.largest, wave, "m/s");
  if (!odd.empty()) slips.add(place, subject + odd);
}

}  // namespace

void find_implausible_loads(CaseSpec const& spec, ParticleSet const& particles,
                            std::vector<BodyProperties> const& facts, Problems& slips) {
  PIOLA_EXPECTS(facts.size() == spec.bodies.size());
  double fastest = 0;
  for (BodyProperties const& body : facts) fastest = std::max(fastest, body.p_wave);
  for (LoadSpec const& load : spec.loads)
    compare_load(spec, load, particles, facts[number_of_body(spec, load.body)], slips);
  for (SupportSpec const& support : spec.supports) {
    if (!support.velocity) continue;
    Body const& body = *body_named(particles, support.body);
    auto const looked = look_at_vector(*support.velocity, particles, supported_particles(particles, body, support),
                                       std::min(spec.run.end, support.until));
    check_drive(looked, facts[number_of_body(spec, support.body)].p_wave,
                "support of body " + in_quotes(body.name) + ": ", place_of(support.places, "velocity"), slips);
  }
  for (RigidSpec const& rigid : spec.rigids) {
    check_drive(look_at_vector(rigid.velocity, particles, {0}, spec.run.end), fastest,
                "rigid shape " + in_quotes(rigid.name) + ": ", place_of(rigid.places, "velocity"), slips);
  }
}

}  // namespace piola
