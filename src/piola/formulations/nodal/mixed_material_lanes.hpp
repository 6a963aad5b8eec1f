// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field_view.hpp"
#include "piola/formulations/nodal/list_sums.hpp"
#include "piola/formulations/nodal/state.hpp"

namespace piola::nodal::inline PIOLA_BACKEND {

/// Saves and restores results in a SIMD group that holds particles of two materials: the pass of the second law
/// overwrites all lanes; put_back() restores the lanes of the first. At most one group per pair of materials.
template <int D>
class MixedMaterialLanes {
 public:
  /// Saves the slots [group, own), which precede the first slot of the second material in the group.
  MixedMaterialLanes(BodyState const& body, Index group, Index own) : body_(body), group_(group), own_(own) {
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
  /// Fields that UpdateStress writes and that depend on the law. F, C and its change depend on the motion alone.
  template <class Visit>
  void each(Visit const& visit) const {
    bool const on_lattice = body_.lattice.group != nullptr;
    visit(body_.stress_for_neighbours, D * (on_lattice ? D + Quadratic<D>::second : Records<D>::used));
    visit(body_.a, D);
    visit(body_.change, 2);
    visit(body_.P, 9);
    visit(body_.cell, 4);
  }

  static constexpr int values = D * Records<D>::used + D + 2 + 9 + 4;
  BodyState const& body_;
  Index group_, own_;
  double kept_[values * lane_count]{};
};

}  // namespace piola::nodal::inline PIOLA_BACKEND
