// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/ranks.hpp"
#include "piola/base/problems.hpp"
#include "piola/formulations/set_up_checks.hpp"
#include "piola/output/frames.hpp"
#include "piola/output/row_writer.hpp"
#include "piola/parallel/agreement.hpp"
#include "piola/simulation/probe_row.hpp"
#include "piola/simulation/state_on_ranks.hpp"
#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <exception>
#include <fmt/format.h>
#include <limits>
#include <thread>

namespace piola {
namespace {

/// A command of rank 0 to the other ranks.
struct Order {
  enum class What : std::int64_t {
    step,
    damp,
    kinetic_energy,
    diagnose,
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

Order send(Order order) {
  ranks::order_bytes(&order, sizeof order);
  return order;
}

/// How long a rank with an error waits for the others, which may be waiting for it [s].
constexpr double patience = 5;

/// Traffic of this rank so far.
struct Said {
  ranks::Traffic traffic = ranks::traffic();
  ranks::Spent spent = ranks::spent();
};

/// Traffic accounting: number of steps, and the traffic to subtract from the totals (before the first step and for
/// observers).
struct Count {
  std::int64_t steps = 0;
  ranks::Traffic before;
  ranks::Spent spent_before;
};
Count counted;

/// RAII guard: traffic during its lifetime is not counted as traffic of steps.
class Aside {
 public:
  Aside() = default;
  Aside(Aside const&) = delete;
  Aside& operator=(Aside const&) = delete;
  ~Aside() {
    if (!ends_) return;
    Said const now;
    auto const put_off = [](auto& before, auto const& from, auto const& to, auto... members) {
      ((before.*members += to.*members - from.*members), ...);
    };
    using ranks::Spent, ranks::Traffic;
    put_off(counted.before, start_.traffic, now.traffic, &Traffic::messages, &Traffic::bytes);
    put_off(counted.spent_before, start_.spent, now.spent, &Spent::collectives, &Spent::in_exchanges,
            &Spent::in_collectives, &Spent::for_orders, &Spent::bytes_to_all);
  }
  void forget() { ends_ = false; }

 private:
  Said start_;
  bool ends_ = true;
};

void count_step() {
  if (counted.steps++ > 0) return;
  counted.before = ranks::traffic();
  counted.spent_before = ranks::spent();
}

constexpr std::size_t numbers_of_traffic = 7;

std::vector<double> gather_traffic() {
  ranks::Traffic const said = ranks::traffic(), &before = counted.before;
  ranks::Spent const spent = ranks::spent(), &spent_before = counted.spent_before;
  double const steps = static_cast<double>(std::max<std::int64_t>(1, counted.steps));
  std::array const mine{static_cast<double>(said.messages - before.messages) / steps,
                        static_cast<double>(said.bytes - before.bytes) / steps,
                        static_cast<double>(spent.collectives - spent_before.collectives) / steps,
                        (spent.in_exchanges - spent_before.in_exchanges) / steps,
                        (spent.in_collectives - spent_before.in_collectives) / steps,
                        (spent.for_orders - spent_before.for_orders) / steps,
                        static_cast<double>(spent.bytes_to_all - spent_before.bytes_to_all) / steps};
  static_assert(mine.size() == numbers_of_traffic);
  return ranks::gather(mine);
}

/// Time of this rank for redistributing values to the writing ranks [s].
double gathered = 0;

/// Adds its lifetime to `gathered`.
class Gathering {
 public:
  Gathering() = default;
  Gathering(Gathering const&) = delete;
  Gathering& operator=(Gathering const&) = delete;
  ~Gathering() { gathered += ranks::spent().in_exchanges - start_; }

 private:
  double start_ = ranks::spent().in_exchanges;
};

/// The formulation on rank 0, whose collective calls are executed on all ranks.
class Conductor final : public Formulation, public SetUpChecked {
 public:
  explicit Conductor(std::unique_ptr<Formulation> formulation) : own_(std::move(formulation)) {}

