// SPDX-License-Identifier: Apache-2.0
#include "piola/report/frame_content.hpp"
#include "piola/base/contracts.hpp"

namespace piola::report {
namespace {

FrameCodes surface_codes(FrameReader const& frame, FrameStatistics const& survey, Lattice const& lattice,
                         Plan const& plan, SurfaceData const& shaping) {
  BodySurfaces const now = shaping.shapes->surfaces(frame);
  FrameCodes codes;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::uint32_t const i : shaping.surfaces->particles) codes.x[c].push_back(lattice.code(now.place[i][c], c));
  for (std::size_t f = 0; f < plan.fields; ++f) {
    auto& list = codes.fields.emplace_back();
    auto const values = shown_values(frame, survey.fields[f].info);
    for (std::uint32_t const i : shaping.surfaces->particles)
      list.push_back(survey.fields[f].scale.code(static_cast<double>(values[i])));
  }
  return codes;
}

}  // namespace

FrameCodes planned_codes(FrameReader const& frame, FrameStatistics const& survey, Lattice const& lattice,
                         Plan const& plan, SurfaceData const& shaping) {
  if (shaping.surfaces) return surface_codes(frame, survey, lattice, plan, shaping);
  FrameCodes codes = codes_of(frame, survey, lattice, plan.fields, plan.every);
  if (plan.stretched && shaping.shapes)
    for (auto& list : shaping.shapes->stretches(frame, plan.every)) codes.fields.push_back(std::move(list));
  return codes;
}

std::vector<std::uint16_t> planned_bodies(FrameStatistics const& survey, Plan const& plan, SurfaceData const& shaping) {
  PIOLA_EXPECTS(plan.every >= 1);
  std::vector<std::uint16_t> body;
  if (shaping.surfaces)
    for (std::uint32_t const i : shaping.surfaces->particles) body.push_back(survey.body[i]);
  else
    for (std::size_t i = 0; i < survey.particles; i += plan.every) body.push_back(survey.body[i]);
  return body;
}

}  // namespace piola::report
