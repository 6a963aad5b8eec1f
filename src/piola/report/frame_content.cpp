// SPDX-License-Identifier: Apache-2.0
#include "piola/report/frame_content.hpp"
#include "piola/base/contracts.hpp"

namespace piola::report {
namespace {

FrameCodes surface_codes(FrameReader const& frame, FrameStatistics const& statistics, Lattice const& lattice,
                         Plan const& plan, SurfaceData const& surface_data) {
  BodySurfaces const now = surface_data.shapes->surfaces(frame);
  FrameCodes codes;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::uint32_t const i : surface_data.surfaces->particles)
      codes.x[c].push_back(lattice.code(now.place[i][c], c));
  for (std::size_t f = 0; f < plan.fields; ++f) {
    auto& list = codes.fields.emplace_back();
    auto const values = shown_values(frame, statistics.fields[f].info);
    for (std::uint32_t const i : surface_data.surfaces->particles)
      list.push_back(statistics.fields[f].scale.code(static_cast<double>(values[i])));
  }
  return codes;
}

}  // namespace

FrameCodes planned_codes(FrameReader const& frame, FrameStatistics const& statistics, Lattice const& lattice,
                         Plan const& plan, SurfaceData const& surface_data) {
  if (surface_data.surfaces) return surface_codes(frame, statistics, lattice, plan, surface_data);
  FrameCodes codes = codes_of(frame, statistics, lattice, plan.fields, plan.every);
  if (plan.stretched && surface_data.shapes)
    for (auto& list : surface_data.shapes->stretches(frame, plan.every)) codes.fields.push_back(std::move(list));
  return codes;
}

std::vector<std::uint16_t> planned_bodies(FrameStatistics const& statistics, Plan const& plan,
                                          SurfaceData const& surface_data) {
  PIOLA_EXPECTS(plan.every >= 1);
  std::vector<std::uint16_t> body;
  if (surface_data.surfaces)
    for (std::uint32_t const i : surface_data.surfaces->particles) body.push_back(statistics.body[i]);
  else
    for (std::size_t i = 0; i < statistics.particles; i += plan.every) body.push_back(statistics.body[i]);
  return body;
}

}  // namespace piola::report
