// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/step_observer.hpp"
#include "piola/guards/guard.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {

void StepObserver::observe(Formulation const& formulation, TimeState const& moment) {
  RunSpec const& run = results_.spec.run;
  if (moment.at_rest || moment.time >= run.end) return;
  double const next = std::min(formulation.stable_time_step(), run.max_step);
  longest_ = std::max(longest_, next);
  double const half = 0.5 * std::min(longest_, logged_);
  if (!(next < half)) return;
  StepBound const bound = formulation.observables().step_bound();
  if (!(bound.step < half)) return;  // shortened to the end of a load or support
  logged_ = bound.step;
  std::string where;
  if (bound.particle >= 0)
    evaluate_on_root(formulation, results_.particles, [&](FieldCache& fields) {
      where = ", at " + suspect(fields, static_cast<std::size_t>(bound.particle), moment.time).text(results_.particles);
    });
  results_.journal.note(
      fmt::format("t = {:.6g} s: the step falls to {:.3g} s (the longest was {:.3g} s), limited by {}{}", moment.time,
                  bound.step, longest_, bound.text, where));
}

}  // namespace piola
