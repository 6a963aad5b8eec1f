// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include "piola/parallel/shares.hpp"
#include <span>
#include <utility>
#include <vector>

namespace piola {

/// Slots first ... first + count - 1, of which the first has this place among the slots of a message.
struct SlotRun {
  Index first, count, place;
};

/// What the particles of this rank read of those that others own, and what others read of its own, for one body of
/// which all ranks have all slots, in the same order. Fields may be read by different sweeps, of which some reach
/// further than others: each has a reach of the plan, by number, and is told to those who read it.
class HaloPlan {
 public:
  /// cut: who owns which slots, from 0 on. `read`: slots that the particles of this rank read, in any order, as often
  /// as they like; reach 0. Collective.
  HaloPlan(Shares cut, std::vector<Index> read);
  HaloPlan(Index slots, std::vector<Index> read) : HaloPlan(Shares({0, slots}), std::move(read)) {}
  /// Other slots that they read; the number of this reach. Collective.
  int add_reach(std::vector<Index> read);

  /// Values [first, first + count) of a field are what neighbours within a reach read of it. A field may have several
  /// such runs; one of no values, where all that neighbours read of it never changes or comes with another field.
  void add(FieldRef const& field, int first, int count, int reach = 0);
  /// Brings the values of fields that others own up to date, in one message from each. Only the ranks that read from
  /// each other take part.
  void exchange(std::span<FieldRef const> fields);
  void exchange(FieldRef const& field) { exchange(std::span(&field, 1)); }

  /// The same slots, of no fields yet.
  HaloPlan without_fields() const;

  /// Particles of which something comes from others, in ascending order.
  std::vector<Index> const& received() const { return received_; }
  std::size_t bytes() const;

 private:
  explicit HaloPlan(Shares cut) : cut_(std::move(cut)) {}
  /// Within one reach.
  struct Slots {
    Index count = 0;
    std::vector<SlotRun> runs;
  };
  struct Side {
    int rank;
    std::vector<Slots> reaches;
    std::vector<double> values;  ///< of a message, kept between exchanges
  };
  struct Values {
    double const* data;
    int first, count, reach;
  };
  static void add_side(std::vector<Side>& sides, int rank, int reach, std::vector<Index> const& slots);
  template <class F>
  void each_of(std::span<FieldRef const> fields, F const& f) const;
  template <bool Out>
  void copy(Side& side, std::span<FieldRef const> fields) const;

  Shares cut_;
  int reaches_ = 0;
  std::vector<Side> sends_, receives_;
  std::vector<Values> values_;
  std::vector<Index> received_;
};

/// plan.exchange(fields), for code that is compiled once per machine.
void exchange(HaloPlan& plan, std::span<FieldRef const> fields);
/// Of a field that the plan need not know, what is within its first reach.
void exchange_once(HaloPlan const& plan, FieldRef const& field, int components);

}  // namespace piola
