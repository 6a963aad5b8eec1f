// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <functional>
#include <vector>

/// Pairs between two sets of particles: the neighbours that each target has among the sources.
namespace piola {

/// Neighbour table for loops. Plain data, so that code of different instruction sets may exchange it. Targets come in
/// groups of lanes; entry k of lane l of group g is source[(begin[g] + k) * lanes + l]. Shorter lists are filled up
/// with a source so far away that its kernel vanishes. Sources come in their order in the set, wherever their records
/// are.
struct CrossSetPairTable {
  Index const* begin = nullptr;       ///< per group of targets, one more at the end
  Index const* source = nullptr;      ///< records of sources
  double const* inverse_h = nullptr;  ///< 1 / smoothing length of each target [1/m]
};

/// Input of CrossSetPairs::build(). Holds references: the vectors must outlive the call.
struct CrossSetPairRequest {
  std::vector<std::array<double, 3>> const& targets;  ///< positions [m]
  std::vector<std::array<double, 3>> const& sources;  ///< positions [m]
  std::vector<double> const& h;                       ///< wanted smoothing length of each target [m]
  double support = 2;                                 ///< of the kernel, in h
  double skin = 0;                ///< candidates up to support * h * (1 + skin) are listed, for sets that move
  std::vector<int> const& least;  ///< sources that each target needs within its support; h grows until it has them
  std::vector<Index> const& target_in_slot;  ///< which target is in each slot, -1: none; a multiple of the lanes
  std::vector<Index> const& slot_of_source;  ///< record of each source
  /// Whether a source may be a neighbour of a target (indices into both sets); empty: always.
  std::function<bool(Index, Index)> visible;
};

/// A target cannot get enough sources.
class TooFewSources : public InputError {
 public:
  TooFewSources(std::string const& text, Index which) : InputError(text), target(which) {}
  Index target;
};

/// Lists of one pair of sets.
class CrossSetPairs {
 public:
  /// `filler`: a source record that is far away. Slots without a target get an empty list. Throws TooFewSources if a
  /// target cannot get enough sources within four times its h.
  void build(CrossSetPairRequest const& request, int lanes, Index filler);

  CrossSetPairTable table() const { return {begin_.data(), source_.data(), inverse_h_.data()}; }
  int count(Index target) const { return count_[static_cast<std::size_t>(target)]; }  ///< within the support
  std::size_t bytes() const;

 private:
  std::vector<Index> begin_, source_;
  std::vector<double> inverse_h_;
  std::vector<int> count_;
};

}  // namespace piola
