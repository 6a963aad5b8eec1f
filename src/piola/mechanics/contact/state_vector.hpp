// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/math/lanes.hpp"
#include "piola/math/tensor.hpp"
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

/// State as a list of numbers, for checkpoints; read in the order of writing.
namespace piola::contact {

inline void put(std::vector<double>& all, Vec<3> const& a) { all.insert(all.end(), a.c, a.c + 3); }

/// Puts the count of all k < n with contains(k), then each of these k with the values that put_values(k) adds.
template <class Contains, class PutValues>
void put_some(std::vector<double>& all, std::size_t n, Contains const& contains, PutValues const& put_values) {
  std::size_t const count = all.size();
  all.push_back(0);
  for (std::size_t k = 0; k < n; ++k) {
    if (!contains(k)) continue;
    all[count] += 1;
    all.push_back(static_cast<double>(k));
    put_values(k);
  }
}

/// A number for some pairs of indices.
using PairValues = std::map<std::pair<Index, Index>, double>;

/// Three numbers for each pair.
inline std::vector<double> numbers_of(PairValues const& pairs) {
  std::vector<double> all;
  for (auto const& [pair, value] : pairs)
    all.insert(all.end(), {static_cast<double>(pair.first), static_cast<double>(pair.second), value});
  return all;
}
/// Inverse of numbers_of().
inline PairValues pair_values_of(std::vector<double> const& all) {
  PIOLA_EXPECTS(all.size() % 3 == 0);
  PairValues pairs;
  for (std::size_t k = 0; k < all.size(); k += 3)
    pairs[{static_cast<Index>(all[k]), static_cast<Index>(all[k + 1])}] = all[k + 2];
  return pairs;
}

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
