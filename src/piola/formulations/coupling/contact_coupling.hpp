// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/common/mirrored_assembly.hpp"
#include "piola/formulations/common/output_fields.hpp"
#include "piola/formulations/coupling/contact_particles.hpp"
#include "piola/formulations/coupling/coupled_formulations.hpp"
#include "piola/formulations/coupling/held_directions.hpp"
#include "piola/formulations/coupling/lost_surfaces.hpp"
#include "piola/formulations/coupling/pair_impulses.hpp"
#include "piola/formulations/coupling/tie_coupling.hpp"
#include "piola/mechanics/contact/colour_contact.hpp"
#include "piola/mechanics/contact/rigid_motion.hpp"
#include "piola/mechanics/contact/surface_contact.hpp"
#include "piola/mechanics/resultants.hpp"
#include <optional>
#include <span>
#include <vector>

namespace piola {

/// Fields of surfaces: pressure, gap, slip and friction heat; zero for particles without a surface point.
std::vector<FieldInfo> contact_fields();

/// Surface contact and ties between the bodies of a run, of any formulation, and with rigid shapes. It changes
/// velocities between steps: half of a step's impulse with the forces before the step, half with those after it. For
/// kick-drift-kick formulations this is velocity Verlet with the contact force included.
class ContactCoupling {
 public:
  using Formulations = ContactParticles::Formulations;
  ContactCoupling(Assembly const& whole, std::vector<FormulationGroup> const& parts);

  /// Evaluates the forces of the current state: before the first step and after loading a checkpoint.
  void start(Formulations const& formulations);
  void begin(Formulations const& formulations, double time, double dt);   ///< before the step of the parts
  void finish(Formulations const& formulations, double time, double dt);  ///< after the step of the parts; time [s] at
                                                                          ///< its end

  /// Returns the step limit of contact [s], given the step limit `step` of the bodies [s].
  double limit(double step) const;
  /// As limit(), with what limits the step.
  StepBound bound(StepBound of_bodies) const;
  /// As limit(), for a state without active contact.
  double settled(double step) const;
  /// Adds energy, work and columns of history.csv.
  void report(Diagnostics& sum) const;
  /// Current state of free and rotating rigid shapes.
  std::vector<RigidState> rigids() const { return motion_.states(system_.rigids()); }
  double kinetic_energy() const { return motion_.kinetic_energy(); }  ///< of free rigid shapes [J]
  /// Set once the motion of a free rigid shape is not finite.
  std::optional<Failure> failure() const;
  void damp(double factor) { motion_.damp(system_, factor); }  ///< free rigid shapes
  /// Mean forces of supports and rigid shapes in the last step, in the order of the case: supports, named loads, rigid
  /// shapes.
  std::vector<Action> actions() const { return actions_.report(); }
  /// Mean force of body B on body A, named "A-B"; moment about the origin.
  std::vector<Action> pairs() const;
  /// Samples a field of contact_fields(): values[id]. Returns false if it is another field.
  bool sample(std::string_view field, std::span<double> values) const;
  void save(StateWriter& writer) const;
  void load(StateReader& reader);
  std::size_t bytes() const { return system_.bytes() + ties_.bytes() + colours_.bytes(); }

 private:
  ContactCoupling(Assembly const& whole, MirroredAssembly const& continued, std::vector<FormulationGroup> const& parts);

  void apply_impulses(Formulations const& formulations, double time, double half);
  void apply(Formulations const& formulations, SparseVectors const& impulses, double factor, double time);
  void damp_chatter(Formulations const& formulations, double time);
  void add_to_energy_balance(double half);
  double contact_time_step() const;
  void fit_areas(Formulations const& formulations);
  void sum_forces();
  void add_forces(std::vector<Vec<3>> const& forces, std::vector<Index> const& at);
  void find_lost_surfaces(Formulations const& formulations);

  std::vector<std::string> names_;  ///< of bodies
  std::vector<RigidShape> shapes_;
  contact::SurfaceContactSystem system_;
  contact::RigidMotion motion_;
  TieCoupling ties_;
  ContactParticles particles_;
  LostSurfaces lost_;
  contact::ColourContact colours_;
  HeldDirections held_;
  Resultants actions_;
  PairImpulses pair_impulses_;
  SparseVectors forces_;  ///< of contact and ties [N]
  /// From a checkpoint, until the state of the bodies is loaded.
  struct Loaded {
    std::vector<double> surfaces, depths, rigid_depths, colours;
  } loaded_;
  double work_ = 0, friction_work_ = 0, chatter_loss_ = 0, last_dt_ = 0, closing_ = 0;
};

}  // namespace piola
