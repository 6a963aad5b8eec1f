// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/mechanics/contact/ties.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace piola::contact {
namespace {

constexpr double near_enough = 0.5;   // of a spacing: points farther from the planes of the other body are not held
constexpr double least_share = 0.05;  // points that see less of a face are beyond its rim
constexpr double looked_at = 2;       // spacings: largest distance at which a point counts as facing a rigid shape
constexpr double opposed = 0.5;       // cosine between the normals of a point and a rigid shape that it lies on

std::size_t index(Index k) { return static_cast<std::size_t>(k); }

/// Points and areas of one tie and side that are near enough to be held, and those left.
class TiedAreas {
 public:
  explicit TiedAreas(Ties::TieReport& report) : report_(report) {}
  /// far: from the other side [spacings]; area [m^(D-1)]. Returns whether the point is held.
  bool hold(std::size_t side, double far, double area) {
    report_.nearest = std::min(report_.nearest, far);
    if (far > near_enough) {
      report_.left += 1;
      left_ += area;
      return false;
    }
    report_.farthest = std::max(report_.farthest, far);
    report_.points[side] += 1;
    held_ += area;
    return true;
  }
  /// Adds the areas to the report.
  void finish() const {
    report_.area += held_.value();
    report_.left_area += left_.value();
  }

 private:
  Ties::TieReport& report_;
  exec::ReproducibleSum held_, left_;
};

}  // namespace

/// Surfaces where they are at the start.
struct Ties::Binding {
  ParticleSet const& set;
  std::vector<Surface> const& surfaces;
  HostParticles const& hosts;
  std::vector<Mat<3>> F;                   ///< by host particle
  std::vector<std::vector<Plane>> planes;  ///< by body and point

  Binding(ParticleSet const& particles, std::vector<Surface> const& all, HostParticles const& of,
          std::vector<Vec<3>> const& x)
      : set(particles), surfaces(all), hosts(of), F(index(of.count())), planes(all.size()) {
    exec_host::parallel_for(of.count(), [&](Index k) { F[index(k)] = of.F(k, x); });
    for (std::size_t b = 0; b < all.size(); ++b)
      for (std::size_t k = 0; k < all[b].points.size(); ++k) {
        SurfacePoint const& p = all[b].points[k];
        Index const host = of.of(b, k);
        planes[b].push_back(
            {x[index(of.self(host))] + F[index(host)] * p.offset, push_forward_normal(F[index(host)], p.normal)});
      }
  }

  /// Points of body b that a point sees, ascending, with their weights.
  std::vector<std::pair<std::size_t, double>> weights(Plane const& point, std::size_t b, CellGrid const& grid,
                                                      double reach) const {
    std::vector<std::pair<std::size_t, double>> seen;
    grid.visit({point.y[0], point.y[1], point.y[2]}, [&](Index j) {
      Plane const& source = planes[b][index(j)];
      Vec<3> const r = point.y - source.y;
      double const w = plane_weight(dot(r, r) / (reach * reach), dot(point.n, source.n));
      if (w > 0) seen.emplace_back(index(j), w);
    });
    std::sort(seen.begin(), seen.end());
    return seen;
  }
};

Ties::Ties(std::vector<TieRule> rules, ParticleSet const& set, std::vector<Surface> const& surfaces,
           HostParticles const& hosts, std::vector<Vec<3>> const& x, std::vector<RigidSurface> const& rigids)
    : rules_(std::move(rules)), found_(rules_.size()), on_first_(rules_.size()), on_rigid_(rigids.size()) {
  PIOLA_EXPECTS(rules_.empty() || x.size() >= hosts.ids().size());
  if (rules_.empty()) return;
  Binding const at(set, surfaces, hosts, x);
  for (std::size_t tie = 0; tie < rules_.size(); ++tie) {
    PIOLA_EXPECTS(!rules_[tie].rigid || *rules_[tie].rigid < rigids.size());
    PIOLA_EXPECTS(rules_[tie].bodies[0] < surfaces.size() && rules_[tie].bodies[1] < surfaces.size());
    if (rules_[tie].rigid) {
      bind_to_rigid(tie, rigids[*rules_[tie].rigid], at);
      continue;
    }
    for (std::size_t side = 0; side < 2; ++side) bind(tie, side, at);
  }
  list_by_particle(x.size());
  opened_.resize(rows_.size());
  lost_.resize(rows_.size());
  pulls_.resize(rows_.size());
}