  double stable_time_step() const override { return own().stable_time_step(); }
  double settled_time_step() const override { return own().settled_time_step(); }
  StepRule step_rule() const override { return own().step_rule(); }
  void step(double time, double dt) override {
    send({Order::What::step, time, dt});
    count_step();
    own().step(time, dt);
  }
  void damp(double factor) override {
    send({Order::What::damp, factor});
    own().damp(factor);
  }
  double kinetic_energy() const override {
    Aside const aside;
    send({Order::What::kinetic_energy});
    return own().kinetic_energy();
  }
  std::vector<RigidState> rigids() const override { return own().rigids(); }
  std::optional<Failure> failure() const override { return own().failure(); }
  Diagnostics diagnose() const override {
    Aside const aside;
    send({Order::What::diagnose});
    return own().diagnose();
  }
  std::vector<FieldInfo> fields() const override { return own().fields(); }
  std::vector<FieldInfo> fields_of(std::size_t body) const override { return own().fields_of(body); }
  void sample(std::string_view field, std::span<double> values) const override {
    Gathering const gathering;
    Aside const aside;
    Order order{Order::What::sample};
    if (field.size() >= sizeof order.field) throw std::invalid_argument(fmt::format("no field is called '{}'", field));
    field.copy(order.field, field.size());
    send(order);
    own().sample(field, values);
  }
  // Local on rank 0: with_probes_of_all() has sent the commands to the other ranks.
  std::optional<std::vector<std::int64_t>> owned() const override { return own().owned(); }
  void sample_owned(std::string_view field, std::span<double> values) const override {
    own().sample_owned(field, values);
  }
  void save(StateWriter& writer) const override {
    Gathering const gathering;
    Aside const aside;
    send({.what = Order::What::save, .code = static_cast<std::int64_t>(writer.rows())});
    LastingWriter lasting(writer);
    own().save(lasting);
    if (writer.rows() == StateWriter::Rows::to_file) lasting.end_rows();
    lasting.raise();
  }
  void load(StateReader& reader) override {
    Aside const aside;
    send({Order::What::load});
    SharedReader shared(&reader);
    own().load(shared);
  }
  int stages_per_step() const override { return own().stages_per_step(); }
  std::vector<std::pair<std::string, double>> costs() const override {
    auto all = own().costs();
    all.emplace_back("gathering", gathered);
    return all;
  }
  std::vector<SetUpCheck> set_up_checks() const override { return set_up_checks_of(own()); }
  std::size_t memory_bytes() const override { return own().memory_bytes(); }
  std::optional<Recuts> recuts() const override { return own().recuts(); }

 private:
  Formulation& own() const { return *own_; }

