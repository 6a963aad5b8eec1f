// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/estimate.hpp"
#include "piola/estimates/reduced_case.hpp"
#include "piola/estimates/step_range.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/formulations/setting_warnings.hpp"
#include "piola/input/check_case.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/measures/probe.hpp"
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace piola {
namespace {

/// Processor time per particle and right-hand side [s], by the number of dimensions: whole steps with all they need,
/// one thread, AVX-512. From `piola bench` (bench/README.md) and, where that has no row, runs of 40 steps.
struct ThroughputModel {
  std::array<double, 3> lattice;      ///< neighbours at fixed distances; taylor_sph: boxes; adaptle: total Lagrangian
  std::array<double, 3> off_lattice;  ///< lists; taylor_sph: simplices; adaptle: Eulerian
  std::array<double, 3> setup;        ///< s per particle for tables, lists and the first output
  std::array<double, 3> overhead;     ///< bytes per particle at the peak over Formulation::memory_bytes
  std::array<double, 3> more_scattered = {};  ///< and these, if scattered
  /// For observation by local particles: replicated bytes per particle of the body; rank 0 needs more for output.
  /// Measured by bench/ranks_memory.py.
  double everywhere = 0, of_first = 0;
  /// As above during set-up, if different: replicated bytes of all particles, and bytes of local ones over
  /// Formulation::memory_bytes, some of which come later.
  struct SetUp {
    double everywhere, lattice, off_lattice;
  };
  std::optional<SetUp> in_set_up = {};
};

/// Measured by the largest resident memory of runs with 64,000 to 512,000 particles: in it are what set-up and
/// measurements of the step limit need for a while, and what a checkpoint needs of one field.
ThroughputModel pace_of(std::string_view formulation) {
  constexpr double ns = 1e-9, us = 1e-6;
  if (formulation == "adaptle")
    return {{300 * ns, 345 * ns, 640 * ns},
            {300 * ns, 377 * ns, 746 * ns},
            {2 * us, 2 * us, 5 * us},
            {280, 280, 250},
            {},
            94,
            6};
  if (formulation == "taylor_sph")
    return {{10 * ns, 98 * ns, 590 * ns},
            {10 * ns, 200 * ns, 1350 * ns},
            {1 * us, 2 * us, 6 * us},
            {600, 800, 1100},
            {0, 130, 200}};
  bool const nodal = formulation == "nodal";
  return {{40 * ns, 103 * ns, 280 * ns},
          {80 * ns, 250 * ns, 1000 * ns},
          {2 * us, 3 * us, 6 * us},
          nodal ? std::array{240.0, 240.0, 245.0} : std::array{270.0, 270.0, 300.0},
          nodal ? std::array{0.0, 0.0, 335.0} : std::array{0.0, 0.0, 100.0},
          73,
          6,
          nodal ? std::optional(ThroughputModel::SetUp{200, -240, 75}) : std::nullopt};
}

constexpr double filter_factor = 2;     ///< of the volumetric filter of jst_sph
constexpr double program_bytes = 31e6;  ///< the program with its libraries
constexpr double messages_bytes = 9e6;  ///< memory of a rank for MPI and messages
constexpr double output_bytes = 14e6;   ///< memory of rank 0 for files, for any number of particles
constexpr double row_stages = 2;        ///< right-hand sides that a row of history.csv is worth
constexpr double frame_seconds = 2.4e-6, checkpoint_seconds = 1e-6;  ///< per particle
constexpr double picture_seconds = 0.2;
constexpr double compressed = 0.42;     ///< remaining fraction of the numbers of a frame
constexpr double picture_bytes = 0.6;   ///< per pixel
constexpr double cell_bytes = 12;       ///< of a history.csv
constexpr double kept_checkpoints = 2;  ///< at a time
constexpr double frame_file_bytes = 48e3, checkpoint_file_bytes = 11e3;  ///< of a file without particles

/// Instruction sets of less width take longer; measured: scalar.
double slowness(std::string const& backend) {
  constexpr std::array<std::pair<std::string_view, double>, 3> factors{{{"v4", 1}, {"v3", 1.2}, {"scalar", 2.5}}};
  for (auto const& [name, factor] : factors)
    if (backend == name || (backend == "auto" && exec_host::processor_can_run(name))) return factor;
  return factors.back().second;
}

/// Whether jst_sph filters the volumetric energy, as far as given by the case.
bool is_filtered(BodySpec const& body) {
  FormulationSpec const& spec = body.formulation;
  auto const word = [&](std::string_view key, std::string_view standard) {
    auto const found = spec.words.find(key);
    return found == spec.words.end() ? standard : std::string_view(found->second);
  };
  if (spec.name != "jst_sph") return false;
  if (word("volumetric_filter", "as_scheme") != "as_scheme") return word("volumetric_filter", "") == "on";
  auto const law = find_law(body.law);
  std::string_view const scheme = word("scheme", "conservative");
  return (scheme == "conservative" || scheme == "filtered") && word("variables", "pF") != "displacement" && law &&
         law->volumetric_split && poissons_ratio_of(body.material) > 0.4499;
}

/// Whether the neighbours of a body follow from its lattice.
bool is_regular(CaseSpec const& spec, BodySpec const& body) {
  bool const mirrored = std::any_of(spec.mirrors.begin(), spec.mirrors.end(),
                                    [&](MirrorSpec const& mirror) { return mirror.body == body.name; });
  std::string_view const name = body.formulation.name;
  auto const says = [&](char const* key, std::string_view word) {
    auto const found = body.formulation.words.find(key);
    return found != body.formulation.words.end() && found->second == word;
  };
  if (name == "adaptle") return !says("description", "eulerian");
  if (name == "taylor_sph")
    return says("virtual_particles", "lattice_cells") ||
           (body.shape.kind == ShapeSpec::Kind::box && says("exchange", "kernel_sums") &&
            !says("virtual_particles", "delaunay") && !says("configuration", "fixed"));
  return !mirrored && body.shape.jitter == 0 && !body.shape.random &&
         body.shape.arrangement == ShapeSpec::Arrangement::lattice;
}

/// Replicated bytes per particle of a body. For adaptle with kernel contact or Eulerian particles including the
/// occupied cells.
double bytes_everywhere(CaseSpec const& spec, BodySpec const& body, ThroughputModel const& pace) {
  if (body.formulation.name != "adaptle") return pace.everywhere;
  constexpr double cells = 40;
  auto const is_eulerian = [](BodySpec const& some) {
    auto const found = some.formulation.words.find("description");
    return found != some.formulation.words.end() && (found->second == "eulerian" || found->second == "patch");
  };
  auto const is_like = [&](BodySpec const& some) { return some.formulation.name == body.formulation.name; };
  using Law = ContactRule::Law;
  bool const apart = spec.contact && (spec.contact->law == Law::none || spec.contact->law == Law::surface);
  bool const touching = !apart && std::count_if(spec.bodies.begin(), spec.bodies.end(), is_like) > 1;
  bool const sorted = touching || std::any_of(spec.bodies.begin(), spec.bodies.end(), is_eulerian);
  return pace.everywhere + (sorted ? cells : 0);
}

/// Whether set-up is distributed; nodal sets some bodies up on every rank (nodal::SetUp::is_shared).
bool is_set_up_by_share(CaseSpec const& spec, BodySpec const& body) {
  auto const continues = [&](MirrorSpec const& mirror) { return mirror.body == body.name; };
  auto const holds = [&](SupportSpec const& support) {
    return support.body == body.name && support.patch && support.hold != SupportSpec::Hold::particles;
  };
  return body.formulation.name != "nodal" || (std::none_of(spec.mirrors.begin(), spec.mirrors.end(), continues) &&
                                              std::none_of(spec.supports.begin(), spec.supports.end(), holds));
}

/// Number of outputs of each kind.
struct Plan {
  double rows, frames, pictures, checkpoints;
};

Plan plan_of(CaseSpec const& spec) {
  OutputSpec const& o = spec.output;
  auto const times = [&](double every) { return every > 0 ? std::floor(spec.run.end / every) + 1 : 0; };
  double const frames = times(o.frames_every), pictures = times(o.pictures.every);
  // Every picture has a frame, which may also be one of the others.
  double const ratio = frames > pictures ? o.pictures.every / o.frames_every : o.frames_every / o.pictures.every;
  bool const coincide = frames == 0 || pictures == 0 || std::abs(ratio - std::round(ratio)) < 1e-9 * ratio;
  return {o.history_every > 0 ? times(o.history_every) : 501,
          coincide ? std::max(frames, pictures) : frames + pictures - 1, pictures,
          std::max(1.0, times(o.checkpoints_every))};
}

/// Bytes of a frame per particle: positions, cells, numbers and fields.
double frame_bytes(OutputSpec const& output, std::vector<FieldInfo> const& fields) {
  double numbers = 4;  // position and volume
  auto const chosen = fields_of_frames(output);
  for (FieldInfo const& field : fields) {
    if (chosen.empty() || std::find(chosen.begin(), chosen.end(), field.name) != chosen.end())
      numbers += field.components;
  }
  constexpr double cells = 17, ids = 16;
  double const share = output.compress ? compressed : 1, share_of_whole = output.compress ? 0.05 : 1;
  return 4 * numbers * share + (cells + ids) * share_of_whole;
}

double picture_pixels(OutputSpec const& output) {
  constexpr double usual = 800e3;  // for a size that follows the content
  double const given = static_cast<double>(output.pictures.width) * output.pictures.height;
  return given > 0 ? given : usual * output.pictures.scale * output.pictures.scale;
}

double disk_of(CaseSpec const& spec, Formulation const& formulation, double particles, double state) {
  Plan const plan = plan_of(spec);
  double columns = 24 + static_cast<double>(formulation.diagnose().more.size());
  for (ProbeSpec const& probe : spec.probes) columns += static_cast<double>(probe.quantities.size());
  return plan.frames * (frame_file_bytes + particles * frame_bytes(spec.output, formulation.fields())) +
         plan.pictures * picture_bytes * picture_pixels(spec.output) +
         kept_checkpoints * (checkpoint_file_bytes + 8 * state * particles) + plan.rows * columns * cell_bytes;
}

bool observes_locally(BodySpec const& body) {
  auto const info = find_formulation(body.formulation.name);
  return info && info->observes_locally;
}

/// Numbers per particle gathered on rank 0 for a row: displacements for probes that need all particles, and velocities
/// of fragments. Additive probes only reduce a few sums.
double probed_numbers(CaseSpec const& spec) {
  auto const asked = [&](auto const& is) { return std::any_of(spec.probes.begin(), spec.probes.end(), is); };
  bool const positions = asked([](ProbeSpec const& probe) { return !is_reducible(probe.kind); });
  bool const velocities = asked([](ProbeSpec const& probe) { return probe.kind == ProbeSpec::Kind::fragment; });
  return (positions ? 3 : 0) + (velocities ? 3 : 0);
}

/// Wall time of `steps` steps with all output [s].
double run_seconds_of(CaseSpec const& spec, double particles, std::int64_t steps, Estimate const& e) {
  Plan const plan = plan_of(spec);
  double const rows = std::min(plan.rows, static_cast<double>(steps) + 1);
  return (static_cast<double>(steps) * e.step_work + rows * e.row_work) / e.busy_threads +
         plan.frames * frame_seconds * particles + plan.pictures * picture_seconds +
         plan.checkpoints * checkpoint_seconds * particles;
}

/// Values that depend on the number of steps. `change`: relative change of the length of the last trial steps.
void count_steps(CaseSpec const& spec, double particles, double change, Estimate& e) {
  StepExcess const excess = e.trial_ends_run ? StepExcess{} : step_excess(spec, change);
  double const as_tried = static_cast<double>(std::max(e.steps, e.most_steps));
  e.most_steps = static_cast<std::int64_t>(std::min(excess.factor * as_tried, 1e18));
  e.varies = excess.why;
  if (spec.run.relax) e.varies = "the run ends as soon as the bodies are at rest: these are the steps to run.end";
  e.rows_per_step = std::min(plan_of(spec).rows / static_cast<double>(e.steps), 1.0);
  e.run_seconds = run_seconds_of(spec, particles, e.steps, e);
  e.most_run_seconds = run_seconds_of(spec, particles, e.most_steps, e);
}

/// `side`: CPU time of one right-hand side, `tables`: before the first one [s].
void count_times(CaseSpec const& spec, ParticleSet const& particles, double stages, double side, double tables,
                 Estimate& e) {
  double const all = static_cast<double>(particles.size());
  // Loops of few particles are shared by few threads.
  constexpr double least_share = 2048;
  e.busy_threads = std::min<double>(e.threads, std::floor(all / least_share) + 1);
  e.step = std::min(e.rule.settled, spec.run.max_step);
  e.stages = stages + e.rule.more_stages;
  e.step_work = e.stages * side;
  e.row_work = row_stages * side;
  e.setup_seconds = tables + e.rule.setup_stages * side / e.busy_threads;
  count_steps(spec, all, 0, e);
}

/// Set-up memory of a rank: of a whole body, and its replicated part [bytes].
struct MemoryInSetUp {
  double all, everywhere;
};

/// `in_steps`: of the body's arrays; `for_a_while`: temporary memory if it is not distributed [bytes].
MemoryInSetUp memory_in_set_up(CaseSpec const& spec, std::size_t b, ThroughputModel const& pace, double n,
                               double in_steps, double for_a_while) {
  BodySpec const& body = spec.bodies[b];
  double const usual = in_steps + for_a_while;
  if (!observes_locally(body) || !is_set_up_by_share(spec, body)) return {usual, usual};
  if (!pace.in_set_up || body.shape.dimension < 3) return {usual, n * bytes_everywhere(spec, body, pace)};
  double const besides = is_regular(spec, body) ? pace.in_set_up->lattice : pace.in_set_up->off_lattice;
  return {in_steps + n * besides, n * pace.in_set_up->everywhere};
}

/// Computes the values that depend on rule, memory and disk.
void count_work(CaseSpec const& spec, ParticleSet const& particles, double stages, double probed, Estimate& e) {
  auto const D = static_cast<std::size_t>(particles.dimension - 1);
  double const slow = slowness(spec.run.backend), all = static_cast<double>(particles.size());
  double side = 0, tables = 0;  // processor time of one right-hand side, of the tables [s]
  double const of_formulation = e.memory;
  e.memory_in_steps = e.memory + program_bytes;
  e.memory_everywhere = e.everywhere_in_set_up = program_bytes + messages_bytes;
  e.memory_in_set_up = program_bytes;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    ThroughputModel const pace = pace_of(spec.bodies[b].formulation.name);
    auto const n = static_cast<double>(particles.bodies[b].last - particles.bodies[b].first);
    bool const regular = is_regular(spec, spec.bodies[b]);
    double const here =
        n * slow * (regular ? pace.lattice : pace.off_lattice)[D] * (is_filtered(spec.bodies[b]) ? filter_factor : 1);
    side += here;
    tables += n * pace.setup[D];
    double const for_a_while = n * (pace.overhead[D] + (regular ? 0 : pace.more_scattered[D]));
    e.memory += for_a_while;
    auto const set_up = memory_in_set_up(spec, b, pace, n, of_formulation * n / all, for_a_while);
    e.memory_in_set_up += set_up.all;
    e.everywhere_in_set_up += set_up.everywhere;
    if (observes_locally(spec.bodies[b])) {
      e.row_bytes += 8 * n * probed;
      e.memory_everywhere += n * bytes_everywhere(spec, spec.bodies[b], pace);
      e.memory_of_first = std::max(e.memory_of_first, output_bytes) + n * pace.of_first;
    } else {
      e.row_work_of_first += row_stages * here;  // all ranks have all of it
      e.memory_everywhere += of_formulation * n / all + for_a_while;
    }
  }
  count_times(spec, particles, stages, side, tables, e);
  e.memory += program_bytes;
}

}  // namespace

