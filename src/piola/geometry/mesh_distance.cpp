// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh_distance.hpp"
#include "piola/base/contracts.hpp"
#include "piola/geometry/mesh_normals.hpp"
#include <algorithm>
#include <cmath>
#include <embree3/rtcore.h>
#include <limits>
#include <new>

namespace piola::geometry {

namespace {

struct CrossingCount : RTCIntersectContext {
  int crossings = 0;
};

void count_crossing(RTCFilterFunctionNArguments const* arguments) {
  ++static_cast<CrossingCount*>(arguments->context)->crossings;
  arguments->valid[0] = 0;  // go on
}

/// Directions of the rays: no two alike, none along an axis or a usual angle.
constexpr std::array<std::array<double, 3>, 7> ray_directions{{{0.4297, 0.7713, 0.4694},
                                                               {-0.6311, 0.2849, 0.7215},
                                                               {0.1873, -0.8529, 0.4873},
                                                               {0.8387, -0.3319, -0.4316},
                                                               {-0.3571, 0.5237, -0.7734},
                                                               {-0.7919, -0.5527, -0.2596},
                                                               {0.2633, 0.1109, -0.9583}}};

}  // namespace

struct MeshDistance::Search {
  /// The search in progress for one place: the nearest foot so far.
  struct Nearest {
    Vec<3> X;
    double square = std::numeric_limits<double>::infinity();
    int face = -1;
    TriangleFoot foot{};
  };

  Surface surface;
  SurfaceNormals normals;
  Sign sign;
  std::vector<char> flat;
  Bounds box;
  Vec<3> centre{};
  double size = 1;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Search(Surface const& given, Links const& links, Sign how) : surface(given), normals(given, links), sign(how) {
    box = bounds_of(surface);
    centre = 0.5 * (box.min + box.max);
    size = largest_extent(box);
    flat.resize(surface.corner.size());
    for (int face = 0; face < surface.faces(); ++face) flat[face] = static_cast<char>(surface.is_flat(face));
    device = rtcNewDevice("threads=1,set_affinity=0");
    if (device == nullptr) throw std::bad_alloc();
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    fill_scene();
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
      release();
      throw std::bad_alloc();
    }
  }
  ~Search() { release(); }
  Search(Search const&) = delete;
  Search& operator=(Search const&) = delete;

  void release() const {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  Vec<3> scaled(Vec<3> const& X) const { return (1 / size) * (X - centre); }

  void fill_scene() {
    RTCGeometry const geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const X = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                3 * sizeof(float), surface.X.size()));
    auto* const corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), surface.corner.size()));
    if (X != nullptr && corners != nullptr) {
      for (std::size_t i = 0; i < surface.X.size(); ++i)
        for (int k = 0; k < 3; ++k) X[3 * i + k] = static_cast<float>(scaled(surface.X[i])[k]);
      for (std::size_t f = 0; f < surface.corner.size(); ++f)
        for (int k = 0; k < 3; ++k) corners[3 * f + k] = static_cast<unsigned>(surface.corner[f][k]);
      rtcSetGeometryPointQueryFunction(geometry, &offer);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry);
  }

  void measure(int face, Nearest& nearest) const {
    auto const& c = surface.corner[face];
    TriangleFoot const foot = foot_on_triangle(nearest.X, surface.X[c[0]], surface.X[c[1]], surface.X[c[2]]);
    Vec<3> const gap = nearest.X - foot.X;
    double const square = dot(gap, gap);
    if (square > nearest.square || (square == nearest.square && face > nearest.face)) return;
    nearest.square = square;
    nearest.face = face;
    nearest.foot = foot;
  }

  struct CandidateFacets {
    Search const* search;
    Nearest best;
    double slack;  ///< what single precision may be wrong by, in the scaled box
  };

  static bool offer(RTCPointQueryFunctionArguments* arguments) {
    auto& offers = *static_cast<CandidateFacets*>(arguments->userPtr);
    int const face = static_cast<int>(arguments->primID);
    if (offers.search->flat[face]) return false;
    double const before = offers.best.square;
    offers.search->measure(face, offers.best);
    if (offers.best.square == before) return false;
    double const distance = std::sqrt(offers.best.square) / offers.search->size;
    arguments->query->radius = static_cast<float>(distance * (1 + 1e-6) + offers.slack);
    return true;
  }

  Nearest nearest_to(Vec<3> const& X) const;
  RTCRayHit ray(Vec<3> const& X, Vec<3> const& direction, double start) const;
};

