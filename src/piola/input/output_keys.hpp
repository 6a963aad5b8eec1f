// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/bound_keys.hpp"
#include "piola/input/case_spec.hpp"
#include <span>

/// Rows of the schema of [output]. Order: that of the manual.
namespace piola {

using OutputKey = BoundKey<OutputSpec>;
using PictureKey = BoundKey<PictureSpec>;
using PicturesKey = BoundKey<PicturesSpec>;
using CutKey = BoundKey<CutPlane>;

std::span<OutputKey const> output_keys();      ///< output and its frames, history and checkpoints
std::span<PictureKey const> picture_keys();    ///< of a picture
std::span<PictureKey const> panel_keys();      ///< of a panel, which takes missing values from the picture
std::span<PicturesKey const> pictures_keys();  ///< of all pictures of a run
std::span<CutKey const> cut_keys();

}  // namespace piola
