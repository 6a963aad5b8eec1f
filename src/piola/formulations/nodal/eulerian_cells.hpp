// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include "piola/formulations/nodal/eulerian_cell.hpp"
#include <array>
#include <vector>

namespace piola::nodal {

/// The Eulerian cells of a body: sums of a kernel over all particles of the body near them, in their present positions.
/// Each cell acts on its own particle and on its neighbours with opposite forces, whatever the cells of the neighbours
/// are, so that momentum is kept without a rule for mixed pairs. All ranks compute all of them. The state is in the
/// field `history`; all else follows from it and from the positions. Theory: docs/theory/nodal.md, "Eulerian cells".
class EulerianCells {
 public:
  /// Keeps a reference to the body.
  explicit EulerianCells(NodalBody& body) : body_(body) {}

  /// Adds the cell of a slot, on all ranks alike. Its owner has stored its state.
  void add(Index slot);
  /// Lets the added cells take part from now on, and computes the forces. Also needed when volumes of other cells have
  /// changed. Collective.
  void join();
  /// Advances the cells by the step dt [s] to the present positions, and computes the forces there. Records the first
  /// cell whose state is not a number. Collective.
  void advance(double dt);
  /// Adds the impulse of the forces during dt [s] to the velocities.
  void kick(double dt) const;
  /// Bound on the square of the largest frequency [1/s2].
  double frequency2() const { return frequency2_; }
  /// Velocities in the last step of the particles that have cells or are near one, which the viscosity needs, for a
  /// checkpoint: three numbers each [m/s].
  std::vector<double> state() const;
  /// Takes that of a checkpoint, after all cells were added. Collective.
  void load(std::vector<double> const& state);

 private:
  /// A neighbour of a particle and the gradient of the kernel, which points towards the neighbour [1/m^(D+1)].
  struct Neighbour {
    std::size_t member;
    Vec<3> gradient;
  };
  /// A particle of an Eulerian cell, or near one.
  struct Member {
    Index slot;
    bool converted;          ///< has an Eulerian cell
    double V0 = 0;           ///< reference volume of its cell [m^D]
    double volume = 0;       ///< [m^D]
    double compression = 0;  ///< share of the artificial viscosity, 0 to 1
    Vec<3> x{};              ///< [m]
    Vec<3> moved{};          ///< in the last step [m]
    Vec<3> v{};              ///< mean velocity of the last step [m/s]
    Vec<3> force{};          ///< [N]
    SymMat<3> stress{};      ///< zero without an Eulerian cell [Pa]
    std::vector<Neighbour> neighbours{};
  };
  using Positions = std::vector<std::array<double, 3>>;

  template <class F>
  void each_cell(std::vector<EulerianStep>& steps, F const& act);
  void read_positions(Positions& to) const;
  void read_moved(Positions const& before);
  void find_members();
  void find_neighbours();
  void read_volumes();
  void find_forces();
  Mat<3> relative_motion(Member const& of) const;
  void find_compression();
  double viscous_work(Member const& of) const;
  double largest_frequency(Member const& of, EulerianCell const& cell) const;
  Vec<3> viscous_force(Member const& a, Neighbour const& to, double& rate) const;
  MaterialRange const& material(Member const& of) const { return body_.material(of.slot); }

  NodalBody& body_;
  double spacing_ = 0, h_ = 0;    ///< of particles, and smoothing length [m]
  double gradient_scale_ = 1;     ///< that makes gradients exact in the undeformed lattice
  double square_in_lattice_ = 1;  ///< number of neighbours times sum of (volume times gradient)^2 there [1/m2]
  std::vector<Index> slots_;      ///< of the cells, ascending
  std::vector<Index> added_;
  std::vector<double> V0_;       ///< reference volumes of all slots [m^D]
  Positions x_;                  ///< of all slots, when forces were last computed [m]
  Positions v_;                  ///< mean velocities of the last step, of all slots [m/s]
  std::vector<Member> members_;  ///< by slot
  double frequency2_ = 0;
};

}  // namespace piola::nodal
