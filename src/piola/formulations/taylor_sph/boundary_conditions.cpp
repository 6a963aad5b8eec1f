// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/boundary_conditions.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/mechanics/prescribed.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace piola::taylor_sph {
namespace {

using Point = std::array<double, 3>;
using Stress = std::array<double, 6>;  // SymMat<3>: XX YY ZZ XY YZ XZ

/// Facets whose normals differ by more are two sides with an edge between them; a polygon's sides at 45 degrees are
/// one.
constexpr double same_side = 0.57;  // cosine of 55 degrees

double length(Point const& a) { return std::sqrt(dot(a, a)); }

/// Position of the component (i, j) in a symmetric tensor of D dimensions.
int component(int i, int j, int D) {
  if (i == j) return i;
  return D == 2 ? 2 : i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

Point traction_of(Stress const& s, Point const& n, int D) {
  Point t{};
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      t[static_cast<std::size_t>(i)] +=
          s[static_cast<std::size_t>(component(i, j, D))] * n[static_cast<std::size_t>(j)];
  return t;
}

/// sym(d (x) n) in the orthonormal basis of stresses; e : sigma = d.sigma.n.
std::array<double, 6> dyad(Point const& d, Point const& n, int D) {
  std::array<double, 6> e{};
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) {
      auto const a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      double const both = i == j ? d[a] * n[a] : (d[a] * n[b] + d[b] * n[a]) / std::sqrt(2.0);
      e[static_cast<std::size_t>(component(i, j, D))] = both;
    }
  return e;
}

double mandel_product(double const* row, Stress const& s, int D) {
  double sum = 0;
  for (int c = 0; c < D * (D + 1) / 2; ++c)
    sum += row[c] * s[static_cast<std::size_t>(c)] * (c < D ? 1 : std::sqrt(2.0));
  return sum;
}

/// Directions across those of `held` [orthonormal], as many as D leaves.
std::vector<Point> free_directions(std::vector<Point> held, int D) {
  static constexpr Point axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Point> free;
  for (int c = 0; c < D && held.size() < static_cast<std::size_t>(D); ++c) {
    Point d = axes[c];
    // An axis that is almost in the span of `held` would leave a direction of round-off.
    Point rest = d;
    for (auto const& h : held)
      for (std::size_t k = 0; k < 3; ++k) rest[k] -= dot(d, h) * h[k];
    if (length(rest) < 0.3 || !make_orthogonal(d, held)) continue;
    held.push_back(d);
    free.push_back(d);
  }
  return free;
}

}  // namespace

Boundary::Boundary(Assembly const& assembly, std::size_t body, Particles const& real)
    : D_(real.dimension()), real_(real), x_(real.X()) {
  PIOLA_EXPECTS(body < assembly.particles.bodies.size());
  Body const& own = real.body();
  std::size_t const n = x_.size();
  held_.resize(n);
  loaded_.resize(n);
  tip_.resize(n);
  for (auto const& crack : assembly.particles.cracks)
    for (std::size_t k = 0; k < n && crack.body == static_cast<int>(body); ++k) {
      auto const at = [&](Point const& end) { return length({x_[k][0] - end[0], x_[k][1] - end[1], 0}); };
      double const reach = 1e-6 * std::min(own.spacing[0], own.spacing[1]);
      tip_[k] = tip_[k] || (crack.tip_at_from && at(crack.from) < reach) || (crack.tip_at_to && at(crack.to) < reach);
    }
  for (auto const& support : assembly.supports) {
    for (auto const id : support.particles) {
      if (id < own.first || id >= own.last) continue;
      for (auto const& d : directions_of(support, D_)) {
        held_[static_cast<std::size_t>(id - own.first)].push_back({supports_.size(), d});
        has_supports_ = true;
      }
    }
    supports_.push_back(support);
    supports_.back().particles.clear();
  }
  read_loads(assembly);
}

void Boundary::read_loads(Assembly const& assembly) {
  std::int64_t const first = real_.body().first, last = real_.body().last;
  for (std::size_t number = 0; number < assembly.loads.size(); ++number) {
    Load const& load = assembly.loads[number];
    std::vector<std::size_t> own;  // places of the particles of this body in the lists of the load
    for (std::size_t k = 0; k < load.particles.size(); ++k)
      if (load.particles[k] >= first && load.particles[k] < last) own.push_back(k);
    Load mine = load;
    mine.particles.clear();
    if (load.on_face()) {
      for (std::size_t const k : own)
        loaded_[static_cast<std::size_t>(load.particles[k] - first)].push_back({tractions_.size(), load.normal_of(k)});
      tractions_.push_back(mine);
      traction_number_.push_back(number);
    } else if (!own.empty()) {
      mine.factor.clear();
      for (std::size_t const k : own) {
        mine.particles.push_back(load.particles[k] - first);
        mine.factor.push_back(load.factor[k]);
      }
      accelerations_.push_back(mine);
      acceleration_number_.push_back(number);
    }
  }
}

