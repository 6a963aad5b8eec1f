// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench.hpp"
#include "piola/base/errors.hpp"
#include "piola/bench/bench_files.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/exec/cpu_time.hpp"
#include "piola/exec/threads.hpp"
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "piola/study/refinement.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

namespace piola {
namespace {

using Parts = std::vector<std::pair<std::string, double>>;

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A row with one instruction set.
struct Subject {
  BenchRowSpec const* row;
  CaseSpec spec;
  ParticleSet particles;
  std::optional<Simulation> simulation = {};
  double time = 0;      ///< of the simulation [s]
  Parts before = {};    ///< timings before the measurement
  double stepping = 0;  ///< wall time of the steps since then [s]
  BenchRow result = {};
};

/// The instruction set asked for and, if wanted and in this program, the scalar path.
std::vector<std::string> backends_of(BenchOptions const& options, bool scalar) {
  auto const usable = exec_host::usable_backends();
  bool const best = options.backend == "auto" && !usable.empty();
  std::vector<std::string> all{best ? usable.front() : options.backend};
  for (std::string const& name : usable)
    if (scalar && name == "scalar" && all.front() != name) all.push_back(name);
  return all;
}

/// Settings for spacings with which a case has at most about `side` cubed particles.
std::vector<std::string> coarsening(std::filesystem::path const& file, std::vector<std::string> const& settings,
                                    int side) {
  ParticleSet made;
  auto const take_at_once = [](std::string const&, double) { return AfterSweep::take; };
  CaseSpec const spec = read_case(file, settings, {.packing = take_at_once}, &made);
  double const power = 1.0 / made.dimension;
  double const now = std::pow(made.size(), power), most = std::pow(side, 3 * power);
  return most < now ? spacing_settings(file, settings, spec, (now - 1) / (most - 1)) : std::vector<std::string>{};
}

Subject prepare(BenchFile const& file, BenchRowSpec const& row, std::string const& backend,
                BenchOptions const& options) {
  std::vector<std::string> settings = row.set;
  settings.push_back("run.instruction_set=" + backend);
  if (options.most_per_side > 0)
    for (std::string& more : coarsening(file.case_file, settings, options.most_per_side))
      settings.push_back(std::move(more));
  Subject s{.row = &row, .spec = {}, .particles = {}};
  s.spec = read_case(file.case_file, settings, {}, &s.particles);
  s.result.bench = file.name;
  s.result.name = row.name;
  s.result.backend = backend;
  s.result.particles = s.particles.size();
  return s;
}

/// Mean over all particles of the field Neighbours.
double mean_neighbours(Formulation const& formulation, std::int64_t particles) {
  std::vector<double> neighbours(static_cast<std::size_t>(particles));
  formulation.observables().sample("Neighbours", neighbours);
  return std::accumulate(neighbours.begin(), neighbours.end(), 0.0) / static_cast<double>(particles);
}

/// Prepares the measurements with a number of threads. Steps that all count start from the initial state.
void start_row(Subject& s, int threads) {
  if (!s.simulation || s.row->steps > 0) {
    s.spec.run.threads = threads;
    double const cpu = exec_host::processor_time();
    s.simulation = build(s.spec, s.particles);
    s.result.set_up = exec_host::processor_time() - cpu;
    s.time = 0;
  }
  exec_host::set_threads(threads);
  exec_host::pin_threads();
  BenchRow const fresh;
  s.result.threads = threads;
  s.result.wall = fresh.wall;
  s.result.cpu = fresh.cpu;
  s.before = s.simulation->formulation->statistics().seconds;
  s.stepping = 0;
}

/// Returns the wall time [s].
double take_steps(Subject& s, int steps) {
  Formulation& formulation = *s.simulation->formulation;
  double const start = wall_seconds();
  for (int k = 0; k < steps; ++k) {
    double const dt = formulation.stable_time_step();
    formulation.step(s.time, dt);
    s.time += dt;
  }
  double const wall = wall_seconds() - start;
  s.stepping += wall;
  return wall;
}

/// Measures the mean of the steps of the row, or of the steps in 50 ms or more, `repeats` times. The steps before warm
/// caches and threads.
void measure(Subject& s, int repeats) {
  constexpr double least = 0.05;  // s: some systems count the processor time of other threads in ticks of milliseconds
  double const one = take_steps(s, s.row->warm_up) / s.row->warm_up;
  int const steps = s.row->steps > 0 ? s.row->steps : std::max(1, static_cast<int>(std::ceil(least / one)));
  for (int k = 0; k < (s.row->steps > 0 ? 1 : repeats); ++k) {
    double const time = s.time, cpu = exec_host::processor_time();
    s.result.wall = std::min(s.result.wall, take_steps(s, steps) / steps);
    s.result.cpu = std::min(s.result.cpu, (exec_host::processor_time() - cpu) / steps);
    s.result.time_step = (s.time - time) / steps;
  }
}

/// BenchRow::parts, from the timings before and after steps that took `stepping` [s].
Parts parts_of(Parts const& before, Parts after, double stepping) {
  bool const in_steps = before != after;
  double sum = 0;
  for (auto const& part : after) sum += part.second;
  for (std::size_t k = 0; k < after.size(); ++k)
    after[k].second =
        in_steps ? (after[k].second - before[k].second) / stepping : after[k].second / (sum > 0 ? sum : 1);
  return after;
}

BenchRow finish(Subject& s, int repeats) {
  Formulation const& formulation = *s.simulation->formulation;
  BenchRow& row = s.result;
  if (auto const failure = formulation.failure())
    throw PhysicsError(fmt::format("{}, {}: a particle {}", row.bench, row.name, failure->what));
  RunStatistics statistics = formulation.statistics();
  row.parts = parts_of(s.before, std::move(statistics.seconds), s.stepping);
  row.stages = statistics.stages_per_step;
  row.neighbours = mean_neighbours(formulation, row.particles);
  row.bytes_per_particle = static_cast<double>(statistics.memory_bytes) / static_cast<double>(row.particles);
  row.observation = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeats; ++k) {
    double const wall = wall_seconds();
    (void)formulation.diagnose();
    row.observation = std::min(row.observation, wall_seconds() - wall);
  }
  return row;
}

/// Measures rows `first` to `last` - 1 in turn, or one row.
void measure_rows(BenchFile const& file, std::size_t first, std::size_t last, BenchOptions const& options,
                  std::vector<BenchRow>& rows) {
  int const rounds = file.in_turn ? options.repeats : 1;
  for (std::string const& backend : backends_of(options, file.rows[first].scalar)) {
    std::vector<Subject> subjects;
    for (std::size_t k = first; k < last; ++k) subjects.push_back(prepare(file, file.rows[k], backend, options));
    int const fixed = subjects.front().spec.run.threads;
    for (int const threads : fixed > 0 ? std::vector{fixed} : options.threads) {
      for (Subject& s : subjects) start_row(s, threads);
      for (int k = 0; k < rounds; ++k)
        for (Subject& s : subjects) measure(s, options.repeats / rounds);
      for (Subject& s : subjects) rows.push_back(finish(s, options.repeats));
    }
  }
}

void measure_file(BenchFile const& file, BenchOptions const& options, std::vector<BenchRow>& rows) {
  std::size_t const count = file.rows.size(), group = file.in_turn ? count : 1, begin = rows.size();
  for (std::size_t k = 0; k < count; k += group) measure_rows(file, k, k + group, options, rows);
  for (std::size_t k = begin; k < rows.size(); ++k) {
    auto const first = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(begin), rows.end(), [&](auto const& r) {
      return r.backend == rows[k].backend && r.threads == rows[k].threads;
    });
    rows[k].relative_cost = first->stages_per_cpu_second() / rows[k].stages_per_cpu_second();
  }
}

}  // namespace