std::int64_t steps_of(StepEstimate const& rule, RunSpec const& run) { return steps_of(rule, run, 0, rule.first); }

std::int64_t steps_of(StepEstimate const& rule, RunSpec const& run, double time, double last) {
  double const most = std::min(rule.settled, run.max_step);
  double step = std::min(last, most), steps = 0;
  while (rule.growth > 1 && step < most && time + step < run.end) {
    time += step;
    double const growth = rule.late_growth > 1 && step > rule.late_from ? rule.late_growth : rule.growth;
    step = std::min(growth * step, most);
    ++steps;
  }
  // As the main loop: a rest of less than a millionth of a step is taken along.
  steps += std::max(1.0, std::ceil((run.end - time) / step * (1 - 1e-6)));
  return static_cast<std::int64_t>(std::min(steps, 1e18));
}

Estimate estimate(CaseSpec const& spec, ParticleSet const& particles, Formulation const& formulation, int threads) {
  Estimate e;
  e.rule = formulation.step_estimate_of_run();
  e.steps = steps_of(e.rule, spec.run);
  e.threads = threads;
  auto const n = static_cast<double>(particles.size());
  StateSize saved;
  formulation.save(saved);
  e.memory = static_cast<double>(formulation.memory_bytes());
  e.disk = disk_of(spec, formulation, n, n > 0 ? static_cast<double>(saved.numbers()) / n : 0);
  count_work(spec, particles, formulation.stages_per_step(), probed_numbers(spec), e);
  for (std::size_t b = 0; b < particles.bodies.size(); ++b) {
    e.talk.push_back(formulation.comm_pattern(b));
    if (!e.talk[b]) continue;
    if (e.talk[b]->stages == 0) e.talk[b]->stages = e.stages;
    e.talk[b]->account_for_shorter_steps(e.rule.settled, e.step);
  }
  return e;
}

