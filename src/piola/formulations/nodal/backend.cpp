// SPDX-License-Identifier: Apache-2.0
// The loops of the nodal formulation for one back end; compiled once per instruction set (PIOLA_BACKEND).
#include "piola/formulations/nodal/step.hpp"

namespace piola::nodal::inline PIOLA_BACKEND {
namespace {

/// f(Step) with the step of the body's dimension.
template <class F>
void with_step(BodyState& body, F const& f) {
  switch (body.dimension) {
    case 1: return f(Step<1>(body));
    case 2: return f(Step<2>(body));
    default: return f(Step<3>(body));
  }
}

void step(BodyState& body, double dt) {
  with_step(body, [&](auto one_step) { one_step(dt); });
}
void accelerate(BodyState& body) {
  with_step(body, [](auto one_step) { one_step.accelerate(); });
}
void update_output_fields(BodyState& body) {
  with_step(body, [](auto one_step) { one_step.update_output_fields(); });
}
void keep(BodyState& body) {
  with_step(body, [](auto one_step) { one_step.keep(); });
}
void restore(BodyState& body) {
  with_step(body, [](auto one_step) { one_step.restore(); });
}

void subtract_gradients(BodyState& body, FieldRef const& centroid) {
  with_step(body, [&](auto one_step) { one_step.subtract_gradients(centroid); });
}

void linearise_pressure(BodyState& body) {
  with_step(body, [](auto one_step) { one_step.linearise_pressure(); });
}
void change_of_ratio(BodyState& body) {
  with_step(body, [](auto one_step) { one_step.change_of_ratio(); });
}
void accelerate_by_pressure(BodyState& body) {
  with_step(body, [](auto one_step) { one_step.accelerate_by_pressure(); });
}

double largest_change(BodyState& body) {
  exec::for_each_block(body.slots, LargestChange{read(body.change), body.partial});
  double largest = 0;
  for (Index k = 0; k < exec::block_count(body.slots); ++k) largest = maximum(largest, body.partial[k]);
  return largest;
}

}  // namespace

/// The entry by which the host finds this instruction set.
extern Backend const backend;
Backend const backend{PIOLA_BACKEND_NAME,
                      lane_count,
                      &step,
                      &accelerate,
                      &update_output_fields,
                      &linearise_pressure,
                      &change_of_ratio,
                      &accelerate_by_pressure,
                      &largest_change,
                      &keep,
                      &restore,
                      &subtract_gradients};

}  // namespace piola::nodal::inline PIOLA_BACKEND
