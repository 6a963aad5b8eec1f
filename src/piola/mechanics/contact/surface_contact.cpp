// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/surface_contact.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <limits>
#include <utility>

namespace piola::contact {
namespace {

constexpr double skin_in_spacings = 0.5;
constexpr double closing = 0.1;  // of a spacing in a step

}  // namespace

SurfaceContactSystem::SurfaceContactSystem(ParticleSet const& particles, std::vector<Surface> surfaces,
                                           std::vector<RigidSurface> rigids, Setting setting)
    : surfaces_(std::move(surfaces)),
      rigids_(std::move(rigids)),
      setting_(std::move(setting)),
      hosts_(particles, surfaces_),
      between_(surfaces_.size(), std::vector<ForceMoment>(surfaces_.size())) {
  for (std::size_t b = 0; b < surfaces_.size(); ++b) {
    Surface const& surface = surfaces_[b];
    if (!surface.points.empty()) skin_ = std::max(skin_, skin_in_spacings * surface.spacing);
    for (std::size_t k = 0; k < surface.points.size(); ++k) {
      SurfacePoint const& p = surface.points[k];
      points_.push_back({hosts_.of(b, k), b, p.offset, p.normal, p.area, p.image});
    }
    rules_.emplace_back();
    for (std::size_t o = 0; o < surfaces_.size(); ++o)
      rules_.back().push_back(pair_rule(setting_[b][o].factor, surface.modulus, surface.spacing, surfaces_[o].modulus,
                                        surfaces_[o].spacing));
    own_.emplace_back();
    if (setting_[b][b].is_active) own_.back() = SelfContactExclusions(particles, b, hosts_, surface.spacing);
    look_at_others(b);
  }
  F_.resize(at(hosts_.count()));
  if (has_friction_) {
    last_F_.resize(F_.size());
    knows_F_.resize(F_.size());
    knows_last_F_.resize(F_.size());
    traces_.resize(points_.size());
  }
  gap_.resize(points_.size());
  normal_force_.resize(points_.size());
  planes_.resize(points_.size());
  loads_.resize(points_.size());
  loaded_.resize(points_.size());
  forces_.resize(ids().size());
  is_pushed_.resize(ids().size());
  inverse_mass_.resize(ids().size());
  on_rigid_.resize(rigids_.size());
  frequencies_.resize(rigids_.size());
}

/// Sets up friction of a body, and its contact with thin or narrow rigid shapes.
void SurfaceContactSystem::look_at_others(std::size_t body) {
  PIOLA_EXPECTS(setting_[body].size() >= others());
  for (PairSetting const& touch : setting_[body])
    has_friction_ = has_friction_ || (touch.is_active && touch.friction.any());
  Surface const& surface = surfaces_[body];
  covered_.emplace_back(rigids_.size());
  thin_.emplace_back(rigids_.size());
  for (std::size_t r = 0; r < rigids_.size(); ++r) {
    PairSetting const& touch = with_rigid(body, r);
    if (surface.points.empty() || !touch.is_active) continue;
    double const dp = surface.spacing;
    std::array<bool, 3>& is_thin = thin_[body][r];
    is_thin = thin_along(rigids_[r], thin_below * dp);
    bool const any = is_thin[0] || is_thin[1] || is_thin[2];
    any_thin_ = any_thin_ || any;
    ShapePoints const points(rigids_[r], dp);
    if (!points.any()) continue;
    covered_[body][r] = points.cover() ? 1 : 0;
    // The edges of a resolved shape get the weight of one of two passes, in addition to the points of the body.
    double const q = any || points.cover() ? 1 : 0.5;
    shape_passes_.push_back(
        {body,
         r,
         points,
         {2 * dp, penalty_stiffness(q, touch.factor, surface.modulus, dp), 0.5 * dp, 0.7 * dp, 1.1 * dp}});
  }
}

void SurfaceContactSystem::set_masses(std::vector<double> const& masses) {
  PIOLA_EXPECTS(masses.size() == inverse_mass_.size());
  for (std::size_t k = 0; k < masses.size(); ++k) inverse_mass_[k] = masses[k] > 0 ? 1 / masses[k] : 0;
}

void SurfaceContactSystem::place_points(std::vector<Vec<3>> const& x) {
  exec_host::parallel_for(static_cast<Index>(active_hosts_.size()), [&](Index k) {
    Index const host = active_hosts_[at(k)];
    F_[at(host)] = hosts_.F(host, x);
    if (has_friction_) knows_F_[at(host)] = 1;
  });
  exec_host::parallel_for(static_cast<Index>(active_points_.size()), [&](Index k) {
    Index const point = active_points_[at(k)];
    Point const& p = points_[at(point)];
    Mat<3> const& F = F_[at(p.host)];
    Vec<3> const m = cofactor(F) * p.N;
    planes_[at(point)] = {x[at(hosts_.self(p.host))] + F * p.S, (1 / std::sqrt(square_of(m))) * m};
  });
}

/// A point that is near a surface. inverse: sum of inverse masses on both sides [1/kg].
void SurfaceContactSystem::note(Index point, double gap, double layer_modulus, double length, double spacing,
                                double inverse) {
  double const depth = std::max(-gap, 0.0);
  gap_[at(point)] = std::min(gap_[at(point)], gap);
  totals_.deepest = std::max(totals_.deepest, depth / spacing);
  totals_.frequency2 =
      std::max(totals_.frequency2, frequency2(layer_modulus, points_[at(point)].area, -depth, length, inverse));
}

void SurfaceContactSystem::add_load(Index point, PointLoad const& load) {
  PointLoad& sum = loads_[at(point)];
  if (loaded_[at(point)] == 0) {
    loaded_[at(point)] = 1;
    loaded_points_.push_back(point);
    sum = {};
  }
  sum.force = sum.force + load.force;
  sum.by_normal = sum.by_normal + load.by_normal;
  sum.on_gradient = sum.on_gradient + load.on_gradient;
}

/// The force f on the target, against the body that it touches.
void SurfaceContactSystem::add_between(Run const& run, Vec<3> const& f) {
  std::size_t const body = points_[at(run.target)].body;
  Vec<3> const moment = cross(planes_[at(run.target)].y, f);
  if (body < run.body) sums_.resultant_on_first[{body, run.body}].add(f, moment);
  if (body > run.body)
    sums_.resultant_on_first[{run.body, body}].add(-1.0 * f, -1.0 * moment);  // internal forces of a body sum to 0
}

/// Over the planes of a run with weight only, because the list may contain any others [1/kg].
double SurfaceContactSystem::largest_inverse_mass(Run const& run) const {
  double inverse = 0;
  for (std::size_t s = run.first; s < run.last; ++s)
    if (weights_[s] > 0) inverse = std::max(inverse, inverse_mass_of(sources_[s]));
  return inverse;
}

void SurfaceContactSystem::push_bodies() {
  gaps_.resize(runs_.size());
  weights_.resize(sources_.size());
  auto const sources_of = [this](Run const& run) {
    return [this, &run](Index k) -> Plane const& { return planes_[at(sources_[run.first + at(k)])]; };
  };
  exec_host::parallel_for(static_cast<Index>(runs_.size()), [&](Index k) {
    Run const& run = runs_[at(k)];
    gaps_[at(k)] = blended_gap(planes_[at(run.target)], static_cast<Index>(run.last - run.first), sources_of(run),
                               rules_[points_[at(run.target)].body][run.body].reach, &weights_[run.first]);
  });
  for (std::size_t k = 0; k < runs_.size(); ++k) {
    Run const& run = runs_[k];
    Gap const& gap = gaps_[k];
    Point const& target = points_[at(run.target)];
    PairRule const& rule = rules_[target.body][run.body];
    double const dp = 2 * rule.length;
    if (!gap.seen() || !(gap.gap < near * dp)) continue;
    Fade const theta = fade(gap.tau2(), rule.fade_from, rule.fade_to);
    double const seen = theta.value * coverage(gap.weight).value;
    if (!(seen > 0)) continue;
    // For both passes, C_s Mbar / dpbar.
    note(run.target, gap.gap, 2 * rule.stiffness, rule.length, dp,
         largest_inverse_mass(run) + inverse_mass_of(run.target));
    if (!(gap.gap < 0)) continue;
    note_deep(run.target, run.body, -gap.gap / dp, planes_[at(run.target)].n);
    Layer const psi = layer(gap.gap, rule.stiffness, rule.length);
    sums_.energy += target.area * psi.energy * seen;
    ++totals_.touched;
    PointLoad const own =
        contact_loads(planes_[at(run.target)], target.area, gap, psi, theta, static_cast<Index>(run.last - run.first),
                      sources_of(run), rule.reach,
                      [&](Index s, PointLoad const& load) { add_load(sources_[run.first + at(s)], load); });
    add_load(run.target, own);
    apply_friction(
        run, gap,
        {run.target, run.body, -target.area * psi.slope * seen, rule.stiffness * target.area, 0.5 * target.area});
    add_between(run, own.force);
  }
}

/// The spring between a point and a free rigid shape, of a stiffness [N/m].
void SurfaceContactSystem::note_spring(std::size_t r, Index point, Vec<3> const& n, double stiffness) {
  RigidSurface const& rigid = rigids_[r];
  if (!(rigid.inverse_mass > 0)) return;
  Vec<3> const& y = planes_[at(point)].y;
  Frequencies& f = frequencies_[r];
  f.of_points = std::max(f.of_points, 2.5 * stiffness * inverse_mass_of(point));
  sums_.springs_of_shape[r] +=
      stiffness * (with_rigid(points_[at(point)].body, r).friction.any() ? rigid.mobility(y) : rigid.mobility(y, n));
}

void SurfaceContactSystem::push_from_rigids(std::vector<Vec<3>> const& x) {
  std::vector<Kept> kept_now;
  for (Index const k : near_rigid_)
    for (std::size_t r = 0; any_thin_ && r < rigids_.size(); ++r)
      if (std::array<bool, 3> const& t = thin_[points_[at(k)].body][r]; (t[0] || t[1] || t[2]) && is_tested(k, r))
        keep_on_side(k, r, x, kept_now);
  std::swap(kept_, kept_now);
  for (Index const k : near_rigid_) {
    Point const& point = points_[at(k)];
    Surface const& surface = surfaces_[point.body];
    double const length = 0.5 * surface.spacing;
    for (std::size_t r = 0; r < rigids_.size(); ++r) {
      if (!is_tested(k, r)) continue;
      double const layer_modulus =
          penalty_stiffness(1, with_rigid(point.body, r).factor, surface.modulus, surface.spacing);
      Distance const d = distance_on_side(k, r);
      if (!(d.value < near * surface.spacing)) continue;
      double const in_lengths = std::min(d.value, 0.0) / length;
      note_spring(r, k, d.normal, layer_modulus * point.area * (1 + 3 * in_lengths * in_lengths));
      note(k, d.value, layer_modulus, length, surface.spacing, inverse_mass_of(k));
      if (!(d.value < 0)) continue;
      note_deep(k, surfaces_.size() + r, -d.value / surface.spacing, d.normal);
      Layer const psi = layer(d.value, layer_modulus, length);
      Vec<3> const f = (-point.area * psi.slope) * d.normal;
      sums_.energy += point.area * psi.energy;
      ++totals_.touched;
      add_load(k, {f, {}, {}});
      rub_on_rigid({k, surfaces_.size() + r, -point.area * psi.slope, layer_modulus * point.area, point.area}, r,
                   d.normal);
      sums_.resultant_on_rigid[r].add(-1.0 * f, -1.0 * cross(planes_[at(k)].y - rigids_[r].centre, f));
    }
  }
}

void SurfaceContactSystem::add_force(Index id, Vec<3> const& f) {
  if (is_pushed_[at(id)] == 0) {
    is_pushed_[at(id)] = 1;
    loaded_indices_.push_back(id);
    forces_[at(id)] = {};
  }
  forces_[at(id)] = forces_[at(id)] + f;
}

void SurfaceContactSystem::start(std::vector<Vec<3>> const& x) {
  PIOLA_EXPECTS(x.size() >= ids().size());
  remember(x);
  evaluate(x, 0);
}

void SurfaceContactSystem::remember(std::vector<Vec<3>> const& x) {
  last_x_ = x;
  last_pose_.clear();
  for (RigidSurface const& rigid : rigids_) last_pose_.push_back(pose_of(rigid));
}

void SurfaceContactSystem::evaluate(std::vector<Vec<3>> const& x, double dt) {
  PIOLA_EXPECTS(x.size() >= ids().size());
  if (has_friction_) {
    std::swap(F_, last_F_);
    std::swap(knows_F_, knows_last_F_);
    std::fill(knows_F_.begin(), knows_F_.end(), 0);
  }
  if (!lists_hold(x)) make_lists(x);
  dt_ = dt;
  std::swap(stuck_, last_stuck_);
  std::swap(deep_, last_deep_);
  stuck_.clear();
  deep_.clear();
  evaluate_forces(x);
  count_passed();
  std::sort(stuck_.begin(), stuck_.end());
  book_lost_springs();
  remember(x);
}

void SurfaceContactSystem::add_up() {
  totals_.energy = sums_.energy.value();
  totals_.spring_energy = sums_.spring_energy.value();
  totals_.friction_work = sums_.friction_work.value();
  for (std::size_t r = 0; r < rigids_.size(); ++r) {
    on_rigid_[r] = sums_.resultant_on_rigid[r].value();
    frequencies_[r].of_shape = sums_.springs_of_shape[r].value();
  }
  for (auto const& [pair, sum] : sums_.resultant_on_first) {
    ForceMoment const resultant_on_first = sum.value();
    between_[pair.first][pair.second] = resultant_on_first;
    between_[pair.second][pair.first] = {-1.0 * resultant_on_first.force, -1.0 * resultant_on_first.moment};
  }
}

void SurfaceContactSystem::forget_forces() {
  for (Index const k : loaded_indices_) {
    forces_[at(k)] = {};
    is_pushed_[at(k)] = 0;
  }
  for (Index const k : loaded_points_) loaded_[at(k)] = 0;
  std::fill(heat_.begin(), heat_.end(), 0.0);
  std::fill(normal_force_.begin(), normal_force_.end(), 0.0);
  std::fill(gap_.begin(), gap_.end(), std::numeric_limits<double>::infinity());
  loaded_indices_.clear();
  loaded_points_.clear();
  totals_ = {};
  std::fill(on_rigid_.begin(), on_rigid_.end(), ForceMoment{});
  std::fill(frequencies_.begin(), frequencies_.end(), Frequencies{});
  for (auto& row : between_) std::fill(row.begin(), row.end(), ForceMoment{});
  sums_ = {};
  sums_.resultant_on_rigid.resize(rigids_.size());
  sums_.springs_of_shape.resize(rigids_.size());
}

void SurfaceContactSystem::evaluate_forces(std::vector<Vec<3>> const& x) {
  forget_forces();
  if (active_points_.empty()) return;
  place_points(x);
  push_bodies();
  push_from_rigids(x);
  push_from_shape_points();
  add_up();
  std::sort(loaded_points_.begin(), loaded_points_.end());
  for (Index const k : loaded_points_) {
    Point const& p = points_[at(k)];
    normal_force_[at(k)] = -dot(loads_[at(k)].force, planes_[at(k)].n);
    Mat<3> const T = couple(p.S, p.N, F_[at(p.host)], loads_[at(k)]);
    Vec<3> own = loads_[at(k)].force;
    for (std::size_t j = hosts_.first(p.host); j < hosts_.last(p.host); ++j) {
      HostParticles::Neighbour const& b = hosts_.neighbour(j);
      Vec<3> const f = T * b.g;
      add_force(b.at, -1.0 * f);
      own = own + f;
    }
    add_force(hosts_.self(p.host), own);
  }
  std::sort(loaded_indices_.begin(), loaded_indices_.end());
}

double SurfaceContactSystem::contact_time_step(std::vector<Vec<3>> const& v) const {
  PIOLA_EXPECTS(v.size() >= ids().size());
  double step = std::min(closing_step_of_shapes(v), crossing_step(v));
  auto const velocity = [&](Index point) { return v[at(hosts_.self(points_[at(point)].host))]; };
  for (Run const& run : runs_) {
    PairRule const& rule = rules_[points_[at(run.target)].body][run.body];
    for (std::size_t s = run.first; s < run.last; ++s) {
      Plane const &a = planes_[at(run.target)], &b = planes_[at(sources_[s])];
      if (!(dot(a.n, b.n) < 0) || !(square_of(a.y - b.y) < rule.reach * rule.reach)) continue;
      double const speed = -dot(velocity(run.target) - velocity(sources_[s]), b.n);
      if (speed > 0) step = std::min(step, closing * 2 * rule.length / speed);
    }
  }
  for (Index const k : near_rigid_)
    for (std::size_t r = 0; r < rigids_.size(); ++r) {
      RigidSurface const& rigid = rigids_[r];
      if (!is_tested(k, r)) continue;
      Distance const d = distance_on_side(k, r);
      double const spacing = surfaces_[points_[at(k)].body].spacing;
      if (!(d.value < near * spacing)) continue;
      double const speed = -dot(velocity(k) - rigid.velocity_at(planes_[at(k)].y), d.normal);
      if (speed > 0) step = std::min(step, closing * spacing / speed);
    }
  return step;
}

std::size_t SurfaceContactSystem::bytes() const {
  std::size_t const stencils = hosts_.count() > 0 ? hosts_.last(hosts_.count() - 1) : 0;
  return points_.size() * (sizeof(Point) + sizeof(Plane) + sizeof(PointLoad)) +
         (F_.size() + last_F_.size()) * sizeof(Mat<3>) + ids().size() * (sizeof(Vec<3>) + 2 * sizeof(double)) +
         sources_.size() * sizeof(Index) + runs_.size() * (sizeof(Run) + sizeof(Gap)) +
         stencils * sizeof(HostParticles::Neighbour);
}

}  // namespace piola::contact