  std::unique_ptr<Formulation> own_;
};

bool is_for_observers(Order const& order) {
  using enum Order::What;
  return order.what == kinetic_energy || order.what == diagnose || order.what == sample || order.what == probes ||
         order.what == frame || order.what == save || order.what == load;
}

/// Counterpart on this rank of saving with a writer of rank 0.
void save_with_first(Formulation const& formulation, StateWriter::Rows rows) {
  NoWriter nobody;
  StateSize size;
  PartOfWriter part;
  StateWriter* const writers[]{&nobody, &part, &size};
  StateWriter& writer = *writers[static_cast<std::size_t>(rows)];
  formulation.save(writer);
  writer.end_rows();
}

void obey(Formulation& formulation, Order const& order) {
  switch (order.what) {
    case Order::What::step: count_step(); return formulation.step(order.first, order.second);
    case Order::What::traffic: return void(gather_traffic());
    case Order::What::damp: return formulation.damp(order.first);
    case Order::What::kinetic_energy: return void(formulation.kinetic_energy());
    case Order::What::diagnose: return void(formulation.diagnose());
    case Order::What::sample: return formulation.sample(order.field, {});
    case Order::What::save: return save_with_first(formulation, static_cast<StateWriter::Rows>(order.code));
    case Order::What::load: {
      SharedReader shared(nullptr);
      try {
        formulation.load(shared);
      } catch (NotThere const&) {
        return;  // rank 0 reports the error and sends the next command
      }
      return;
    }
    default: return;
  }
}

}  // namespace

void refuse_on_ranks(Assembly const& assembly, int count) {
  if (count < 2) return;
  Problems problems;
  auto const refuse = [&](std::string const& what) {
    problems.add({}, fmt::format("{} on one rank (asked for {}) - start it without mpirun", what, count));
  };
  auto const shares = [](FormulationSpec const& spec) {
    auto const info = find_formulation(spec.name);
    return info && info->on_ranks;
  };
  // Formulations that do not run on ranks are allowed beside one that does; each rank then computes all of their
  // bodies.
  bool const any = std::any_of(assembly.formulations.begin(), assembly.formulations.end(), shares);
  for (std::size_t k = 0; k < assembly.formulations.size() && !any; ++k)
    refuse(fmt::format("body '{}': formulation \"{}\" runs", assembly.particles.bodies[k].name,
                       assembly.formulations[k].name));
  problems.raise_if_any();
}

void compare_on_ranks(Assembly const& assembly) {
  if (!ranks::several()) return;
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
  if (ranks::same(print)) return;
  throw ranks::Disagreement(
      {2,
       "the ranks have read different cases (the same particles, motions and materials are needed on all) - give "
       "all of them the same words, and files that every machine sees under the same path"});
}

void agree_to_go_on() {
  ranks::Trouble const trouble = ranks::agree({});
  if (trouble.code != 0) throw ranks::Disagreement(trouble);
  phase = phase == Phase::reading ? Phase::building : Phase::running;
}

std::unique_ptr<Formulation> conducted(std::unique_ptr<Formulation> formulation) {
  if (!ranks::several() || ranks::own() != 0) return formulation;
  return std::make_unique<Conductor>(std::move(formulation));
}

void with_probes_of_all(double time, std::function<void()> const& look) {
  Aside const aside;
  if (ranks::several() && ranks::own() == 0) send({Order::What::probes, time});
  look();
}

void with_frame_of_all(std::function<void()> const& write) {
  Gathering const gathering;
  Aside const aside;
  if (ranks::several() && ranks::own() == 0) send({Order::What::frame});
  write();
}

int follow(Simulation& simulation) {
  Formulation& formulation = *simulation.formulation;
  std::optional<ProbeRow> probes;  // made when rank 0 has made them without complaint
  for (;;) {
    Aside aside;
    Order const order = send({Order::What::end});  // overwritten by the broadcast of rank 0
    if (!is_for_observers(order)) aside.forget();
    if (order.what == Order::What::end) {
      ranks::agree({});
      phase = Phase::over;
      return static_cast<int>(order.code);
    }
    if (order.what == Order::What::probes) {
      if (!probes) probes.emplace(simulation.spec, simulation.particles);
      probes->take_part(formulation, order.first);
    } else if (order.what == Order::What::frame) {
      FieldCache cache(formulation, simulation.particles, FieldCache::Of::owned);
      RowWriter part(nullptr);
      FrameContent(simulation.spec.output.frame_fields, simulation.spec.output.compress, cache).put(part);
    } else {
      obey(formulation, order);
    }
  }
}

std::vector<RankTraffic> traffic_on_ranks() {
  if (!ranks::several() || phase != Phase::running || ranks::own() != 0) return {};
  send({Order::What::traffic});
  std::vector<double> const all = gather_traffic();
  std::vector<RankTraffic> each;
  for (std::size_t k = 0; k + numbers_of_traffic <= all.size(); k += numbers_of_traffic)
    each.push_back({all[k], all[k + 1], all[k + 2], all[k + 3], all[k + 4], all[k + 5], all[k + 6]});
  return each;
}

std::optional<ranks::Trouble> leave(ranks::Trouble const& own) {
  if (!ranks::several() || phase == Phase::over || (own.code == 0 && phase != Phase::running)) return own;
  if (phase == Phase::reading) return ranks::agree(own);
  if (phase == Phase::building) return ranks::agree_within(patience, own);
  if (ranks::own() != 0) {
    if (own.code == 0) return own;
    // Lower ranks may have an error, too, and only one is to print.
    std::this_thread::sleep_for(std::chrono::milliseconds(300 * ranks::own()));
    return std::nullopt;
  }
  send({Order::What::end, 0, 0, own.code});
  return ranks::agree_within(own.code == 0 ? std::numeric_limits<double>::infinity() : patience, own);
}

}  // namespace piola
