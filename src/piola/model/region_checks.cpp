// SPDX-License-Identifier: Apache-2.0
#include "piola/model/region_checks.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/formula_loop.hpp"
#include "piola/model/case_particles.hpp"
#include <algorithm>
#include <atomic>
#include <cmath>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;

double determinant(std::array<Expression, 9> const& F, Vec3 const& X) {
  auto const f = [&](std::size_t i) { return F[i](X); };
  return f(0) * (f(4) * f(8) - f(5) * f(7)) - f(1) * (f(3) * f(8) - f(5) * f(6)) + f(2) * (f(3) * f(7) - f(4) * f(6));
}

}  // namespace

std::string box_of(ParticleSet const& particles, Body const& body) {
  PIOLA_EXPECTS(body.first < body.last);
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

bool FormulaCheck::finite_at(std::int64_t id, Expression const& formula, std::string const& name, Place const& place,
                             double least) const {
  Vec3 const& X = particles_.X[static_cast<std::size_t>(id)];
  double const value = formula(X);
  if (std::isfinite(value) && value > least) return true;
  std::string const bound = least > -unbounded ? "above " + number_text(least) + " " : "";
  problems_.add(place, name + ", formula " + in_quotes(formula.text()) + " is " + number_text(value) +
                           " at X = " + point_text(X, particles_.dimension) + " of body " + in_quotes(body_.name) +
                           " (allowed: a finite number " + bound + "at every particle)");
  return false;
}

bool FormulaCheck::finite(Expression const& formula, std::string const& name, Place const& place, double least) const {
  std::atomic<bool> good{true};
  for_each_with_formulas(formula, body_, [&](Expression const& mine, std::size_t id) {
    double const value = mine(particles_.X[id]);
    if (!(std::isfinite(value) && value > least)) good.store(false, std::memory_order_relaxed);
  });
  if (good) return true;
  // The first one is named.
  for (std::int64_t id = body_.first; id < body_.last; ++id)
    if (!finite_at(id, formula, name, place, least)) break;
  return false;
}

bool FormulaCheck::finite(Expression const& formula, std::string const& name, Place const& place,
                          std::span<std::int64_t const> ids) const {
  return std::all_of(ids.begin(), ids.end(), [&](std::int64_t id) { return finite_at(id, formula, name, place); });
}

void FormulaCheck::gradient(std::array<Expression, 9> const& F, Place const& place) const {
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

bool check_where(Expression const& where, std::string const& name, Place const& place, ParticleSet const& particles,
                 Body const& body, Problems& problems) {
  if (body.first == body.last) return false;
  if (!FormulaCheck(particles, body, problems).finite(where, name, place)) return false;
  if (!select_particles(particles, body, &where).empty()) return true;
  problems.add(place, name + ", formula " + in_quotes(where.text()) + " selects no particle of body " +
                          in_quotes(body.name) + " (" + box_of(particles, body) + ") - change the condition");
  return false;
}

}  // namespace piola
