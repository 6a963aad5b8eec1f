// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_support.hpp"
#include "piola/exec/cpu_time.hpp"
#include "piola/exec/threads.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

namespace piola {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() { return exec_host::processor_time(); }

std::vector<std::string> speedup_over_scalar(std::string const& backend, char const* const* usable) {
  std::vector<std::string> r{backend};
  for (; *usable != nullptr; ++usable)
    if (backend != "scalar" && std::string_view(*usable) == "scalar") r.emplace_back(*usable);
  return r;
}

void pin_to(int threads) {
  exec_host::set_threads(threads);
  exec_host::pin_threads();
}

double take_steps(Formulation& formulation, double time, int steps) {
  for (int k = 0; k < steps; ++k) {
    double const dt = formulation.stable_time_step();
    formulation.step(time, dt);
    time += dt;
  }
  return time;
}

Timing fastest_step(Formulation& formulation, int repeats) {
  // Some systems count the processor time of other threads in ticks of milliseconds.
  constexpr double least = 0.05;
  double wall = wall_seconds();
  double time = take_steps(formulation, 0, 1);
  int const steps = std::max(1, static_cast<int>(std::ceil(least / (wall_seconds() - wall))));
  Timing best{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int k = 0; k < repeats; ++k) {
    wall = wall_seconds();
    double const cpu = cpu_seconds();
    time = take_steps(formulation, time, steps);
    best.wall = std::min(best.wall, (wall_seconds() - wall) / steps);
    best.cpu = std::min(best.cpu, (cpu_seconds() - cpu) / steps);
  }
  return best;
}

double mean_neighbours(Formulation const& formulation, std::int64_t particles) {
  std::vector<double> neighbours(static_cast<std::size_t>(particles));
  formulation.sample("Neighbours", neighbours);
  return std::accumulate(neighbours.begin(), neighbours.end(), 0.0) / static_cast<double>(particles);
}

void RateRow::fill(Formulation const& formulation, std::int64_t count, Timing const& step) {
  auto const number = static_cast<double>(count);
  particles = static_cast<long>(count);
  bytes_per_particle = static_cast<double>(formulation.memory_bytes()) / number;
  per_second = number / step.wall;
  per_cpu_second = number / step.cpu;
}

nlohmann::ordered_json RateRow::json() const {
  return {{"name", name},           {"machine", backend},       {"threads", threads},
          {"particles", particles}, {"neighbours", neighbours}, {"bytes_per_particle", bytes_per_particle}};
}

}  // namespace piola
