// SPDX-License-Identifier: Apache-2.0
// The loops of JST-SPH for one back end; compiled once per instruction set (PIOLA_BACKEND).
#include "piola/domain/communicator.hpp"
#include "piola/formulations/jst_sph/step.hpp"
#include "piola/formulations/jst_sph/verlet_step.hpp"

namespace piola::jst_sph::inline PIOLA_BACKEND {
namespace {

/// f(Step) with the step of the body's dimension and neighbour table.
template <template <int, class> class Kind, int D, class F>
void with_loader(BodyState& body, F const& f) {
  if (body.regular)
    f(Kind<D, StencilLoader<D>>(body, {body.stencil}));
  else
    f(Kind<D, ListLoader<D>>(body, {body.list}));
}
template <template <int, class> class Kind, class F>
void with_step(BodyState& body, F const& f) {
  switch (body.dimension) {
    case 1: return with_loader<Kind, 1>(body, f);
    case 2: return with_loader<Kind, 2>(body, f);
    default: return with_loader<Kind, 3>(body, f);
  }
}

void step(BodyState& body, double dt) {
  auto const take = [&](auto one_step) { one_step(dt); };
  if (body.constants.integrator == Integrator::verlet)
    with_step<VerletStep>(body, take);
  else
    with_step<Step>(body, take);
}

void update_deformation(BodyState& body) {
  with_step<Step>(body, [](auto one_step) { one_step.update_deformation(); });
}

void update_wave_speed(BodyState& body) {
  switch (body.dimension) {
    case 1: return compute_wave_speed<1>(body);
    case 2: return compute_wave_speed<2>(body);
    default: return compute_wave_speed<3>(body);
  }
}

double largest_wave_speed(BodyState& body) {
  double largest = largest_wave_speed_of(body, body.wave_speed);
  if (body.halo != nullptr) comm::allreduce_max(largest);
  return largest;
}

}  // namespace

/// The entry by which the host finds this instruction set.
extern Backend const backend;
Backend const backend{PIOLA_BACKEND_NAME, lane_count,          &step,
                      &update_wave_speed, &largest_wave_speed, &update_deformation};

}  // namespace piola::jst_sph::inline PIOLA_BACKEND
