// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/estimate.hpp"
#include "piola/base/contracts.hpp"
#include "piola/estimates/reduced_case.hpp"
#include "piola/estimates/step_range.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/input/contact_capabilities.hpp"
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace piola {
namespace {

constexpr double program_bytes = 31e6;  ///< the program with its libraries and buffers of files
/// Memory of rank 0 in addition, for MPI and collective output: 512 particles take 41 MB on the first of three ranks,
/// and 32 MB alone (bench/ranks_memory.py).
constexpr double rank_bytes = 10e6;
constexpr double frame_seconds = 2.4e-6, checkpoint_seconds = 1e-6;  ///< per particle
constexpr double picture_seconds = 0.2;
constexpr double compressed = 0.42;     ///< remaining fraction of the numbers of a frame
constexpr double picture_bytes = 0.6;   ///< per pixel
constexpr double cell_bytes = 12;       ///< of a history.csv
constexpr double kept_checkpoints = 2;  ///< at a time
constexpr double frame_file_bytes = 48e3, checkpoint_file_bytes = 11e3;  ///< of a file without particles

/// Number of outputs of each kind.
struct Plan {
  double rows, frames, pictures, checkpoints;
};

Plan plan_of(CaseSpec const& spec) {
  OutputSpec const& o = spec.output;
  auto const times = [&](double every) { return every > 0 ? std::floor(spec.run.end / every) + 1 : 0; };
  double const frames = times(o.frames_every), pictures = times(o.pictures.every);
  // Every picture needs a frame, which may coincide with one of the regular frames.
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

/// `built`: particles of the formulation, which may be a part of `particles`.
double disk_of(CaseSpec const& spec, Formulation const& formulation, double particles, double built) {
  Plan const plan = plan_of(spec);
  StateSize saved;
  formulation.save(saved);
  double const state = static_cast<double>(saved.numbers()) / built;
  double columns = 24 + static_cast<double>(formulation.diagnose().more.size());
  for (ProbeSpec const& probe : spec.probes) columns += static_cast<double>(probe.quantities.size());
  return plan.frames * (frame_file_bytes + particles * frame_bytes(spec.output, formulation.observables().fields())) +
         plan.pictures * picture_bytes * picture_pixels(spec.output) +
         kept_checkpoints * (checkpoint_file_bytes + 8 * state * particles) + plan.rows * columns * cell_bytes;
}

double seconds_of_row(Formulation const& formulation) {
  auto const start = CostMeter::Clock::now();
  (void)formulation.diagnose();
  return std::chrono::duration<double>(CostMeter::Clock::now() - start).count();
}

/// Wall time of `steps` steps with all output [s].
double run_seconds_of(CaseSpec const& spec, double particles, std::int64_t steps, Estimate const& e) {
  Plan const plan = plan_of(spec);
  double const rows = std::min(plan.rows, static_cast<double>(steps) + 1);
  return static_cast<double>(steps) * e.step_seconds + rows * e.row_seconds + plan.frames * frame_seconds * particles +
         plan.pictures * picture_seconds + plan.checkpoints * checkpoint_seconds * particles;
}

/// Values that depend on the number of steps. `change`: relative change of the length of the last trial steps.
void count_steps(CaseSpec const& spec, double particles, double change, Estimate& e) {
  StepExcess const excess = e.trial_ends_run ? StepExcess{} : step_excess(spec, change);
  double const as_tried = static_cast<double>(std::max(e.steps, e.most_steps));
  e.most_steps = static_cast<std::int64_t>(std::min(excess.factor * as_tried, 1e18));
  e.varies = excess.why;
  if (spec.run.relax) e.varies = "the run ends as soon as the bodies are at rest: these are the steps to run.end";
  e.run_seconds = run_seconds_of(spec, particles, e.steps, e);
  e.most_run_seconds = run_seconds_of(spec, particles, e.most_steps, e);
}

/// Number of steps of a run of this length from `time` [s] on, after a step `last` [s].
std::int64_t steps_of(StepEstimate const& rule, RunSpec const& run, double time, double last) {
  double const most = std::min(rule.settled, run.max_step);
  double step = std::min(last, most), steps = 0;
  while (rule.growth > 1 && step < most && time + step < run.end) {
    time += step;
    step = std::min(rule.growth * step, most);
    ++steps;
  }
  // As the time loop: a rest of less than a millionth of a step is taken along.
  steps += std::max(1.0, std::ceil((run.end - time) / step * (1 - 1e-6)));
  return static_cast<std::int64_t>(std::min(steps, 1e18));
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

/// Memory that set-up and steps of a formulation have taken [bytes].
double bytes_of(Formulation const& formulation, CostMeter const& meter) {
  return std::max(meter.bytes(), static_cast<double>(formulation.statistics().memory_bytes));
}

double particles_of(Body const& body) { return static_cast<double>(body.last - body.first); }

/// Cost of a body, scaled from that of a part of it.
struct ScaledCost {
  StepEstimate rule;
  double setup_seconds = 0, step_seconds = 0, row_seconds = 0, bytes = 0, disk = 0;
};

/// `particles`: number along each direction of the part. Loops of few particles occupy few of the `threads`.
ScaledCost scaled_cost(CaseSpec const& spec, ParticleSet const& set, std::size_t body, int particles, int threads) {
  double const bodies = static_cast<double>(set.bodies.size());
  TrialLimits const limits{.fewest = 10, .most = 100, .seconds = 1 / bodies, .longest = 5 / bodies};
  auto const busy = [&](double n) {
    constexpr double fewest = 2048;  // particles of a thread
    return std::min<double>(threads, std::floor(n / fewest) + 1);
  };
  Assembly const part = part_of_case(spec, body, particles);
  CostMeter const meter;
  auto const formulation = make_formulation(part);
  ScaledCost cost{.rule = formulation->step_estimate(), .setup_seconds = meter.seconds()};
  auto const some = static_cast<double>(part.particles.size());
  double const here = particles_of(set.bodies[body]), scale = here / some;
  cost.disk = disk_of(spec, *formulation, here, some);
  Trial const trial = take_trial_steps(*formulation, spec.run, limits);
  double const scale_of_time = scale * busy(some) / busy(static_cast<double>(set.size()));
  cost.setup_seconds *= scale;
  cost.step_seconds = scale_of_time * trial.step_seconds;
  cost.row_seconds = scale_of_time * seconds_of_row(*formulation);
  cost.bytes = scale * bytes_of(*formulation, meter);
  return cost;
}

/// Particles of a body that a rank stores: its part, and two layers of ghosts around a cube of this size, without the
/// layers outside a cubic body.
double stored_by_rank(double particles, int dimension, int ranks) {
  constexpr double layers = 2;
  double const own = particles / ranks, edges = 1.0 / dimension;
  double const around = std::pow(std::pow(own, edges) + 2 * layers, dimension) - own;
  return std::min(own + (1 - std::pow(ranks, -edges)) * around, particles);
}

}  // namespace

std::int64_t steps_of(StepEstimate const& rule, RunSpec const& run) { return steps_of(rule, run, 0, rule.first); }

std::pair<Estimate, Trial> estimate(Simulation& s, CostMeter const& meter) {
  PIOLA_EXPECTS(s.formulation != nullptr && s.particles.size() > 0);
  auto const n = static_cast<double>(s.particles.size());
  Estimate e;
  e.threads = s.threads;
  e.setup_seconds = meter.seconds();
  e.rule = s.formulation->step_estimate();
  e.disk = disk_of(s.spec, *s.formulation, n, n);
  Trial const trial = take_trial_steps(*s.formulation, s.spec.run, {});
  correct(e, s.spec, trial, s.formulation->step_estimate());
  e.step_seconds = trial.step_seconds;
  double const bytes = bytes_of(*s.formulation, meter);
  e.memory = program_bytes + static_cast<double>(s.particles.bytes()) + bytes;
  for (std::size_t b = 0; b < s.spec.bodies.size(); ++b)
    e.distributed.push_back(bytes * particles_of(s.particles.bodies[b]) / n);
  e.row_seconds = seconds_of_row(*s.formulation);
  double const change = e.step > trial.step ? 0 : trial.earlier / trial.step - 1;  // 0: as the rule foresees
  count_steps(s.spec, n, change, e);
  return {e, trial};
}

Estimate estimate_from_parts(CaseSpec const& spec, ParticleSet const& particles, int threads) {
  PIOLA_EXPECTS(threads >= 1);
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  constexpr std::array part_size{4000, 100, 24};
  Estimate e;
  e.threads = threads;
  std::size_t const initial_velocities = particles.X.size() * sizeof(particles.X[0]);  // parts have none
  e.memory = program_bytes + static_cast<double>(particles.bytes() + initial_velocities);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    int const size = part_size[static_cast<std::size_t>(particles.dimension - 1)];
    // The first steps of a formulation load its code, whose memory and time must not be scaled.
    (void)scaled_cost(spec, particles, b, size / 3, threads);
    ScaledCost const cost = scaled_cost(spec, particles, b, size, threads);
    if (b == 0 || cost.rule.settled < e.rule.settled) e.rule = cost.rule;
    e.setup_seconds += cost.setup_seconds;
    e.step_seconds += cost.step_seconds;
    e.row_seconds += cost.row_seconds;
    e.memory += cost.bytes;
    e.distributed.push_back(cost.bytes);
    e.disk += cost.disk;
  }
  e.step = std::min(e.rule.settled, spec.run.max_step);
  e.steps = steps_of(e.rule, spec.run);
  count_steps(spec, static_cast<double>(particles.size()), 0, e);
  return e;
}

double memory_of_rank(Estimate const& cost, ParticleSet const& particles, int ranks) {
  PIOLA_EXPECTS(ranks >= 1);
  PIOLA_EXPECTS(ranks == 1 || cost.distributed.size() == particles.bodies.size());
  if (ranks == 1) return cost.memory;
  double memory = cost.memory + rank_bytes;
  for (std::size_t b = 0; b < particles.bodies.size(); ++b) {
    double const n = particles_of(particles.bodies[b]);
    memory -= cost.distributed[b] * (1 - stored_by_rank(n, particles.dimension, ranks) / n);
  }
  return memory;
}

}  // namespace piola
