// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/system.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <limits>
#include <utility>

namespace piola::contact {
namespace {

constexpr double skin_in_spacings = 0.5;
/// Planes move a little farther than their particles where these turn; this share of the skin leaves room for that.
constexpr double share_of_skin = 1.0 / 3;
constexpr double near = 0.25;    // spacings from which on a gap limits the step
constexpr double closing = 0.1;  // of a spacing in a step

std::size_t at(Index k) { return static_cast<std::size_t>(k); }

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

double square_of(Vec<3> const& a) { return dot(a, a); }

}  // namespace

System::System(ParticleSet const& particles, std::vector<Surface> surfaces, std::vector<RigidSurface> rigids,
               Setting setting)
    : surfaces_(std::move(surfaces)),
      rigids_(std::move(rigids)),
      setting_(std::move(setting)),
      carriers_(particles, surfaces_),
      between_(surfaces_.size(), std::vector<Between>(surfaces_.size())) {
  for (std::size_t b = 0; b < surfaces_.size(); ++b) {
    Surface const& surface = surfaces_[b];
    if (!surface.points.empty()) skin_ = std::max(skin_, skin_in_spacings * surface.spacing);
    for (std::size_t k = 0; k < surface.points.size(); ++k) {
      SurfacePoint const& p = surface.points[k];
      points_.push_back({carriers_.of(b, k), b, p.offset, p.normal, p.area});
    }
    rules_.emplace_back();
    for (Surface const& other : surfaces_)
      rules_.back().push_back(
          pair_rule(setting_.factor, surface.modulus, surface.spacing, other.modulus, other.spacing));
  }
  F_.resize(at(carriers_.count()));
  planes_.resize(points_.size());
  loads_.resize(points_.size());
  loaded_.resize(points_.size());
  forces_.resize(ids().size());
  is_pushed_.resize(ids().size());
  inverse_mass_.resize(ids().size());
  on_rigid_.resize(rigids_.size());
}

void System::set_masses(std::vector<double> const& masses) {
  for (std::size_t k = 0; k < masses.size(); ++k) inverse_mass_[k] = masses[k] > 0 ? 1 / masses[k] : 0;
}

bool System::lists_hold(std::vector<Vec<3>> const& x) const {
  if (listed_at_.empty()) return false;
  double const most = share_of_skin * skin_ * share_of_skin * skin_;
  for (Index k = 0; k < carriers_.count(); ++k)
    if (!(square_of(x[at(carriers_.self(k))] - listed_at_[at(k)]) < most)) return false;
  for (std::size_t r = 0; r < rigids_.size(); ++r)
    if (!(square_of(rigids_[r].centre - listed_at_[at(carriers_.count()) + r]) < most)) return false;
  return true;
}

void System::place_points(std::vector<Vec<3>> const& x) {
  exec_host::for_each_in_set_up(static_cast<Index>(active_carriers_.size()), [&](Index k) {
    Index const carrier = active_carriers_[at(k)];
    F_[at(carrier)] = carriers_.F(carrier, x);
  });
  exec_host::for_each_in_set_up(static_cast<Index>(active_points_.size()), [&](Index k) {
    Index const point = active_points_[at(k)];
    Point const& p = points_[at(point)];
    Mat<3> const& F = F_[at(p.carrier)];
    Vec<3> const m = cofactor(F) * p.N;
    planes_[at(point)] = {x[at(carriers_.self(p.carrier))] + F * p.S, (1 / std::sqrt(square_of(m))) * m};
  });
}

/// Sources of body b for every point that may be near it.
void System::list_sources(std::size_t b, std::vector<Index> const& of_body, Vec<3> const& low, Vec<3> const& high) {
  Box const box{low, high};
  auto const reach = [&](Point const& p) { return setting_.meets[p.body][b] ? rules_[p.body][b].reach + skin_ : -1.0; };
  double largest = 0;
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (double const r = reach(points_[k]); r > 0 && box.holds(planes_[k].y, r)) largest = std::max(largest, r);
  if (!(largest > 0)) return;
  std::vector<std::array<double, 3>> places;
  for (Index const k : of_body) places.push_back({planes_[at(k)].y[0], planes_[at(k)].y[1], planes_[at(k)].y[2]});
  CellGrid const grid(places, largest);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    double const r = reach(points_[k]);
    Vec<3> const& y = planes_[k].y;
    if (!(r > 0) || !box.holds(y, r)) continue;
    std::size_t const first = sources_.size();
    grid.visit({y[0], y[1], y[2]}, [&](Index j) {
      Index const source = of_body[at(j)];
      if (square_of(planes_[at(source)].y - y) < r * r) sources_.push_back(source);
    });
    std::sort(sources_.begin() + static_cast<std::ptrdiff_t>(first), sources_.end());
    if (sources_.size() > first) runs_.push_back({static_cast<Index>(k), b, first, sources_.size()});
  }
}

