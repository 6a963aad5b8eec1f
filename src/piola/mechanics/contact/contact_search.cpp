// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/mechanics/contact/surface_contact.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>

namespace piola::contact {
namespace {

/// Rotating planes move a little farther than their particles; this fraction of the skin allows for that.
constexpr double share_of_skin = 1.0 / 3;
/// Opposing normals have a negative product; until lists are rebuilt they rotate by no more than this margin allows.
constexpr double facing = 0.8;

/// The box around some places.
struct Box {
  Vec<3> low{{1e300, 1e300, 1e300}}, high{{-1e300, -1e300, -1e300}};
  void add(Vec<3> const& y) {
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], y[c]);
      high[c] = std::max(high[c], y[c]);
    }
  }
  bool holds(Vec<3> const& y, double margin) const {
    for (int c = 0; c < 3; ++c)
      if (!(y[c] > low[c] - margin && y[c] < high[c] + margin)) return false;
    return true;
  }
};

}  // namespace

bool SurfaceContactSystem::lists_hold(std::vector<Vec<3>> const& x) const {
  if (listed_at_.empty()) return false;
  double const most = share_of_skin * skin_ * share_of_skin * skin_;
  for (Index k = 0; k < hosts_.count(); ++k)
    if (!(square_of(x[at(hosts_.self(k))] - listed_at_[at(k)]) < most)) return false;
  for (std::size_t r = 0; r < rigids_.size(); ++r)
    if (!(travel_from(listed_rigids_[r], rigids_[r]) < share_of_skin * skin_)) return false;
  return true;
}

/// Whether two points that are near each other may push: those of one body not across its own thickness or corners.
bool SurfaceContactSystem::may_touch(Index target, Index source) const {
  Point const &a = points_[at(target)], &b = points_[at(source)];
  if (a.body != b.body) return true;
  return dot(planes_[at(target)].n, planes_[at(source)].n) < facing && !own_[a.body].hold(a.host, b.host);
}

/// Sources of body b for every point that may be near it.
void SurfaceContactSystem::list_sources(std::size_t b, std::vector<Index> const& of_body, Vec<3> const& low,
                                        Vec<3> const& high) {
  Box const box{low, high};
  auto const reach = [&](Point const& p) {
    return is_active(p.body, b) && !p.image ? rules_[p.body][b].reach + skin_ : -1.0;
  };
  double largest = 0;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (double const r = reach(points_[k]); r > 0 && box.holds(planes_[k].y, r)) largest = std::max(largest, r);
  if (!(largest > 0)) return;
  std::vector<std::array<double, 3>> places;
  places.reserve(of_body.size());
  for (Index const k : of_body) places.push_back({planes_[at(k)].y[0], planes_[at(k)].y[1], planes_[at(k)].y[2]});
  CellGrid const grid(places, largest);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    double const r = reach(points_[k]);
    Vec<3> const& y = planes_[k].y;
    if (!(r > 0) || is_dropped(k) || is_left_out(k, b) || !box.holds(y, r)) continue;
    std::size_t const first = sources_.size();
    grid.visit({y[0], y[1], y[2]}, [&](Index j) {
      Index const source = of_body[at(j)];
      if (square_of(planes_[at(source)].y - y) < r * r && may_touch(static_cast<Index>(k), source))
        sources_.push_back(source);
    });
    std::sort(sources_.begin() + static_cast<std::ptrdiff_t>(first), sources_.end());
    if (sources_.size() > first) runs_.push_back({static_cast<Index>(k), b, first, sources_.size()});
  }
}

void SurfaceContactSystem::exclude_pair(std::size_t body, std::size_t point, std::size_t other, bool out) {
  PIOLA_EXPECTS(body < surfaces_.size() && point < surfaces_[body].points.size());
  PIOLA_EXPECTS(other < others());
  left_out_.resize(points_.size() * others());
  left_out_[place_of(body, point) * others() + other] = out ? 1 : 0;
  listed_at_.clear();
}

