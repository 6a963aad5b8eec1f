// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/face_parts.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

using Point = std::array<double, 3>;

/// A patch may be nearest to a particle behind the loaded ones. It belongs to one of these if that is not farther away
/// than this [spacings]: where a curved surface cuts a corner off a cell, which then has less than `corner` of the
/// surface, or on irregular clouds.
constexpr double beside = 1.01, corner = 0.5, behind = 0.75;

/// The part of a body's surface that a load acts on, patch by patch.
template <int D>
class LoadedFace {
 public:
  LoadedFace(SetUp const& from, Fits<D> const& fits, std::vector<SurfacePatch> const& patches, Load const& load)
      : load_(load),
        body_(from.body),
        fits_(fits),
        place_(static_cast<std::size_t>(from.order.particles), none),
        area_(place_.size(), 0) {
    std::vector<std::size_t> of_id(static_cast<std::size_t>(body_.last - body_.first), none);
    for (std::size_t k = 0; k < load.particles.size(); ++k)
      if (load.particles[k] >= body_.first && load.particles[k] < body_.last)
        of_id[static_cast<std::size_t>(load.particles[k] - body_.first)] = k;
    for (std::size_t slot = 0; slot < place_.size(); ++slot)
      place_[slot] = of_id[static_cast<std::size_t>(from.order.id[slot] - body_.first)];
    for (std::size_t k = 0; k < load.particles.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) faces_[c] = faces_[c] || load.normal_of(k)[c] != 0;
    for (auto const& patch : patches)
      if (faces_[static_cast<std::size_t>(patch.axis)]) area_[static_cast<std::size_t>(patch.particle)] += patch.area;
  }

  /// Cosine between the patch and the exact surface there; zero where the load does not act.
  double cosine(SurfacePatch const& patch) const { return std::max(0.0, facing(patch)); }

  /// Whether it is part of that surface. Sides of blocks beside a pole may look away from it a little.
  bool has(SurfacePatch const& patch) const { return facing(patch) > -0.5; }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// -1 where the load does not act.
  double facing(SurfacePatch const& patch) const {
    auto const axis = static_cast<std::size_t>(patch.axis);
    if ((load_.normal && !patch.outermost) || !faces_[axis]) return -1;
    std::size_t const k = place_of(static_cast<std::size_t>(patch.particle));
    return k == none ? -1 : load_.normal_of(k)[axis] * (patch.upper ? 1 : -1);
  }

  /// Which of the load's particles answers for what is nearest to a.
  std::size_t place_of(std::size_t a) const {
    if (place_[a] != none) return place_[a];
    std::size_t found = none;
    double const reach = !load_.normal && area_[a] < corner ? beside : body_.regular ? 0 : behind;
    double least = reach * reach;
    auto const& X = fits_.X();
    for (std::size_t n = fits_.pairs().first(a); n < fits_.pairs().end(a); ++n) {
      std::size_t const b = fits_.pairs().at(n);
      double square = 0;
      for (std::size_t c = 0; c < 3; ++c) square += (X[b][c] - X[a][c]) * (X[b][c] - X[a][c]);
      if (place_[b] == none || square >= least) continue;
      least = square;
      found = place_[b];
    }
    return found;
  }

  Load const& load_;
  Body const& body_;
  Fits<D> const& fits_;
  std::array<bool, 3> faces_{};     ///< the surface faces along these axes
  std::vector<std::size_t> place_;  ///< of a slot among the load's particles
  std::vector<double> area_;        ///< of a slot's patches along these axes, in spacings
};

/// Areas times normals, added up over patches as they are.
template <int D>
std::vector<FacePart> vector_parts(LoadedFace<D> const& face, Divergence<D> const& divergence, Point const& area) {
  std::vector<Point> sum;
  for (int axis = 0; axis < D; ++axis) {
    auto const share = divergence.shares([&](SurfacePatch const& p) {
      double const whole = p.axis == axis && face.has(p) ? area[static_cast<std::size_t>(axis)] : 0;
      return p.upper ? whole : -whole;
    });
    sum.resize(share.size());
    for (std::size_t b = 0; b < share.size(); ++b) sum[b][static_cast<std::size_t>(axis)] = share[b];
  }
  std::vector<FacePart> parts(sum.size());
  for (std::size_t b = 0; b < sum.size(); ++b) {
    double const size = std::sqrt(sum[b][0] * sum[b][0] + sum[b][1] * sum[b][1] + sum[b][2] * sum[b][2]);
    if (!(size > 0)) continue;
    parts[b] = {size, {sum[b][0] / size, sum[b][1] / size, sum[b][2] / size}};
  }
  return parts;
}

/// Areas of the exact surface: what patches show of themselves along its normals.
template <int D>
std::vector<FacePart> scalar_parts(LoadedFace<D> const& face, Divergence<D> const& divergence, Point const& area,
                                   std::optional<Point> const& normal) {
  auto const share =
      divergence.shares([&](SurfacePatch const& p) { return face.cosine(p) * area[static_cast<std::size_t>(p.axis)]; });
  std::vector<FacePart> parts(share.size());
  for (std::size_t b = 0; b < share.size(); ++b) parts[b] = {share[b], normal.value_or(Point{})};
  return parts;
}

}  // namespace

template <int D>
std::vector<std::vector<FacePart>> face_parts(SetUp const& from, Fits<D> const& fits, Divergence<D> const& divergence,
                                              std::array<double, 3> const& h) {
  std::vector<std::vector<FacePart>> parts;
  Point area{1, 1, 1};  // of a patch of size one in spacings, by its axis
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) area[axis] *= c == axis ? 1 : h[c];
  for (auto const& load : from.loads) {
    parts.emplace_back();
    if (!load.on_face()) continue;
    LoadedFace<D> const face(from, fits, divergence.patches(), load);
    parts.back() = load.normal || !load.pressure ? scalar_parts<D>(face, divergence, area, load.normal)
                                                 : vector_parts<D>(face, divergence, area);
  }
  return parts;
}

template std::vector<std::vector<FacePart>> face_parts<1>(SetUp const&, Fits<1> const&, Divergence<1> const&,
                                                          std::array<double, 3> const&);
template std::vector<std::vector<FacePart>> face_parts<2>(SetUp const&, Fits<2> const&, Divergence<2> const&,
                                                          std::array<double, 3> const&);
template std::vector<std::vector<FacePart>> face_parts<3>(SetUp const&, Fits<3> const&, Divergence<3> const&,
                                                          std::array<double, 3> const&);

}  // namespace piola::nodal
