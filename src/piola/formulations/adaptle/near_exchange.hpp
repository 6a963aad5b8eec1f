// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/formulations/adaptle/particle_order.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "piola/parallel/cell_marks.hpp"
#include "piola/parallel/shares.hpp"
#include <array>
#include <span>
#include <vector>

namespace piola::adaptle {

/// What ranks tell each other of particles that are near each other in space. In each step all say in which cells they
/// have some, then each knows who reads what of its own and tells them: where they are, and later in the step the rest.
/// Every function but those that return something is collective.
class NearExchange {
 public:
  /// cuts: who has what of each body.
  NearExchange(std::span<Shares const> cuts, ParticleOrder const& order);

  /// Of own particles: slots in the order of ids.
  SlotList own() const { return of(own_); }
  /// Coordinates of all particles of a run along an axis, in no order.
  std::vector<double> coordinates(System const& system, std::size_t axis) const;

  /// The positions of own particles and the cells of these are known. Afterwards `marks` has all that it may be asked,
  /// positions of others that own particles read are here, and received() says which these are.
  void meet(System const& system, MovingGrid const& grid, CellMarks& marks);
  SlotList received() const { return of(received_); }
  /// Own and received particles, in the order of ids.
  SlotList present() const { return of(present_); }
  /// Those of present() are sorted.
  void choose(MovingGrid const& grid, CellMarks const& marks);
  /// What there is to do if nothing is near anything.
  void forget();

  /// Components [first, first + count) of a field.
  struct FieldPart {
    FieldRef field;
    int first, count;
  };
  /// What is told per kind of reading; fields of `flow` go by sorted number, those of `touch` by slot.
  using Told = std::array<std::vector<FieldPart>, 2>;
  void exchange(Told const& told);
  /// f(slot) for the particles of others that this rank reads because bodies meet.
  template <class F>
  void each_touched(F const& f) const {
    for (Side const& side : receives_)
      for (Index const slot : side.particles[touch]) f(slot);
  }

 private:
  static constexpr std::size_t flow = 0, touch = 1;
  /// Of one other rank.
  struct Side {
    bool meets = false;                           ///< cells of both are near each other
    std::vector<Index> slots;                     ///< in the order in which they are told
    std::array<std::vector<Index>, 2> particles;  ///< of these by kind of reading
    std::vector<double> values;                   ///< of a message, kept between steps
    void choose(MovingGrid const& grid, CellMarks const& marks);
    std::size_t numbers(Told const& told) const;
    /// f(value in the message, value in its field)
    template <class F>
    void each(Told const& told, F const& f);
  };
  /// Somebody of another rank who reads, and where [edges].
  struct Reader {
    int rank;
    CellBox::Bounds where;
  };
  static SlotList of(std::vector<Index> const& slots) { return {static_cast<Index>(slots.size()), slots.data()}; }
  static std::size_t width_of(std::vector<FieldPart> const& parts);
  void find_own_cells(System const& system, MovingGrid const& grid);
  void tell_cells();
  void choose_sends(MovingGrid const& grid, CellMarks const& marks);
  void tell_counts();
  void send();
  void tell_positions(System const& system);

  ParticleOrder const* order_;
  std::vector<Index> own_, received_, present_;
  std::vector<CellMarks::Cell> mine_, all_;  ///< cells; all_: rank after rank
  std::vector<std::size_t> starts_;          ///< in all_
  std::vector<Index> number_of_;             ///< per cell: which of mine_
  std::vector<Reader> readers_;              ///< of mine_[0], then those of mine_[1], and so on, rank by rank
  std::vector<std::size_t> first_reader_;    ///< of each of mine_, one more at the end
  std::vector<Side> sends_, receives_;       ///< per rank
};

}  // namespace piola::adaptle
