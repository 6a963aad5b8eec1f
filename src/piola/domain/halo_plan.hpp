// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/partition.hpp"
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include <span>
#include <utility>
#include <vector>

namespace piola {

/// Slots first ... first + count - 1. `place`: position of the first one among the slots of a message.
struct SlotRun {
  Index first, count, place;
};

/// Communication plan for the ghost particles of one body. Slots are numbered alike on all ranks. A field has a cutoff
/// level (reach): sweeps with a larger support need more ghosts, and a field is sent only to the ranks that read it at
/// its level. Values are read and written through the FieldRef of each exchange.
class HaloPlan {
 public:
  /// cut: partition of the slots, which start at 0. `read`: slots that local particles read at level 0, in any order;
  /// duplicates and local slots are ignored. Collective.
  HaloPlan(Partition cut, std::vector<Index> read);
  HaloPlan(Index slots, std::vector<Index> read) : HaloPlan(Partition({0, slots}), std::move(read)) {}
  /// Adds a cutoff level with separate slots to read. Returns the number of the level. Collective.
  int add_cutoff(std::vector<Index> read);

  /// Declares that neighbours at level `reach` read the components [first, first + count) of a field. A field may have
  /// several such ranges. count = 0 declares a field that is never sent, because its values are constant or travel with
  /// another field.
  void add(FieldRef const& field, int first, int count, int reach = 0);
  /// Updates the ghost values of `fields`, with one message per neighbouring rank. Called by all ranks; only
  /// neighbouring ranks communicate.
  void exchange(std::span<FieldRef const> fields);
  void exchange(FieldRef const& field) { exchange(std::span(&field, 1)); }

  /// Returns a copy of the plan without fields.
  HaloPlan without_fields() const;

  /// Ghost particles: slots whose values this rank receives, in ascending order.
  std::vector<Index> const& received() const { return received_; }
  std::size_t bytes() const;

 private:
  explicit HaloPlan(Partition cut) : cut_(std::move(cut)) {}
  /// Slots of one cutoff level.
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

  Partition cut_;
  int reaches_ = 0;
  std::vector<Side> sends_, receives_;
  std::vector<Values> values_;
  std::vector<Index> received_;
};

/// Calls plan.exchange(fields); for code that is compiled once per instruction set.
void exchange(HaloPlan& plan, std::span<FieldRef const> fields);
/// Updates the components [0, components) of a field that need not be add()ed, for the ghosts that neighbours at level
/// `reach` read. Called by all ranks.
void exchange_once(HaloPlan const& plan, FieldRef const& field, int components, int reach = 0);

}  // namespace piola
