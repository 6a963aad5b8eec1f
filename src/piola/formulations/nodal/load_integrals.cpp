// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/load_integrals.hpp"
#include "piola/domain/sum_over_slots.hpp"
#include "piola/formulations/nodal/loaded_face.hpp"
#include "piola/math/circle.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola::nodal {

using Point = std::array<double, 3>;

WholeArea exact_area(SetUp const& from, Load const& load) {
  WholeArea sum;
  for (std::size_t k = 0; k < load.particles.size(); ++k) {
    auto const id = static_cast<std::size_t>(load.particles[k]);
    if (load.particles[k] < from.body.first || load.particles[k] >= from.body.last) continue;
    double const area = load.factor[k] * from.rho0[part_of(from.set, id)] * from.set.volume[id];
    sum.size += area;
    for (std::size_t c = 0; c < 3; ++c) sum.vector[c] += area * load.normal_of(k)[c];
  }
  return sum;
}

template <int D>
Point unit_areas(SetUp const& from, std::array<double, 3> const& h) {
  Point area{1, 1, 1};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) area[axis] *= c == axis ? 1 : h[c];
  if (from.set.axisymmetric)
    for (double& size : area) size *= circle(h[0]);
  return area;
}

namespace {

using Moments = std::array<double, 10>;

Moments scaled_moments(Moments moments, double by) {
  for (double& m : moments) m *= by;
  return moments;
}

/// Areas times normals, added up over patches as they are.
template <int D>
LazyZeroArray<FacePart> vector_parts(LoadedFace<D> const& face, SurfaceIntegrals<D> const& surface, Point const& area) {
  LazyZeroArray<Point> sum(surface.particles());
  for (std::size_t axis = 0; axis < D; ++axis) {
    auto const share = surface.shares(
        [&](SurfacePatch const& p) { return face.has(p) ? scaled_moments(p.moments[axis], area[axis]) : Moments{}; });
    surface.for_each_local([&](std::size_t b) { sum[b][axis] = share[b]; });
  }
  LazyZeroArray<FacePart> parts(sum.size());
  surface.for_each_local([&](std::size_t b) {
    double const size = std::sqrt(sum[b][0] * sum[b][0] + sum[b][1] * sum[b][1] + sum[b][2] * sum[b][2]);
    if (size > 0) parts[b] = {size, {sum[b][0] / size, sum[b][1] / size, sum[b][2] / size}};
  });
  return parts;
}

/// Areas of the exact surface: projections of the patches on its normals.
template <int D>
LazyZeroArray<FacePart> scalar_parts(LoadedFace<D> const& face, SurfaceIntegrals<D> const& surface, Point const& area,
                                     std::optional<Point> const& normal) {
  auto const share = surface.shares([&](SurfacePatch const& p) {
    return scaled_moments(p.extent, face.cosine(p) * area[static_cast<std::size_t>(p.axis)]);
  });
  LazyZeroArray<FacePart> parts(share.size());
  surface.for_each_local([&](std::size_t b) { parts[b] = {share[b], normal.value_or(Point{})}; });
  return parts;
}

/// Area in the body itself, without its images. Collective on a distributed body.
template <int D>
WholeArea area_of(SetUp const& from, LocalFits<D> const& fits, LazyZeroArray<FacePart> const& parts) {
  Range const own{fits.own().first, std::min(fits.own().last, from.order.particles)};
  auto const sums = sums_over_slots<4>(fits.shared().has_value(), own, [&](Index slot, double* sum) {
    FacePart const& part = parts[static_cast<std::size_t>(slot)];
    sum[0] = part.area / (from.images != nullptr ? from.images->multiplicity(slot) : 1);
    for (int c = 0; c < 3; ++c) sum[1 + c] = sum[0] * part.normal[static_cast<std::size_t>(c)];
  });
  return {sums.value(0), {sums.value(1), sums.value(2), sums.value(3)}};
}

double length_of(Point const& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Compares the area that a load acts on with the exact one, and scales its `parts`, if they are given, to that.
void check_area(SetUp const& from, Load const& load, WholeArea const& found, LazyZeroArray<FacePart>* parts,
                std::vector<SetUpCheck>& checks) {
  constexpr double warned = 1e-3, rounding = 1e-9;
  WholeArea const exact = exact_area(from, load);
  if (!(exact.size > 0)) return;  // on another body
  double error = found.size / exact.size - 1;
  if (parts == nullptr) {
    Point const& v = found.vector;
    error = length_of({v[0] - exact.vector[0], v[1] - exact.vector[1], v[2] - exact.vector[2]}) / exact.size;
  } else if (std::abs(error) > rounding && found.size > 0) {
    for (FacePart& part : *parts) part.area *= exact.size / found.size;
  }
  std::string warning;
  std::string const measured = fmt::format("load '{}': sides of cells make up {:.6g} of an area of {:.6g} m^{}",
                                           load.name, found.size, exact.size, from.set.dimension - 1);
  if (std::abs(error) > warned && parts != nullptr)
    warning = fmt::format(
        "{}; the load is scaled by {:.6g}, so that its total is exact, and approximate within a spacing of the edge - "
        "use smaller spacings if what happens there counts",
        measured, exact.size / found.size);
  else if (std::abs(error) > warned)
    warning =
        fmt::format("{}, and their resultant is wrong by {:.2g} of the area - use smaller spacings", measured, error);
  checks.push_back({load.name + ".area_error", error, warning});
}

}  // namespace

template <int D>
std::vector<LazyZeroArray<double>> face_areas(SetUp const& from, SurfaceIntegrals<D> const& surface,
                                              std::array<double, 3> const& h) {
  Point const area = unit_areas<D>(from, h);
  std::vector<LazyZeroArray<double>> all;
  for (int axis = 0; axis < D; ++axis)
    for (bool const upper : {false, true})
      all.push_back(surface.shares([&](SurfacePatch const& p) {
        bool const on_face = p.outermost && p.axis == axis && p.upper == upper;
        return on_face ? scaled_moments(p.extent, area[static_cast<std::size_t>(axis)]) : Moments{};
      }));
  return all;
}

template <int D>
std::vector<LazyZeroArray<FacePart>> load_integrals(SetUp const& from, LocalFits<D> const& fits,
                                                    SurfaceIntegrals<D> const& surface, FacePartsOf const& of) {
  std::vector<LazyZeroArray<FacePart>> parts;
  Point const area = unit_areas<D>(from, of.h);
  for (auto const& load : from.loads) {
    parts.emplace_back();
    if (!load.on_face() || load.absorbs) continue;
    LoadedFace<D> const face(from, fits, surface.patches(), load);
    bool const by_area = load.normal || !load.pressure;
    parts.back() = by_area ? scalar_parts<D>(face, surface, area, load.normal) : vector_parts<D>(face, surface, area);
    check_area(from, load, area_of(from, fits, parts.back()), by_area ? &parts.back() : nullptr, of.checks);
  }
  return parts;
}

template Point unit_areas<1>(SetUp const&, Point const&);
template Point unit_areas<2>(SetUp const&, Point const&);
template Point unit_areas<3>(SetUp const&, Point const&);
template std::vector<LazyZeroArray<double>> face_areas<1>(SetUp const&, SurfaceIntegrals<1> const&,
                                                          std::array<double, 3> const&);
template std::vector<LazyZeroArray<double>> face_areas<2>(SetUp const&, SurfaceIntegrals<2> const&,
                                                          std::array<double, 3> const&);
template std::vector<LazyZeroArray<double>> face_areas<3>(SetUp const&, SurfaceIntegrals<3> const&,
                                                          std::array<double, 3> const&);
template std::vector<LazyZeroArray<FacePart>> load_integrals<1>(SetUp const&, LocalFits<1> const&,
                                                                SurfaceIntegrals<1> const&, FacePartsOf const&);
template std::vector<LazyZeroArray<FacePart>> load_integrals<2>(SetUp const&, LocalFits<2> const&,
                                                                SurfaceIntegrals<2> const&, FacePartsOf const&);
template std::vector<LazyZeroArray<FacePart>> load_integrals<3>(SetUp const&, LocalFits<3> const&,
                                                                SurfaceIntegrals<3> const&, FacePartsOf const&);

}  // namespace piola::nodal
