// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/report/page_budget.hpp"
#include "piola/report/page_surfaces.hpp"
#include <optional>

namespace piola::report {

/// Optional data to show particles as surfaces or stretched balls.
struct SurfaceData {
  std::optional<BodyShapes> shapes = {};
  std::optional<PageSurfaces> surfaces = {};  ///< then only with `shapes`
};

/// Codes of a frame as in a plan: positions (on the surface for particles at one), then fields, then the components of
/// V if balls are stretched.
FrameCodes planned_codes(FrameReader const& frame, FrameStatistics const& statistics, Lattice const& lattice,
                         Plan const& plan, SurfaceData const& surface_data);

/// The bodies of the particles that a page holds.
std::vector<std::uint16_t> planned_bodies(FrameStatistics const& statistics, Plan const& plan,
                                          SurfaceData const& surface_data);

}  // namespace piola::report
