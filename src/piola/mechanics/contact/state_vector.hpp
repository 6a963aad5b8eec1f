// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/math/tensor.hpp"
#include <cstddef>
#include <vector>

/// State as a list of numbers, for checkpoints; read in the order of writing.
namespace piola::contact {

inline void put(std::vector<double>& all, Vec<3> const& a) { all.insert(all.end(), a.c, a.c + 3); }

class StateVector {
 public:
  explicit StateVector(std::vector<double> const& all) : from_(all.begin()), end_(all.end()) {}
  bool any() const { return from_ < end_; }
  double next() {
    PIOLA_EXPECTS(any());
    return *from_++;
  }
  std::size_t count() {
    double const number = next();
    PIOLA_EXPECTS(number >= 0);
    return static_cast<std::size_t>(number);
  }
  void take(Vec<3>& a) {
    for (double& c : a.c) c = next();
  }
  std::vector<double> rest() const { return {from_, end_}; }

 private:
  std::vector<double>::const_iterator from_, end_;
};

}  // namespace piola::contact
