// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include <span>
#include <vector>

namespace piola::nodal {

/// Copies the values of a slot, `components` of them, from set-up data to a field.
void copy_at(LazyZeroArray<double> const& from, FieldRef const& to, int components, Index i);
/// Sets the deformation gradients of the points of a cell in the field `history` to those of the reference shape.
void put_reference_shape(FieldRef const& history, Index i, int D);

/// Fills the fields of a body that has its memory: reference data, then the state of t = 0. Exists only while the body
/// is constructed.
class FieldSetUp {
 public:
  FieldSetUp(NodalBody& body, Reference& reference, Assembly const& assembly)
      : body_(body), s_(body.state()), reference_(reference), assembly_(assembly) {}

  /// Fields and records from the reference data, which release what fields now hold.
  void fill_reference();
  /// Particles on mirror planes, half of whose volume belongs to the body: scales masses and areas of loaded faces.
  std::vector<MirroredParticle> keep_own_side();
  /// Positions and velocities of t = 0.
  void fill_initial();
  /// Solids in rate form start free of stress where they are not deformed.
  void fill_histories();
  /// F = offset + GRAD x with an offset that stays: F starts from the given values, which count at the particles.
  /// Collective if the body is distributed.
  void fill_offset(Backend const& backend);

 private:
  /// Temperature of a particle at the start over that of its material [K].
  double temperature_above(Index slot, double of_material) const;
  /// History of a law on blocks of points at the start.
  void fill_block_history(MaterialRange const& range);
  std::span<MirroredParticle const> mirrored() const {
    return {s_.boundary.mirrored, static_cast<std::size_t>(s_.boundary.mirrored_count)};
  }

  NodalBody& body_;
  BodyState& s_;
  Reference& reference_;
  Assembly const& assembly_;
};

}  // namespace piola::nodal
