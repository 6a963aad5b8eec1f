// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/mirrored_assembly.hpp"
#include "piola/base/contracts.hpp"
#include "piola/particles/body_extents.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace piola {
namespace {

using Coordinates = std::array<double, 3>;
using ImageOrigin = MirroredAssembly::Origin;

/// A point near a plane feels surfaces within two spacings and a skin, and those are carried by particles within three
/// spacings more.
constexpr double surfaces_within = 4, carriers_within = 3.2;  // spacings
constexpr double rounding = 1e-6;                             // of a spacing

double largest_spacing(Body const& body, int dimension) {
  return *std::max_element(body.spacing.begin(), body.spacing.begin() + dimension);
}

struct SymmetryPlane {
  std::size_t axis;
  bool upper;
  double at;  ///< [m]
};

std::vector<SymmetryPlane> planes_of(Assembly const& whole, std::size_t b) {
  BodyExtents const ends = extents_of(whole.particles, whole.particles.bodies[b]);
  std::vector<SymmetryPlane> planes;
  for (MirrorPlane const& mirror : whole.mirrors) {
    if (mirror.body != b) continue;
    auto const axis = static_cast<std::size_t>(mirror.axis);
    planes.push_back({axis, mirror.upper, ends.at[axis][mirror.upper ? 1 : 0]});
  }
  return planes;
}

/// One body with its images, in the order in which they are found.
class BodyImages {
 public:
  BodyImages(Assembly const& whole, std::size_t b, double depth)
      : whole_(whole), rounding_(rounding * largest_spacing(whole.particles.bodies[b], whole.particles.dimension)) {
    Body const& body = whole.particles.bodies[b];
    std::vector<SymmetryPlane> const planes = planes_of(whole, b);
    for (auto id = body.first; id < body.last; ++id) all_.push_back({id, {1, 1, 1}, {0, 0, 0}, false});
    for (std::size_t k = 0; !planes.empty() && k < all_.size(); ++k) known_.insert(key_of(all_[k]));
    // Images of images behind edges; between two planes the body goes on without end.
    for (std::size_t before = 0; !planes.empty() && before != all_.size();) {
      before = all_.size();
      for (SymmetryPlane const& plane : planes) reflect(plane, depth);
    }
  }
  std::vector<ImageOrigin> const& all() const { return all_; }
  Coordinates place(ImageOrigin const& origin) const {
    Coordinates X = whole_.particles.X[static_cast<std::size_t>(origin.id)];
    for (std::size_t c = 0; c < 3; ++c) X[c] = origin.sign[c] * X[c] + origin.shift[c];
    return X;
  }

 private:
  /// A place of a particle, to a hundredth of a thousandth of a spacing.
  std::array<long long, 4> key_of(ImageOrigin const& origin) const {
    Coordinates const X = place(origin);
    std::array<long long, 4> key{0, 0, 0, origin.id};
    for (std::size_t c = 0; c < 3; ++c) key[c] = std::llround(X[c] / (10 * rounding_));
    return key;
  }
  void reflect(SymmetryPlane const& plane, double depth) {
    for (std::size_t k = 0, n = all_.size(); k < n; ++k) {
      ImageOrigin image = all_[k];
      double const inside = (plane.upper ? -1 : 1) * (place(image)[plane.axis] - plane.at);
      if (!(inside > rounding_ && inside < depth)) continue;
      image.sign[plane.axis] *= -1;
      image.shift[plane.axis] = 2 * plane.at - image.shift[plane.axis];
      image.image = true;
      if (known_.insert(key_of(image)).second) all_.push_back(image);
    }
  }

