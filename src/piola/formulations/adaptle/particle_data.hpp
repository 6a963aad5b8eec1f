// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/formulations/adaptle/fields.hpp"
#include "piola/formulations/adaptle/options.hpp"
#include <vector>

namespace piola::adaptle {

/// The arrays of all particles of a run, by slot, and the view of the run for loops (System), to which its other parts
/// add theirs. Arrays have the length of the whole run; pages are allocated on first write. phi and active are
/// replicated; other fields are written only for local particles and ghosts.
class ParticleData {
 public:
  /// Sets constants of bodies, contact and kernel types.
  ParticleData(Assembly const& assembly, Options const& options);
  ParticleData(ParticleData const&) = delete;
  ParticleData& operator=(ParticleData const&) = delete;

  /// Sets the reference data of the local particles.
  void set_reference();
  /// Sets the evolved fields of the local particles to the start of the run.
  void set_initial_state(Assembly const& assembly);
  /// Updates what loops read of the kernel types.
  void update_kernel_types();

  System& system() { return system_; }
  System const& system() const { return system_; }
  Fields& fields() { return system_.field; }
  Fields const& fields() const { return system_.field; }
  ParticleSet const& set() const { return set_; }
  std::vector<BodyConstants> const& bodies() const { return body_; }
  BodyConstants const& body_of(Index slot) const { return body_[static_cast<std::size_t>(system_.body_of[slot])]; }
  FailureSlot const& failure() const { return failure_; }
  /// Whether some pair of bodies has surface contact first.
  bool has_surface_contact() const;
  /// Whether any particle is not fully Eulerian (replicated).
  bool has_lagrangian() const;
  /// Whether any particle is deleted (replicated).
  bool has_deleted() const;
  /// Mass of any particle for contact, replicated [kg]; 0 for deleted particles, which do not take part in contact.
  double contact_mass(std::int64_t id) const;
  std::size_t bytes() const;

  /// Calls f(field, components) for all fields of a checkpoint. Slots count if is_saved(). Deformation follows from
  /// positions, except for deleted particles. The reference data of converted particles are not needed.
  template <class F>
  void each_saved(F const& f) const {
    memory_.each_evolved([&](std::string const&, FieldRef const& field, int components) { f(field, components); });
    if (!Fields::holds(fields().F) || !has_deleted()) return;
    f(fields().F, 9);
    f(fields().F_rate, 9);
    f(fields().gap, 1);
  }
  bool is_saved(FieldRef const& field, Index slot) const {
    bool const deforms =
        field.data == fields().F.data || field.data == fields().F_rate.data || field.data == fields().gap.data;
    return !deforms || !(fields().active.at(slot) > 0);
  }
  /// Whether all ranks have all values of the field.
  bool is_replicated(FieldRef const& field) const {
    return field.data == fields().phi.data || field.data == fields().active.data;
  }

 private:
  void set_bodies(Assembly const& assembly, Options const& options);
  void set_contact(Assembly const& assembly);
  void allocate(Options const& options);
  double initial_thickness(Index slot);
  void set_descriptions(Options const& options);
  void blend_patch(BodyConstants const& body, double width, std::vector<Index> const& outside);

  ParticleSet const set_;  ///< copy-on-write, shared with the case
  FieldList memory_;       ///< of the fields
  System system_;
  std::vector<BodyConstants> body_;
  std::vector<KernelContactPair> contact_pairs_;
  std::vector<int> body_of_;
  LazyZeroArray<Correction> correction_;
  LazyZeroArray<double> position_;
  std::vector<std::uint8_t> eulerian_;
  std::vector<double> partial_;
  FailureSlot failure_;
};

}  // namespace piola::adaptle
