// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/point_factors.hpp"
#include "piola/materials/solids.hpp"
#include <algorithm>

namespace piola::adaptle {
namespace {

std::size_t place(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

void PointFactors::build(std::vector<BodyConstants> const& bodies, std::vector<BodyOptions> const& options,
                         FieldRef const& volume, Index particles, ParticleOrder const& order,
                         std::span<std::array<double, 3> const> X, double time) {
  *this = {};
  volume_ = volume;
  room_ = place(particles) + 16;  // loops read whole lanes
  order_ = &order;
  X_ = X;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (options[k].initial_pressure && (options[k].initial_pressure_lasts || !(time > 0)))
      add_initial_pressure(bodies[k], options[k]);
    add_explosive(bodies[k], options[k]);
    add_scatter(bodies[k]);
  }
  go_to(time);
}

void PointFactors::add_initial_pressure(BodyConstants const& body, BodyOptions const& options) {
  initial_pressure_.resize(room_);
  for (Index i = body.first; i < body.last; ++i) initial_pressure_[place(i)] = (*options.initial_pressure)(X(i));
  if (!options.initial_pressure_lasts) impulses_.push_back({body.first, body.last});
}

/// A particle burns while the front passes one and a half spacings.
void PointFactors::add_explosive(BodyConstants const& body, BodyOptions const& options) {
  double front = 0;
  with_solid(body.material, [&](auto const& law) { front = law.front_speed(); });
  if (!(front > 0)) return;
  lit_.resize(room_);
  burnt_.resize(room_, 1);
  for (Index i = body.first; i < body.last && options.ignition; ++i) lit_[place(i)] = (*options.ignition)(X(i));
  explosives_.push_back({body.first, body.last, front / (1.5 * body.spacing)});
}

void PointFactors::add_scatter(BodyConstants const& body) {
  with_solid(body.material, [&](auto const& law) {
    if (!(law.scatter.modulus < unbounded)) return;
    toughness_.resize(room_, 1);
    for (Index i = body.first; i < body.last; ++i)
      toughness_[place(i)] = law.scatter.factor(order_->id(i), value_at(volume_, i));
  });
}

void PointFactors::go_to(double time) {
  for (Explosive const& body : explosives_)
    for (Index i = body.first; i < body.last; ++i)
      burnt_[place(i)] = std::clamp((time - lit_[place(i)]) * body.rate, 0.0, 1.0);
}

void PointFactors::end_of_step() {
  for (auto const& [first, last] : impulses_)
    std::fill(initial_pressure_.begin() + first, initial_pressure_.begin() + last, 0);
  impulses_.clear();
}

OwnFactors PointFactors::view() const {
  auto const data = [](std::vector<double> const& v) { return v.empty() ? nullptr : v.data(); };
  return {data(initial_pressure_), data(burnt_), data(toughness_)};
}

}  // namespace piola::adaptle
