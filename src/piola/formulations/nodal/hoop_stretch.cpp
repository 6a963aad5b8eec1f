// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/hoop_stretch.hpp"

namespace piola::nodal {
namespace {

/// Integral of f r^i z^j dA, for powers that sum to one at most.
SectionFunctional weighted(SectionMoments const& section, int i, int j) {
  auto const of = [&](int m, int n) { return section.of[SectionMoments::at(m + i, n + j)]; };
  return {of(0, 0), of(1, 0), of(0, 1), 0.5 * of(2, 0), 0.5 * of(0, 2), of(1, 1)};
}

SectionFunctional combined(SectionFunctional const& a, double by, SectionFunctional const& b, double scale) {
  SectionFunctional r;
  for (std::size_t m = 0; m < r.size(); ++m) r[m] = (a[m] + by * b[m]) * scale;
  return r;
}

}  // namespace

std::array<double, 10> integral_over_section(SectionMoments const& section) {
  SectionFunctional const f = weighted(section, 0, 0);
  return {f[0], f[1], f[2], 0, f[3], f[4], 0, 0, 0, f[5]};
}

std::array<SectionFunctional, 3> hoop_functionals(ScaledCell const& cell, SectionMoments const& section,
                                                  std::array<double, 4> const& L) {
  double const per_volume = 1 / cell.volume;
  SectionFunctional const whole = weighted(section, 0, 0);
  SectionFunctional const along_r = combined(weighted(section, 1, 0), -cell.centroid[0], whole, per_volume),
                          along_z = combined(weighted(section, 0, 1), -cell.centroid[1], whole, per_volume);
  // L^-1, from the first row to the second.
  SectionFunctional const first = combined(along_r, 0, whole, 1 / L[0]);
  return {combined(whole, 0, whole, per_volume), first, combined(along_z, -L[2], first, 1 / L[3])};
}

SectionMoments reflected_section(SectionMoments section, std::array<double, 3> const& sign) {
  for (std::size_t m = 0; m < SectionMoments::powers.size(); ++m) {
    auto const [i, j] = SectionMoments::powers[m];
    section.of[m] *= (i % 2 == 0 ? sign[0] : 1) * (j % 2 == 0 ? 1 : sign[1]);
  }
  return section;
}

SectionMoments completed_section(SectionMoments const& section, std::size_t axis) {
  std::array<double, 3> across{1, 1, 1};
  across[axis] = -1;
  SectionMoments sum = reflected_section(section, across);
  for (std::size_t m = 0; m < SectionMoments::powers.size(); ++m) sum.of[m] += section.of[m];
  return sum;
}

}  // namespace piola::nodal
