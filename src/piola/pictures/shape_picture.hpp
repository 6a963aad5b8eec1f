// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/pictures/picture_overrides.hpp"

namespace piola {

/// How the bodies of a case are drawn before a run: with the picture settings of the case, changed by `look`.
struct ShapePictureOptions {
  PictureOverrides look = {};
  bool patches = false;  ///< colours by patch: interior particles are grey
};

/// Draws the initial particles of a case, coloured by body or by patch, and its rigid shapes. A particle on several
/// patches has the colour of the one with the largest part. Throws InputError if patches are requested and there are
/// none.
Image draw_shape(CaseSpec const& spec, ParticleSet const& particles, ShapePictureOptions const& options);

}  // namespace piola
