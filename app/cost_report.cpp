// SPDX-License-Identifier: Apache-2.0
#include "cost_report.hpp"
#include "piola/base/text.hpp"
#include "streams.hpp"
#include <fmt/format.h>
#include <string>

namespace piola::app {
namespace {

std::string steps_text(Estimate const& cost) {
  std::string const steps = cost.most_steps > cost.steps
                                ? fmt::format("{} to {}", count_text(cost.steps), count_text(cost.most_steps))
                                : fmt::format("about {}", count_text(cost.steps));
  return steps + (cost.most_steps == 1 ? " step" : " steps") +
         (cost.trial_steps > 0 ? fmt::format(", {} of them tried", count_text(cost.trial_steps)) : "");
}

}  // namespace

void say_cost(CasePlan const& plan) {
  Estimate const& cost = plan.cost;
  bool const bounded = plan.spec.run.max_step <= cost.step;
  std::string const first =
      cost.rule.first < cost.step ? fmt::format(", from {} at the start", quantity_text(cost.rule.first, "s", 3)) : "";
  print_result("step: about {}{}, {}\n", quantity_text(cost.step, "s", 3), first, steps_text(cost));
  print_result("  limited by {}\n", bounded ? "run.max_step" : cost.rule.limit);
  if (!cost.varies.empty()) print_result("  {}\n", cost.varies);
  std::string const most =
      cost.most_steps > cost.steps ? " (" + duration_text(cost.most_run_seconds) + " at most)" : "";
  print_result("needs, estimated: {} to set up and {}{} to run with {} {}, {} of memory, {} of disk\n",
               duration_text(cost.setup_seconds), duration_text(cost.run_seconds), most, cost.threads,
               cost.threads == 1 ? "thread" : "threads", size_text(cost.memory), size_text(cost.disk));
}

void say_ranks(CasePlan const& plan, int ranks) {
  std::string const all = count_text(ranks) + (ranks == 1 ? " rank" : " ranks");
  print_result("on {}: about {} particles and {} of memory each\n", all, count_text(plan.particles.size() / ranks),
               size_text(memory_of_rank(plan.cost, plan.particles, ranks)));
  print_result("  a run of 20 steps on {} (run.end = \"{}\") shows the speed: message_seconds in summary.json\n", all,
               quantity_text(20 * plan.cost.step, "s", 3));
}

}  // namespace piola::app
