// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/report/survey.hpp"
#include <string>
#include <vector>

namespace piola::report {

struct Shaping;

/// What of the frames goes into a page.
struct Plan {
  std::vector<std::size_t> frames = {};  ///< places in the survey's lists
  std::size_t fields = 0;                ///< the first so many of the survey
  int bits = 14;                         ///< of a coordinate
  std::size_t every = 1;                 ///< particles: each so many
  bool stretched = false;                ///< balls are, by F
  std::size_t particles(std::size_t all) const { return (all + every - 1) / every; }
};

/// What may be given up, and what not.
struct PlanLimits {
  double bytes = 0;              ///< for frames in the page
  std::size_t least_fields = 0;  ///< fields beyond these go first
  double correction = 1;         ///< a plan before took so many times what was expected
};

/// All of it, or less until it fits: stretched balls, then fields, then frames (not below twelve), then 12 bits, then
/// each k-th particle, unless surfaces are shown. What a frame takes is measured on three in the middle.
Plan fitting_plan(RunFolder const& run, Survey const& survey, Plan plan, PlanLimits const& limits,
                  Shaping const& shaping);

/// What a plan leaves out of what was wanted to stay within a budget [bytes], and what no plan can show, in sentences.
std::vector<std::string> plan_notes(Plan const& plan, Plan const& wanted, Survey const& survey, double budget);

}  // namespace piola::report