MeshDistance::Search::Nearest MeshDistance::Search::nearest_to(Vec<3> const& X) const {
  // Further away than this single precision is useless, and every face is measured.
  constexpr double farthest = 1e4;
  Vec<3> const q = scaled(X);
  double const reach = std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2])});
  CandidateFacets offers{this, {X}, 1e-6 * (1 + reach)};
  if (reach < farthest) {
    RTCPointQuery query{};
    query.x = static_cast<float>(q[0]);
    query.y = static_cast<float>(q[1]);
    query.z = static_cast<float>(q[2]);
    query.radius = std::numeric_limits<float>::infinity();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &query, &context, nullptr, &offers);
  } else {
    for (int face = 0; face < surface.faces(); ++face)
      if (!flat[face]) measure(face, offers.best);
  }
  return offers.best;
}

RTCRayHit MeshDistance::Search::ray(Vec<3> const& X, Vec<3> const& direction, double start) const {
  Vec<3> const q = scaled(X);
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(q[0]);
  ray.ray.org_y = static_cast<float>(q[1]);
  ray.ray.org_z = static_cast<float>(q[2]);
  ray.ray.dir_x = static_cast<float>(direction[0]);
  ray.ray.dir_y = static_cast<float>(direction[1]);
  ray.ray.dir_z = static_cast<float>(direction[2]);
  ray.ray.tnear = static_cast<float>(start / size);
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

MeshDistance::MeshDistance(Surface const& surface, Links const& links, Sign sign)
    : search_(std::make_unique<Search>(surface, links, sign)) {
  PIOLA_EXPECTS(links.across.size() == 3 * surface.corner.size());
}

MeshDistance::~MeshDistance() = default;

Foot MeshDistance::at(Vec<3> const& X) const {
  Search::Nearest const nearest = search_->nearest_to(X);
  if (nearest.face < 0) return {std::numeric_limits<double>::infinity(), {{1, 0, 0}}};  // all faces are flat
  Vec<3> const gap = X - nearest.foot.X, n = search_->normals.at(nearest.face, nearest.foot.feature);
  double const distance = std::sqrt(nearest.square);
  // Below this the difference of two places has no direction any more, and the surface's own is as good.
  constexpr double touching = 1e-9;
  bool const inside = search_->sign == Sign::rays ? inside_by_rays(X) : dot(gap, n) < 0;
  double const sign = inside ? -1 : 1;
  if (distance < touching * search_->size) return {sign * distance, n};
  return {sign * distance, (sign / distance) * gap};
}

bool MeshDistance::inside_by_rays(Vec<3> const& X) const {
  for (int i = 0; i < 3; ++i)
    if (!(X[i] >= search_->box.min[i] && X[i] <= search_->box.max[i])) return false;
  int inside = 0;
  for (auto const& d : ray_directions) {
    RTCRayHit ray = search_->ray(X, {{d[0], d[1], d[2]}}, 0);
    CrossingCount context;
    rtcInitIntersectContext(&context);
    context.filter = &count_crossing;
    rtcOccluded1(search_->scene, &context, &ray.ray);
    inside += context.crossings % 2;
  }
  return 2 * inside > static_cast<int>(ray_directions.size());
}

std::optional<MeshDistance::Hit> MeshDistance::ahead(Vec<3> const& X, Vec<3> const& direction, double start) const {
  RTCRayHit ray = search_->ray(X, direction, start);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(search_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return Hit{static_cast<double>(ray.ray.tfar) * search_->size, static_cast<int>(ray.hit.primID)};
}

}  // namespace piola::geometry
