// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/simulation/look.hpp"

namespace piola {

/// How the bodies of a case are drawn before anything runs; what is not given is as the case has it for its pictures.
struct ShapePictureOptions {
  LookOptions look = {};
  bool patches = false;  ///< colours by patch: what is deep inside is grey
};

/// The particles of a case as they start, in the colours of their bodies or of the patches that they stand for, and its
/// rigid shapes. A particle that stands for several patches has the colour of the one with the largest part. Throws
/// InputError if patches are asked for and there are none.
Image draw_shape(CaseSpec const& spec, ParticleSet const& particles, ShapePictureOptions const& options);

}  // namespace piola
