// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/exec/memory.hpp"
#include "piola/formulations/common/mirror_images.hpp"
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include <array>
#include <vector>

namespace piola::jst_sph {

/// The values that each of the two sweeps of a step reads at neighbours, stored together: for lists records [X, values]
/// per particle, for lattices an array per value. What ghosts and mirror images get follows from the same values.
class NeighbourRecords {
 public:
  /// Keeps a reference to `state`, that of the body.
  NeighbourRecords(BodyState& state, Options const& options);
  NeighbourRecords(NeighbourRecords const&) = delete;
  NeighbourRecords& operator=(NeighbourRecords const&) = delete;

  /// Allocates the records of all slots, those of images after those of the body, and places the fields in them.
  void place(FieldList& fields, Index slots, Index images);
  /// Sets `u` and `second` of the state, once its fields are bound.
  void bind(MirrorImages& images);
  /// Lists only: the position of a particle in its records.
  void set_position(Index slot, std::array<double, 3> const& X);
  /// Components [first, first + count) of `second` that are constant: alpha and beta for the adjoint of the Laplacian.
  struct ComponentRange {
    int first, count;
  };
  ComponentRange constants() const;
  /// Adds the values that sweeps exchange, and the buffers of the filter: gradients read near neighbours (level 0),
  /// Laplacians and the filter also far ones (level 1).
  void add_to(HaloPlan& halo) const;
  std::size_t bytes() const { return first_.memory.bytes() + second_.memory.bytes(); }

 private:
  enum class Ghosts { near, far, constant };
  struct Value {
    FieldRef* field;  ///< nullptr: corrections of the Laplacian
    int components;
    MirrorImages::Kind image;
    Ghosts ghosts;
  };
  struct Sweep {
    std::vector<Value> values;  ///< in the order in which the sweep reads them
    Memory memory;
    std::ptrdiff_t component = 0, particle = 1, start = 0;
    FieldVersion version;
  };
  void place(Sweep& sweep, FieldList& fields, Index slots, Index images) const;
  static void add_to(HaloPlan& halo, FieldRef const& record, std::vector<Value> const& values);

  BodyState& state_;
  Sweep first_, second_;
};

}  // namespace piola::jst_sph
