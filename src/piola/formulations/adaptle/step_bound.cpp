// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/step_bound.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/finish_pass.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola::adaptle {
namespace {

/// The shortest step so far, of equal ones that of the first particle, and what may limit it.
struct ParticleBound {
  double step = 1e300;  ///< [s]
  Index slot = FailureSlot::none;
  double h = 0, mass = 0;                  ///< [m], [kg]
  double volume_rate = 0, closing = 0;     ///< |tr L|, see ContactSum::closing [1/s]
  double stiffness = 0, acceleration = 0;  ///< of contact [N/m], [m/s2]
  double sound = 0, compression = 0;       ///< [m/s], |mu_ab| of the viscosity [m/s]
  double shortest_length = 1;              ///< of material, over its length at rest; at most 1
  double sheared_cfl = 0;                  ///< Courant number of that length

  void add(ParticleBound const& other) {
    if (other.step < step || (other.step == step && other.slot < slot)) *this = other;
  }
};

/// Steps of the particles of a body, from the sums and fields that the last step has left.
template <int D>
class BoundOfParticle {
 public:
  BoundOfParticle(System const& s, BodyConstants const& body)
      : s_(s), end_(s, body, s.material, false, 0), kick_(s, s.material, 0) {}

  ParticleBound operator()(Index i) const {
    static_assert(lane_count == 1, "one particle at a time");
    Group const one{i, 1};
    BlockScratch scratch(i);
    gather(one, scratch);
    Mat<3> const L = scratch.gradient(one);
    bool const material = s_.material.used && end_.phi.at(i) < 1;
    Mat<3> inverse_F = material ? inverse(end_.F.template matrix<double>(i)) : identity<3, double>();
    if (s_.settings.axisymmetric) inverse_F(2, 2) = 1;
    Vec<3> const a = end_.a.template vector<3, double>(i);
    bool const touching = end_.contact.data != nullptr;
    return {.step = end_.limit(one, scratch, L, inverse_F),
            .slot = i,
            .h = end_.body.h,
            .mass = end_.mass.at(i),
            .volume_rate = std::abs(trace(L)),
            .closing = touching ? end_.contact.at(i, ContactSum::closing) : 0,
            .stiffness = touching ? end_.contact.at(i, ContactSum::stiffness) : 0,
            .acceleration = std::sqrt(dot(a, a)),
            .sound = end_.c.at(i),
            .compression = scratch.compression[0],
            .shortest_length = material && end_.active.at(i) > 0
                                   ? 1 / std::sqrt(std::max(1.0, StepLimit::stretch_squared(inverse_F)))
                                   : 1,
            .sheared_cfl = lane(end_.sheared_cfl(i), 0)};
  }

 private:
  /// The velocity gradient and the compression of the viscosity.
  void gather(Group one, BlockScratch& scratch) const {
    using R = SpatialResult;
    Index const i = one.first;
    double spatial[R::stride]{};
    if (s_.spatial.result != nullptr)
      load_records<R::stride>(s_.spatial.result, R::stride, s_.spatial.result_of + i, spatial);
    kick_.set_gradient(one, spatial + R::L, scratch);
    if (s_.settings.plane_stress)
      scratch.L[8][0] =
          Components(read(s_.field.thickness_rate)).at(i) / Components(read(s_.field.thickness_half)).at(i);
    bool const summed = kick_.heat.data != nullptr;
    scratch.compression[0] =
        summed ? maximum(spatial[R::compression], kick_.compression.at(i)) : spatial[R::compression];
  }

  System const& s_;
  StepEnd<D> end_;
  Kick<D> kick_;
};

template <int D>
ParticleBound shortest_of(System const& s) {
  ParticleBound shortest;
  for (int b = 0; b < s.bodies; ++b) {
    BoundOfParticle<D> const bound_of(s, s.body[b]);
    for (Index i = s.part[b].first; i < s.part[b].last; ++i) shortest.add(bound_of(i));
  }
  if (s.shared) comm::allreduce_sum(shortest);
  return shortest;
}

/// Names the bound of StepLimit::step() that gives the step `b.step`.
std::string text_of(ParticleBound const& b, double cfl) {
  constexpr double same = 1 + 1e-9;  // despite rounding
  double const rate = std::max(b.volume_rate, b.closing);
  if (rate * b.step * same > largest_change) {
    auto const change = fmt::format("{:.4g} 1/s, {} % per step", rate, 100 * largest_change);
    return b.volume_rate > b.closing
               ? fmt::format("the change of volume ({})", change)
               : fmt::format("the approach of another body or a rigid shape ({} of a spacing)", change);
  }
  if (b.stiffness > 0 && 0.5 * std::sqrt(b.mass / b.stiffness) < b.step * same)
    return fmt::format("the stiffness of contact: 0.5 sqrt(m / k) with k = {:.4g} N/m", b.stiffness);
  if (b.acceleration > 0 && 0.25 * std::sqrt(b.h / b.acceleration) < b.step * same)
    return fmt::format("acceleration: 0.25 sqrt(h / a) with a = {:.4g} m/s2", b.acceleration);
  bool const compressed = b.sheared_cfl * b.shortest_length < cfl;
  return fmt::format(
      "waves: run.cfl h / c with run.cfl = {}{}, lengths compressed to {:.4g} of those at rest, a sound speed of "
      "{:.4g} "
      "m/s, and approach of neighbours at {:.4g} m/s (viscosity)",
      cfl, compressed && b.sheared_cfl > cfl ? fmt::format(", raised to {:.3g} in shear", b.sheared_cfl) : "",
      compressed ? b.shortest_length : 1, b.sound, b.compression);
}

}  // namespace

StepBound find_step_bound(Particles const& particles) {
  System const& s = particles.system();
  ParticleBound const found = s.dimension == 2 ? shortest_of<2>(s) : shortest_of<3>(s);
  double const step = particles.stable_time_step();
  // The steps differ if the particle was converted or deleted after its stable step had been found. The tolerance is
  // for round-off: this pass runs on the host, the loops of a step in a back end.
  if (!(std::abs(found.step - step) <= 1e-6 * step))
    return {.step = step, .text = "a particle that was converted or deleted in the last step"};
  return {.step = step, .text = text_of(found, s.settings.cfl), .particle = found.slot};
}

}  // namespace piola::adaptle
