// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/report/frame_statistics.hpp"
#include <string>
#include <vector>

namespace piola::report {

struct SurfaceData;

/// Selection of frames, fields and particles for a page.
struct Plan {
  std::vector<std::size_t> frames = {};  ///< places in the lists of FrameStatistics
  std::size_t fields = 0;                ///< number of fields, the first ones of FrameStatistics
  int bits = 14;                         ///< of a coordinate
  std::size_t every = 1;                 ///< every `every`-th particle
  bool stretched = false;                ///< balls are, by F
  std::size_t particles(std::size_t all) const {
    PIOLA_EXPECTS(every >= 1);
    return (all + every - 1) / every;
  }
};

/// Limits for reducing a plan.
struct PageBudget {
  double bytes = 0;              ///< for frames in the page
  std::size_t least_fields = 0;  ///< fields beyond these go first
  double correction = 1;         ///< ratio of actual to expected size of a previous plan
};

/// Reduces a plan until it fits. Drops in this order: stretched balls, then fields, then frames (not below twelve),
/// then 12 bits, then each k-th particle, unless surfaces are shown. The size of a frame is measured on three in the
/// middle.
Plan fitting_plan(RunFolder const& run, FrameStatistics const& statistics, Plan plan, PageBudget const& limits,
                  SurfaceData const& surface_data);

/// Sentences on what a plan omits from `wanted` to stay within a budget [bytes], and on what no plan can show.
std::vector<std::string> plan_notes(Plan const& plan, Plan const& wanted, FrameStatistics const& statistics,
                                    double budget);

}  // namespace piola::report