void System::list_points_near_rigids() {
  near_rigid_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (!setting_.meets_rigids[points_[k].body]) continue;
    double const reach = skin_ + near * surfaces_[points_[k].body].spacing;
    bool const any = std::any_of(rigids_.begin(), rigids_.end(), [&](RigidSurface const& rigid) {
      return distance_from(rigid, planes_[k].y).value < reach;
    });
    if (any) near_rigid_.push_back(static_cast<Index>(k));
  }
}

void System::activate(std::vector<char> const& points) {
  std::vector<char> carries(at(carriers_.count()), 0);
  active_points_.clear();
  active_carriers_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (points[k] == 0) continue;
    active_points_.push_back(static_cast<Index>(k));
    carries[at(points_[k].carrier)] = 1;
  }
  for (std::size_t k = 0; k < carries.size(); ++k)
    if (carries[k] != 0) active_carriers_.push_back(static_cast<Index>(k));
}

void System::make_lists(std::vector<Vec<3>> const& x) {
  activate(std::vector<char>(points_.size(), 1));
  place_points(x);
  std::vector<std::vector<Index>> of_body(surfaces_.size());
  std::vector<Box> boxes(surfaces_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    of_body[points_[k].body].push_back(static_cast<Index>(k));
    boxes[points_[k].body].add(planes_[k].y);
  }
  runs_.clear();
  sources_.clear();
  for (std::size_t b = 0; b < surfaces_.size(); ++b)
    if (!of_body[b].empty()) list_sources(b, of_body[b], boxes[b].low, boxes[b].high);
  list_points_near_rigids();

  std::vector<char> active(points_.size(), 0);
  for (Run const& run : runs_) active[at(run.target)] = 1;
  for (Index const k : sources_) active[at(k)] = 1;
  for (Index const k : near_rigid_) active[at(k)] = 1;
  activate(active);
  listed_at_.clear();
  for (Index k = 0; k < carriers_.count(); ++k) listed_at_.push_back(x[at(carriers_.self(k))]);
  for (RigidSurface const& rigid : rigids_) listed_at_.push_back(rigid.centre);
}

void System::note(double gap, double area, double layer_modulus, double length, double spacing, double inverse) {
  totals_.deepest = std::max(totals_.deepest, -gap / spacing);
  totals_.frequency2 = std::max(totals_.frequency2, frequency2(layer_modulus, area, gap, length, inverse));
}

