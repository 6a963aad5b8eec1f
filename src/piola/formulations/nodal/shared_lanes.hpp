// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/view.hpp"
#include "piola/formulations/nodal/list_sums.hpp"
#include "piola/formulations/nodal/state.hpp"

namespace piola::nodal::inline PIOLA_MACHINE {

/// Where the particles of two materials meet within a group of lanes, the pass of the second law writes all its lanes;
/// this keeps what the first law gave to its own, and puts it back. One group per pair of materials, so it costs
/// nothing.
template <int D>
class SharedLanes {
 public:
  /// Of the slots [group, own): those of other materials before the first one of its own.
  SharedLanes(BodyState const& body, Index group, Index own) : body_(body), group_(group), own_(own) {
    int at = 0;
    each([&](FieldRef const& field, int components) {
      View const from = read(field);
      for (Index i = group_; i < own_; ++i)
        for (int c = 0; c < components; ++c) kept_[at++] = from.scalar<double>(i, c);
    });
  }

  void put_back() const {
    int at = 0;
    each([&](FieldRef const& field, int components) {
      WriteView const to = write(field);
      for (Index i = group_; i < own_; ++i)
        for (int c = 0; c < components; ++c) to.scalar(i, kept_[at++], c);
    });
  }

 private:
  /// What UpdateStress writes and depends on the law. F, C and its change come from the motion alone.
  template <class Visit>
  void each(Visit const& visit) const {
    visit(body_.second, D * Records<D>::width);
    visit(body_.a, D);
    visit(body_.change, 2);
    visit(body_.P, 9);
    visit(body_.cell, 4);
  }

  static constexpr int values = D * Records<D>::width + D + 2 + 9 + 4;
  BodyState const& body_;
  Index group_, own_;
  double kept_[values * lane_count]{};
};

}  // namespace piola::nodal::inline PIOLA_MACHINE
