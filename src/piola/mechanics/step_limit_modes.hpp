// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <span>

/// Vibration modes that estimates of step limits iterate.
namespace piola {

/// Deterministic number from -0.5 to 0.5, equal on every computer, without a pattern that a mode could be orthogonal
/// to.
double pseudo_random(std::uint64_t k);

/// The largest |u_k|.
double largest_of(std::span<double const> u);

/// Start value of the next measurement: `value` of the last mode divided by `most`, plus a random part, so that a new
/// dominant mode is found. Purely random if most is 0. `most`: the largest |value| of the mode; `k`: index of the
/// number.
double refreshed(double value, double most, std::uint64_t k);

}  // namespace piola
