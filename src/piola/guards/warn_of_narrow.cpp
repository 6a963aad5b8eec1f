// SPDX-License-Identifier: Apache-2.0
#include "piola/guards/warn_of_narrow.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/contact_capabilities.hpp"
#include "piola/model/region_checks.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace piola {
namespace {

using Kind = RigidShape::Kind;

/// Lengths of the edges of a box from the shortest to the longest; of a cylinder and a sphere the diameter comes first.
std::array<double, 3> widths_of(RigidShape const& rigid, int dimension) {
  if (rigid.kind == Kind::plane) return {INFINITY, INFINITY, INFINITY};
  double const across = 2 * rigid.radius;
  if (rigid.kind == Kind::sphere) return {across, across, across};
  std::array<double, 3> widths{across, across, 2 * rigid.half_lengths[0]};
  if (rigid.kind == Kind::box) {
    for (std::size_t c = 0; c < 3; ++c) widths[c] = 2 * rigid.half_lengths[c];
    if (dimension == 3 && widths[2] < widths[1]) std::swap(widths[1], widths[2]);
    if (widths[1] < widths[0]) std::swap(widths[0], widths[1]);
    if (dimension == 3 && widths[2] < widths[1]) std::swap(widths[1], widths[2]);
  }
  return widths;
}

/// Whether a body begins in front of a narrow end of a plane box.
bool stands_before_end(RigidShape const& rigid, BodySpec const& spec, ParticleSet const& particles, Body const& body) {
  std::size_t const across = rigid.half_lengths[0] < rigid.half_lengths[1] ? 0 : 1, along = 1 - across;
  for (auto id = body.first; id < body.last; ++id) {
    auto const x = start_of(spec, particles.X[static_cast<std::size_t>(id)]);
    if (std::fabs(x[across] - rigid.centre[across]) < rigid.half_lengths[across] + body.spacing[across] &&
        std::fabs(x[along] - rigid.centre[along]) > rigid.half_lengths[along])
      return true;
  }
  return false;
}

void warn_of_tool(RigidSpec const& rigid, BodySpec const& body, double width, double spacing, Problems& found) {
  found.add(
      place_of(rigid.places, ""),
      fmt::format("the rigid shape {} is {} wide, less than the spacing of body {}, {}: contact takes it for "
                  "one spacing wide, so that piercing and stress around it are not resolved - take a spacing of {} or "
                  "less where these matter",
                  in_quotes(rigid.name), quantity_text(width, "m"), in_quotes(body.name), quantity_text(spacing, "m"),
                  quantity_text(0.5 * width, "m", 2)));
}

void warn_of_sheet(RigidSpec const& rigid, BodySpec const& body, double width, double spacing, Problems& found) {
  found.add(
      place_of(rigid.places, ""),
      fmt::format("the rigid shape {} is {} thick, less than the spacing of body {}, {}: particles of adaptle that "
                  "get past its middle are pushed out at its far side (contact_overlap is above 1 then) - make it "
                  "thicker, or take contact.law = \"surface\" with bodies that stay total-Lagrangian",
                  in_quotes(rigid.name), quantity_text(width, "m"), in_quotes(body.name), quantity_text(spacing, "m")));
}

}  // namespace

void warn_of_narrow_shapes(CaseSpec const& spec, ParticleSet const& particles, Problems& found) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  int const D = particles.dimension;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    for (std::size_t r = 0; r < spec.rigids.size(); ++r) {
      RigidSpec const& rigid = spec.rigids[r];
      double const spacing =
          *std::max_element(particles.bodies[b].spacing.begin(), particles.bodies[b].spacing.begin() + D);
      auto const widths = widths_of(rigid, D);
      if (has_kernel_contact(spec, b) && !rigid.turns()) {
        double const least = *std::min_element(widths.begin(), widths.begin() + D);
        if (least < spacing) warn_of_sheet(rigid, spec.bodies[b], least, spacing, found);
        continue;
      }
      // A plate is narrow in one direction, a needle in all but one.
      bool const plate = rigid.kind == Kind::box && D == 2;
      if (!pushed_by_rigid(spec, b, r) || !(widths[D == 3 ? 1 : 0] < spacing)) continue;
      if (!plate || stands_before_end(rigid, spec.bodies[b], particles, particles.bodies[b]))
        warn_of_tool(rigid, spec.bodies[b], widths[D == 3 ? 1 : 0], spacing, found);
    }
}

}  // namespace piola
