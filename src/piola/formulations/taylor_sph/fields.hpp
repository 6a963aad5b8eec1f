// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/formulations/taylor_sph/state.hpp"
#include <vector>

namespace piola::taylor_sph {

/// The one list of the fields of the real particles, by slot: memory, layout and checkpoint follow from it. Evolved
/// fields are in the order of the checkpoint. Those that neighbours read lie in records, see Record.
struct Fields : FieldSet {
  explicit Fields(int D) : D_(D) {}
  int const D_;

  ListedField x{*this, "Position", "m", D_, Role::evolved};  ///< constant in the fixed configuration
  ListedField v{*this, "Velocity", "m/s", D_, Role::evolved};
  ListedField drift{*this, "Drift", "m/s", D_, Role::evolved};              ///< velocity of positions in the last step
  ListedField displacement{*this, "Displacement", "m", D_, Role::evolved};  ///< in the fixed configuration
  ListedField stress{*this, "Stress", "Pa", D_*(D_ + 1) / 2, Role::evolved};
  ListedField out_of_plane{*this, "OutOfPlaneStress", "Pa", 1, Role::evolved};
  ListedField kernel_volume{*this, "KernelVolume", "m3", 1, Role::evolved};
  ListedField acceleration{*this, "Acceleration", "m/s2", D_, Role::derived};  ///< of loads, at half time
  ListedField mass{*this, "Mass", "kg", 1, Role::reference};

  /// Zeros for this number of slots; positions are so far away that every kernel vanishes.
  void allocate(Index slots);
  void set_views(BodyState& state);
  std::size_t bytes() const { return FieldSet::bytes() + records_.bytes(); }

 private:
  int place_in_record(Field const& field) const;
  Memory records_;
};

/// The one list of the fields of the cells, whose centres are the virtual particles, by slot of the cell. Kernel sums
/// need their records only; the other fields belong to the adjoint exchange.
struct CellFields : FieldSet {
  CellFields(int D, int corners, bool adjoint)
      : D_(D),
        corners_(corners),
        patterns_(corners == D + 1 ? 0
                  : D == 2         ? 1
                                   : 4),
        adjoint_(adjoint) {}
  int const D_, corners_, patterns_;  ///< patterns: hourglass patterns of a box
  bool const adjoint_;

  ListedField stress{*this, "CellStress", "Pa", D_*(D_ + 1) / 2, Role::evolved};
  ListedField out_of_plane{*this, "CellOutOfPlaneStress", "Pa", 1, Role::evolved};
  ListedField hourglass{*this, "CellHourglass", "m", patterns_* D_, Role::evolved};  ///< amplitudes of the patterns
  ListedField force{*this, "CornerForces", "N", corners_* D_, Role::derived};
  ListedField gradient{*this, "VolumeTimesVelocityGradient", "m3/s", D_* D_, Role::derived};

  void allocate(Index slots);
  void set_views(BodyState& state);
  std::size_t bytes() const { return records_.bytes() + memory_.bytes(); }

 private:
  Memory records_, memory_;
};

/// Calls f(field) for the evolved fields of a list, in its order.
template <class Set, class F>
void each_evolved(Set& set, F const& f) {
  set.each([&](auto& field) {
    if (field.role() == Role::evolved) f(field);
  });
}

/// Values of the evolved fields of `count` particles or cells, the k-th of which is in slot(k); an unallocated field
/// has none.
template <class Slot>
std::vector<std::vector<double>> evolved_values(FieldSet const& set, Index count, Slot const& slot) {
  std::vector<std::vector<double>> all;
  each_evolved(set, [&](Field const& field) {
    all.emplace_back();
    for (Index k = 0; k < count && field.size() > 0; ++k)
      for (int c = 0; c < field.components(); ++c) all.back().push_back(field.at(slot(k), c));
  });
  return all;
}
/// Inverse of evolved_values(); fields without values stay as they are.
template <class Slot>
void set_evolved(FieldSet& set, std::vector<std::vector<double>> const& values, Slot const& slot) {
  auto from = values.begin();
  each_evolved(set, [&](Field& field) {
    auto const n = static_cast<std::size_t>(field.components());
    for (std::size_t k = 0; k < from->size(); ++k)
      field.at(slot(static_cast<Index>(k / n)), static_cast<int>(k % n)) = (*from)[k];
    ++from;
  });
}

}  // namespace piola::taylor_sph
