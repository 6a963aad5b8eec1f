// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/bound_keys.hpp"
#include "piola/input/case_spec.hpp"
#include <span>

/// Rows of the schema of [run]. Order: that of the manual.
namespace piola {

using RunKey = BoundKey<RunSpec>;
using GuardKey = BoundKey<GuardLimits>;

std::span<RunKey const> run_keys();
std::span<GuardKey const> guard_keys();

}  // namespace piola