std::vector<BenchRow> measure_steps(BenchOptions const& options) {
  std::vector<BenchRow> rows;
  for (BenchFile const& file : read_benchmarks(options.cases, options.names)) measure_file(file, options, rows);
  return rows;
}

std::string to_json(std::vector<BenchRow> const& rows) {
  auto all = nlohmann::ordered_json::array();
  for (BenchRow const& row : rows) {
    auto parts = nlohmann::ordered_json::object();
    for (auto const& [name, fraction] : row.parts) parts[name] = fraction;
    all.push_back({{"bench", row.bench},
                   {"name", row.name},
                   {"machine", row.backend},
                   {"threads", row.threads},
                   {"particles", row.particles},
                   {"neighbours", row.neighbours},
                   {"bytes_per_particle", row.bytes_per_particle},
                   {"set_up_cpu_seconds", row.set_up},
                   {"stages_per_step", row.stages},
                   {"seconds_per_step", row.wall},
                   {"cpu_seconds_per_step", row.cpu},
                   {"stages_per_second", row.stages_per_second()},
                   {"stages_per_cpu_second", row.stages_per_cpu_second()},
                   {"relative_cost", row.relative_cost},
                   {"time_step", row.time_step},
                   {"simulated_ms_per_cpu_second", 1e3 * row.time_step / row.cpu},
                   {"observation_seconds", row.observation},
                   {"parts", parts}});
  }
  return nlohmann::ordered_json{{"rows", all}}.dump(2) + "\n";
}

std::string to_text(std::vector<BenchRow> const& rows) {
  std::string text, bench;
  for (BenchRow const& row : rows) {
    if (row.bench != bench)
      text += fmt::format("\n{:<34} {:>7} {:>7} {:>9} {:>5} {:>7} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>9}  {}\n",
                          row.bench, "machine", "threads", "particles", "pairs", "bytes", "set-up s", "ms/step",
                          "M st./s", "M/cpu s", "relative", "ms/cpu s", "observe", "parts");
    bench = row.bench;
    text += fmt::format(
        "{:<34} {:>7} {:>7} {:>9} {:>5.1f} {:>7.0f} {:>9.3f} {:>9.3f} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.3g} {:>9.3f} ",
        row.name, row.backend, row.threads, row.particles, row.neighbours, row.bytes_per_particle, row.set_up,
        1e3 * row.wall, 1e-6 * row.stages_per_second(), 1e-6 * row.stages_per_cpu_second(), row.relative_cost,
        1e3 * row.time_step / row.cpu, 1e3 * row.observation);
    for (auto const& [name, fraction] : row.parts)
      if (fraction > 0) text += fmt::format(" {} {:.0f} %", name, 100 * fraction);
    text += "\n";
  }
  return text +
         "\npairs: neighbours per particle; bytes: per particle; set-up: processor time; M st./s: million "
         "particle-stages by wall time;\nM/cpu s: by processor time of all threads, the figure to compare on a "
         "machine that others use too; relative: its inverse, over that of\nthe first row; ms/cpu s: simulated time by "
         "processor time; observe: ms for a row of the history; parts: of the time of a step, or of the set-up\n";
}

}  // namespace piola