void System::add_load(Index point, PointLoad const& load) {
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

void System::push_bodies() {
  gaps_.resize(runs_.size());
  auto const sources_of = [this](Run const& run) {
    return [this, &run](Index k) -> Plane const& { return planes_[at(sources_[run.first + at(k)])]; };
  };
  exec_host::for_each_in_set_up(static_cast<Index>(runs_.size()), [&](Index k) {
    Run const& run = runs_[at(k)];
    gaps_[at(k)] = blended_gap(planes_[at(run.target)], static_cast<Index>(run.last - run.first), sources_of(run),
                               rules_[points_[at(run.target)].body][run.body].reach);
  });
  for (std::size_t k = 0; k < runs_.size(); ++k) {
    Run const& run = runs_[k];
    Gap const& gap = gaps_[k];
    Point const& target = points_[at(run.target)];
    PairRule const& rule = rules_[target.body][run.body];
    double const dp = 2 * rule.length;
    if (!gap.seen() || !(gap.gap < near * dp)) continue;
    Fade const theta = fade(gap.tau2(), rule.fade_from, rule.fade_to);
    if (!(theta.value > 0)) continue;
    double inverse = 0;
    for (std::size_t s = run.first; s < run.last; ++s) inverse = std::max(inverse, inverse_mass_of(sources_[s]));
    // Of both passes, C_s Mbar / dpbar.
    note(std::min(gap.gap, 0.0), target.area, 2 * rule.stiffness, rule.length, dp,
         inverse + inverse_mass_of(run.target));
    if (!(gap.gap < 0)) continue;
    Layer const psi = layer(gap.gap, rule.stiffness, rule.length);
    totals_.energy += target.area * psi.energy * theta.value;
    ++totals_.touched;
    PointLoad const own =
        contact_loads(planes_[at(run.target)], target.area, gap, psi, theta, static_cast<Index>(run.last - run.first),
                      sources_of(run), rule.reach,
                      [&](Index s, PointLoad const& load) { add_load(sources_[run.first + at(s)], load); });
    add_load(run.target, own);
    rub(run, gap, -target.area * psi.slope * theta.value, rule.stiffness * target.area);
    Between &on_target = between_[target.body][run.body], &on_source = between_[run.body][target.body];
    Vec<3> const moment = cross(planes_[at(run.target)].y, own.force);
    on_target = {on_target.force + own.force, on_target.moment + moment};
    on_source = {on_source.force - own.force, on_source.moment - moment};
  }
}

/// Follows the spring of a point; a new contact starts without one.
Spring System::drag(Index point, std::size_t with, Vec<3> const& jump, Vec<3> const& n, double k, double bound) {
  Stuck const key{point, with, {}, {}};
  auto const last = std::lower_bound(last_stuck_.begin(), last_stuck_.end(), key);
  bool const known = last != last_stuck_.end() && last->point == point && last->with == with;
  Mat<3> const& F = F_[at(points_[at(point)].carrier)];
  Spring const spring = dragged(known ? F * last->stretch : Vec<3>{}, known ? jump : Vec<3>{}, n, k, bound);
  if (known) totals_.friction_work += friction_work(last->force, spring.force, jump);
  totals_.spring_energy += 0.5 * k * square_of(spring.stretch);
  stuck_.push_back({point, with, inverse(F) * spring.stretch, spring.force});
  return spring;
}

/// Friction of a target on the planes that it touches. The jump is zero for any rigid motion of all.
void System::rub(Run const& run, Gap const& gap, double normal_force, double stiffness) {
  if (!(setting_.friction > 0)) return;
  Plane const& a = planes_[at(run.target)];
  double const reach = rules_[points_[at(run.target)].body][run.body].reach;
  auto const moved = [&](Index point) {
    Point const& p = points_[at(point)];
    return planes_[at(point)].y - last_x_[at(carriers_.self(p.carrier))] - carriers_.F(p.carrier, last_x_) * p.S;
  };
  Vec<3> jump = moved(run.target), n;
  std::vector<std::pair<double, Vec<3>>> sources;  // share, F^-1 r
  for (std::size_t s = run.first; s < run.last; ++s) {
    Plane const& b = planes_[at(sources_[s])];
    Vec<3> const r = a.y - b.y;
    double const share = plane_weight(square_of(r) / (reach * reach), dot(a.n, b.n)) / gap.weight;
    Index const carrier = points_[at(sources_[s])].carrier;
    sources.emplace_back(share, share > 0 ? inverse(F_[at(carrier)]) * r : Vec<3>{});
    if (!(share > 0)) continue;
    Mat<3> const change = F_[at(carrier)] - carriers_.F(carrier, last_x_);
    jump = jump - share * (moved(sources_[s]) + change * sources.back().second);
    n = n + share * b.n;
  }
  n = (1 / std::sqrt(square_of(n))) * n;
  Spring const spring = drag(run.target, run.body, jump, n, stiffness, setting_.friction * normal_force);
  Vec<3> const& f = spring.force;
  add_load(run.target, {f, {}, {}});
  for (std::size_t k = 0; k < sources.size(); ++k) {
    auto const& [share, arm] = sources[k];
    if (share > 0) add_load(sources_[run.first + k], {-share * f, {}, share * outer(f, arm)});
  }
  std::size_t const body = points_[at(run.target)].body;
  Between &on_target = between_[body][run.body], &on_source = between_[run.body][body];
  Vec<3> const moment = cross(a.y, f);
  on_target = {on_target.force + f, on_target.moment + moment};
  on_source = {on_source.force - f, on_source.moment - moment};
}

/// Rigid shapes move without turning.
void System::rub_on_rigid(Index k, std::size_t r, Vec<3> const& n, double normal_force, double stiffness) {
  if (!(setting_.friction > 0)) return;
  Point const& p = points_[at(k)];
  Vec<3> const& y = planes_[at(k)].y;
  Vec<3> const jump = y - last_x_[at(carriers_.self(p.carrier))] - carriers_.F(p.carrier, last_x_) * p.S -
                      (rigids_[r].centre - last_centre_[r]);
  Vec<3> const f = drag(k, surfaces_.size() + r, jump, n, stiffness, setting_.friction * normal_force).force;
  add_load(k, {f, {}, {}});
  on_rigid_[r] = {on_rigid_[r].force - f, on_rigid_[r].moment - cross(y - rigids_[r].centre, f)};
}

void System::push_from_rigids() {
  for (Index const k : near_rigid_) {
    Point const& point = points_[at(k)];
    Surface const& surface = surfaces_[point.body];
    double const layer_modulus = setting_.factor * surface.modulus / surface.spacing, length = 0.5 * surface.spacing;
    for (std::size_t r = 0; r < rigids_.size(); ++r) {
      Distance const d = distance_from(rigids_[r], planes_[at(k)].y);
      if (!(d.value < near * surface.spacing)) continue;
      note(std::min(d.value, 0.0), point.area, layer_modulus, length, surface.spacing, inverse_mass_of(k));
      if (!(d.value < 0)) continue;
      Layer const psi = layer(d.value, layer_modulus, length);
      Vec<3> const f = (-point.area * psi.slope) * d.normal;
      totals_.energy += point.area * psi.energy;
      ++totals_.touched;
      add_load(k, {f, {}, {}});
      rub_on_rigid(k, r, d.normal, -point.area * psi.slope, layer_modulus * point.area);
      on_rigid_[r].force = on_rigid_[r].force - f;
      on_rigid_[r].moment = on_rigid_[r].moment - cross(planes_[at(k)].y - rigids_[r].centre, f);
    }
  }
}

void System::add_force(Index id, Vec<3> const& f) {
  if (is_pushed_[at(id)] == 0) {
    is_pushed_[at(id)] = 1;
    pushed_.push_back(id);
    forces_[at(id)] = {};
  }
  forces_[at(id)] = forces_[at(id)] + f;
}

void System::start(std::vector<Vec<3>> const& x) {
  remember(x);
  evaluate(x);
}

std::vector<double> System::state() const {
  std::vector<double> all{totals_.energy,
                          totals_.deepest,
                          totals_.frequency2,
                          totals_.spring_energy,
                          totals_.friction_work,
                          static_cast<double>(totals_.touched),
                          static_cast<double>(pushed_.size())};
  auto const put = [&](Vec<3> const& a) { all.insert(all.end(), a.c, a.c + 3); };
  for (Index const k : pushed_) {
    all.push_back(k);
    put(forces_[at(k)]);
  }
  auto const put_between = [&](Between const& between) {
    put(between.force);
    put(between.moment);
  };
  std::for_each(on_rigid_.begin(), on_rigid_.end(), put_between);
  for (auto const& row : between_) std::for_each(row.begin(), row.end(), put_between);
  for (Stuck const& s : stuck_) {
    all.push_back(s.point);
    all.push_back(static_cast<double>(s.with));
    put(s.stretch);
    put(s.force);
  }
  return all;
}

void System::restore(std::vector<Vec<3>> const& x, std::vector<double> const& state) {
  make_lists(x);
  if (!active_points_.empty()) place_points(x);
  remember(x);
  auto from = state.begin();
  auto const number = [&] { return *from++; };
  auto const take = [&](Vec<3>& a) {
    std::copy_n(from, 3, a.c);
    from += 3;
  };
  totals_ = {number(), number(), number(), number(), number(), static_cast<std::int64_t>(number())};
  for (auto n = static_cast<std::size_t>(number()); n > 0; --n) {
    auto const k = static_cast<Index>(number());
    add_force(k, {});
    take(forces_[at(k)]);
  }
  auto const take_between = [&](Between& between) {
    take(between.force);
    take(between.moment);
  };
  std::for_each(on_rigid_.begin(), on_rigid_.end(), take_between);
  for (auto& row : between_) std::for_each(row.begin(), row.end(), take_between);
  stuck_.clear();
  while (from < state.end()) {
    Stuck s{static_cast<Index>(number()), static_cast<std::size_t>(number()), {}, {}};
    take(s.stretch);
    take(s.force);
    stuck_.push_back(s);
  }
}

void System::remember(std::vector<Vec<3>> const& x) {
  last_x_ = x;
  last_centre_.clear();
  for (RigidSurface const& rigid : rigids_) last_centre_.push_back(rigid.centre);
}

void System::evaluate(std::vector<Vec<3>> const& x) {
  if (!lists_hold(x)) make_lists(x);
  std::swap(stuck_, last_stuck_);
  stuck_.clear();
  push_all(x);
  std::sort(stuck_.begin(), stuck_.end());
  remember(x);
}

void System::push_all(std::vector<Vec<3>> const& x) {
  for (Index const k : pushed_) {
    forces_[at(k)] = {};
    is_pushed_[at(k)] = 0;
  }
  for (Index const k : loaded_points_) loaded_[at(k)] = 0;
  pushed_.clear();
  loaded_points_.clear();
  totals_ = {};
  std::fill(on_rigid_.begin(), on_rigid_.end(), Between{});
  for (auto& row : between_) std::fill(row.begin(), row.end(), Between{});
  if (active_points_.empty()) return;
  place_points(x);
  push_bodies();
  push_from_rigids();
  std::sort(loaded_points_.begin(), loaded_points_.end());
  for (Index const k : loaded_points_) {
    Point const& p = points_[at(k)];
    Mat<3> const T = couple(p.S, p.N, F_[at(p.carrier)], loads_[at(k)]);
    Vec<3> own = loads_[at(k)].force;
    for (std::size_t j = carriers_.first(p.carrier); j < carriers_.last(p.carrier); ++j) {
      Carriers::Neighbour const& b = carriers_.neighbour(j);
      Vec<3> const f = T * b.g;
      add_force(b.at, -1.0 * f);
      own = own + f;
    }
    add_force(carriers_.self(p.carrier), own);
  }
  std::sort(pushed_.begin(), pushed_.end());
}

double System::closing_step(std::vector<Vec<3>> const& v) const {
  double step = std::numeric_limits<double>::infinity();
  auto const velocity = [&](Index point) { return v[at(carriers_.self(points_[at(point)].carrier))]; };
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
    for (RigidSurface const& rigid : rigids_) {
      Distance const d = distance_from(rigid, planes_[at(k)].y);
      double const spacing = surfaces_[points_[at(k)].body].spacing;
      if (!(d.value < near * spacing)) continue;
      double const speed = -dot(velocity(k) - rigid.velocity, d.normal);
      if (speed > 0) step = std::min(step, closing * spacing / speed);
    }
  return step;
}

std::size_t System::bytes() const {
  std::size_t const stencils = carriers_.count() > 0 ? carriers_.last(carriers_.count() - 1) : 0;
  return points_.size() * (sizeof(Point) + sizeof(Plane) + sizeof(PointLoad)) + F_.size() * sizeof(Mat<3>) +
         ids().size() * (sizeof(Vec<3>) + 2 * sizeof(double)) + sources_.size() * sizeof(Index) +
         runs_.size() * (sizeof(Run) + sizeof(Gap)) + stencils * sizeof(Carriers::Neighbour);
}

}  // namespace piola::contact
