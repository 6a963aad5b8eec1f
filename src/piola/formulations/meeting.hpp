// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/continued.hpp"
#include "piola/formulations/ensemble.hpp"
#include "piola/formulations/meeting_ties.hpp"
#include "piola/formulations/observed.hpp"
#include "piola/mechanics/actions.hpp"
#include "piola/mechanics/contact/colour_contact.hpp"
#include "piola/mechanics/contact/rigid_motion.hpp"
#include "piola/mechanics/contact/system.hpp"
#include <memory>
#include <optional>
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
  /// The same if nothing touches.
  double settled(double step) const;
  /// Adds energy, work and columns.
  void report(Diagnostics& sum) const;
  /// Rigid shapes that are free or turn, as they stand.
  std::vector<RigidState> rigids() const { return motion_.states(system_.rigids()); }
  double kinetic_energy() const { return motion_.kinetic_energy(); }  ///< of free rigid shapes [J]
  /// Set once a free rigid shape moves with what is not a number.
  std::optional<Failure> failure() const;
  void damp(double factor) { motion_.damp(system_, factor); }  ///< free rigid shapes
  /// What supports took and rigid shapes gave, in the order of the case: supports, loads with a name, rigid shapes.
  std::vector<Action> actions() const { return actions_.report(); }
  /// What body B did to body A, named "A-B"; the moment about the origin.
  std::vector<Action> pairs() const;
  /// Fields of surfaces: pressure, gap, slip and heat of friction, zero for particles without a surface point.
  static std::vector<FieldInfo> fields();
  /// Whether the field is one of these; then values[id].
  bool sample(std::string_view field, std::span<double> values) const;
  void save(StateWriter& writer) const;
  void load(StateReader& reader);
  /// Particles of a part that it reads in every step, which it knows before it looks.
  std::size_t read_of(std::size_t part) const {
    std::size_t n = 0;
    for (Share const& share : shares_) n += share.part == part ? share.local.size() : 0;
    return n;
  }
  std::size_t bytes() const { return system_.bytes() + ties_.bytes() + colours_.bytes(); }

 private:
  Meeting(Assembly const& whole, Continued const& continued, std::vector<EnsemblePart> const& parts);

  /// A direction of a particle that a support holds, or a mirror plane, which tells nobody.
  struct Held {
    std::size_t support;  ///< `plane`: none
    std::array<double, 3> direction;
    double until;  ///< [s]
  };
  struct Share {
    std::size_t part;
    std::vector<Index> at;            ///< indices into run_ids_
    std::vector<std::int64_t> local;  ///< ids in the part
    std::int64_t lost = 0;            ///< particles that had lost their surface when this was asked last
  };

  static constexpr std::size_t plane = static_cast<std::size_t>(-1);
  /// An index into System::ids() behind a mirror plane: x' = sign x + shift of another one.
  struct Image {
    Index at, source;
    std::array<double, 3> sign, shift;
  };

  void find_particles(Continued const& continued);
  void find_coloured(Assembly const& whole);
  void find_shares(std::vector<EnsemblePart> const& parts);
  void place_images();
  void fold_images();
  void read_masses(Formulations const& formulations);
  void read_state(Formulations const& formulations);
  void drop_lost_surfaces(Formulations const& formulations);
  void push(Formulations const& formulations, double time, double half);
  void give(Formulations const& formulations, double time, double half);
  void damp_chatter(Formulations const& formulations, double time);
  void book(double half);
  double closing_step() const;
  void find_held(Continued const& continued);
  void sum_forces();

  int dimension_;
  std::vector<std::string> names_;  ///< of bodies
  std::vector<RigidShape> shapes_;
  std::vector<Support> supports_;
  contact::System system_;
  contact::RigidMotion motion_;
  std::vector<Share> shares_;
  /// Of the run, by index: those of System::ids(), -1 where they are images, then particles of bodies that meet by
  /// colour alone.
  std::vector<std::int64_t> run_ids_;
  std::vector<Image> images_;            ///< by `at`
  std::vector<std::vector<Held>> held_;  ///< by index into run_ids_
  std::vector<double> mass_;
  std::vector<Vec<3>> x_, v_;
  Actions actions_;
  MeetingTies ties_;
  contact::ColourContact colours_;
  std::vector<Vec<3>> forces_;  ///< of contact and ties, by index into run_ids_ [N]
  std::vector<Index> pushed_;   ///< that have one, ascending
  std::vector<contact::System::Between> pair_impulses_;
  std::vector<double> loaded_;  ///< of a checkpoint, until the state of the bodies is read
  double work_ = 0, friction_work_ = 0, chatter_loss_ = 0, last_dt_ = 0, closing_ = 0;
};

}  // namespace piola
