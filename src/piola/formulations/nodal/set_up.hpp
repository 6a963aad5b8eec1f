// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/common/mirror_images.hpp"
#include "piola/formulations/common/set_up_checks.hpp"
#include "piola/formulations/nodal/lattice_layout.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/mechanics/surface_constraint.hpp"
#include "piola/neighbours/pair_table_views.hpp"
#include "piola/particles/ordering.hpp"
#include <memory>
#include <optional>
#include <vector>

namespace piola::nodal {

/// Cost of setting up a body [s].
struct SetUpCosts {
  double cells = 0;                   ///< volumes, moments and surface
  double fits = 0;                    ///< neighbours and quadratic fits
  double integration_correction = 0;  ///< the divergence theorem
  double masses = 0;
  double tables = 0;  ///< data for the loops
};

/// Input of the set-up of a body.
struct SetUp {
  ParticleSet const& set;
  Body const& body;
  SlotOrder const& order;
  std::vector<Load> const& loads;
  std::vector<Support> const& supports;
  std::vector<double> const& rho0;          ///< of the main material and of the parts [kg/m^3]
  double least_mass;                        ///< of a particle over that of its cell
  Backend const& backend;                   ///< instruction set of the loops that solve for the divergence theorem
  MirrorImages const* images = nullptr;     ///< the whole body behind its mirror planes; nullptr: it has none
  std::optional<Range> own = std::nullopt;  ///< local slots if the body is distributed; empty: all

  /// Whether the set-up is distributed over ranks. With mirror planes, or surface places that supports hold, each rank
  /// sets up the whole body.
  bool is_shared() const;
  Range own_slots() const { return own.value_or(Range{0, order.slots()}); }
};

/// Weight of a particle on a loaded face.
struct FacePart {
  double area = 0;                 ///< [m^(D-1)]; may be negative: weights are exact for quadratic fields as a whole
  std::array<double, 3> normal{};  ///< outward unit vector
};

/// The undeformed body for the loops: values per slot, in the order of Fields. On ranks: of local slots, and V, X and
/// mu of ghosts. Theory: docs/theory/nodal.md, section 3.
struct Reference {
  LazyZeroArray<double> V, mass, L, g, k, own, mu;
  /// On a lattice: index of the stored group of k per group of lanes, if groups with identical geometry share it.
  LazyZeroArray<std::int32_t> group_of_k;
  LazyZeroArray<double> X;                     ///< in spacings, D per slot
  LazyZeroArray<double> centroid;              ///< of the cell relative to the particle, D per slot [m]
  std::vector<LazyZeroArray<FacePart>> parts;  ///< per load on a face, per slot; empty for other loads
  std::vector<ConstrainedFacet> held;          ///< parts of the surface that supports hold
  LazyZeroArray<std::int64_t> begin;           ///< lists, see ListTable
  std::vector<Index> neighbour;
  std::vector<double> weight;
  // With mirror planes lists refer to images by the slots after those of the body; V and mass are those of the whole
  // body.
  std::vector<Index> images;             ///< images that are neighbours, numbered as in SetUp::images
  std::vector<Index> source_of_image;    ///< slots
  LazyZeroArray<double> own_fractions;   ///< of particle volumes, in the body itself; empty: no planes
  std::optional<LatticeLayout> lattice;  ///< replaces the lists if particles fill a lattice
  std::unique_ptr<HaloPlan> halo;        ///< of ghosts, without fields; nullptr on one rank
  int integration_iterations = 0;
  std::vector<SetUpCheck> checks;
  SetUpCosts costs;

  ListTable list() const { return {begin.data(), nullptr, neighbour.data(), weight.data()}; }
  /// Slot of a neighbour, or of the source of an image.
  Index owner(Index neighbour_slot) const {
    auto const slots = static_cast<Index>(V.size());
    return neighbour_slot < slots ? neighbour_slot : source_of_image[static_cast<std::size_t>(neighbour_slot - slots)];
  }
  /// Fraction of a particle's volume that belongs to the body itself, on this side of its mirror planes.
  double own_fraction(Index slot) const {
    return own_fractions.empty() ? 1 : own_fractions[static_cast<std::size_t>(slot)];
  }
  int neighbours(Index slot) const {
    auto const at = static_cast<std::size_t>(slot);
    return static_cast<int>(begin[at + 1] - begin[at]);
  }
};

/// Throws InputError: a particle without a cell, too few particles across, gradients that violate the divergence
/// theorem. Collective on a distributed body; all ranks throw.
Reference make_reference(SetUp const& from);

}  // namespace piola::nodal
