// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/ensemble.hpp"
#include "piola/formulations/meeting_ties.hpp"
#include "piola/mechanics/actions.hpp"
#include "piola/mechanics/contact/system.hpp"
#include <memory>
#include <span>
#include <vector>

namespace piola {

/// Surface contact between the bodies of a run, whatever moves them, and with rigid shapes, and ties between them. It
/// pushes them at the instants between steps: half of a step's impulse with the forces before it, half with those after
/// it. For formulations that kick, drift and kick this is velocity Verlet with the force of contact among the others.
class Meeting {
 public:
  using Formulations = std::vector<std::unique_ptr<Formulation>>;
  Meeting(Assembly const& whole, std::vector<EnsemblePart> const& parts);

  /// Forces of the state as it is: before the first step, and after a checkpoint has been read.
  void look(Formulations const& formulations);
  void begin(Formulations const& formulations, double time, double dt);   ///< before the parts step
  void finish(Formulations const& formulations, double time, double dt);  ///< after it; time [s] at the end

  /// The step that contact leaves of one that the bodies bear [s].
  double limit(double step) const;
  /// Adds energy, work and columns.
  void report(Diagnostics& sum) const;
  /// What supports took and rigid shapes gave, in the order of the case: supports, loads with a name, rigid shapes.
  std::vector<Action> actions() const { return actions_.report(); }
  /// What body B did to body A, named "A-B"; the moment about the origin.
  std::vector<Action> pairs() const;
  void save(StateWriter& writer) const;
  void load(StateReader& reader);
  std::size_t bytes() const { return system_.bytes() + ties_.bytes(); }

 private:
  /// A direction of a particle that a support holds.
  struct Held {
    std::size_t support;
    std::array<double, 3> direction;
    double until;  ///< [s]
  };
  struct Share {
    std::size_t part;
    std::vector<Index> at;            ///< indices into System::ids()
    std::vector<std::int64_t> local;  ///< ids in the part
  };

  void read_state(Formulations const& formulations);
  void push(Formulations const& formulations, double time, double half);
  void book(double half);
  void sum_forces();
  void move_rigids(double time, double dt);

  int dimension_;
  std::vector<std::string> names_;  ///< of bodies
  std::vector<RigidShape> shapes_;
  std::vector<Support> supports_;
  contact::System system_;
  std::vector<Share> shares_;
  std::vector<std::vector<Held>> held_;  ///< by index into System::ids()
  std::vector<double> mass_;
  std::vector<Vec<3>> x_, v_;
  Actions actions_;
  MeetingTies ties_;
  std::vector<Vec<3>> forces_;  ///< of contact and ties, by index into System::ids() [N]
  std::vector<Index> pushed_;   ///< that have one, ascending
  std::vector<contact::System::Between> pair_impulses_;
  std::vector<double> loaded_;  ///< of a checkpoint, until the state of the bodies is read
  double work_ = 0, friction_work_ = 0, last_dt_ = 0, closing_ = 0;
};

}  // namespace piola
