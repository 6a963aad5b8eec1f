// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/estimates/estimate.hpp"
#include "piola/exec/threads.hpp"
#include "piola/model/read_case.hpp"
#include "piola/observers/results_folder.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/simulation/build.hpp"
#include "piola/study/convergence_table.hpp"
#include "piola/study/refinement.hpp"
#include "commands.hpp"
#include "run_support.hpp"
#include "set_up_watch.hpp"
#include "signals.hpp"
#include "streams.hpp"
#include "study_runs.hpp"
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <functional>
#include <memory>

namespace piola::app {
namespace {

namespace fs = std::filesystem;

struct ConvergeArguments {
  CaseOptions from;
  std::string out;
  std::vector<std::string> columns;
  std::vector<double> factors{1, 1 / 1.5, 1 / 2.25};
  int jobs = 1;
  bool only_check = false;
};

/// The case with one spacing.
struct Level {
  StudyRun run;
  CaseSpec spec;
  std::int64_t particles = 0;
  Estimate cost;
};

Estimate cost_of(CaseSpec const& spec, ParticleSet const& particles) {
  if (particles.size() >= large_case)
    return estimate_from_parts(spec, particles, exec_host::set_threads(spec.run.threads));
  CostMeter const meter;
  Simulation simulation = build(spec, particles);
  return estimate(simulation, meter).first;
}

/// The case as it is, with all settings but those of the spacing.
struct Given {
  CaseSpec spec;
  ParticleSet particles;
};

Given read_given(StudySpec const& study, std::vector<std::string> const& settings) {
  Given given;
  SetUpWatch watch("reading the case and making its particles", {});
  given.spec = read_case(study.case_file, settings, {.packing = std::ref(watch)}, &given.particles);
  return given;
}

Level level_of(StudySpec const& study, Given const& given, double factor) {
  Level level{{{}, study.settings, {}}, {}, 0, {}};
  try {
    auto const more = spacing_settings(study.case_file, study.settings, given.spec, factor);
    level.run.settings.insert(level.run.settings.end(), more.begin(), more.end());
    Given const scaled = more.empty() ? given : read_given(study, level.run.settings);
    level.spec = scaled.spec;
    level.particles = scaled.particles.size();
    level.cost = cost_of(scaled.spec, scaled.particles);
  } catch (InputError const& error) {
    throw InputError(fmt::format("with spacings {:.3g} times as large:\n{}", factor, error.what()));
  }
  level.run.value_text = {fmt::format("\"{:.6g} m\"", finest_spacing(level.spec))};
  return level;
}

/// One level for each factor, the coarsest first.
std::vector<Level> levels_of(StudySpec const& study, std::vector<double> factors) {
  std::sort(factors.begin(), factors.end(), std::greater<>());
  if (std::adjacent_find(factors.begin(), factors.end()) != factors.end())
    throw InputError("--factors: two are the same (allowed: two or three different ones) - change one");
  Given const given = read_given(study, study.settings);
  if (given.spec.quantities.empty())
    throw InputError(
        fmt::format("{}: has no [[quantity]] to compare (one or more are needed) - add one, or name columns of "
                    "history.csv with --column",
                    study.case_file.string()));
  std::vector<Level> levels;
  for (double const factor : factors) levels.push_back(level_of(study, given, factor));
  auto const folders = run_folders(levels.size());
  for (std::size_t k = 0; k < levels.size(); ++k) levels[k].run.folder = folders[k];
  return levels;
}

/// Directions that do not change alike make an observed order less certain.
void say_uneven(std::vector<Level> const& levels) {
  constexpr double notable = 0.05;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    SpacingRatio const ratio = spacing_ratio(levels[k].spec, levels[k - 1].spec);
    if (ratio.most > (1 + notable) * ratio.least)
      print_result(
          "note: from {} to {} the spacings of bodies and directions change by factors from {:.3g} to {:.3g}, so that "
          "the order is less certain - choose factors that divide the numbers of particles\n",
          levels[k - 1].run.folder, levels[k].run.folder, ratio.least, ratio.most);
    if (ratio.mean > 1 - notable)
      throw InputError(
          fmt::format("--factors: {} and {} have nearly the same spacing (mean ratio {:.3g}, allowed: below "
                      "{}) - choose factors further apart",
                      levels[k - 1].run.folder, levels[k].run.folder, ratio.mean, 1 - notable));
  }
}

void say_costs(std::vector<Level> const& levels) {
  double seconds = 0, memory = 0;
  for (Level const& level : levels) {
    double const wall = level.cost.setup_seconds + level.cost.run_seconds;
    seconds += wall;
    memory = std::max(memory, level.cost.memory);
    print_result("{}: spacing {}, {} particles, about {} steps and {}\n", level.run.folder,
                 quantity_text(finest_spacing(level.spec), "m"), count_text(level.particles),
                 count_text(level.cost.steps), duration_text(wall));
  }
  print_result("in all about {}, estimated, one run after the other; at most {} of memory for one\n",
               duration_text(seconds), size_text(memory));
}

std::vector<double> spacings_of(std::vector<Level> const& levels) {
  std::vector<double> spacings{finest_spacing(levels.front().spec)};
  for (std::size_t k = 1; k < levels.size(); ++k)
    spacings.push_back(spacings.back() * spacing_ratio(levels[k].spec, levels[k - 1].spec).mean);
  return spacings;
}

/// The study without its runs.
StudySpec study_of(ConvergeArguments const& options) {
  StudySpec study;
  study.case_file = case_file(options.from.file);
  study.jobs = options.jobs;
  study.threads = share_of_cores(study.jobs);
  std::string const& given = options.from.threads;  // the case reader reports an invalid number
  std::from_chars(given.data(), given.data() + given.size(), study.threads);
  study.settings = options.from.overrides();
  if (given.empty()) study.settings.push_back("run.threads=" + std::to_string(study.threads));
  if (!options.columns.empty())
    study.settings.push_back(quantity_setting(study.case_file, study.settings, options.columns));
  return study;
}

fs::path folder_of(ConvergeArguments const& options, StudySpec const& study) {
  if (!options.out.empty()) return options.out;
  std::string const results = default_results(study.case_file).string();
  return results.substr(0, results.rfind('-')) + "-converge";
}

int converge(ConvergeArguments const& options) {
  StudySpec study = study_of(options);
  auto const levels = levels_of(study, options.factors);
  say_costs(levels);
  say_uneven(levels);
  if (options.only_check) return with_output(completed);
  std::vector<StudyRun> runs;
  std::vector<std::string> identities;
  study.parameters.emplace_back("spacing", std::vector<std::string>{});
  for (Level const& level : levels) {
    runs.push_back(level.run);
    identities.push_back(level.spec.identity.run);
    study.parameters.front().second.push_back(level.run.value_text.front());
  }
  fs::path const folder = folder_of(options, study);
  auto const outcomes = make_runs(study, folder, runs, identities);
  int const code = code_of(outcomes);
  if (code == stopped_by_signal) return code;
  ConvergenceTable const table(levels.front().spec.quantities, spacings_of(levels), outcomes);
  write_whole_file(folder / "convergence.csv", table.csv());
  print_result("{}", table.text());
  return with_output(code == completed && !table.has_errors() ? physics_failed : code);
}

}  // namespace

void add_converge(CLI::App& program, Action& action) {
  auto const options = std::make_shared<ConvergeArguments>();
  CLI::App* command = program.add_subcommand(
      "converge", "Run a case with two or three spacings: how large are the errors of its quantities?");
  options->from.add_to(*command);
  command
      ->add_option("--column", options->columns,
                   "Another column of history.csv to compare: NAME (its last value) or NAME:TAKE, "
                   "as in tip.displacement_y:minimum; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command
      ->add_option("--factors", options->factors,
                   "Two or three factors on the spacing of every body (default: 1 0.667 0.444, that is 1/1.5 and "
                   "1/1.5^2)")
      ->expected(2, 3)
      ->check(CLI::Range(0.01, 100.0));
  command->add_option("--out,-o", options->out,
                      "Folder for the runs, study.csv and convergence.csv (default: NAME-converge)");
  command->add_option("--jobs", options->jobs, "Runs at a time (default 1)")->check(CLI::Range(1, 3));
  command->add_flag("--check", options->only_check, "Say what it would run and how long it would take, and stop");
  command->callback([options, &action] { action = [options] { return converge(*options); }; });
}

}  // namespace piola::app
