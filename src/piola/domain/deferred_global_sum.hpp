// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include <cstddef>
#include <span>
#include <vector>

namespace piola {

/// A running total over steps whose global reduction is deferred. Each step adds the local part without communication.
/// over_ranks() reduces the parts step by step, so the total is bit-identical to one that is reduced in every step.
class DeferredGlobalSum {
 public:
  /// Adds a value that is replicated on all ranks.
  void add(double known) {
    if (open_.empty()) {
      total_ += known;
    } else {
      exec::ReproducibleSum part;
      if (comm::rank() == 0) part += known;
      add_part(part);
    }
  }
  /// Adds the local part of a value that is distributed over the ranks. Collective: every 1000th call reduces.
  void add_part(exec::ReproducibleSum const& part) {
    constexpr std::size_t many = 1000;
    open_.push_back({part});
    if (open_.size() == many) settle();
  }
  /// Returns the total over all ranks. Collective.
  double over_ranks() const {
    std::vector<Part> parts(open_);
    comm::allreduce_sum(std::span(parts));
    double total = total_;
    for (Part const& part : parts) total += part.sum.value();
    return total;
  }
  /// Reduces the open parts, so that value() is over_ranks(). Collective.
  void settle() { set(over_ranks()); }
  bool settled() const { return open_.empty(); }
  double value() const { return total_; }
  /// Replaces the total and discards all open parts.
  void set(double total) {
    open_.clear();
    total_ = total;
  }

 private:
  struct Part {
    exec::ReproducibleSum sum;
    void add(Part const& other) { sum += other.sum; }
  };
  double total_ = 0;
  std::vector<Part> open_;
};

}  // namespace piola
