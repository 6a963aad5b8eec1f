// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/setting_warnings.hpp"
#include "piola/base/text.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {

bool BodyWarnings::has_support() const {
  Body const& body = assembly_.particles.bodies[body_];
  return std::any_of(assembly_.supports.begin(), assembly_.supports.end(), [&](Support const& support) {
    return std::any_of(support.particles.begin(), support.particles.end(),
                       [&](std::int64_t id) { return id >= body.first && id < body.last; });
  });
}

bool BodyWarnings::has_mirror() const {
  return std::any_of(assembly_.mirrors.begin(), assembly_.mirrors.end(),
                     [&](MirrorPlane const& mirror) { return mirror.body == body_; });
}

bool BodyWarnings::has_setting(std::string_view name) const {
  return spec().words.contains(name) || spec().numbers.contains(name) || spec().formulas.contains(name);
}

bool BodyWarnings::has_setting(std::string_view name, std::string_view word) const {
  auto const given = spec().words.find(name);
  return given != spec().words.end() && given->second == word;
}

void BodyWarnings::ignored(std::string_view name, std::string_view why) {
  if (has_setting(name))
    add("formulation." + std::string(name),
        std::string(name) + " has no effect here (" + std::string(why) + ") - remove it, or change what it depends on");
}

void BodyWarnings::add(std::string key, std::string text) {
  found_.push_back(
      {body_, std::move(key), "body " + in_quotes(assembly_.particles.bodies[body_].name) + ": " + std::move(text)});
}

bool varies_between(std::span<std::int64_t const> particles, Expression const& formula, ParticleSet const& set,
                    double t) {
  constexpr double much = 1e-6;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::int64_t const id : particles) {
    double const value = formula(set.X[static_cast<std::size_t>(id)], t);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return most - least > much * std::max(std::abs(least), std::abs(most));
}

double poissons_ratio_of(MaterialParameters const& material) {
  double ratio = 0;
  with_any_law(material,
               [&](auto const& law) { ratio = (3 * law.kappa - 2 * law.mu) / (2 * (3 * law.kappa + law.mu)); });
  return ratio;
}

void warn_of_tension(BodyWarnings& warnings) {
  bool unlimited = false;
  with_solid(warnings.material(), [&](auto const& law) {
    unlimited = !law.brittle && !law.damages && !(law.spall_pressure < unbounded) && law.front_speed() == 0 &&
                law.yield_stress({}, 0) < unbounded;
  });
  if (unlimited)
    warnings.add(
        "material.spall_pressure",
        "nothing limits the tension of a metal in Eulerian particles (where it is fast, hundreds of GPa of it, and "
        "energies below zero) - give spall_pressure or a damage law");
}

}  // namespace piola