/// Holds the points of one body that lie on the other one.
void Ties::bind(std::size_t tie, std::size_t side, Binding const& at) {
  TieRule const& rule = rules_[tie];
  std::size_t const a = rule.bodies[side], b = rule.bodies[1 - side];
  Surface const &own = at.surfaces[a], &other = at.surfaces[b];
  PairRule const pair = pair_rule(rule.stiffness, own.modulus, own.spacing, other.modulus, other.spacing);
  double const K = 2 * pair.stiffness, dp = 2 * pair.length;  // of both sides together
  CohesiveLaw const law = cohesive_law(K, rule.strength, rule.toughness, rule.shear_weight);
  found_[tie].stiffness = K;
  TiedAreas areas(found_[tie]);
  std::vector<std::array<double, 3>> places;
  for (Plane const& plane : at.planes[b]) places.push_back({plane.y[0], plane.y[1], plane.y[2]});
  CellGrid const grid(places, pair.reach);
  for (std::size_t k = 0; k < own.points.size(); ++k) {
    SurfacePoint const& point = own.points[k];
    if (!selects(rule, point, at)) continue;
    Plane const& plane = at.planes[a][k];
    auto shares = at.weights(plane, b, grid, pair.reach);
    std::vector<double> weights(shares.size());
    Gap const gap = blended_gap(
        plane, static_cast<Index>(shares.size()),
        [&](Index j) -> Plane const& { return at.planes[b][shares[index(j)].first]; }, pair.reach, weights.data());
    if (!gap.seen()) continue;
    double const seen = fade(gap.tau2(), pair.fade_from, pair.fade_to).value * coverage(gap.weight).value;
    if (!(seen > least_share)) continue;
    double const area = 0.5 * seen * point.area;
    if (!areas.hold(side, std::fabs(gap.gap) / dp, area)) continue;
    for (auto& share : shares) share.second /= gap.weight;
    add_row(tie, {a, k, b}, area, law, at, shares);
  }
  areas.finish();
}

/// Ties the points of a body that lie on a rigid shape, with the whole law: the shape has no points of its own.
void Ties::bind_to_rigid(std::size_t tie, RigidSurface const& rigid, Binding const& at) {
  TieRule const& rule = rules_[tie];
  std::size_t const a = rule.bodies[0];
  Surface const& own = at.surfaces[a];
  double const K = penalty_stiffness(1, rule.stiffness, own.modulus, own.spacing);
  CohesiveLaw const law = cohesive_law(K, rule.strength, rule.toughness, rule.shear_weight);
  found_[tie].stiffness = K;
  TiedAreas areas(found_[tie]);
  for (std::size_t k = 0; k < own.points.size(); ++k) {
    SurfacePoint const& point = own.points[k];
    if (!selects(rule, point, at)) continue;
    Plane const& plane = at.planes[a][k];
    Distance const d = distance_from(rigid, plane.y);
    double const far = std::fabs(d.value) / own.spacing;
    if (!(far < looked_at) || !(-dot(plane.n, d.normal) > opposed)) continue;
    if (!areas.hold(0, far, point.area)) continue;
    add_row(tie, {a, k, at.surfaces.size() + *rule.rigid}, point.area, law, at, {});
    rows_.back().rigid = *rule.rigid;
    rows_.back().arm = transpose(rigid.turn) * (plane.y - rigid.centre);
  }
  areas.finish();
}

/// Whether a tie means a point at all.
bool Ties::selects(TieRule const& rule, SurfacePoint const& point, Binding const& at) {
  Vec<3> const Y = vector_of(at.set.X[static_cast<std::size_t>(point.particle)]) + point.offset;
  return !point.image && (!rule.where || (*rule.where)({Y[0], Y[1], Y[2]}) != 0);
}