namespace {

/// Steps of a trial: enough for the first measurement of nodal, else as many as the time allows by counted work.
std::int64_t steps_to_try(Estimate const& e) {
  constexpr double seconds = 2, fewest = 60, most = 400;
  return static_cast<std::int64_t>(std::clamp(seconds * e.busy_threads / e.step_work, fewest, most));
}

/// Corrects the steps by those of a trial. `now`: the rule after it.
void correct(Estimate& e, CaseSpec const& spec, Trial const& trial, StepEstimate now) {
  e.trial_steps = e.steps = trial.steps;
  e.step = trial.step;
  e.trial_ends_run = trial.over || trial.failure;
  if (e.trial_ends_run) return;
  constexpr double nearly = 0.98;
  bool const growing = now.growth > 1 && trial.step < nearly * std::min(now.settled, spec.run.max_step);
  if (!growing) {
    now.settled = trial.step;
    now.growth = 1;
  }
  e.step = std::min(now.settled, spec.run.max_step);
  e.steps += steps_of(now, spec.run, trial.time, trial.step);
  e.most_steps = e.steps;
  // Steps that are short because a load has just come, or an impact, grow to those of the rule at best.
  if ((trial.earlier < nearly * trial.step || any_contact(spec)) && e.rule.settled > trial.step) {
    now.settled = e.rule.settled;
    e.steps = trial.steps + steps_of(now, spec.run, trial.time, now.settled);
  }
}

}  // namespace

