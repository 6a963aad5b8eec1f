// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/slits.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/neighbours/line_of_sight.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

using Place = std::array<double, 3>;

/// Signed distance of a place from the surface of the whole body, continued behind mirror planes [m].
double distance_from_whole(SetUp const& from, Place X) {
  for (std::size_t c = 0; c < 3 && from.images != nullptr; ++c)
    for (bool const upper : {false, true}) {
      if (!from.images->has_plane(c, upper)) continue;
      double const plane = from.images->plane(c, upper);
      if (upper ? X[c] > plane : X[c] < plane) X[c] = 2 * plane - X[c];
    }
  return from.body.outline.distance(X);
}

/// Lines between places in spacings.
class Slits {
 public:
  Slits(SetUp const& from, ScaledBody const& scaled)
      : h_(scaled.h),
        line_([&from](Place const& X) { return distance_from_whole(from, X); },
              *std::min_element(scaled.h.begin(), scaled.h.begin() + from.set.dimension)) {}

  bool block(Place const& a, Place const& b) const { return line_.is_blocked(in_metres(a), in_metres(b)); }

 private:
  Place in_metres(Place X) const {
    for (std::size_t c = 0; c < 3; ++c) X[c] *= h_[c];
    return X;
  }
  Place h_;
  LineOfSight line_;
};

/// A facet as the surface of one of its two cells. `away`: vector from the middle between the two particles to the
/// particle of that cell.
SurfacePatch patch_of(CellFacet const& facet, Index particle, Place const& away) {
  SurfacePatch patch;
  patch.particle = particle;
  double const sign = particle == facet.a ? 1 : -1;
  Place normal{};
  for (std::size_t J = 0; J < 3; ++J) {
    patch.moments[J] = moments_about(facet.moments[J], away);
    for (double& m : patch.moments[J]) m *= sign;
    normal[J] = patch.moments[J][0];
    if (std::abs(normal[J]) > std::abs(normal[static_cast<std::size_t>(patch.axis)])) patch.axis = static_cast<int>(J);
  }
  patch.upper = normal[static_cast<std::size_t>(patch.axis)] > 0;
  double const area = std::hypot(normal[0], normal[1], normal[2]);
  for (std::size_t J = 0; J < 3 && area > 0; ++J)
    for (std::size_t m = 0; m < patch.extent.size(); ++m) patch.extent[m] += normal[J] / area * patch.moments[J][m];
  return patch;
}

/// Vector from the line between two particles to the centre of their facet, perpendicular to the line.
Place beside_line(CellFacet const& facet, Place const& across) {
  Place centre{};
  double square = 0, along = 0, length = 0;
  for (std::size_t J = 0; J < 3; ++J) square += facet.moments[J][0] * facet.moments[J][0];
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t J = 0; J < 3 && square > 0; ++J)
      centre[c] += facet.moments[J][0] * facet.moments[J][1 + c] / square;
    along += centre[c] * across[c];
    length += across[c] * across[c];
  }
  for (std::size_t c = 0; c < 3; ++c) centre[c] -= along / length * across[c];
  return centre;
}

/// Whether a slit goes through a facet: the line between the particles is blocked, and its parallel through the centre
/// of the facet. At a re-entrant edge that one is not.
bool is_across(Slits const& slits, CellFacet const& facet, Place a, Place b) {
  if (!slits.block(a, b)) return false;
  Place across{};
  for (std::size_t c = 0; c < 3; ++c) across[c] = b[c] - a[c];
  Place const beside = beside_line(facet, across);
  for (std::size_t c = 0; c < 3; ++c) {
    a[c] += beside[c];
    b[c] += beside[c];
  }
  return slits.block(a, b);
}

}  // namespace

std::function<bool(std::size_t, std::size_t)> lines_across_slits(SetUp const& from, ScaledBody const& scaled) {
  if (!from.body.outline.distance) return {};
  return [&scaled, slits = Slits(from, scaled)](std::size_t a, std::size_t b) {
    return slits.block(scaled.X[a], scaled.X[b]);
  };
}

ScaledBody body_with_slits(SetUp const& from, std::optional<LatticeShape> const& lattice) {
  ScaledBody body = scaled_body(from, lattice);
  if (!from.body.outline.distance) return body;
  Slits const slits(from, body);
  auto const count = static_cast<Index>(body.facets.size());
  std::vector<char> is_open(body.facets.size());
  auto const ends = [&](CellFacet const& facet) -> std::pair<Place const&, Place const&> {
    return {body.X[static_cast<std::size_t>(facet.a)], body.X[static_cast<std::size_t>(facet.b)]};
  };
  exec_host::parallel_for(count, [&](Index k) {
    CellFacet const& facet = body.facets[static_cast<std::size_t>(k)];
    auto const [a, b] = ends(facet);
    is_open[static_cast<std::size_t>(k)] = is_across(slits, facet, a, b) ? 1 : 0;
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < is_open.size(); ++k) {
    CellFacet const facet = body.facets[k];
    if (is_open[k] == 0) {
      body.facets[kept++] = facet;
      continue;
    }
    auto const [a, b] = ends(facet);
    Place away{};
    for (std::size_t c = 0; c < 3; ++c) away[c] = 0.5 * (a[c] - b[c]);
    body.patches.push_back(patch_of(facet, facet.a, away));
    for (double& c : away) c = -c;
    body.patches.push_back(patch_of(facet, facet.b, away));
  }
  body.facets.resize(kept);
  return body;
}

}  // namespace piola::nodal
