// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/mirror_images.hpp"
#include "piola/formulations/nodal/lattice_layout.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/mechanics/surface_hold.hpp"
#include "piola/neighbours/tables.hpp"
#include "piola/particles/ordering.hpp"
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
};

/// What a particle answers for of a loaded face.
struct FacePart {
  double area = 0;                 ///< [m^(D-1)]; negative ones occur: parts are exact for quadratic fields as a whole
  std::array<double, 3> normal{};  ///< outward unit vector
};

/// The undeformed body as loops see it: values per slot, one after the other, in the order of Fields. Theory:
/// docs/theory/nodal.md, section 3.
struct Reference {
  std::vector<double> V, mass, L, g, k, own, mu;
  /// Where k of a group of lanes is stored, counted in groups, if groups that are alike share it: on a lattice.
  std::vector<std::int32_t> group_of_k;
  std::vector<double> X;                     ///< in spacings, D per slot
  std::vector<double> centroid;              ///< of the cell relative to the particle, D per slot [m]
  std::vector<std::vector<FacePart>> parts;  ///< per load on a face, per slot; empty for other loads
  std::vector<HeldPlace> held;               ///< parts of the surface that supports hold
  std::vector<std::int64_t> begin;           ///< lists, see ListTable
  std::vector<Index> neighbour;
  std::vector<double> weight;
  // With mirror planes lists name images by the slots after those of the body; V and mass are those of the whole body.
  std::vector<Index> images;           ///< those that are neighbours, as SetUp::images counts them
  std::vector<Index> source_of_image;  ///< slots
  std::vector<double> share;  ///< of a particle in the body itself, where that is not all of it; empty: no planes
  std::optional<LatticeLayout> lattice;  ///< takes the place of the lists where particles fill a lattice
  int closure_iterations = 0;
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

/// Throws InputError: a particle without a cell, too few particles across.
Reference make_reference(SetUp const& from);

}  // namespace piola::nodal
