// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/driver_and_workers.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/measures/probe_set.hpp"
#include "piola/output/collective_table_writer.hpp"
#include "piola/output/frames.hpp"
#include "piola/simulation/distributed_state.hpp"
#include "piola/simulation/state_hash.hpp"
#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <thread>

namespace piola {
namespace {

/// A command of rank 0 to the other ranks.
struct Command {
  enum class What : std::int64_t {
    step,
    damp,
    descend,
    kinetic_energy,
    diagnose,
    step_bound,
    sample,
    probes,
    frame,
    save,
    load,
    traffic,
    end
  } what;
  double first = 0, second = 0;  // time and dt, factor, time
  std::int64_t code = 0;
  char field[64]{};  // of sample
};

/// How far the ranks of this run are.
enum class Phase { reading, building, running, over };
Phase phase = Phase::reading;

Command send(Command order) {
  comm::broadcast_command(&order, sizeof order);
  return order;
}

/// How long a rank with an error waits for the others, which may be waiting for it [s].
constexpr double shutdown_timeout = 5;

/// Traffic of this rank so far.
struct TrafficSnapshot {
  comm::Traffic traffic = comm::traffic();
  comm::CommStatistics spent = comm::comm_statistics();
};

/// Traffic accounting: number of steps, and the traffic to subtract from the totals (before the first step and for
/// observers).
struct Count {
  std::int64_t steps = 0;
  comm::Traffic before;
  comm::CommStatistics spent_before;
};
Count counted;

/// RAII guard: traffic during its lifetime is not counted as traffic of steps.
class ExcludeFromStepTraffic {
 public:
  ExcludeFromStepTraffic() = default;
  ExcludeFromStepTraffic(ExcludeFromStepTraffic const&) = delete;
  ExcludeFromStepTraffic& operator=(ExcludeFromStepTraffic const&) = delete;
  ~ExcludeFromStepTraffic() {
    if (!ends_) return;
    TrafficSnapshot const now;
    auto const put_off = [](auto& before, auto const& from, auto const& to, auto... members) {
      ((before.*members += to.*members - from.*members), ...);
    };
    using comm::CommStatistics, comm::Traffic;
    put_off(counted.before, start_.traffic, now.traffic, &Traffic::messages, &Traffic::bytes);
    put_off(counted.spent_before, start_.spent, now.spent, &CommStatistics::collectives, &CommStatistics::in_exchanges,
            &CommStatistics::in_collectives, &CommStatistics::waiting_for_commands, &CommStatistics::replicated_bytes);
  }
  void forget() { ends_ = false; }

 private:
  TrafficSnapshot start_;
  bool ends_ = true;
};

void count_step() {
  if (counted.steps++ > 0) return;
  counted.before = comm::traffic();
  counted.spent_before = comm::comm_statistics();
}

constexpr std::size_t numbers_of_traffic = 7;

std::vector<double> gather_traffic() {
  comm::Traffic const said = comm::traffic(), &before = counted.before;
  comm::CommStatistics const spent = comm::comm_statistics(), &spent_before = counted.spent_before;
  double const steps = static_cast<double>(std::max<std::int64_t>(1, counted.steps));
  std::array const mine{static_cast<double>(said.messages - before.messages) / steps,
                        static_cast<double>(said.bytes - before.bytes) / steps,
                        static_cast<double>(spent.collectives - spent_before.collectives) / steps,
                        (spent.in_exchanges - spent_before.in_exchanges) / steps,
                        (spent.in_collectives - spent_before.in_collectives) / steps,
                        (spent.waiting_for_commands - spent_before.waiting_for_commands) / steps,
                        static_cast<double>(spent.replicated_bytes - spent_before.replicated_bytes) / steps};
  static_assert(mine.size() == numbers_of_traffic);
  return comm::gather(mine);
}

/// Time of this rank for redistributing values to the writing ranks [s].
double gathered = 0;

/// Adds its lifetime to `gathered`.
class GatherTimer {
 public:
  GatherTimer() = default;
  GatherTimer(GatherTimer const&) = delete;
  GatherTimer& operator=(GatherTimer const&) = delete;
  ~GatherTimer() { gathered += comm::comm_statistics().in_exchanges - start_; }

 private:
  double start_ = comm::comm_statistics().in_exchanges;
};

/// The formulation on rank 0, whose collective calls are executed on all ranks.
class DriverProxy final : public Formulation, public Observables {
 public:
  explicit DriverProxy(std::unique_ptr<Formulation> formulation) : own_(std::move(formulation)) {}