Point Boundary::facet_area(Index facet, Points const& x) const {
  auto const f = static_cast<std::size_t>(facet);
  if (D_ == 1) return {surface_.outward[f], 0, 0};
  auto const corner = [&](std::size_t k) {
    return x[static_cast<std::size_t>(surface_.corner[f * static_cast<std::size_t>(D_) + k])];
  };
  auto const edge = [&](std::size_t k) {
    Point const a = corner(0), b = corner(k);
    return Point{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  };
  Point const t = edge(1);
  if (D_ == 2) return {t[1], -t[0], 0};
  Point const s = edge(2);
  return {0.5 * (t[1] * s[2] - t[2] * s[1]), 0.5 * (t[2] * s[0] - t[0] * s[2]), 0.5 * (t[0] * s[1] - t[1] * s[0])};
}

void Boundary::add_to_side(Index particle, Index facet, Point const& area) {
  auto& sides = sides_[static_cast<std::size_t>(particle)];
  double const size = length(area);
  Side* best = nullptr;
  double closest = -2;
  for (auto& side : sides) {
    double const cosine = dot(side.area, area) / (length(side.area) * size);
    if (cosine > closest) best = &side;
    closest = std::max(closest, cosine);
  }
  // A point of a surface in D dimensions has at most D independent normals.
  bool const full = sides.size() == static_cast<std::size_t>(D_);
  if (best == nullptr || (closest < same_side && !full)) {
    sides.push_back({});
    best = &sides.back();
  }
  best->facets.push_back(facet);
  for (std::size_t c = 0; c < 3; ++c) best->area[c] += area[c];
}

void Boundary::sort_facets(Surface const& surface) {
  surface_ = surface;
  sides_.assign(x_.size(), {});
  for (Index f = 0; f < surface_.count(); ++f)
    for (int k = 0; k < D_; ++k) {
      Index const particle = surface_.corner[static_cast<std::size_t>(f) * D_ + k];
      if (!tip_[static_cast<std::size_t>(particle)]) add_to_side(particle, f, facet_area(f, real_.X()));
    }
}

void Boundary::update_normals(Points const& x) {
  for (Index const particle : particles_)
    for (auto& side : sides_[static_cast<std::size_t>(particle)]) {
      side.area = {};
      for (Index const f : side.facets) {
        Point const a = facet_area(f, x);
        for (std::size_t c = 0; c < 3; ++c) side.area[c] += a[c] / D_;
      }
      double const size = length(side.area);
      for (std::size_t c = 0; c < 3; ++c) side.normal[c] = side.area[c] / size;
    }
}

void Boundary::attach_tractions() {
  for (std::size_t k = 0; k < loaded_.size(); ++k)
    for (auto const& traction : loaded_[k]) {
      Side* best = nullptr;
      double closest = 0.5;
      for (auto& side : sides_[k])
        if (dot(side.reference_normal, traction.normal) > closest) {
          closest = dot(side.reference_normal, traction.normal);
          best = &side;
        }
      Point const& X = real_.X()[k];
      if (best == nullptr)
        throw InputError(fmt::format(
            "load: the particle at ({:.4g}, {:.4g}, {:.4g}) m carries a traction but is not on the surface - "
            "load particles of a face, and give the box placement = \"on_boundary\"",
            X[0], X[1], X[2]));
      best->tractions.push_back(traction.load);
    }
}

std::vector<Index> const& Boundary::arrange(Surface const& surface, Points const& x) {
  sort_facets(surface);
  particles_.clear();
  for (std::size_t k = 0; k < x_.size(); ++k)
    if (!sides_[k].empty() || !held_[k].empty()) particles_.push_back(static_cast<Index>(k));
  update_normals(real_.X());
  for (auto& sides : sides_)
    for (auto& side : sides) side.reference_normal = side.normal;
  attach_tractions();
  update_normals(x);
  items_.assign(particles_.size(), {});
  return particles_;
}

/// A pressure that does not follow keeps the normal of the start.
Point Boundary::traction_of_load(std::size_t traction, Side const& side, Index particle, double time) const {
  Point t{};
  Point const& X = real_.X(particle);
  Load const& load = tractions_[traction];
  if (has_ended(load.until, time)) return t;
  if (load.pressure) return acceleration_by(load.value, load.follows ? side.normal : side.reference_normal, 1, X, time);
  for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c) t[c] = load.value[c](X, time);
  return t;
}

Point Boundary::traction_on(Side const& side, Index particle, double time) const {
  Point t{};
  for (std::size_t const l : side.tractions) {
    Point const part = traction_of_load(l, side, particle, time);
    for (std::size_t c = 0; c < 3; ++c) t[c] += part[c];
  }
  return t;
}

