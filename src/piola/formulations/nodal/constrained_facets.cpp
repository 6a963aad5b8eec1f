// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/constrained_facets.hpp"
#include "piola/formulations/nodal/loaded_face.hpp"
#include "piola/formulations/nodal/surface_integrals.hpp"
#include <limits>
#include <map>

namespace piola::nodal {
namespace {

/// A place smaller than this [spacings^(D-1)] has its particle far from it, and is merged.
constexpr double least_part = 0.25;

/// A part of a face while it is added up, in spacings.
struct Part {
  double area = 0;
  std::array<double, 3> first{};    ///< integral of X
  std::map<Index, double> weights;  ///< by slot; they sum to the area

  std::array<double, 3> middle() const { return {first[0] / area, first[1] / area, first[2] / area}; }
  void add(Part const& other) {
    area += other.area;
    for (std::size_t c = 0; c < 3; ++c) first[c] += other.first[c];
    for (auto const& [slot, weight] : other.weights) weights[slot] += weight;
  }
};

/// The integral of the motion over a patch.
template <int D>
Part part_of(LocalFits<D> const& fits, SurfacePatch const& patch, double counts) {
  Part part;
  auto const a = static_cast<std::size_t>(patch.particle);
  auto moments = patch.extent;
  for (double& m : moments) m *= counts;
  part.area = moments[0];
  for (std::size_t c = 0; c < 3; ++c) part.first[c] = moments[0] * fits.X()[a][c] + moments[1 + c];
  each_share<D>(fits, a, moments, [&](std::size_t k, double share) {
    part.weights[static_cast<Index>(particle_of_share<D>(fits, a, k))] += share;
  });
  return part;
}

/// Merges places that are too small into others; returns the rest.
std::vector<Part> without_slivers(std::vector<Part> const& all) {
  std::vector<Part> parts, slivers;
  double largest = 0;
  for (auto const& part : all) largest = std::max(largest, part.area);
  for (auto const& part : all)
    if (part.area > 0) (part.area < std::min(least_part, largest) ? slivers : parts).push_back(part);
  std::vector<std::array<double, 3>> middles;
  for (auto const& part : parts) middles.push_back(part.middle());
  for (auto const& sliver : slivers) {
    auto const X = sliver.middle();
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < parts.size(); ++k) {
      double square = 0;
      for (std::size_t c = 0; c < 3; ++c) square += (middles[k][c] - X[c]) * (middles[k][c] - X[c]);
      if (square < least) nearest = k;
      least = std::min(least, square);
    }
    parts[nearest].add(sliver);
  }
  return parts;
}

template <int D>
std::vector<Part> parts_of(SetUp const& from, LocalFits<D> const& fits, std::vector<SurfacePatch> const& patches,
                           Support const& support) {
  Load face;
  face.particles = support.particles;
  face.normals = support.normals;
  face.patch = support.patch;
  face.whole_patch = support.whole_patch;
  LoadedFace<D> const held(from, fits, patches, face);
  std::vector<Part> parts(support.particles.size());
  for (auto const& patch : patches) {
    double const cosine = held.cosine(patch);
    if (cosine > 0) parts[held.owner(patch)].add(part_of<D>(fits, patch, cosine));
  }
  return without_slivers(parts);
}

ConstrainedFacet place_of(Part const& part, std::array<double, 3> const& h) {
  ConstrainedFacet place;
  for (std::size_t c = 0; c < 3; ++c) place.X[c] = part.middle()[c] * h[c];
  for (auto const& [slot, weight] : part.weights) place.weights.push_back({slot, weight / part.area});
  return place;
}

}  // namespace

template <int D>
std::vector<ConstrainedFacet> constrained_facets(SetUp const& from, LocalFits<D> const& fits,
                                                 std::vector<SurfacePatch> const& patches,
                                                 std::array<double, 3> const& h) {
  std::vector<ConstrainedFacet> places;
  std::map<std::array<double, 3>, std::size_t>
      known;  // two supports may hold the same place, each of them in its own directions
  for (std::size_t s = 0; s < from.supports.size(); ++s) {
    if (!from.supports[s].on_surface()) continue;
    for (auto const& part : parts_of<D>(from, fits, patches, from.supports[s])) {
      ConstrainedFacet const place = place_of(part, h);
      auto const [at, is_new] = known.try_emplace(place.X, places.size());
      if (is_new) places.push_back(place);
      places[at->second].supports.push_back(s);
    }
  }
  return places;
}

template std::vector<ConstrainedFacet> constrained_facets<1>(SetUp const&, LocalFits<1> const&,
                                                             std::vector<SurfacePatch> const&,
                                                             std::array<double, 3> const&);
template std::vector<ConstrainedFacet> constrained_facets<2>(SetUp const&, LocalFits<2> const&,
                                                             std::vector<SurfacePatch> const&,
                                                             std::array<double, 3> const&);
template std::vector<ConstrainedFacet> constrained_facets<3>(SetUp const&, LocalFits<3> const&,
                                                             std::vector<SurfacePatch> const&,
                                                             std::array<double, 3> const&);

}  // namespace piola::nodal
