// SPDX-License-Identifier: Apache-2.0
#include "piola/input/check_case.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;

Place place_of(Places const& places, std::string_view key) {
  auto const found = places.find(key);
  return found == places.end() ? Place{} : found->second;
}

std::string point_text(Vec3 const& X, int dimension) {
  std::string text = "(";
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    text += (d > 0 ? ", " : "") + number_text(X[d], 4);
  return text + ") m";
}

Body const* body_named(ParticleSet const& particles, std::string_view name) {
  for (Body const& body : particles.bodies) {
    if (body.name == name) return &body;
  }
  return nullptr;
}

/// One body's formulas looked at on its particles; each formula complains at most once.
class FormulaCheck {
 public:
  FormulaCheck(ParticleSet const& particles, Body const& body, Problems& problems)
      : particles_(particles), body_(body), problems_(problems) {}

  /// Whether the value is a finite number at every particle; reports the first particle where it is not.
  bool finite(Expression const& formula, std::string const& name, Place const& place) const {
    for (std::int64_t id = body_.first; id < body_.last; ++id) {
      Vec3 const& X = particles_.X[static_cast<std::size_t>(id)];
      double const value = formula(X);
      if (std::isfinite(value)) continue;
      problems_.add(place, name + ", formula " + in_quotes(formula.text()) + " is " + number_text(value) +
                               " at X = " + point_text(X, particles_.dimension) + " of body " + in_quotes(body_.name) +
                               " (allowed: a finite number at every particle)");
      return false;
    }
    return true;
  }

  void gradient(std::array<Expression, 9> const& F, Place const& place) const {
    std::string const name = "body.initial_deformation_gradient";
    for (Expression const& component : F) {
      if (!finite(component, name, place)) return;
    }
    for (std::int64_t id = body_.first; id < body_.last; ++id) {
      Vec3 const& X = particles_.X[static_cast<std::size_t>(id)];
      double const J = determinant(F, X);
      if (J > 0) continue;
      problems_.add(place, name + " has the determinant " + number_text(J) +
                               " at X = " + point_text(X, particles_.dimension) + " of body " + in_quotes(body_.name) +
                               " (allowed: above 0) - a body cannot be turned inside out");
      return;
    }
  }

 private:
  static double determinant(std::array<Expression, 9> const& F, Vec3 const& X) {
    auto const f = [&](std::size_t i) { return F[i](X); };
    return f(0) * (f(4) * f(8) - f(5) * f(7)) - f(1) * (f(3) * f(8) - f(5) * f(6)) + f(2) * (f(3) * f(7) - f(4) * f(6));
  }

  ParticleSet const& particles_;
  Body const& body_;
  Problems& problems_;
};

void check_body(BodySpec const& spec, ParticleSet const& particles, Body const& body, Problems& problems) {
  if (body.first == body.last) {
    problems.add(place_of(spec.places, "shape"),
                 "body " + in_quotes(spec.name) + " has no particles - make the spacing smaller or the body larger");
    return;
  }
  FormulaCheck const check(particles, body, problems);
  auto const dimension = static_cast<std::size_t>(particles.dimension);
  for (std::size_t d = 0; d < dimension; ++d) {
    std::string const index = "[" + std::to_string(d) + "]";
    check.finite(spec.initial_velocity[d], "body.initial_velocity" + index, place_of(spec.places, "initial_velocity"));
    if (spec.initial_displacement) {
      check.finite((*spec.initial_displacement)[d], "body.initial_displacement" + index,
                   place_of(spec.places, "initial_displacement"));
    }
  }
  if (spec.initial_deformation_gradient) {
    check.gradient(*spec.initial_deformation_gradient, place_of(spec.places, "initial_deformation_gradient"));
  }
}

std::string box_of(ParticleSet const& particles, Body const& body) {
  Vec3 low = particles.X[static_cast<std::size_t>(body.first)], high = low;
  for (std::int64_t id = body.first; id < body.last; ++id) {
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], particles.X[static_cast<std::size_t>(id)][d]);
      high[d] = std::max(high[d], particles.X[static_cast<std::size_t>(id)][d]);
    }
  }
  return "its particles reach from " + point_text(low, particles.dimension) + " to " +
         point_text(high, particles.dimension);
}

void check_where(Expression const& where, std::string const& name, Place const& place, ParticleSet const& particles,
                 Body const& body, Problems& problems) {
  if (body.first == body.last) return;
  if (!FormulaCheck(particles, body, problems).finite(where, name, place)) return;
  if (!select_particles(particles, body, &where).empty()) return;
  problems.add(place, name + ", formula " + in_quotes(where.text()) + " selects no particle of body " +
                          in_quotes(body.name) + " (" + box_of(particles, body) + ") - change the condition");
}

// A point of the body is at most half a cell diagonal away from a particle; jitter adds to that.
void check_point(ProbeSpec const& probe, double jitter, ParticleSet const& particles, Body const& body,
                 Problems& problems) {
  if (body.first == body.last) return;
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::int64_t id = body.first; id < body.last; ++id) {
    double distance2 = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      double const part = (particles.X[static_cast<std::size_t>(id)][d] - probe.at[d]) / body.spacing[d];
      distance2 += part * part;
    }
    nearest2 = std::min(nearest2, distance2);
  }
  if (std::sqrt(nearest2) <= 1.2 + jitter) return;
  problems.add(place_of(probe.places, "at"),
               "probe.at of " + in_quotes(probe.name) + " is " + point_text(probe.at, particles.dimension) +
                   ", outside body " + in_quotes(body.name) + " (" + box_of(particles, body) + ") - move the point");
}

}  // namespace

ParticleSet make_particles(CaseSpec const& spec) {
  ParticleSet particles;
  for (BodySpec const& body : spec.bodies) fill(body.shape, body.name, particles);
  return particles;
}

std::vector<std::int64_t> select_particles(ParticleSet const& particles, Body const& body, Expression const* where) {
  std::vector<std::int64_t> ids;
  for (std::int64_t id = body.first; id < body.last; ++id) {
    if (where == nullptr || (*where)(particles.X[static_cast<std::size_t>(id)]) != 0) ids.push_back(id);
  }
  return ids;
}

void check_regions(CaseSpec const& spec, ParticleSet const& particles, Problems& problems) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    check_body(spec.bodies[b], particles, particles.bodies[b], problems);
  for (SupportSpec const& support : spec.supports) {
    Body const* const body = body_named(particles, support.body);
    if (body == nullptr) continue;
    check_where(support.where, "support.where", place_of(support.places, "where"), particles, *body, problems);
  }
  for (ProbeSpec const& probe : spec.probes) {
    Body const* const body = body_named(particles, probe.body);
    if (body == nullptr) continue;
    double const jitter = spec.bodies[static_cast<std::size_t>(body - particles.bodies.data())].shape.jitter;
    if (probe.kind == ProbeSpec::Kind::point) check_point(probe, jitter, particles, *body, problems);
    if (!probe.where) continue;
    check_where(*probe.where, "probe.where", place_of(probe.places, "where"), particles, *body, problems);
  }
}

}  // namespace piola
