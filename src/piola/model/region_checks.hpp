// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/input/places.hpp"
#include "piola/particles/particle_set.hpp"
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// Tools of check_with_particles and of the warnings about a case.

/// "its particles reach from ... to ...".
std::string box_of(ParticleSet const& particles, Body const& body);

/// Evaluates formulas on the particles of a body. Reports at most one problem per formula. Holds references, which must
/// outlive it.
class FormulaCheck {
 public:
  FormulaCheck(ParticleSet const& particles, Body const& body, Problems& problems)
      : particles_(particles), body_(body), problems_(problems) {}

  /// Whether the value at t = 0 is a finite number above `least` at every particle; reports the first particle where it
  /// is not.
  bool finite(Expression const& formula, std::string const& name, Place const& place, double least = -unbounded) const;
  /// As above, for the particles `ids` of the body.
  bool finite(Expression const& formula, std::string const& name, Place const& place,
              std::span<std::int64_t const> ids) const;
  /// Finite components and a positive determinant at every particle.
  void gradient(std::array<Expression, 9> const& F, Place const& place) const;

 private:
  bool finite_at(std::int64_t id, Expression const& formula, std::string const& name, Place const& place,
                 double least = -unbounded) const;

  ParticleSet const& particles_;
  Body const& body_;
  Problems& problems_;
};

/// Whether a condition is a finite number everywhere and selects at least one particle.
bool check_where(Expression const& where, std::string const& name, Place const& place, ParticleSet const& particles,
                 Body const& body, Problems& problems);

/// Checks that the bodies support the contact settings of the case: rules, pairs, rigid shapes.
void check_contact(CaseSpec const& spec, Problems& problems);
/// Refuses what the minimisation of the energy (run.relax_method) cannot do.
void check_minimisation(CaseSpec const& spec, Problems& problems);

/// Whether the bodies of the case are given as half sections of bodies of revolution.
bool is_in_sections(CaseSpec const& spec);
/// Refuses conduction of heat, and temperatures that differ at the start, where they have no effect.
void check_heat(BodySpec const& body, Problems& problems);
/// Refuses what axisymmetric cases cannot have, and shapes beyond the axis.
void check_axisymmetry(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);

/// Opens the cracks of the last body of the set. Adds impossible cracks to `problems`.
void open_cracks(CaseSpec const& spec, ParticleSet& particles, Problems& problems);
/// Reports the cracks, mirrors, rings, rigid shapes and contact that the formulation of the bodies does not support.
void check_abilities(CaseSpec const& spec, Problems& problems);

/// Position at the start of a particle with the reference position X [m].
std::array<double, 3> start_of(BodySpec const& body, std::array<double, 3> const& X);
/// Distance of a point from the surface of a rigid shape [m], negative inside.
double distance_to(RigidShape const& shape, std::array<double, 3> const& x, int dimension);

/// Reports rigid shapes that hold particles at the start, and velocities of theirs that are not finite then.
void check_rigid(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);
/// Reports unsupported settings of rigid shapes that are free or rotate.
void check_free_rigids(CaseSpec const& spec, int dimension, Problems& problems);

/// Reports ties between bodies that cannot be held, that hold nothing, or whose stiffness or spacing does not fit their
/// law.
void check_ties(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);
/// Warns of ties whose spacing cannot resolve their failure.
void warn_of_ties(CaseSpec const& spec, ParticleSet const& particles, Problems& found);

/// Reports bodies that overlap at the start.
void check_overlap(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);
/// Reports bodies in contact with a body that has a mirror plane, unless they have the same plane or keep clear of it.
void check_mirrored_contact(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);

/// Sets the part number of the particles of bodies with parts.
void mark_parts(CaseSpec const& spec, ParticleSet& particles);
/// Reports parts without particles, parts that take all of a body, and bodies that cannot have any.
void check_parts(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);

/// The part of check_with_particles() for supports, loads and mirrors.
void check_boundaries(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);

}  // namespace piola
