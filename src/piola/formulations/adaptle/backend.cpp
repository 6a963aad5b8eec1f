// SPDX-License-Identifier: Apache-2.0
// The loops of AdapTLE for one back end; compiled once per instruction set (PIOLA_BACKEND).
#include "piola/formulations/adaptle/step.hpp"

namespace piola::adaptle::inline PIOLA_BACKEND {
namespace {

template <class F>
void with_step(System& s, F const& f) {
  if (s.dimension == 2)
    f(Step<2>{s});
  else
    f(Step<3>{s});
}

void predict(System& s, double dt) {
  with_step(s, [&](auto step) { step.predict(dt); });
}
void deform(System& s) {
  with_step(s, [](auto step) { step.deform(); });
}
void half_state(System& s, double dt) {
  with_step(s, [&](auto step) {
    if (s.settings.corrected)
      step.template half_state<true>(dt);
    else
      step.template half_state<false>(dt);
  });
}
void correct(System& s) {
  with_step(s, [](auto step) { step.correct(); });
}
void sweep(System& s) {
  with_step(s, [](auto step) { step.sweep(); });
}
StepSums finish(System& s, double dt) {
  StepSums m;
  with_step(s, [&](auto step) { m = step.finish(dt); });
  return m;
}
void search(CellListSearch const& s) { find_neighbours(s); }

}  // namespace

/// The entry by which the host finds this instruction set.
extern Backend const backend;
Backend const backend{PIOLA_BACKEND_NAME, lane_count, &predict, &deform, &half_state,
                      &correct,           &sweep,     &finish,  &search};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
