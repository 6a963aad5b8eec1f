// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/law_factors.hpp"
#include "piola/base/contracts.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>

namespace piola::adaptle {
namespace {

std::size_t place(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

void PointFactors::build(std::vector<BodyConstants> const& bodies, std::vector<BodyOptions> const& options,
                         std::vector<Range> const& own, ParticleSet const& set, double time) {
  PIOLA_EXPECTS(bodies.size() == options.size() && bodies.size() == own.size());
  *this = {};
  set_ = &set;
  own_ = own;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (options[k].initial_pressure && (options[k].initial_pressure_lasts || !(time > 0)))
      add_initial_pressure(own[k], options[k]);
    add_explosive(bodies[k], own[k], options[k]);
    add_scatter(bodies[k], own[k]);
  }
  go_to(time);
}

LazyZeroArray<double>& PointFactors::with(LazyZeroArray<double>& values, double otherwise) const {
  if (!values.empty()) return values;
  values = LazyZeroArray<double>(place(static_cast<Index>(set_->size())) + 16);  // loops read whole lanes
  for (Range const& own : own_)
    for (Index i = own.first; i < own.last && otherwise != 0; ++i) values[place(i)] = otherwise;
  return values;
}

void PointFactors::add_initial_pressure(Range own, BodyOptions const& options) {
  with(initial_pressure_, 0);
  for (Index i = own.first; i < own.last; ++i) initial_pressure_[place(i)] = (*options.initial_pressure)(X(i));
  if (!options.initial_pressure_lasts) impulses_.push_back(own);
}

/// A particle burns while the front passes one and a half spacings.
void PointFactors::add_explosive(BodyConstants const& body, Range own, BodyOptions const& options) {
  double front = 0;
  with_solid(body.material, [&](auto const& law) { front = law.front_speed(); });
  if (!(front > 0)) return;
  with(ignition_time_, 0);
  with(burnt_, 1);
  for (Index i = own.first; i < own.last && options.ignition; ++i) ignition_time_[place(i)] = (*options.ignition)(X(i));
  explosives_.push_back({own, front / (1.5 * body.spacing)});
}

void PointFactors::add_scatter(BodyConstants const& body, Range own) {
  with_solid(body.material, [&](auto const& law) {
    if (!(law.scatter.modulus < unbounded)) return;
    with(toughness_, 1);
    for (Index i = own.first; i < own.last; ++i)
      toughness_[place(i)] = law.scatter.factor(place(i), set_->volume[place(i)]);
  });
}

void PointFactors::go_to(double time) {
  for (Explosive const& body : explosives_)
    for (Index i = body.own.first; i < body.own.last; ++i)
      burnt_[place(i)] = std::clamp((time - ignition_time_[place(i)]) * body.rate, 0.0, 1.0);
}

void PointFactors::end_of_step() {
  for (Range const& own : impulses_)
    std::fill(initial_pressure_.begin() + own.first, initial_pressure_.begin() + own.last, 0);
  impulses_.clear();
}

LawFactors PointFactors::view() const {
  auto const data = [](LazyZeroArray<double> const& v) { return v.empty() ? nullptr : v.data(); };
  return {data(initial_pressure_), data(burnt_), data(toughness_)};
}

}  // namespace piola::adaptle
