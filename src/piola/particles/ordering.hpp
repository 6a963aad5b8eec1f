// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
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

/// The axes of a body's lattice: the longest one first, along which its rows lie, then the remaining ones in order.
std::array<std::size_t, 3> row_axes(Body const& body);

SlotOrder pencil_order(ParticleSet const& set, Body const& body);

/// Random permutation of particles, to test that results do not depend on their order. Tiles are assigned to `owners`
/// at random; each owner keeps its tiles contiguous, in a random order. Tiles of 64 particles stay intact, because sums
/// over blocks start with them; an incomplete tile stays at the end.
struct Shuffle {
  int owners = 0;  ///< 0: no permutation
  std::uint64_t seed = 1;
  std::int64_t* moved = nullptr;  ///< counts the tiles that the permutation has moved; nullptr: not counted
  /// Formulations use loops over neighbour lists even for unpermuted lattices, as the reference for permuted bodies,
  /// which cannot use lattice loops.
  bool lists = false;
};
/// The numbers 0 ... count - 1 with their tiles permuted.
std::vector<std::size_t> shuffled_indices(std::size_t count, Shuffle const& shuffle);
/// The present shuffle. Copy it to make orders later.
Shuffle const& current_shuffle();
/// Sets the shuffle of later shuffled_order() calls and returns the previous one. Not thread-safe against
/// shuffled_order().
Shuffle set_shuffle(Shuffle const& shuffle);

/// pencil_order(), permuted by the shuffle in leaves of 16 slots (exec::leaf_size). For formulations whose results do
/// not depend on the order.
SlotOrder shuffled_order(ParticleSet const& set, Body const& body);

/// As shuffled_order(), for an order in which the particles of a part are contiguous. Tiles are permuted within a part;
/// tiles with particles of several parts stay.
SlotOrder shuffled_within_parts(ParticleSet const& set, SlotOrder const& order);
/// Whether bodies are permuted, or the reference for permuted ones: see Shuffle::lists.
bool shuffle_forces_lists();

}  // namespace piola
