// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <cstdint>

/// Particles that supports drive and that loads act on, as loops see them: plain data that crosses between machines.
namespace piola {

/// A direction in which supports prescribe the velocity of a particle. The directions of one particle are orthonormal.
struct HeldDirection {
  Index slot;
  std::int32_t axis;        ///< the direction is this axis; -1: oblique
  bool at_rest;             ///< for as long as it is held
  double direction[3];      ///< unit vector
  double position;          ///< of a particle that is held at rest along an axis [m]
  double mass;              ///< of the particle [kg]
  bool multiplied;          ///< multipliers hold the velocity that is interpolated there; the particle's own may differ
  double start_speed;       ///< prescribed velocity at the start of the step [m/s]
  double speed;             ///< prescribed velocity at the end of the step [m/s]
  double mean_speed;        ///< over the step [m/s]: the displacement is dt times it
  double work;              ///< of the reaction in this step [J]
  std::int32_t support;     ///< the one that holds it, in the order of the assembly
  double at_start, at_end;  ///< changes of velocity by it in this step, at the places of its start and end [m/s]
};

/// A particle on which loads act; values of two: at the start and at the end of the step.
struct LoadedParticle {
  Index slot;
  double mass;            ///< [kg]
  double dead[2][3]{};    ///< acceleration by dead loads [m/s2]
  double follow[2][3]{};  ///< by pressures that follow the face, before it is deformed [m/s2]
  double acting[2][3]{};  ///< by all of them [m/s2]
  double turn[2][9]{};    ///< cof F, which turns the pressures that follow
  double work = 0;        ///< in this step [J]
};

}  // namespace piola
