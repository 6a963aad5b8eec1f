// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/removed_energy.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

/// Fewest marks for an estimate.
constexpr std::size_t fewest_marks = 5;
/// Largest ratio of the energies of two fifths that is extrapolated.
constexpr double largest_ratio = 0.99;

}  // namespace

void RemovedEnergy::end_step() {
  if (++steps_ < spacing_) return;
  steps_ = 0;
  marks_.push_back(total_);
  if (marks_.size() < most_marks) return;
  for (std::size_t k = 0; 2 * k + 1 < marks_.size(); ++k) marks_[k] = marks_[2 * k + 1];
  marks_.resize(marks_.size() / 2);
  spacing_ *= 2;
}

double RemovedEnergy::left() const {
  if (marks_.size() < fewest_marks) return std::numeric_limits<double>::infinity();
  std::size_t const fifth = marks_.size() / 5, last = marks_.size() - 1;
  double const later = std::abs(total_ - marks_[last - fifth]),
               earlier = marks_[last - fifth] - marks_[last - 2 * fifth];
  if (later == 0) return 0;
  double const ratio = std::min(later / std::max(earlier, later), largest_ratio);
  return std::sqrt(later * std::max(1.0, ratio / (1 - ratio)) / total_);
}

std::vector<double> RemovedEnergy::state() const {
  std::vector<double> all{total_, spacing_, steps_, static_cast<double>(marks_.size())};
  all.insert(all.end(), marks_.begin(), marks_.end());
  all.resize(state_size());
  return all;
}

void RemovedEnergy::load(std::vector<double> const& state) {
  total_ = state[0];
  spacing_ = state[1];
  steps_ = state[2];
  marks_.assign(state.begin() + 4, state.begin() + 4 + static_cast<std::ptrdiff_t>(state[3]));
}

}  // namespace piola
