// SPDX-License-Identifier: Apache-2.0
// The loops of Taylor-SPH for one back end; compiled once per instruction set (PIOLA_BACKEND).
#include "piola/formulations/taylor_sph/step.hpp"
#include "piola/kernels/list.hpp"

namespace piola::taylor_sph::inline PIOLA_BACKEND {
namespace {

template <int D, class Kernel, class F>
void with_rate_form(BodyState& body, F const& f) {
  with_law(body.material, [&](auto const& law) {
    using Law = std::decay_t<decltype(law)>;
    if constexpr (RateForm<Law>) f(Step<D, Kernel, Law>(body, law));
  });
}
template <int D, class F>
void with_kernel(BodyState& body, F const& f) {
  piola::with_kernel(*body.k.kernel, LaneKernels{}, [&]<class K>() { with_rate_form<D, K>(body, f); });
}
template <class F>
void with_step(BodyState& body, F const& f) {
  switch (body.dimension) {
    case 1: return with_kernel<1>(body, f);
    case 2: return with_kernel<2>(body, f);
    default: return with_kernel<3>(body, f);
  }
}

void half_step(BodyState& body, double dt) {
  with_step(body, [&](auto step) { step.half(dt); });
}
void full_step(BodyState& body, double dt) {
  with_step(body, [&](auto step) { step.full(dt); });
}
void impose(BodyState& body) {
  with_step(body, [](auto step) { step.impose(); });
}
void filter(BodyState& body) {
  with_step(body, [](auto step) { step.filter(); });
}
void motion(BodyState& body, double* sums) {
  for (int k = 0; k < MotionSums::size; ++k) sums[k] = 0;
  with_step(body, [&](auto step) { step.motion(sums); });
}
void add_rigid(BodyState& body, double const* rate) {
  with_step(body, [&](auto step) { step.add_rigid(rate); });
}
CellMeasures place(BodyState& body) {
  CellMeasures m;
  with_step(body, [&](auto step) { m = step.place(); });
  return m;
}
void adjoint_step(BodyState& body, double dt) {
  with_step(body, [&](auto step) { step.adjoint(dt); });
}
CellEnergy cell_energy(BodyState& body) {
  CellEnergy e;
  with_step(body, [&](auto step) { e = step.cell_energy(); });
  return e;
}

}  // namespace

/// The entry by which the host finds this instruction set.
extern Backend const backend;
Backend const backend{PIOLA_BACKEND_NAME, lane_count, &half_step,    &full_step,  &impose, &filter, &motion,
                      &add_rigid,         &place,     &adjoint_step, &cell_energy};

}  // namespace piola::taylor_sph::inline PIOLA_BACKEND
