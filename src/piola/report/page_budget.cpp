// SPDX-License-Identifier: Apache-2.0
#include "piola/report/page_budget.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/report/frame_content.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola::report {
namespace {

constexpr std::size_t least_frames = 12;
constexpr int few_bits = 12;

/// Estimated characters of the frames of a plan in the page, from one key frame and one extrapolated from two frames.
double expected_size(RunFolder const& run, FrameStatistics const& statistics, Plan const& plan,
                     SurfaceData const& surface_data) {
  Lattice const lattice = Lattice::of(statistics.low, statistics.high, plan.bits);
  FrameCodec coder;
  std::size_t const count = plan.frames.size(), first = count > 3 ? count / 2 - 1 : 0;
  double key = 0, other = 0;
  for (std::size_t k = first; k < std::min(count, first + 3); ++k) {
    FrameReader const frame(run.frames[statistics.frames[plan.frames[k]]].second);
    auto const bytes = coder.encode(planned_codes(frame, statistics, lattice, plan, surface_data), k == first);
    (k == first ? key : other) = static_cast<double>(packed_text(bytes).size());
  }
  double const keys = std::ceil(static_cast<double>(count) / FrameCodec::key_every);
  return keys * key + (static_cast<double>(count) - keys) * other;
}

}  // namespace

Plan fitting_plan(RunFolder const& run, FrameStatistics const& statistics, Plan plan, PageBudget const& limits,
                  SurfaceData const& surface_data) {
  PIOLA_EXPECTS(plan.every >= 1 && plan.fields <= statistics.fields.size());
  PIOLA_EXPECTS(limits.bytes > 0 && limits.correction > 0);
  auto const fitting = [&] {
    return limits.bytes / (limits.correction * expected_size(run, statistics, plan, surface_data));
  };
  double fits = fitting();
  if (fits < 1 && plan.stretched) {
    plan.stretched = false;
    fits = fitting();
  }
  while (fits < 1 && plan.fields > limits.least_fields) {
    --plan.fields;
    fits = fitting();
  }
  if (fits < 1 && plan.frames.size() > least_frames) {
    auto const wanted = static_cast<std::size_t>(fits * static_cast<double>(plan.frames.size()));
    auto const places = spread(plan.frames.size(), std::max(wanted, least_frames));
    std::vector<std::size_t> frames;
    for (std::size_t const k : places) frames.push_back(plan.frames[k]);
    plan.frames = std::move(frames);
    fits = fitting();
  }
  if (fits < 1 && plan.bits > few_bits) {
    plan.bits = few_bits;
    fits = fitting();
  }
  if (fits < 1 && !surface_data.surfaces) plan.every *= static_cast<std::size_t>(std::ceil(1 / fits));
  return plan;
}

std::vector<std::string> plan_notes(Plan const& plan, Plan const& wanted, FrameStatistics const& statistics,
                                    double budget) {
  auto const count = [](std::size_t n) { return count_text(static_cast<std::int64_t>(n)); };
  std::vector<std::string> held;
  if (plan.stretched < wanted.stretched) held.push_back("round balls");
  if (plan.fields < wanted.fields) held.push_back(fmt::format("{} of {} fields", plan.fields, wanted.fields));
  if (plan.frames.size() < wanted.frames.size())
    held.push_back(fmt::format("{} of {} frames", plan.frames.size(), wanted.frames.size()));
  if (plan.bits < wanted.bits) held.push_back(fmt::format("positions in {} bits", plan.bits));
  if (plan.every > wanted.every)
    held.push_back(fmt::format("one particle in {} ({} of {})", plan.every, count(plan.particles(statistics.particles)),
                               count(statistics.particles)));
  std::vector<std::string> notes;
  if (!held.empty())
    notes.push_back(fmt::format(
        "to stay within {} the page holds {}; --budget, --frames, --fields and --bits choose "
        "otherwise{}",
        size_text(budget), joined(held), plan.every > wanted.every ? ", --surface leaves out what lies inside" : ""));
  if (statistics.outside > 0)
    notes.push_back(fmt::format("{} particle{} flew out of the box that is shown, or went astray",
                                count(statistics.outside), statistics.outside == 1 ? "" : "s"));
  return notes;
}

}  // namespace piola::report
