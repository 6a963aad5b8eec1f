// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_cells.hpp"
#include "piola/domain/partition.hpp"
#include "piola/exec/field.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include <array>
#include <span>
#include <vector>

namespace piola::adaptle {

/// Spatial halo exchange. In each step ranks whose particles are near each other exchange their occupied cells there;
/// each rank derives which of its particles other ranks need; positions are sent first, other fields later in the step.
/// All void functions are collective.
class SpatialHaloExchange {
 public:
  /// cuts: partition of each body.
  explicit SpatialHaloExchange(std::span<Partition const> cuts);

  /// Local particles: slots in the order of ids.
  SlotList own() const { return of(own_); }
  /// Coordinates of all particles of a run along an axis, unordered.
  std::vector<double> coordinates(System const& system, std::size_t axis) const;

  /// Exchanges cells and positions. bounds: of the particles of each rank. Precondition: positions and cells of local
  /// particles are set. Afterwards `marks` is complete for local cells and those adjacent, the positions of spatial
  /// ghosts are set, and received() lists these.
  void meet(System const& system, CellList const& grid, std::span<CoordinateBounds const> bounds, HaloCells& marks);
  SlotList received() const { return of(received_); }
  /// Local particles and spatial ghosts, in the order of ids.
  SlotList present() const { return of(present_); }
  /// Chooses the particles to exchange. Precondition: those of present() are sorted.
  void choose(CellList const& grid, HaloCells const& marks);
  /// Clears the exchange in a step without spatial neighbours.
  void forget();

  /// Components [first, first + count) of a field.
  struct FieldPart {
    FieldRef field;
    int first, count;
  };
  /// Fields per kind of reading; those of `flow` by sorted number, those of `touch` by slot.
  using FieldGroups = std::array<std::vector<FieldPart>, 2>;
  void exchange(FieldGroups const& fields);
  /// Calls f(slot) for the spatial ghosts that this rank reads for contact.
  template <class F>
  void each_touched(F const& f) const {
    for (Side const& side : receives_)
      for (Index const slot : side.particles[touch]) f(slot);
  }

 private:
  static constexpr std::size_t flow = 0, touch = 1;
  /// Communication with one other rank.
  struct Side {
    bool overlaps = false;                        ///< cells of both ranks are adjacent
    std::vector<Index> slots;                     ///< in the order of sending
    std::array<std::vector<Index>, 2> particles;  ///< indices of these by kind of reading
    std::vector<double> values;                   ///< message buffer, kept between steps
    void choose(CellList const& grid, HaloCells const& marks);
    std::size_t numbers(FieldGroups const& fields) const;
    /// Calls f(value in the message, value in its field).
    template <class F>
    void each(FieldGroups const& fields, F const& f);
  };
  /// A remote rank that reads particles of a cell, and the bounds of its reading particles [cell edges].
  struct Reader {
    int rank;
    QuantisedBounds::Bounds where;
  };
  static SlotList of(std::vector<Index> const& slots) { return {static_cast<Index>(slots.size()), slots.data()}; }
  static std::size_t width_of(std::vector<FieldPart> const& parts);
  /// The smallest box of cells that holds the cells of a rank, by their indices along each axis.
  struct CellBox {
    std::array<Index, 3> low, high;
    bool is_within(CellBox const& other, Index layers) const {
      for (std::size_t c = 0; c < 3; ++c)
        if (low[c] > other.high[c] + layers || high[c] < other.low[c] - layers) return false;
      return true;
    }
  };
  void find_own_cells(System const& system, CellList const& grid);
  void select_cells(CellList const& grid, std::span<CoordinateBounds const> bounds);
  void exchange_cells();
  void select_sends(CellList const& grid, HaloCells const& marks);
  void send_counts();
  void send();
  void send_positions(System const& system);

  std::vector<Index> own_, received_, present_;
  std::vector<HaloCells::Cell> mine_;  ///< own cells
  std::vector<std::vector<HaloCells::Cell>>
      others_;                             ///< per rank: remote cells near local ones; before: local cells to send
  std::vector<char> is_near_;              ///< per rank
  std::vector<Index> number_of_;           ///< per cell: index into mine_
  std::vector<Reader> readers_;            ///< of mine_[0], then those of mine_[1], and so on, rank by rank
  std::vector<std::size_t> first_reader_;  ///< of each of mine_, one more at the end
  std::vector<Side> sends_, receives_;     ///< per rank
};

}  // namespace piola::adaptle
