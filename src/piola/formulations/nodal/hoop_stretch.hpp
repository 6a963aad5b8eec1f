// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/scaled_body.hpp"
#include <array>

/// Hoop stretch of axisymmetric bodies, at set-up. Lengths in spacings. Theory: docs/theory/axisymmetry.md, section 2.
namespace piola::nodal {

/// Integrals of a radial field over the section of a cell, weights of (value; derivatives r, z, rr, zz, rz) at the
/// particle.
using SectionFunctional = std::array<double, 6>;

/// int f dA, in the order of NormalMoments.
std::array<double, 10> integral_over_section(SectionMoments const& section);

/// F_33 = eta_0 + t_1 eta_1 + t_2 eta_2 at the points t of a cell, the projection of f / R on linear functions with the
/// weight R. The functionals eta_n [1/spacing]. `L`: Cholesky factor of the spread, row by row.
std::array<SectionFunctional, 3> hoop_functionals(ScaledCell const& cell, SectionMoments const& section,
                                                  std::array<double, 4> const& L);

/// Moments of the section of an image. The weight of the radius is positive on both sides of the axis, so that
/// integrals of f / R times the weight change sign there.
SectionMoments reflected_section(SectionMoments section, std::array<double, 3> const& sign);

/// The section of a cell on a plane together with its other half.
SectionMoments completed_section(SectionMoments const& section, std::size_t axis);

}  // namespace piola::nodal
