// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/part_filled.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/mirror_images.hpp"
#include "piola/formulations/nodal/lattice_layout.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/formulations/set_up_checks.hpp"
#include "piola/mechanics/surface_hold.hpp"
#include "piola/neighbours/tables.hpp"
#include "piola/parallel/halo_plan.hpp"
#include "piola/parallel/own_slots.hpp"
#include "piola/particles/ordering.hpp"
#include <memory>
#include <optional>
#include <vector>

namespace piola::nodal {

/// What setting up a body has cost [s].
struct SetUpCosts {
  double cells = 0;    ///< volumes, moments and surface
  double fits = 0;     ///< neighbours and quadratic fits
  double closure = 0;  ///< the divergence theorem
  double masses = 0;
  double tables = 0;  ///< what the loops read
};

/// What a body is set up from.
struct SetUp {
  ParticleSet const& set;
  Body const& body;
  SlotOrder const& order;
  std::vector<Load> const& loads;
  std::vector<Support> const& supports;
  std::vector<double> const& rho0;       ///< of the body and of its parts [kg/m^3]
  double least_mass;                     ///< of a particle over that of its cell
  Machine const& machine;                ///< whose loops solve for the divergence theorem
  MirrorImages const* images = nullptr;  ///< the whole body behind its mirror planes; nullptr: it has none
  /// Of the residual that the gradients leave in the divergence theorem; less changes no answer.
  double closure_tolerance = 1e-3;
  std::optional<Range> own = std::nullopt;  ///< slots of this rank, where several share the body; nothing: all

  /// Whether ranks set up their parts together. What goes on behind a mirror plane, and places of the surface that
  /// supports hold, each rank sets up as a whole.
  bool is_shared() const;
  Range own_slots() const { return own.value_or(Range{0, order.slots()}); }
};

/// What a particle answers for of a loaded face.
struct FacePart {
  double area = 0;                 ///< [m^(D-1)]; negative ones occur: parts are exact for quadratic fields as a whole
  std::array<double, 3> normal{};  ///< outward unit vector
};

/// The undeformed body as loops see it: values per slot, one after the other, in the order of Fields; on ranks of own
/// slots, and V, X and mu of those that their particles read, too. Theory: docs/theory/nodal.md, section 3.
struct Reference {
  PartFilled<double> V, mass, L, g, k, own, mu;
  /// Where k of a group of lanes is stored, counted in groups, if groups that are alike share it: on a lattice.
  PartFilled<std::int32_t> group_of_k;
  PartFilled<double> X;                     ///< in spacings, D per slot
  PartFilled<double> centroid;              ///< of the cell relative to the particle, D per slot [m]
  std::vector<PartFilled<FacePart>> parts;  ///< per load on a face, per slot; empty for other loads
  std::vector<HeldPlace> held;              ///< parts of the surface that supports hold
  PartFilled<std::int64_t> begin;           ///< lists, see ListTable
  std::vector<Index> neighbour;
  std::vector<double> weight;
  // With mirror planes lists name images by the slots after those of the body; V and mass are those of the whole body.
  std::vector<Index> images;           ///< those that are neighbours, as SetUp::images counts them
  std::vector<Index> source_of_image;  ///< slots
  PartFilled<double> share;  ///< of a particle in the body itself, where that is not all of it; empty: no planes
  std::optional<LatticeLayout> lattice;  ///< takes the place of the lists where particles fill a lattice
  std::unique_ptr<HaloPlan> halo;        ///< of neighbours, without fields; nullptr: one rank has all particles
  int closure_iterations = 0;
  std::vector<SetUpCheck> checks;
  SetUpCosts costs;

  ListTable list() const { return {begin.data(), nullptr, neighbour.data(), weight.data()}; }
  /// Slot of a neighbour, or of what it is the image of.
  Index owner(Index neighbour_slot) const {
    auto const slots = static_cast<Index>(V.size());
    return neighbour_slot < slots ? neighbour_slot : source_of_image[static_cast<std::size_t>(neighbour_slot - slots)];
  }
  int neighbours(Index slot) const {
    auto const at = static_cast<std::size_t>(slot);
    return static_cast<int>(begin[at + 1] - begin[at]);
  }
};

/// Throws InputError: a particle without a cell, too few particles across, gradients that do not obey the divergence
/// theorem; on ranks that share the body it is collective, and all throw.
Reference make_reference(SetUp const& from);

}  // namespace piola::nodal