  double stable_time_step() const override { return own().stable_time_step(); }
  StepEstimate step_estimate() const override { return own().step_estimate(); }
  void step(double time, double dt) override {
    send({Command::What::step, time, dt});
    count_step();
    own().step(time, dt);
  }
  void damp(double factor) override {
    send({Command::What::damp, factor});
    own().damp(factor);
  }
  Descent descend(double time, double dt) override {
    send({Command::What::descend, time, dt});
    count_step();
    return own().descend(time, dt);
  }
  double kinetic_energy() const override {
    ExcludeFromStepTraffic const aside;
    send({Command::What::kinetic_energy});
    return own().kinetic_energy();
  }
  std::optional<Failure> failure() const override { return own().failure(); }
  StepBound step_bound() const override {
    ExcludeFromStepTraffic const aside;
    send({Command::What::step_bound});
    return own().observables().step_bound();
  }
  Diagnostics diagnose() const override {
    ExcludeFromStepTraffic const aside;
    send({Command::What::diagnose});
    return own().diagnose();
  }
  Observables const& observables() const override { return *this; }
  std::vector<FieldInfo> fields() const override { return own().observables().fields(); }
  std::vector<FieldInfo> fields_of(std::size_t body) const override { return own().observables().fields_of(body); }
  std::vector<RigidState> rigids() const override { return own().observables().rigids(); }
  void sample(std::string_view field, std::span<double> values) const override {
    GatherTimer const gathering;
    ExcludeFromStepTraffic const aside;
    Command order{Command::What::sample};
    if (field.size() >= sizeof order.field) throw std::invalid_argument(fmt::format("no field is called '{}'", field));
    field.copy(order.field, field.size());
    send(order);
    own().observables().sample(field, values);
  }
  // Local on rank 0: evaluate_probes_collectively() has sent the commands to the other ranks.
  std::optional<std::vector<std::int64_t>> local_particles() const override {
    return own().observables().local_particles();
  }
  void sample_local(std::string_view field, std::span<double> values) const override {
    own().observables().sample_local(field, values);
  }
  void save(StateWriter& writer) const override {
    GatherTimer const gathering;
    ExcludeFromStepTraffic const aside;
    send({.what = Command::What::save, .code = static_cast<std::int64_t>(writer.rows())});
    DeferredErrorWriter lasting(writer);
    own().save(lasting);
    if (writer.rows() != StateWriter::Rows::to_root) lasting.end_rows();
    lasting.raise();
  }
  void load(StateReader& reader) override {
    ExcludeFromStepTraffic const aside;
    send({Command::What::load});
    BroadcastReader shared(&reader);
    own().load(shared);
  }
  RunStatistics statistics() const override {
    RunStatistics all = own().statistics();
    all.seconds.emplace_back("gather", gathered);
    return all;
  }
  CoupledParticles* coupled_particles() override { return nullptr; }

 private:
  Formulation& own() const { return *own_; }