  Assembly const& whole_;
  double rounding_;
  std::set<std::array<long long, 4>> known_;
  std::vector<ImageOrigin> all_;
};

Vec<3> turned(ImageOrigin const& origin, Vec<3> const& a) {
  return {{origin.sign[0] * a[0], origin.sign[1] * a[1], origin.sign[2] * a[2]}};
}

bool lies_on(SymmetryPlane const& plane, Assembly const& whole, contact::SurfacePoint const& point) {
  auto const axis = static_cast<int>(plane.axis);
  double const X = whole.particles.X[static_cast<std::size_t>(point.particle)][plane.axis] + point.offset[axis];
  double const size = std::sqrt(dot(point.offset, point.offset)) + std::fabs(plane.at) + std::fabs(X);
  return (plane.upper ? 1 : -1) * point.normal[axis] > 1 - 1e-9 && std::fabs(X - plane.at) <= 1e-9 * size;
}

/// Points of one body, then those of its images.
contact::Surface surface_of(Assembly const& whole, std::size_t b, std::vector<ImageOrigin> const& all,
                            std::int64_t first) {
  contact::Surface surface = whole.surfaces[b];
  for (SymmetryPlane const& plane : planes_of(whole, b))
    std::erase_if(surface.points, [&](auto const& point) { return lies_on(plane, whole, point); });
  std::vector<contact::SurfacePoint> points = surface.points;
  std::map<std::int64_t, std::vector<std::size_t>> of_particle;
  std::int64_t const own = whole.particles.bodies[b].first;
  for (std::size_t k = 0; k < points.size(); ++k) {
    of_particle[points[k].particle].push_back(k);
    surface.points[k].particle += first - own;
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    auto const found = all[k].image ? of_particle.find(all[k].id) : of_particle.end();
    if (found == of_particle.end()) continue;
    for (std::size_t const p : found->second)
      surface.points.push_back({first + static_cast<std::int64_t>(k), turned(all[k], points[p].offset),
                                turned(all[k], points[p].normal), points[p].area, true});
  }
  return surface;
}

}  // namespace

MirroredAssembly::MirroredAssembly(Assembly const& whole) : assembly(whole) {
  PIOLA_EXPECTS(whole.mirrors.empty() || whole.surfaces.size() == whole.particles.bodies.size());
  PIOLA_EXPECTS(whole.initial_displacement.empty() || whole.initial_displacement.size() == whole.particles.X.size());
  if (whole.mirrors.empty()) return;
  ParticleSet const& particles = whole.particles;
  double depth = 0;
  for (Body const& body : particles.bodies)
    depth = std::max(depth, surfaces_within * largest_spacing(body, particles.dimension));
  std::vector<Coordinates> X, displacement;
  for (std::size_t b = 0; b < particles.bodies.size(); ++b) {
    Body const& from = particles.bodies[b];
    BodyImages const images(whole, b, depth + carriers_within * largest_spacing(from, particles.dimension));
    auto const first = static_cast<std::int64_t>(origins.size());
    for (ImageOrigin const& origin : images.all()) {
      origins.push_back(origin);
      X.push_back(images.place(origin));
      if (whole.initial_displacement.empty()) continue;
      displacement.push_back(whole.initial_displacement[static_cast<std::size_t>(origin.id)]);
      for (std::size_t c = 0; c < 3; ++c) displacement.back()[c] *= origin.sign[c];
    }
    Body& body = assembly.particles.bodies[b];
    body.first = first;
    body.last = static_cast<std::int64_t>(origins.size());
    assembly.surfaces[b] = surface_of(whole, b, images.all(), first);
    mirrors.emplace_back();
    for (SymmetryPlane const& plane : planes_of(whole, b))
      mirrors.back().push_back({static_cast<int>(plane.axis), plane.at, plane.upper ? -1.0 : 1.0});
    for (SymmetryPlane const& plane : planes_of(whole, b))
      for (auto id = from.first; id < from.last; ++id)
        if (std::fabs(particles.X[static_cast<std::size_t>(id)][plane.axis] - plane.at) <
            rounding * largest_spacing(from, particles.dimension))
          on_planes.push_back({id, static_cast<int>(plane.axis)});
  }
  assembly.particles.X = std::move(X);
  assembly.initial_displacement = std::move(displacement);
}

}  // namespace piola
