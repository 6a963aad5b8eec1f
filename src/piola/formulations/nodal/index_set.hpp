// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <utility>
#include <vector>

namespace piola::nodal {

/// A subset of the numbers 0 ... count - 1, in ascending order.
class IndexSet {
 public:
  /// All numbers.
  explicit IndexSet(Index count = 0) : count_(count) {}
  /// The marked numbers.
  explicit IndexSet(std::vector<bool> const& marked) : some_(true) {
    for (std::size_t a = 0; a < marked.size(); ++a)
      if (marked[a]) numbers_.push_back(static_cast<Index>(a));
    count_ = static_cast<Index>(numbers_.size());
  }

  Index size() const { return count_; }
  std::size_t operator[](Index k) const {
    return static_cast<std::size_t>(some_ ? numbers_[static_cast<std::size_t>(k)] : k);
  }

 private:
  bool some_ = false;
  Index count_ = 0;
  std::vector<Index> numbers_;
};

}  // namespace piola::nodal
