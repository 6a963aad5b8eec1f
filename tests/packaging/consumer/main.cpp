// SPDX-License-Identifier: Apache-2.0
// Runs a case of the installed examples for a few steps and prints its energy.
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/run_case.hpp"
#include <cstdio>

int main(int, char** arguments) {
  piola::Simulation simulation = piola::build(piola::read_case(arguments[1]));
  piola::Listener listener;
  std::atomic<int> stop{0};
  piola::CaseRun run(simulation, {.folder = ""}, listener, stop);
  run.advance({.step = 5});
  std::printf("%lld steps, %.6g J\n", static_cast<long long>(run.moment().step),
              simulation.formulation->diagnose().total_energy());
  return run.moment().step == 5 ? 0 : 1;
}