void Boundary::prescribe_velocity(Index particle, double time, double dt, BoundaryItem& item) const {
  Point const velocity = real_.v(particle);
  auto const at = static_cast<std::size_t>(particle);
  std::vector<HeldDirection> lasting;
  std::vector<Direction> directions;
  // The support named last decides where several hold a particle.
  for (std::size_t k = held_[at].size(); k-- > 0;) {
    HeldDirection const& held = held_[at][k];
    if (has_ended(supports_[held.support].until, time)) continue;
    lasting.push_back(held);
    directions.push_back(held.direction);
  }
  item.held = 0;
  for (PrescribedAxis const& along : hold_along(directions)) {
    std::copy(along.direction.begin(), along.direction.end(), item.direction[item.held]);
    item.support[item.held] = static_cast<int>(lasting[along.row].support);
    item.speed_before[item.held] = dot(velocity, along.direction);
    item.speed_after[item.held] = along.speed([&](std::size_t row) {
      auto const& given = supports_[lasting[row].support].velocity;
      return given ? speed_along(*given, lasting[row].direction, real_.X(particle), time + dt) : 0;
    });
    ++item.held;
  }
}

void Boundary::prescribe_stress(Index particle, double time, double dt, BoundaryItem& item) const {
  Stress const stress = real_.stress_components(particle);
  auto const at = static_cast<std::size_t>(particle);
  int const n = D_ * (D_ + 1) / 2;
  item.rows = 0;
  std::vector<Point> held;
  held.reserve(static_cast<std::size_t>(item.held));
  for (int h = 0; h < item.held; ++h)
    held.push_back({item.direction[h][0], item.direction[h][1], item.direction[h][2]});
  std::vector<Point> const free = free_directions(held, D_);
  bool const fresh = !(time > 0) || std::any_of(held_[at].begin(), held_[at].end(), [&](HeldDirection const& h) {
    double const until = supports_[h.support].until;
    return has_ended(until, time) && !has_ended(until, time * (1 - 1e-8));
  });
  for (auto const& side : sides_[at]) {
    Point const now = traction_on(side, particle, time), then = traction_on(side, particle, time + dt);
    for (auto const& d : free) {
      auto row = dyad(d, side.normal, D_);
      double before = dot(d, now), after = dot(d, then);
      double const whole = std::sqrt(std::inner_product(row.begin(), row.end(), row.begin(), 0.0));
      for (int r = 0; r < item.rows; ++r) {
        double part = 0;
        for (int c = 0; c < n; ++c) part += row[static_cast<std::size_t>(c)] * item.row[r][c];
        for (int c = 0; c < n; ++c) row[static_cast<std::size_t>(c)] -= part * item.row[r][c];
        before -= part * item.before[r];
        after -= part * item.after[r];
      }
      double const rest = std::sqrt(std::inner_product(row.begin(), row.end(), row.begin(), 0.0));
      if (rest < 0.3 * whole || item.rows == n) continue;  // almost linearly dependent
      for (int c = 0; c < n; ++c) item.row[item.rows][c] = row[static_cast<std::size_t>(c)] / rest;
      item.before[item.rows] = !fresh ? before / rest : mandel_product(item.row[item.rows], stress, D_);
      item.after[item.rows] = after / rest;
      std::copy(d.begin(), d.end(), item.along[item.rows]);
      std::copy(side.normal.begin(), side.normal.end(), item.normal[item.rows]);
      ++item.rows;
    }
  }
}

void Boundary::prescribe(double time, double dt) {
  PIOLA_EXPECTS(dt >= 0);
  update_normals();
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    prescribe_velocity(particles_[k], time, dt, items_[k]);
    prescribe_stress(particles_[k], time, dt, items_[k]);
  }
}

void Boundary::prescribe_velocities(double time, double dt) {
  if (has_tractions()) update_normals();
  if (!has_supports()) return;
  for (std::size_t k = 0; k < particles_.size(); ++k) prescribe_velocity(particles_[k], time, dt, items_[k]);
}

double Boundary::power() const {
  exec::ReproducibleSum sum;
  for (Index const particle : particles_)
    for (auto const& side : sides_[static_cast<std::size_t>(particle)])
      sum += dot(real_.v(particle), traction_of(real_.stress_components(particle), side.area, D_));
  return sum.value();
}

Point Boundary::force_on_sides(Index particle) const {
  Point f{};
  Stress const stress = real_.stress_components(particle);
  for (auto const& side : sides_[static_cast<std::size_t>(particle)]) {
    Point const part = traction_of(stress, side.area, D_);
    for (std::size_t c = 0; c < 3; ++c) f[c] += part[c];
  }
  return f;
}

void Boundary::each_traction(double time, AddLoad const& add) const {
  for (Index const particle : particles_)
    for (auto const& side : sides_[static_cast<std::size_t>(particle)])
      for (std::size_t const l : side.tractions) {
        Point f = traction_of_load(l, side, particle, time);
        for (double& c : f) c *= length(side.area);
        add(traction_number_[l], particle, f);
      }
}

void Boundary::each_acceleration(double time, AddLoad const& add) const {
  for (std::size_t l = 0; l < accelerations_.size(); ++l) {
    Load const& load = accelerations_[l];
    if (has_ended(load.until, time)) continue;
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
      Point a{};
      for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c)
        a[c] = load.factor[k] * load.value[c](real_.X(static_cast<Index>(load.particles[k])), time);
      add(acceleration_number_[l], static_cast<Index>(load.particles[k]), a);
    }
  }
}

double Boundary::next_end_time(double time) const {
  return piola::next_end_time(time, supports_, tractions_, accelerations_);
}

}  // namespace piola::taylor_sph