/// c of y_p = x_p + F_p S by the positions around p; the factor of the particle itself is left to the caller.
void Ties::add_row(std::size_t tie, Hold const& hold, double area, CohesiveLaw const& law, Binding const& at,
                   std::vector<std::pair<std::size_t, double>> const& shares) {
  std::map<Index, double> own, other;
  auto const add = [&](std::map<Index, double>& to, Index host, double factor, Vec<3> const& arm) {
    Index const self = at.hosts.self(host);
    to[self] += factor;
    for (std::size_t j = at.hosts.first(host); j < at.hosts.last(host); ++j) {
      HostParticles::Neighbour const& b = at.hosts.neighbour(j);
      double const c = factor * dot(b.g, arm);
      to[b.at] += c;
      to[self] -= c;
    }
  };
  SurfacePoint const& point = at.surfaces[hold.body].points[hold.point];
  Index const host = at.hosts.of(hold.body, hold.point), self = at.hosts.self(host);
  add(own, host, 1, point.offset);
  Vec<3> const& y = at.planes[hold.body][hold.point].y;
  for (auto const& [source, share] : shares) {
    Index const with = at.hosts.of(hold.other, source);
    Vec<3> const away = inverse(at.F[index(with)]) * (y - at.planes[hold.other][source].y);
    add(other, with, -share, at.surfaces[hold.other].points[source].offset + away);
  }
  Row row{tie, hold, host, point.normal, area, law, terms_.size(), 0, 0};
  terms_.push_back({self, 0});
  for (auto const& [particle, c] : own)
    if (particle != self) terms_.push_back({particle, c});
  row.other = terms_.size();
  for (auto const& [particle, c] : other) terms_.push_back({particle, c});
  row.last = terms_.size();
  // So that the forces of a row sum to nothing, or to that on a rigid shape.
  terms_[row.first].c = shares.empty() ? 1 : 0;
  for (std::size_t k = row.first + 1; k < row.last; ++k) terms_[row.first].c -= terms_[k].c;
  rows_.push_back(row);
}

void Ties::list_by_particle(std::size_t particles) {
  std::vector<std::size_t> count(particles);
  for (Term const& term : terms_) ++count[index(term.at)];
  std::vector<std::size_t> place(particles);
  begin_ = {0};
  for (std::size_t k = 0; k < particles; ++k) {
    if (count[k] == 0) continue;
    place[k] = begin_.back();
    touched_.push_back(static_cast<Index>(k));
    begin_.push_back(begin_.back() + count[k]);
  }
  by_particle_.resize(terms_.size());
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t k = rows_[r].first; k < rows_[r].last; ++k)
      by_particle_[place[index(terms_[k].at)]++] = {static_cast<Index>(r), terms_[k].c};
  forces_.resize(particles);
}

/// The largest eigenvalue of M^-1 C^T K C is at most that of the same product of absolute values, which is at most the
/// largest growth of any positive vector.
double Ties::frequency2(std::vector<double> const& inverse_masses) const {
  constexpr int rounds = 40;
  std::vector<double> v(forces_.size(), 1.0), next;
  double bound = rows_.empty() ? 0 : std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds && bound > 0; ++round) {
    next.assign(v.size(), 0);
    for (Row const& row : rows_) {
      double sum = 0;
      for (std::size_t k = row.first; k < row.last; ++k) sum += std::fabs(terms_[k].c) * v[index(terms_[k].at)];
      sum *= row.area * row.law.stiffness * std::max(1.0, row.law.shear2);
      for (std::size_t k = row.first; k < row.last; ++k) next[index(terms_[k].at)] += std::fabs(terms_[k].c) * sum;
    }
    double growth = 0, largest = 0;
    for (Index const i : touched_) {
      next[index(i)] *= inverse_masses[index(i)];
      if (v[index(i)] > 0) growth = std::max(growth, next[index(i)] / v[index(i)]);
      largest = std::max(largest, next[index(i)]);
    }
    bound = std::min(bound, growth);
    if (!(largest > 0)) break;
    for (double& value : next) value /= largest;
    v.swap(next);
  }
  return bound;
}

}  // namespace piola::contact
