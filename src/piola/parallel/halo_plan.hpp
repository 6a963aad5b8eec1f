// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include <vector>

namespace piola {

/// The slots of a body that one rank owns: a contiguous share of its blocks of 64 slots, which sums start with, so that
/// they are the same blocks for any number of ranks.
Range share_of(Index slots, int rank, int ranks);

/// Slots first ... first + count - 1, of which the first has this place among the slots of a message.
struct SlotRun {
  Index first, count, place;
};

/// What the particles of this rank read of those that others own, and what others read of its own, for one body of
/// which all ranks have all slots, in the same order.
class HaloPlan {
 public:
  /// `read`: slots that the particles of this rank read, in any order, as often as they like. Collective.
  HaloPlan(Index slots, std::vector<Index> read);

  /// Values [first, first + count) of a field are what neighbours read of it. A field may have several such runs; one
  /// of no values, where all that neighbours read of it never changes or comes with another field.
  void add(FieldRef const& field, int first, int count);
  /// Brings the values of a field that others own up to date. Only the ranks that read from each other take part.
  void exchange(FieldRef const& field);

  Index received() const;  ///< particles whose values come from others
  /// f(slot) for each of them.
  template <class F>
  void each_received(F const& f) const {
    for (Side const& side : receives_)
      for (SlotRun const& run : side.runs)
        for (Index i = run.first; i < run.first + run.count; ++i) f(i);
  }
  std::size_t bytes() const;

 private:
  struct Side {
    int rank;
    Index slots;  ///< how many
    std::vector<SlotRun> runs;
    std::vector<double> values;  ///< of a message, kept between exchanges
  };
  struct Values {
    double const* data;
    int first, count;
  };
  std::vector<Side> sends_, receives_;
  std::vector<Values> values_;
};

/// plan.exchange(field), for code that is compiled once per machine.
void exchange(HaloPlan& plan, FieldRef const& field);

}  // namespace piola
