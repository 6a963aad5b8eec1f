// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/constrained_facets.hpp"
#include "piola/formulations/nodal/load_integrals.hpp"
#include "piola/formulations/nodal/loaded_face.hpp"
#include "piola/formulations/nodal/surface_integrals.hpp"
#include <cmath>
#include <limits>
#include <map>

namespace piola::nodal {
namespace {

/// A place smaller than this [spacings^(D-1)] has its particle far from it, and is merged.
constexpr double least_part = 0.25;

/// A part of a face while it is added up, in spacings.
struct Part {
  double area = 0;
  std::array<double, 3> first{};        ///< integral of X
  std::map<Index, double> weights{};    ///< by slot or image; they sum to the area
  double size = 0;                      ///< [m^(D-1)], without what is behind mirror planes
  std::array<double, 3> normal_area{};  ///< integral of the unit normal, in units of the size
  Index slot = 0;                       ///< of a particle

  std::array<double, 3> middle() const { return {first[0] / area, first[1] / area, first[2] / area}; }
  void add(Part const& other) {
    area += other.area;
    size += other.size;
    for (std::size_t c = 0; c < 3; ++c) {
      first[c] += other.first[c];
      normal_area[c] += other.normal_area[c];
    }
    for (auto const& [at, weight] : other.weights) weights[at] += weight;
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

/// The places of a face on this side of mirror planes. `h`: spacings [m].
template <int D>
std::vector<Part> parts_of(SetUp const& from, LocalFits<D> const& fits, std::vector<SurfacePatch> const& patches,
                           Load const& face, std::array<double, 3> const& h) {
  LoadedFace<D> const on(from, fits, patches, face);
  auto const unit = unit_areas<D>(from, h);
  std::vector<Part> parts(face.particles.size());
  for (auto const& patch : patches) {
    double const cosine = on.cosine(patch);
    if (!(cosine > 0) || patch.particle >= from.order.particles) continue;
    std::size_t const owner = on.owner(patch);
    Part part = part_of<D>(fits, patch, cosine);
    part.size = part.area * unit[static_cast<std::size_t>(patch.axis)] /
                (from.images != nullptr ? from.images->multiplicity(patch.particle) : 1);
    for (std::size_t c = 0; c < 3; ++c) part.normal_area[c] = part.size * face.normal_of(owner)[c];
    parts[owner].add(part);
    parts[owner].slot = patch.particle;
  }
  return without_slivers(parts);
}

Load face_of(Support const& support) {
  Load face;
  face.particles = support.particles;
  face.normals = support.normals;
  face.patch = support.patch;
  face.whole_patch = support.whole_patch;
  return face;
}

ConstrainedFacet place_of(Part const& part, std::array<double, 3> const& h) {
  ConstrainedFacet place;
  for (std::size_t c = 0; c < 3; ++c) place.X[c] = part.middle()[c] * h[c];
  for (auto const& [slot, weight] : part.weights) place.weights.push_back({slot, weight / part.area});
  return place;
}

/// The facet of a part. Weights of mirror images are added to those of their sources.
AbsorbingFacet facet_of(SetUp const& from, Part const& part, ConstrainedFacet const& place) {
  AbsorbingFacet facet{.X = place.X, .normal = part.normal_area, .area = part.size, .slot = part.slot};
  double const length = std::sqrt(dot(facet.normal, facet.normal));
  for (double& n : facet.normal) n /= length;
  std::map<Index, std::array<double, 3>> weights;
  for (auto const& w : place.weights) {
    Index const image = w.slot - from.order.particles;
    auto& of = weights[from.source_of(w.slot)];
    for (std::size_t c = 0; c < 3; ++c) of[c] += w.weight * (image < 0 ? 1 : from.images->sign(image)[c]);
  }
  for (auto const& [slot, of] : weights) facet.weights.push_back({slot, of});
  return facet;
}

}  // namespace

template <int D>
std::vector<AbsorbingFacet> absorbing_facets(SetUp const& from, LocalFits<D> const& fits,
                                             std::vector<SurfacePatch> const& patches, std::array<double, 3> const& h) {
  std::vector<AbsorbingFacet> facets;
  for (std::size_t l = 0; l < from.loads.size(); ++l) {
    Load const& load = from.loads[l];
    double const exact = load.absorbs ? exact_area(from, load).size : 0;
    if (!(exact > 0)) continue;  // another load, or on another body
    std::size_t const first = facets.size();
    double found = 0;
    for (auto const& part : parts_of<D>(from, fits, patches, load, h)) {
      facets.push_back(facet_of(from, part, place_of(part, h)));
      facets.back().load = l;
      found += part.size;
    }
    for (std::size_t k = first; k < facets.size(); ++k) facets[k].area *= exact / found;
  }
  return facets;
}

template <int D>
std::vector<ConstrainedFacet> constrained_facets(SetUp const& from, LocalFits<D> const& fits,
                                                 std::vector<SurfacePatch> const& patches,
                                                 std::array<double, 3> const& h) {
  std::vector<ConstrainedFacet> places;
  std::map<std::array<double, 3>, std::size_t>
      known;  // two supports may hold the same place, each of them in its own directions
  for (std::size_t s = 0; s < from.supports.size(); ++s) {
    if (!from.supports[s].on_surface()) continue;
    for (auto const& part : parts_of<D>(from, fits, patches, face_of(from.supports[s]), h)) {
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
template std::vector<AbsorbingFacet> absorbing_facets<1>(SetUp const&, LocalFits<1> const&,
                                                         std::vector<SurfacePatch> const&,
                                                         std::array<double, 3> const&);
template std::vector<AbsorbingFacet> absorbing_facets<2>(SetUp const&, LocalFits<2> const&,
                                                         std::vector<SurfacePatch> const&,
                                                         std::array<double, 3> const&);
template std::vector<AbsorbingFacet> absorbing_facets<3>(SetUp const&, LocalFits<3> const&,
                                                         std::vector<SurfacePatch> const&,
                                                         std::array<double, 3> const&);

}  // namespace piola::nodal
