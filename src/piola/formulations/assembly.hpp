// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/registry.hpp"
#include "piola/materials/registry.hpp"
#include "piola/mechanics/contact/friction.hpp"
#include "piola/mechanics/contact/surface.hpp"
#include "piola/mechanics/contact/tie_rule.hpp"
#include "piola/mechanics/load.hpp"
#include "piola/mechanics/rigid_shape.hpp"
#include "piola/mechanics/support.hpp"
#include "piola/parallel/work_balance.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace piola {

/// A face of a box across which the body is continued by its mirror image.
struct MirrorPlane {
  std::size_t body = 0;
  int axis = 0;
  bool upper = false;  ///< at the largest coordinate, else at the smallest
  bool skew = false;   ///< the image moves the opposite way: zero velocity along the plane; small strains
};

/// What keeps bodies of one run apart.
struct ContactRule {
  enum class Law {
    none,     ///< bodies see each other as one
    kernel,   ///< repulsion by the kernel, stiffness from the impedances
    linear,   ///< linear spring with the stiffness of the material: slow impacts
    printed,  ///< repulsion by the kernel with a constant and current volumes, as published
    surface   ///< surfaces push each other, also those of a formulation that has a contact of its own
  };
  Law law = Law::kernel;
  double scale = 1;                                                 ///< factor on the stiffness
  double stiffness = std::numeric_limits<double>::quiet_NaN();      ///< printed: K [Pa/m^D]; nan: not given
  double closing_speed = std::numeric_limits<double>::quiet_NaN();  ///< [m/s]; nan: from the initial velocities
  contact::FrictionLaw friction;  ///< between surfaces and on rigid shapes that surfaces meet
  bool self = false;              ///< whether surfaces meet themselves
  double exponent = std::numeric_limits<double>::quiet_NaN();  ///< n of eq. (15); nan: 4 to 8, by what bodies bear
};

/// What is different between two bodies, a body and a rigid shape, or a body and itself, where surfaces meet.
struct ContactPair {
  std::array<std::string, 2> between;  ///< names
  bool off = false;                    ///< nothing keeps them apart
  double scale = 1;                    ///< factor on the stiffness
  contact::FrictionLaw friction;
};

/// What is said of two, in either order; null: nothing.
template <class Pair>
Pair const* find_pair(std::vector<Pair> const& pairs, std::string const& a, std::string const& b) {
  for (Pair const& pair : pairs)
    if ((pair.between[0] == a && pair.between[1] == b) || (pair.between[0] == b && pair.between[1] == a)) return &pair;
  return nullptr;
}

/// Everything that a formulation is built from: plain numbers in Id order, no input text.
struct Assembly {
  ParticleSet particles;
  std::vector<MaterialParameters> materials;                ///< one per body
  std::vector<std::vector<MaterialParameters>> parts;       ///< per body those of its parts; empty: no body has any
  std::vector<FormulationSpec> formulations;                ///< one per body
  std::vector<std::array<double, 3>> initial_velocity;      ///< m/s, one per particle, or empty: at rest
  std::vector<std::array<double, 3>> initial_displacement;  ///< m, one per particle, or empty: none
  std::vector<std::array<double, 9>>
      initial_deformation_gradient;  ///< row by row, one per particle, or empty: from the displacement
  std::vector<Support> supports;
  std::vector<Load> loads;
  std::vector<MirrorPlane> mirrors;
  std::vector<RigidShape> rigid_shapes;
  ContactRule contact;
  std::vector<ContactPair> contact_pairs;
  std::vector<contact::Surface> surfaces;                 ///< one per body, or empty: no surface contact
  std::vector<contact::TieRule> ties;                     ///< of bodies that have surfaces
  bool pushed = false;                                    ///< Formulation::push will be called
  double cfl = std::numeric_limits<double>::quiet_NaN();  ///< nan: the scheme's default
  std::string machine = "auto";                           ///< instruction set: auto, scalar, v3, v4
  Repartition repartition;                                ///< on ranks
  /// For estimates: nobody works on any particle, so that what is made is what every rank knows of those of others.
  /// Only of formulations whose FormulationInfo says `tells_of_space`.
  bool only_known = false;
};

/// The materials of a body: its own, then those of its parts, as ParticleSet::part counts them.
inline std::vector<MaterialParameters> materials_of(Assembly const& assembly, std::size_t body) {
  std::vector<MaterialParameters> all{assembly.materials[body]};
  if (!assembly.parts.empty()) all.insert(all.end(), assembly.parts[body].begin(), assembly.parts[body].end());
  return all;
}

}  // namespace piola
