// SPDX-License-Identifier: Apache-2.0
// Total-Lagrangian particles that become Eulerian, or fail.
#include "piola/formulations/adaptle/finish_pass.hpp"
#include "piola/formulations/adaptle/particles.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <array>
#include <cmath>

namespace piola::adaptle {
namespace {

struct Share {
  double energy = 0, momentum[3]{};
  Share(State const& s, Reference const& r) : energy(s.energy) {
    for (int c = 0; c < 3; ++c) {
      energy += 0.5 * r.mass * s.v[c] * s.v[c];
      momentum[c] = r.mass * s.v[c];
    }
  }
};

double strain_of(int dimension, Deformation const& d, SymMat<3> const& stress, BodyConstants const& b) {
  return dimension == 2 ? equivalent_strain<2>(d.F, stress, b) : equivalent_strain<3>(d.F, stress, b);
}

}  // namespace

/// Evaluates convert_when; true if a particle wants to convert by it, of any rank.
bool Particles::wishes_by_formula() {
  double any_wish = 0;
  bool asked = false;
  for (std::size_t k = 0; k < body_.size(); ++k) {
    BodyConstants const& b = body_[k];
    if (!options_.bodies[k].convert_when) continue;
    asked = true;
    Expression const& formula = *options_.bodies[k].convert_when;
    with_solid(b.material, [&](auto const& law) {
      for (Index i = own_[k].first; i < own_[k].last; ++i) {
        State const& s = state_[at(i)];
        if (s.phi > 0 || wish_[at(i)] == 1) continue;
        double const p = acting_pressure(law, s, system_.own, i, s.rho, s.energy / reference_[at(i)].mass);
        SymMat<3> stress = symmetric_of(s.S);
        for (int c = 0; c < 3; ++c) stress.c[c] -= p;
        std::array const values{s.damage,
                                s.plastic_strain,
                                b.rho0 / s.rho,
                                -p,
                                von_mises(symmetric_of(s.S)),
                                s.temperature,
                                strain_of(system_.dimension, deformation_[at(i)], stress, b),
                                s.rho};
        if (formula(X(i), books_.time, values) == 0) continue;
        wish_[at(i)] = 1;
        any_wish = 1;
      }
    });
  }
  if (exchanges_ && asked) ranks::take_largest(any_wish);
  return any_wish > 0;
}

/// Those that wish so convert or fail; the neighbours of failed ones go with them, theirs do not. Those that the guard
/// alone wants come last, so that nothing depends on who comes first. All ranks do it for all particles.
void Particles::convert(double dt) {
  if (exchanges_) exchanges_->wishes(system_);
  ConversionSums sums;
  for (Index i = 0; i < system_.particles; ++i) {
    if (wish_[at(i)] == 0) continue;
    std::size_t const body = at(body_of_[at(i)]);
    if (body_[body].deletes)
      remove(i);
    else if (wish_[at(i)] == 1) {
      material_.each_neighbour(i, options_.bodies[body].conversion_radius * body_[body].material_h, reference_,
                               [&](Index j) { make_eulerian(j, dt, false, sums); });
      make_eulerian(i, dt, false, sums);
    }
  }
  for (Index i = 0; i < system_.particles; ++i)
    if (wish_[at(i)] == 2 && !body_[at(body_of_[at(i)])].deletes) make_eulerian(i, dt, true, sums);
  if (exchanges_) ranks::add(sums);
  books_.converted_mass += sums.value(0);
  books_.energy_change += sums.value(1);
  books_.momentum_change += sums.value(2);
  choose_material();
}

/// x, v, S, energy and history stay. rho follows from J, which belongs to half time, carried on to the end of the step.
void Particles::make_eulerian(Index i, double dt, bool by_guard, ConversionSums& sums) {
  State& s = state_[at(i)];
  if (s.phi == 1) return;
  books_.converted += 1;
  books_.by_guard += by_guard ? 1 : 0;
  Share const before(s, reference_[at(i)]);
  Half const& h = half_[at(i)];
  if (s.phi == 0) s.rho = h.rho * std::exp(-0.5 * dt * h.divergence);
  s.phi = 1;
  Share const after(s, reference_[at(i)]);
  if (!is_own(i)) return;  // the others know of it that it has converted
  double const jump[3]{reference_[at(i)].mass, std::abs(after.energy - before.energy),
                       std::hypot(after.momentum[0] - before.momentum[0], after.momentum[1] - before.momentum[1],
                                  after.momentum[2] - before.momentum[2])};
  sums.add(jump);
}

/// Bears no stress any more and leaves the sums of its neighbours; its deformation stays as it is.
void Particles::remove(Index i) {
  State& s = state_[at(i)];
  if (!(s.alive > 0)) return;
  s.alive = 0;
  for (double& c : s.S) c = 0;
  Rates& k = rates_[at(i)];
  for (double& c : k.S) c = 0;
  k.rho = k.energy = k.thickness = 0;
  for (double& c : deformation_[at(i)].rate) c = 0;
  books_.deleted += 1;
}

}  // namespace piola::adaptle
