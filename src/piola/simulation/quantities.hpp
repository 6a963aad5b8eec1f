// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/output/history.hpp"
#include "piola/output/summary.hpp"
#include <optional>
#include <vector>

namespace piola {

/// The first local maximum of |y| that rises above half of the largest |y|, refined by the parabola through three
/// samples.
struct Peak {
  double time = 0;
  double value = 0;  ///< with its sign
};
std::optional<Peak> first_peak(std::vector<double> const& time, std::vector<double> const& y);

/// Evaluates one [[quantity]] on the rows of a history, in the unit that the case asks for. Empty cells are skipped.
/// Nothing if the history does not hold it (no such column, no peak, threshold never reached); `why` then says so.
std::optional<MeasuredQuantity> measure(QuantitySpec const& spec, HistoryTable const& history, std::string& why);

}  // namespace piola