Estimate estimate_by_trial(Simulation& s, Trial& trial) {
  constexpr double shutdown_timeout = 10;  // s, on slow or busy machines
  Estimate e = estimate(s.spec, s.particles, *s.formulation, s.threads);
  trial = take_trial_steps(*s.formulation, s.spec.run, steps_to_try(e), shutdown_timeout);
  correct(e, s.spec, trial, s.formulation->step_estimate_of_run());
  double const change = e.step > trial.step ? 0 : trial.earlier / trial.step - 1;  // 0: as the rule foresees
  count_steps(s.spec, static_cast<double>(s.particles.size()), change, e);
  return e;
}

Estimate estimate_from_parts(CaseSpec const& spec, ParticleSet const& particles, int threads) {
  constexpr std::array part_size{4000, 100, 24};
  Estimate e;
  e.threads = threads;
  double stages = 1;
  std::vector<double> own_steps;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    Assembly const a = part_of_case(spec, b, part_size[static_cast<std::size_t>(particles.dimension - 1)]);
    auto const formulation = make_formulation(a);
    StepEstimate const rule = formulation->step_estimate_of_run();
    own_steps.push_back(rule.settled);
    if (b == 0 || rule.settled < e.rule.settled) e.rule = rule;
    stages = formulation->stages_per_step();
    StateSize saved;
    formulation->save(saved);
    auto const all = static_cast<double>(particles.bodies[b].last - particles.bodies[b].first);
    auto const some = static_cast<double>(a.particles.size());
    e.memory += static_cast<double>(formulation->memory_bytes()) * all / some;
    e.disk += disk_of(spec, *formulation, all, static_cast<double>(saved.numbers()) / some);
    e.talk.push_back(formulation->comm_pattern(0));
    if (e.talk.back()) e.talk.back()->replicated_values *= all / some;
    if (e.talk.back()) e.talk.back()->stages = stages + rule.more_stages;
  }
  e.steps = steps_of(e.rule, spec.run);
  count_work(spec, particles, stages, probed_numbers(spec), e);
  for (std::size_t b = 0; b < e.talk.size(); ++b)
    if (e.talk[b]) e.talk[b]->account_for_shorter_steps(own_steps[b], e.step);
  return e;
}

}  // namespace piola
