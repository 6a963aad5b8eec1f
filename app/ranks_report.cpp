// SPDX-License-Identifier: Apache-2.0
#include "ranks_report.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/estimates/count_coupled_communication.hpp"
#include "piola/estimates/estimate.hpp"
#include "piola/estimates/scaling.hpp"
#include "piola/simulation/build.hpp"
#include "set_up_watch.hpp"
#include "streams.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola::app {
namespace {

/// The smallest and the largest of something that the ranks have.
template <class F>
std::string between(Scaling const& scaling, F const& f, std::string (*text)(double)) {
  auto const [low, high] = std::minmax_element(scaling.shares.begin(), scaling.shares.end(),
                                               [&](RankLoad const& a, RankLoad const& b) { return f(a) < f(b); });
  std::string const least = text(f(*low)), most = text(f(*high));
  return least == most ? most : least + " to " + most;
}

std::string count(double n) { return count_text(static_cast<std::int64_t>(std::llround(n))); }
/// Averages over steps need not be whole.
std::string mean(double n) {
  std::string const text = fmt::format("{:.1f}", n);
  return n < 1000 && !text.ends_with(".0") ? text : count(n);
}
std::string size(double bytes) { return size_text(bytes); }

struct CountedCase {
  Scaling on_ranks;
  int paying;  ///< the most ranks that pay, up to `most`
};
constexpr int most = 1024;

/// Throws InputError for cases that do not run on ranks.
CountedCase counted(CaseSpec const& spec, ParticleSet const& particles, Estimate cost, int ranks) {
  SetUpWatch const watch(fmt::format("counting what {} particles tell each other", count_text(particles.size())), {});
  if (!runs_on_ranks(cost))
    throw InputError(fmt::format(
        "--ranks {}: what this case would send is not known before it runs (bodies that ranks do not share were not "
        "counted) - run some steps with mpirun, and look at \"ranks\" in summary.json",
        ranks));
  if (particles.size() >= large_case) count_talk_between(assemble(spec, particles), cost);
  return {scale(particles, cost, ranks), max_efficient_ranks(particles, cost, most)};
}

}  // namespace

void print_rank_estimate(CaseSpec const& spec, ParticleSet const& particles, Estimate const& cost, int ranks) {
  auto const [s, paying] = counted(spec, particles, cost, ranks);
  print_result("on {} {} with {} {} each:\n", count(ranks), ranks == 1 ? "rank" : "ranks", cost.threads,
               cost.threads == 1 ? "thread" : "threads");
  print_result(
      "  of a rank: {} particles, and {} of others that it reads; it sends {} messages, {} in a step; {} of memory\n",
      between(
          s, [](RankLoad const& r) { return static_cast<double>(r.particles); }, count),
      between(
          s, [](RankLoad const& r) { return static_cast<double>(r.halo + r.near); }, count),
      between(
          s, [](RankLoad const& r) { return r.messages; }, mean),
      between(
          s, [](RankLoad const& r) { return r.bytes; }, size),
      between(
          s, [](RankLoad const& r) { return r.memory; }, size));
  if (s.replicated_values > 0) print_result("  all ranks are told {} in a step\n", size(s.replicated_values));
  StepTimes const& t = s.times;
  auto const time = [](double seconds) { return quantity_text(seconds, "s", 3); };
  print_result("  a step, estimated: {} (sweeps {}, messages {}, {} collectives {}, rows of history.csv {})\n",
               time(t.total()), time(t.sweeps), time(t.messages), mean(s.collectives), time(t.collectives),
               time(t.rows));
  print_result("  efficiency {:.0f} %; {}\n", 100 * s.efficiency,
               paying >= most ? fmt::format("{} ranks still pay", most)
                              : fmt::format("beyond {} {} more than half of the time is lost", paying,
                                            paying == 1 ? "rank" : "ranks"));
}

}  // namespace piola::app
