// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/registry.hpp"
#include <span>

/// The laws of Piola that work on blocks of points, as those of libraries do (piola_material.h). Adding one: a file in
/// this folder that defines its LawInfo, its name here and in own_laws.cpp.
namespace piola::block_laws {

extern LawInfo const arruda_boyce, drucker_prager, holmquist_johnson_cook, ogden, orthotropic, p_alpha, viscoelastic;

/// All of them; their indices are set by the registry.
std::span<LawInfo const* const> own_laws();

}  // namespace piola::block_laws
