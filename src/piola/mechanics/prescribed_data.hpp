// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <cstdint>

/// Held and loaded particles for loops: plain data, independent of the instruction set.
namespace piola {

/// A direction in which supports prescribe the velocity of a particle. The directions of one particle are orthonormal.
struct PrescribedDirection {
  Index slot;
  std::int32_t axis;        ///< the direction is this axis; -1: oblique
  bool at_rest;             ///< during the whole time that it is held
  double direction[3];      ///< unit vector
  double position;          ///< of a particle held at rest along an axis [m]
  double mass;              ///< of the particle [kg]
  bool multiplied;          ///< multipliers enforce the interpolated velocity; that of the particle may differ
  double start_speed;       ///< prescribed velocity at the start of the step [m/s]
  double speed;             ///< prescribed velocity at the end of the step [m/s]
  double mean_speed;        ///< over the step [m/s]: the displacement is dt times it
  double work;              ///< of the reaction in this step [J]
  std::int32_t support;     ///< index in the assembly
  double at_start, at_end;  ///< velocity changes by the support in this step, at its start and end positions [m/s]
};

/// A loaded particle; pairs of values: at the start and at the end of the step.
struct LoadedParticle {
  Index slot;
  double mass;              ///< [kg]
  double dead[2][3]{};      ///< acceleration by dead loads [m/s2]
  double follower[2][3]{};  ///< by follower pressures, before the face is deformed [m/s2]
  double acting[2][3]{};    ///< by all of them [m/s2]
  double turn[2][9]{};      ///< cof F, which rotates follower pressures
  double work = 0;          ///< in this step [J]
};

}  // namespace piola
