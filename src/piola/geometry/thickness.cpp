// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/thickness.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

namespace piola::geometry {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Straight inwards from a foot on the surface, by steps of the distance.
struct InwardRay {
  Solid const& solid;
  double shortest, longest;  ///< steps [m]

  /// The way to the face opposite, if that is less than `most`; X becomes half of it.
  double from(Vec<3> const& place, double most, Vec<3>& X) const {
    constexpr double opposite = 0.8;
    constexpr int most_steps = 1000;
    Foot const first = solid.at(place);
    Vec<3> const start = place - first.distance * first.normal, inwards = -1.0 * first.normal;
    double way = shortest;
    for (int k = 0; k < most_steps && way < most; ++k) {
      Foot const foot = solid.at(start + way * inwards);
      if (foot.distance >= 0) {
        double const facing = dot(foot.normal, inwards);
        if (facing < opposite) return nowhere;
        way -= foot.distance / facing;
        X = start + (0.5 * way) * inwards;
        return way;
      }
      double const step = std::max(-foot.distance, shortest);
      way += solid.distance_is_bound() ? step : std::min(step, longest);
    }
    return nowhere;
  }
};

/// Leaves the first piece in each cube of a given side [m]: a mesh may have far more faces than the question needs.
void thin_out(std::vector<SurfacePiece>& pieces, double side) {
  std::set<std::array<std::int64_t, 3>> taken;
  std::erase_if(pieces, [&](SurfacePiece const& piece) {
    std::array<std::int64_t, 3> cube{};
    for (int i = 0; i < 3; ++i)
      cube[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(piece.X[i] / side));
    return !taken.insert(cube).second;
  });
}

}  // namespace

std::optional<Thinnest> thinnest(Solid const& solid, double edge) {
  PIOLA_EXPECTS(edge > 0);
  constexpr std::size_t together = 4096;  // pieces per batch; a batch uses the result of earlier batches as its bound
  constexpr double shortest = 1e-3;       // of a piece
  std::vector<SurfacePiece> pieces;
  solid.cut_surface(edge, pieces);
  thin_out(pieces, 0.25 * edge);
  InwardRay const ray{solid, shortest * edge, edge};
  Thinnest best{nowhere, {}};
  std::vector<Thinnest> found(std::min(pieces.size(), together));
  for (std::size_t first = 0; first < pieces.size(); first += together) {
    std::size_t const count = std::min(together, pieces.size() - first);
    exec_host::parallel_for(static_cast<Index>(count), [&](Index k) {
      Thinnest& one = found[static_cast<std::size_t>(k)];
      one.thickness = ray.from(pieces[first + static_cast<std::size_t>(k)].X, best.thickness, one.X);
    });
    for (std::size_t k = 0; k < count; ++k)
      if (found[k].thickness < best.thickness) best = found[k];
  }
  if (!(best.thickness < nowhere)) return std::nullopt;
  return best;
}

}  // namespace piola::geometry