void SurfaceContactSystem::drop(std::vector<char> const& lost) {
  PIOLA_EXPECTS(lost.size() == ids().size());
  dropped_.resize(points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (lost[at(hosts_.self(points_[k].host))] != 0) dropped_[k] = 1;
  listed_at_.clear();
}

double SurfaceContactSystem::stored_at(std::size_t body, std::size_t point, std::size_t other) const {
  PIOLA_EXPECTS(body < surfaces_.size() && point < surfaces_[body].points.size());
  PIOLA_EXPECTS(other < others());
  std::size_t const target = place_of(body, point);
  if (other >= surfaces_.size()) {
    std::size_t const r = other - surfaces_.size();
    Surface const& own = surfaces_[body];
    if (!is_tested(static_cast<Index>(target), r)) return 0;
    double const k = penalty_stiffness(1, with_rigid(body, r).factor, own.modulus, own.spacing);
    return points_[target].area *
           layer(distance_on_side(static_cast<Index>(target), r).value, k, 0.5 * own.spacing).energy;
  }
  for (std::size_t k = 0; k < runs_.size(); ++k) {
    if (at(runs_[k].target) != target || runs_[k].body != other || !gaps_[k].seen()) continue;
    PairRule const& rule = rules_[body][other];
    return points_[target].area * layer(gaps_[k].gap, rule.stiffness, rule.length).energy *
           fade(gaps_[k].tau2(), rule.fade_from, rule.fade_to).value * coverage(gaps_[k].weight).value;
  }
  return 0;
}

void SurfaceContactSystem::list_points_near_rigids() {
  near_rigid_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    auto const point = static_cast<Index>(k);
    double const reach = skin_ + near * surfaces_[points_[k].body].spacing;
    bool any = false;
    for (std::size_t r = 0; r < rigids_.size() && !any && !points_[k].image; ++r)
      any = is_tested(point, r) && (kept(point, r) != nullptr || distance_from(rigids_[r], planes_[k].y).value < reach);
    if (any) near_rigid_.push_back(point);
  }
}

void SurfaceContactSystem::activate(std::vector<char> const& points) {
  std::vector<char> carries(at(hosts_.count()), 0);
  active_points_.clear();
  active_hosts_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (points[k] == 0) continue;
    active_points_.push_back(static_cast<Index>(k));
    carries[at(points_[k].host)] = 1;
  }
  for (std::size_t k = 0; k < carries.size(); ++k)
    if (carries[k] != 0) active_hosts_.push_back(static_cast<Index>(k));
}

void SurfaceContactSystem::make_lists(std::vector<Vec<3>> const& x) {
  activate(std::vector<char>(points_.size(), 1));
  place_points(x);
  std::vector<std::vector<Index>> of_body(surfaces_.size());
  std::vector<Box> boxes(surfaces_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (is_dropped(k)) continue;
    of_body[points_[k].body].push_back(static_cast<Index>(k));
    boxes[points_[k].body].add(planes_[k].y);
  }
  runs_.clear();
  sources_.clear();
  for (std::size_t b = 0; b < surfaces_.size(); ++b)
    if (!of_body[b].empty()) list_sources(b, of_body[b], boxes[b].low, boxes[b].high);
  list_points_near_rigids();
  list_shape_points(of_body);

  std::vector<char> active(points_.size(), 0);
  for (Run const& run : runs_) active[at(run.target)] = 1;
  for (Index const k : sources_) active[at(k)] = 1;
  for (Index const k : near_rigid_) active[at(k)] = 1;
  activate(active);
  listed_at_.clear();
  for (Index k = 0; k < hosts_.count(); ++k) listed_at_.push_back(x[at(hosts_.self(k))]);
  listed_rigids_.clear();
  for (RigidSurface const& rigid : rigids_) listed_rigids_.push_back(pose_of(rigid));
}

}  // namespace piola::contact