  std::unique_ptr<Formulation> own_;
};

bool is_for_observers(Command const& order) {
  using enum Command::What;
  return order.what == kinetic_energy || order.what == diagnose || order.what == step_bound || order.what == sample ||
         order.what == probes || order.what == frame || order.what == save || order.what == load;
}

/// Counterpart on this rank of saving with a writer of rank 0.
void save_with_first(Formulation const& formulation, StateWriter::Rows rows) {
  NullStateWriter ignored;
  StateSize size;
  LocalRowsWriter part;
  StateHash hash;
  StateWriter* const writers[]{&ignored, &part, &size, &hash};
  StateWriter& writer = *writers[static_cast<std::size_t>(rows)];
  formulation.save(writer);
  writer.end_rows();
}

void execute_command(Formulation& formulation, Command const& order) {
  switch (order.what) {
    case Command::What::step: count_step(); return formulation.step(order.first, order.second);
    case Command::What::traffic: return void(gather_traffic());
    case Command::What::damp: return formulation.damp(order.first);
    case Command::What::descend: count_step(); return void(formulation.descend(order.first, order.second));
    case Command::What::kinetic_energy: return void(formulation.kinetic_energy());
    case Command::What::diagnose: return void(formulation.diagnose());
    case Command::What::step_bound: return void(formulation.observables().step_bound());
    case Command::What::sample: return formulation.observables().sample(order.field, {});
    case Command::What::save: return save_with_first(formulation, static_cast<StateWriter::Rows>(order.code));
    case Command::What::load: {
      BroadcastReader shared(nullptr);
      try {
        formulation.load(shared);
      } catch (MissingOnRoot const&) {
        return;  // rank 0 reports the error and sends the next command
      }
      return;
    }
    default: return;
  }
}

}  // namespace

void require_identical_case(Assembly const& assembly) {
  if (!comm::is_parallel()) return;
  std::uint64_t print = 14'695'981'039'346'656'037ULL;  // Fowler, Noll and Vo's, word by word
  auto const add = [&](double value) { print = (print ^ std::bit_cast<std::uint64_t>(value)) * 1'099'511'628'211ULL; };
  auto const add_points = [&](auto const& points) {
    for (auto const& point : points)
      for (double const value : point) add(value);
  };
  add_points(assembly.particles.X);
  add_points(assembly.initial_velocity);
  for (double const volume : assembly.particles.volume) add(volume);
  for (MaterialParameters const& material : assembly.materials)
    for (double const value : material.value) add(value);
  if (comm::all_equal(print)) return;
  throw comm::CollectiveError(
      {2,
       "the ranks have read different cases (the same particles, motions and materials are needed on all) - give "
       "all of them the same words, and files that every machine sees under the same path"});
}

void agree_to_continue() {
  comm::RankError const trouble = comm::agree({});
  if (trouble.code != 0) throw comm::CollectiveError(trouble);
  phase = phase == Phase::reading ? Phase::building : Phase::running;
}

std::unique_ptr<Formulation> driven_by_root(std::unique_ptr<Formulation> formulation) {
  PIOLA_EXPECTS(formulation != nullptr);
  if (!comm::is_parallel() || comm::rank() != 0) return formulation;
  return std::make_unique<DriverProxy>(std::move(formulation));
}

void evaluate_probes_collectively(double time, std::function<void()> const& look) {
  PIOLA_EXPECTS(std::isfinite(time) && look != nullptr);
  ExcludeFromStepTraffic const aside;
  if (comm::is_parallel() && comm::rank() == 0) send({Command::What::probes, time});
  look();
}

void write_frame_collectively(bool failed, std::function<void()> const& write) {
  PIOLA_EXPECTS(write != nullptr);
  GatherTimer const gathering;
  ExcludeFromStepTraffic const aside;
  if (comm::is_parallel() && comm::rank() == 0) send({.what = Command::What::frame, .code = failed ? 1 : 0});
  write();
}

int run_worker(Simulation& simulation) {
  PIOLA_EXPECTS(simulation.formulation != nullptr);
  Formulation& formulation = *simulation.formulation;
  std::optional<ProbeSet> probes;  // made when rank 0 has made them without complaint
  for (;;) {
    ExcludeFromStepTraffic aside;
    Command const order = send({Command::What::end});  // overwritten by the broadcast of rank 0
    if (!is_for_observers(order)) aside.forget();
    if (order.what == Command::What::end) {
      comm::agree({});
      phase = Phase::over;
      return static_cast<int>(order.code);
    }
    if (order.what == Command::What::probes) {
      if (!probes) probes.emplace(simulation.spec, simulation.particles);
      probes->evaluate_local(formulation, order.first);
    } else if (order.what == Command::What::frame) {
      FieldCache cache(formulation, simulation.particles, FieldCache::Of::local);
      CollectiveTableWriter part(nullptr);
      OutputSpec const& output = simulation.spec.output;
      FrameContent(fields_of_frames(output, order.code != 0), output.compress, cache).put(part);
    } else {
      execute_command(formulation, order);
    }
  }
}

std::vector<RankTraffic> traffic_on_ranks() {
  if (!comm::is_parallel() || phase != Phase::running || comm::rank() != 0) return {};
  send({Command::What::traffic});
  std::vector<double> const all = gather_traffic();
  std::vector<RankTraffic> each;
  for (std::size_t k = 0; k + numbers_of_traffic <= all.size(); k += numbers_of_traffic)
    each.push_back({all[k], all[k + 1], all[k + 2], all[k + 3], all[k + 4], all[k + 5], all[k + 6]});
  return each;
}

std::optional<comm::RankError> shut_down(comm::RankError const& own) {
  if (!comm::is_parallel() || phase == Phase::over || (own.code == 0 && phase != Phase::running)) return own;
  if (phase == Phase::reading) return comm::agree(own);
  if (phase == Phase::building) return comm::agree_within(shutdown_timeout, own);
  if (comm::rank() != 0) {
    if (own.code == 0) return own;
    // Lower ranks may have an error, too, and only one is to print.
    std::this_thread::sleep_for(std::chrono::milliseconds(300 * comm::rank()));
    return std::nullopt;
  }
  send({Command::What::end, 0, 0, own.code});
  return comm::agree_within(own.code == 0 ? std::numeric_limits<double>::infinity() : shutdown_timeout, own);
}

}  // namespace piola
