// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/report/page_surfaces.hpp"
#include "piola/report/plan.hpp"
#include <optional>

namespace piola::report {

/// What makes more of particles than round balls, where a page has it.
struct Shaping {
  std::optional<BodyShapes> shapes = {};
  std::optional<PageSurfaces> surfaces = {};  ///< then only with `shapes`
};

/// The codes of a frame as a plan has it: positions, of particles at a surface on that surface, then fields, then the
/// components of V if balls are stretched.
FrameCodes planned_codes(FrameReader const& frame, Survey const& survey, Lattice const& lattice, Plan const& plan,
                         Shaping const& shaping);

/// The bodies of the particles that a page holds.
std::vector<std::uint16_t> planned_bodies(Survey const& survey, Plan const& plan, Shaping const& shaping);

}  // namespace piola::report
