// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/common/mirror_images.hpp"
#include "piola/formulations/common/set_up_checks.hpp"
#include "piola/formulations/nodal/absorbing_surface.hpp"
#include "piola/formulations/nodal/lattice_layout.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/mechanics/surface_constraint.hpp"
#include "piola/particles/ordering.hpp"
#include <memory>
#include <optional>
#include <vector>

namespace piola::nodal {

/// Cost of setting up a body [s].
struct SetUpCosts {
  double cells = 0;      ///< volumes, moments, facets and surface
  double fits = 0;       ///< neighbours and quadratic fits
  double gradients = 0;  ///< fluxes through facets
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
  Backend const& backend;                   ///< of the loops that use the reference data
  MirrorImages const* images = nullptr;     ///< the whole body behind its mirror planes; nullptr: it has none
  std::optional<Range> own = std::nullopt;  ///< local slots if the body is distributed; empty: all
  bool contact = false;                     ///< contact acts on the body
  bool failure = false;                     ///< cells may fail
  bool conducts = false;                    ///< heat is conducted

  /// Whether the set-up is distributed over ranks. With mirror planes, surface places that supports hold, or
  /// non-reflecting patches, each rank sets up the whole body.
  bool is_shared() const;
  Range own_slots() const { return own.value_or(Range{0, order.slots()}); }
  /// Slot of the particle that an entry of the scaled body is, or is the image of.
  Index source_of(Index entry) const {
    return entry < order.particles ? entry
                                   : images->particles().source[static_cast<std::size_t>(entry - order.particles)];
  }
};

/// Weight of a particle on a loaded face.
struct FacePart {
  double area = 0;                 ///< [m^(D-1)]; may be negative: weights are exact for quadratic fields as a whole
  std::array<double, 3> normal{};  ///< outward unit vector
};

/// Gradients of a body that fills a lattice, one set for each distinct group of lanes, see LatticeTable.
struct LatticeGradients {
  std::vector<std::ptrdiff_t> offset;
  LazyZeroArray<std::int32_t> group;
  std::vector<double> motion, force;
  Index guard = 0;  ///< slots before the first and after the last one that loops may read

  bool empty() const { return offset.empty(); }
  LatticeTable table() const {
    if (empty()) return {};
    return {static_cast<int>(offset.size()), offset.data(), group.data(), motion.data(), force.data()};
  }
  std::size_t bytes() const { return 8 * (offset.size() + motion.size() + force.size()) + 4 * group.size(); }
};

/// The gradients of a body whose cells may fail, which follow the conditions of the cells.
class Refits {
 public:
  virtual ~Refits() = default;
  /// Slots with a new condition, in ascending order, on all ranks alike.
  struct Change {
    Index slot;
    CellCondition condition;
  };
  /// Sets conditions, and the gradients of the intact cells around in `to`, which must stay where it is.
  struct Found {
    std::vector<Index> changed;     ///< local slots with other gradients
    std::vector<Index> unsolvable;  ///< local slots whose neighbours determine no gradient: these cells fail, too
  };
  virtual Found set(std::vector<Change> const& changes) = 0;
  /// Slots of the particles nearer to that of `slot` than `reach` spacings, itself included.
  virtual std::vector<Index> near(Index slot, double reach) const = 0;
  /// Whether the cell of any slot is intact, on all ranks alike.
  virtual bool is_intact(Index slot) const = 0;
};

/// A cell with a common facet, seen from another one: unit vector to its particle; area of the facet over the distance
/// of the particles [m^(D-2)].
struct CellNeighbour {
  Index slot;
  double area_over_distance;
  std::array<double, 3> direction;
};
/// Neighbours of the cells of the local particles of a body with conduction of heat, through common facets.
struct FacetList {
  std::vector<std::size_t> begin;  ///< per local particle, one more at the end
  std::vector<CellNeighbour> neighbour;
};

/// The undeformed body for the loops: values per slot, in the order of Fields. On ranks: of local slots, and V and X of
/// ghosts. Theory: docs/theory/nodal.md, section 3.
struct Reference {
  LazyZeroArray<double> V, mass, L, k, own;
  LazyZeroArray<double> hoop;                     ///< axisymmetric bodies, see HoopSums
  LazyZeroArray<double> X;                        ///< in spacings, D per slot
  LazyZeroArray<double> centroid;                 ///< of the cell relative to the particle, D per slot [m]
  std::vector<LazyZeroArray<FacePart>> parts;     ///< per load on a face, per slot; empty for other loads
  std::vector<LazyZeroArray<double>> face_areas;  ///< of a box in contact, see face_areas(); empty: none
  std::vector<ConstrainedFacet> held;             ///< parts of the surface that supports hold
  std::vector<AbsorbingFacet> absorbing;          ///< parts of non-reflecting patches
  LazyZeroArray<std::int64_t> begin;  ///< lists, see GradientList; of a lattice without weights and gradients
  std::vector<Index> neighbour;
  std::vector<double> weight, gradient, reaction;
  std::vector<double> back_weight;  ///< of a body whose cells may fail: the weights for the neighbours
  LatticeGradients lattice;         ///< replaces the gradients of lists if particles fill a lattice
  // With mirror planes lists refer to images by the slots after those of the body; V and mass are those of the whole
  // body.
  std::vector<Index> images;            ///< images that are neighbours, numbered as in SetUp::images
  std::vector<Index> source_of_image;   ///< slots
  LazyZeroArray<double> own_fractions;  ///< of particle volumes, in the body itself; empty: no planes
  std::unique_ptr<HaloPlan> halo;       ///< of ghosts, without fields; nullptr on one rank
  std::vector<SetUpCheck> checks;
  SetUpCosts costs;
  FacetList facets;                ///< of a body with conduction of heat
  std::shared_ptr<Refits> refits;  ///< of a body whose cells may fail; else nullptr

  GradientList list() const {
    return {begin.data(),    neighbour.data(), weight.data(),
            gradient.data(), reaction.data(),  back_weight.empty() ? weight.data() : back_weight.data()};
  }
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

/// Throws InputError: a particle without a cell, too few particles across, gradients that miss the divergence theorem.
/// Collective on a distributed body; all ranks throw. `to`: new; must stay where it is if cells may fail.
void make_reference(SetUp const& from, Reference& to);

}  // namespace piola::nodal
