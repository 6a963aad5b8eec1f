// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/particles/particle_set.hpp"
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// Tools of check_regions, internal to input/.

Place place_of(Places const& places, std::string_view key);
/// "(0.5, 6, 0.5) m".
std::string point_text(std::array<double, 3> const& X, int dimension);
/// "its particles reach from ... to ...".
std::string box_of(ParticleSet const& particles, Body const& body);

/// One body's formulas looked at on its particles; each formula complains at most once.
class FormulaCheck {
 public:
  FormulaCheck(ParticleSet const& particles, Body const& body, Problems& problems)
      : particles_(particles), body_(body), problems_(problems) {}

  /// Whether the value at t = 0 is a finite number at every particle; reports the first particle where it is not.
  bool finite(Expression const& formula, std::string const& name, Place const& place) const;
  /// The same for some particles of the body.
  bool finite(Expression const& formula, std::string const& name, Place const& place,
              std::span<std::int64_t const> ids) const;
  /// Finite components and a positive determinant at every particle.
  void gradient(std::array<Expression, 9> const& F, Place const& place) const;

 private:
  bool finite_at(std::int64_t id, Expression const& formula, std::string const& name, Place const& place) const;

  ParticleSet const& particles_;
  Body const& body_;
  Problems& problems_;
};

/// Whether a condition is a finite number everywhere and selects at least one particle.
bool check_where(Expression const& where, std::string const& name, Place const& place, ParticleSet const& particles,
                 Body const& body, Problems& problems);

/// Opens the cracks of the last body of the set; those that cannot be are problems.
void open_cracks(CaseSpec const& spec, ParticleSet& particles, Problems& problems);
/// Reports the cracks, mirrors, rings, rigid shapes and contact that the formulation of the bodies does not know.
void check_abilities(CaseSpec const& spec, Problems& problems);

/// Reports rigid shapes that hold particles at the start, and velocities of theirs that are not finite then.
void check_rigid(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);

/// The parts of check_regions that look at supports, loads and mirrors.
void check_boundaries(CaseSpec const& spec, ParticleSet const& particles, Problems& problems);

}  // namespace piola
