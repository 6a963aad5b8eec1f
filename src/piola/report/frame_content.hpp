// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/report/page_surfaces.hpp"
#include "piola/report/plan.hpp"
#include <optional>

namespace piola::report {

/// Optional data to show particles as surfaces or stretched balls.
struct Shaping {
  std::optional<BodyShapes> shapes = {};
  std::optional<PageSurfaces> surfaces = {};  ///< then only with `shapes`
};

/// Codes of a frame as in a plan: positions (on the surface for particles at one), then fields, then the components of
/// V if balls are stretched.
FrameCodes planned_codes(FrameReader const& frame, Survey const& survey, Lattice const& lattice, Plan const& plan,
                         Shaping const& shaping);

/// The bodies of the particles that a page holds.
std::vector<std::uint16_t> planned_bodies(Survey const& survey, Plan const& plan, Shaping const& shaping);

}  // namespace piola::report
