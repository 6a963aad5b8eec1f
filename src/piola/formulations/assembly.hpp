// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include "piola/formulations/registry.hpp"
#include "piola/materials/registry.hpp"
#include "piola/mechanics/contact/surface.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// Particles whose velocity is prescribed in some directions: at zero, or as `velocity` says.
struct Support {
  enum class Frame {
    axes,    ///< the directions in `fix`
    normal,  ///< along `normal`: a roller on an oblique plane
    tangent  ///< across `normal`: the particle may move along the normal alone
  };
  std::vector<std::int64_t> particles;  ///< ids
  std::array<bool, 3> fix{};
  Frame frame = Frame::axes;
  std::array<double, 3> normal{};                          ///< unit vector
  std::optional<std::array<Expression, 3>> velocity;       ///< m/s, in X, Y, Z, t; nothing: at rest
  double until = std::numeric_limits<double>::infinity();  ///< s: released then
  std::string name = {};
  std::array<double, 3> about{};  ///< point of its moment: the middle of its particles at the start [m]
};

/// A dead load: particle k feels the acceleration value(X, t) * factor[k].
struct Load {
  std::vector<std::int64_t> particles;  ///< ids
  std::vector<double> factor;  ///< traction [Pa]: area / mass; force per volume [N/m^3]: 1 / density; acceleration: 1
  std::array<Expression, 3> value;
  double until = std::numeric_limits<double>::infinity();  ///< s: gone then
  /// Outward unit normal of the loaded face in the reference configuration, if the load is a traction.
  std::optional<std::array<double, 3>> normal = {};
  std::vector<std::array<double, 3>> normals = {};  ///< the same particle by particle, of curved faces
  bool pressure = false;                            ///< the value's first component is a pressure [Pa] on that face
  bool follows = false;                             ///< a pressure on the deformed face, along its current normal
  std::string name = {};                            ///< empty: its force is not recorded
  std::array<double, 3> about{};  ///< point of its moment: the middle of its particles at the start [m]

  bool on_face() const { return normal.has_value() || !normals.empty(); }
  /// Of the face at particle k.
  std::array<double, 3> normal_of(std::size_t k) const { return normals.empty() ? *normal : normals[k]; }
};

/// A face of a box across which the body is continued by its mirror image.
struct MirrorPlane {
  std::size_t body = 0;
  int axis = 0;
  bool upper = false;  ///< at the largest coordinate, else at the smallest
  bool skew = false;   ///< the image moves the opposite way: zero velocity along the plane; small strains
};

/// A rigid obstacle that bodies slide on without friction.
struct RigidShape {
  enum class Kind { plane, sphere, cylinder, box };
  std::string name;
  Kind kind = Kind::plane;
  std::array<double, 3> centre{};        ///< of sphere, cylinder and box; a point of the plane [m]
  std::array<double, 3> axis{0, 0, 1};   ///< unit vector: plane: outward normal, towards the bodies; cylinder: its axis
  std::array<double, 3> half_lengths{};  ///< box: half its edges; cylinder: half its length in the first [m]
  double radius = 0;                     ///< sphere, cylinder [m]
  std::array<Expression, 3> velocity;    ///< prescribed, in t [m/s]
};

/// What keeps bodies of one run apart.
struct ContactRule {
  enum class Law {
    none,    ///< bodies see each other as one
    kernel,  ///< repulsion by the kernel, stiffness from the impedances
    linear,  ///< linear spring with the stiffness of the material: slow impacts
    printed  ///< repulsion by the kernel with a constant and current volumes, as published
  };
  Law law = Law::kernel;
  double scale = 1;                                                 ///< factor on the stiffness
  double stiffness = std::numeric_limits<double>::quiet_NaN();      ///< printed: K [Pa/m^D]; nan: not given
  double closing_speed = std::numeric_limits<double>::quiet_NaN();  ///< [m/s]; nan: from the initial velocities
  double friction = 0;  ///< mu of Coulomb's law, between surfaces and on rigid shapes that surfaces meet
  double exponent = 4;  ///< n of eq. (15)
};

/// Everything that a formulation is built from: plain numbers in Id order, no input text.
struct Assembly {
  ParticleSet particles;
  std::vector<MaterialParameters> materials;                ///< one per body
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
  std::vector<contact::Surface> surfaces;                 ///< one per body, or empty: no surface contact
  bool pushed = false;                                    ///< Formulation::push will be called
  double cfl = std::numeric_limits<double>::quiet_NaN();  ///< nan: the scheme's default
  std::string machine = "auto";                           ///< instruction set: auto, scalar, v3, v4
};

}  // namespace piola
