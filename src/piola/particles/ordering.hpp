// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/parallel.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <vector>

namespace piola {

/// Order of a body's particles in memory: pencils of 8 x 8 lattice rows along the longest direction, rows in full. Then
/// neighbours lie at few distinct distances in memory (unit-stride loads), and the rows around a pencil stay in the
/// second-level cache. Empty slots at the end fill the last group of lanes.
struct SlotOrder {
  static constexpr Index no_particle = -1;
  static constexpr Index alignment = 16;  ///< slots are a multiple of it, hence of every lane count
  std::vector<std::int64_t> id;           ///< per slot: particle id, or no_particle
  Index particles = 0;
  Index slots() const { return static_cast<Index>(id.size()); }
};

/// Particles by rows of the lattice, in each along `axis[0]`, then by id. rank[z * lattice[axis[1]] + y]: the place of
/// the row at y along axis[1] and z along axis[2] among all rows.
SlotOrder order_by_rows(ParticleSet const& set, Body const& body, std::array<std::size_t, 3> const& axis,
                        std::vector<std::size_t> const& rank);

/// The axes of a body's lattice: the longest, along which its rows lie, and the others as they come.
std::array<std::size_t, 3> row_axes(Body const& body);

SlotOrder pencil_order(ParticleSet const& set, Body const& body);

/// Tests that results do not depend on where particles stand: as if they were dealt out to several owners, tile by tile
/// at random, each of which keeps its tiles together, in an order of its own. Tiles of 64 particles in the order of the
/// body stay together as they are, an incomplete one at the end, because sums over blocks start with them.
struct Shuffle {
  int owners = 0;  ///< 0: particles stand in the order of the body
  std::uint64_t seed = 1;
  std::int64_t* moved = nullptr;  ///< counts tiles that stand elsewhere for it; nullptr: nobody wants to know
  /// Formulations that have loops for whole lattices, which dealt bodies cannot take, take those for lists also where
  /// nothing is dealt: what a dealt body is compared with.
  bool lists = false;
};
/// The numbers 0 ... count - 1 with the tiles among them dealt out.
std::vector<std::size_t> dealt_numbers(std::size_t count, Shuffle const& shuffle);
/// The shuffle that is set: who makes orders later takes a copy.
Shuffle const& shuffle_now();
/// For all that dealt_order makes from now on; returns the one before. Not while others make orders.
Shuffle set_shuffle(Shuffle const& shuffle);

/// pencil_order, dealt out as the shuffle says, by leaves of 16 slots (exec::leaf_size): of formulations that promise
/// not to depend on it.
SlotOrder dealt_order(ParticleSet const& set, Body const& body);

/// The same of any order in which the particles of a part stand together: tiles of one part change places with each
/// other, those with particles of several parts stay.
SlotOrder dealt_within_parts(ParticleSet const& set, SlotOrder const& order);
/// Whether bodies are dealt out, or compared with ones that are: see Shuffle::lists.
bool shuffle_takes_lists();

}  // namespace piola
