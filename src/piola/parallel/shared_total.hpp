// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/exact_sum.hpp"
#include "piola/parallel/ranks.hpp"
#include <cstddef>
#include <span>
#include <vector>

namespace piola {

/// A sum over steps of which each rank knows a part. Steps ask nobody for the others' parts: ranks put them together
/// when somebody looks, in the order of the steps, so that the total has the bits of one that is kept up to date.
class SharedTotal {
 public:
  /// What all ranks know.
  void add(double known) {
    if (open_.empty()) {
      total_ += known;
    } else {
      exec::ExactSum part;
      if (ranks::own() == 0) part += known;
      add_part(part);
    }
  }
  /// What all ranks have a part of. Collective, though rarely one has to wait for others.
  void add_part(exec::ExactSum const& part) {
    constexpr std::size_t many = 1000;
    open_.push_back({part});
    if (open_.size() == many) settle();
  }
  /// What all ranks have added. Collective.
  double over_ranks() const {
    std::vector<Part> parts(open_);
    ranks::add(std::span(parts));
    double total = total_;
    for (Part const& part : parts) total += part.sum.value();
    return total;
  }
  /// Collective; value() is over_ranks() then.
  void settle() { set(over_ranks()); }
  bool settled() const { return open_.empty(); }
  double value() const { return total_; }
  /// Forgets what there was.
  void set(double total) {
    open_.clear();
    total_ = total;
  }

 private:
  struct Part {
    exec::ExactSum sum;
    void add(Part const& other) { sum += other.sum; }
  };
  double total_ = 0;
  std::vector<Part> open_;
};

}  // namespace piola
