// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/output/history.hpp"
#include "piola/output/summary.hpp"
#include <optional>
#include <vector>

namespace piola {

/// The first local maximum of |y| above half of the largest |y|, refined by a parabola through three samples.
struct Peak {
  double time = 0;
  double value = 0;  ///< with its sign
};
std::optional<Peak> first_peak(std::vector<double> const& time, std::vector<double> const& y);

/// Evaluates one [[quantity]] on the rows of a history, in the unit of the case. Empty cells are skipped. Returns
/// nothing if the history lacks it (no such column, no peak, threshold never reached); `why` then gives the reason.
std::optional<MeasuredQuantity> measure(QuantitySpec const& spec, HistoryTable const& history, std::string& why);

}  // namespace piola
