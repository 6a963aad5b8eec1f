// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/load_balancer.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/materials/registry.hpp"
#include "piola/mechanics/contact/friction.hpp"
#include "piola/mechanics/contact/surface.hpp"
#include "piola/mechanics/contact/tie_rule.hpp"
#include "piola/mechanics/load.hpp"
#include "piola/mechanics/rigid_shape.hpp"
#include "piola/mechanics/rigid_spring.hpp"
#include "piola/mechanics/support.hpp"
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
  bool skew = false;   ///< antisymmetric image motion: zero velocity along the plane; small strains only
};

/// Contact law between the bodies of a run.
struct ContactRule {
  enum class Law {
    none,          ///< no contact; Eulerian bodies merge
    kernel,        ///< repulsion by the kernel, stiffness from the impedances
    linear,        ///< linear spring with the stiffness of the material: slow impacts
    as_published,  ///< repulsion by the kernel with a constant and current volumes, as published
    surface        ///< surface contact, also for formulations that have a kernel contact of their own
  };
  Law law = Law::kernel;
  double scale = 1;                                                 ///< factor on the stiffness
  double stiffness = std::numeric_limits<double>::quiet_NaN();      ///< as published: K [Pa/m^D]; nan: not given
  double closing_speed = std::numeric_limits<double>::quiet_NaN();  ///< [m/s]; nan: from the initial velocities
  contact::FrictionLaw friction;  ///< between surfaces and on rigid shapes in surface contact
  bool self = false;              ///< self-contact of surfaces
  double exponent = std::numeric_limits<double>::quiet_NaN();  ///< n of eq. (15); nan: 4 to 8, from the strength of the
                                                               ///< bodies
};

/// Settings of surface contact that differ for one pair: two bodies, a body and a rigid shape, or a body and itself.
struct ContactPair {
  std::array<std::string, 2> between;  ///< names
  bool off = false;                    ///< no contact between the two
  double scale = 1;                    ///< factor on the stiffness
  contact::FrictionLaw friction;
};

/// The pair that names `a` and `b`, in either order; null if there is none.
template <class Pair>
Pair const* find_pair(std::vector<Pair> const& pairs, std::string const& a, std::string const& b) {
  for (Pair const& pair : pairs)
    if ((pair.between[0] == a && pair.between[1] == b) || (pair.between[0] == b && pair.between[1] == a)) return &pair;
  return nullptr;
}

/// Everything that a formulation is built from, without the text of the case: particles and their initial state as
/// numbers in Id order; supports and loads keep their formulas of time. simulation/build.hpp: assemble().
struct Assembly {
  ParticleSet particles;
  std::vector<MaterialParameters> materials;                ///< one per body
  std::vector<std::vector<MaterialParameters>> parts;       ///< per body the materials of its parts; empty: no body has
                                                            ///< parts
  std::vector<FormulationSpec> formulations;                ///< one per body
  std::vector<std::array<double, 3>> initial_velocity;      ///< m/s, one per particle, or empty: at rest
  std::vector<std::array<double, 3>> initial_displacement;  ///< m, one per particle, or empty: none
  std::vector<std::array<double, 9>>
      initial_deformation_gradient;         ///< row by row, one per particle, or empty: from the displacement
  std::vector<double> initial_temperature;  ///< K, one per particle, 0: of the material; or empty
  std::vector<Support> supports;
  std::vector<Load> loads;
  std::vector<MirrorPlane> mirrors;
  std::vector<RigidShape> rigid_shapes;
  std::vector<RigidSpring> springs;  ///< of rigid shapes
  ContactRule contact;
  std::vector<ContactPair> contact_pairs;
  std::vector<contact::Surface> surfaces;                 ///< one per body, or empty: no surface contact
  std::vector<contact::TieRule> ties;                     ///< of bodies that have surfaces
  bool coupled = false;                                   ///< contact or ties use Formulation::coupled_particles()
  double cfl = std::numeric_limits<double>::quiet_NaN();  ///< nan: the scheme's default
  std::string backend = "auto";                           ///< instruction set: auto, scalar, v3, v4
  Repartition repartition;
  bool minimises = false;  ///< whether Formulation::descend() takes the place of steps
};

/// The materials of a body: the main one, then those of its parts, in the order of ParticleSet::part.
inline std::vector<MaterialParameters> materials_of(Assembly const& assembly, std::size_t body) {
  std::vector<MaterialParameters> all{assembly.materials[body]};
  if (!assembly.parts.empty()) all.insert(all.end(), assembly.parts[body].begin(), assembly.parts[body].end());
  return all;
}

}  // namespace piola
