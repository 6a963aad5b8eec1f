// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/absorbing_surface.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/slot_collectives.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

/// Relative error of the mean velocity in the norm of the masses. Energy and momenta are kept better than that.
constexpr double accuracy = 1e-10;
/// Ten iterations are usual, because the dashpots add a fraction of the mass to the mass.
constexpr int most_iterations = 200;

/// rho c^2 of pressure waves [Pa]; in plates and bars those of the missing directions without stress.
double pressure_modulus(Constants const& of, int dimension) {
  double const whole = of.kappa + 4 * of.mu / 3;
  if (!of.stress_free) return whole;
  return dimension == 1 ? 9 * of.kappa * of.mu / (3 * of.kappa + of.mu) : 4 * of.mu * (of.kappa + of.mu / 3) / whole;
}

double product(std::vector<double> const& a, std::vector<double> const& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

void set_drags(std::vector<AbsorbingFacet>& facets, std::vector<Load> const& loads, int dimension,
               std::function<Constants const&(Index slot)> const& constants_of) {
  PIOLA_EXPECTS(constants_of != nullptr);
  for (AbsorbingFacet& facet : facets) {
    Absorption const& absorbs = *loads[facet.load].absorbs;
    Constants const& of = constants_of(facet.slot);
    double const M = pressure_modulus(of, dimension), normal = std::sqrt(of.rho0 * M),
                 shear = std::sqrt(of.rho0 * of.mu);
    facet.normal_drag = facet.area * absorbs.impedance[0] * normal;
    facet.shear_drag = facet.area * absorbs.impedance[1] * shear;
    if (!absorbs.angle) continue;
    double const cosine = std::cos(*absorbs.angle);
    facet.normal_drag = facet.area * normal * (1 - 2 * of.mu / M * (1 - cosine * cosine)) / cosine;
    facet.shear_drag = facet.area * normal * 2 * of.mu / M * cosine;
  }
}

AbsorbingSurface::AbsorbingSurface(int dimension, Input const& input) : D_(dimension), loads_(input.loads) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  for (AbsorbingFacet const& facet : input.facets) {
    std::size_t const first = weights_.size();
    for (auto const& w : facet.weights) {
      auto const [at, is_new] = place_.try_emplace(w.slot, particles_.size());
      if (is_new) {
        particles_.push_back({input.mass(w.slot), input.X(w.slot)});
        slots_.push_back(w.slot);
      }
      weights_.push_back({at->second, w.of});
    }
    facets_.push_back({facet, first, weights_.size()});
    facets_.back().of.weights.clear();
  }
}

void AbsorbingSurface::begin_step(std::span<PrescribedDirection const> held, std::span<MirroredParticle const> mirrored,
                                  double time, double dt) {
  lost_ = work_ = 0;
  converges_ = true;
  impulses_.clear();
  for (Facet& facet : facets_) {
    Load const& load = loads_[facet.of.load];
    facet.acts = !has_ended(load.until, time);
    for (int side = 0; side < 2; ++side)
      for (std::size_t c = 0; facet.acts && c < static_cast<std::size_t>(D_); ++c)
        facet.background[side][c] = load.value[c](facet.of.X, time + side * dt);
  }
  held_.clear();
  for (PrescribedDirection const& h : held)
    if (auto const a = place_.find(h.slot); a != place_.end())
      held_.push_back({a->second, {h.direction[0], h.direction[1], h.direction[2]}, h.support});
  for (MirroredParticle const& p : mirrored)
    if (auto const a = place_.find(p.slot); a != place_.end())
      for (std::size_t c = 0; c < 3; ++c) {
        Held on_plane{a->second, {}, -1};
        on_plane.direction[c] = 1;
        if ((p.axes >> c & 1) != 0) held_.push_back(on_plane);
      }
}

AbsorbingSurface::Vector AbsorbingSurface::values(FieldRef const& field) const {
  if (own_) allgather_selected_slots(field, *own_, slots_, D_);
  Vector all;
  all.reserve(slots_.size() * static_cast<std::size_t>(D_));
  for (Index const slot : slots_)
    for (int c = 0; c < D_; ++c) all.push_back(value_at(field, slot, c));
  return all;
}

/// Mean over a facet.
AbsorbingSurface::Point AbsorbingSurface::mean(Facet const& facet, Vector const& of) const {
  auto const D = static_cast<std::size_t>(D_);
  Point sum{};
  for (std::size_t k = facet.first; k < facet.last; ++k)
    for (std::size_t c = 0; c < D; ++c) sum[c] += weights_[k].of[c] * of[weights_[k].particle * D + c];
  return sum;
}

/// Force that drags a facet with the velocity u, Z u [N].
AbsorbingSurface::Point AbsorbingSurface::drag(Facet const& facet, Point const& u) const {
  double const along = (facet.of.normal_drag - facet.of.shear_drag) * dot(u, facet.of.normal);
  Point force{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c)
    force[c] = facet.of.shear_drag * u[c] + along * facet.of.normal[c];
  return force;
}

/// Forces on the particles from forces on the facets, B^T times these [N].
template <class Of>
AbsorbingSurface::Vector AbsorbingSurface::forces(Of const& force_on) const {
  auto const D = static_cast<std::size_t>(D_);
  Vector sum(slots_.size() * D, 0);
  for (Facet const& facet : facets_) {
    if (!facet.acts) continue;
    Point const force = force_on(facet);
    for (std::size_t k = facet.first; k < facet.last; ++k)
      for (std::size_t c = 0; c < D; ++c) sum[weights_[k].particle * D + c] += weights_[k].of[c] * force[c];
  }
  return sum;
}

/// Removes what supports and mirror planes hold.
void AbsorbingSurface::remove_held(Vector& of) const {
  auto const D = static_cast<std::size_t>(D_);
  for (Held const& h : held_) {
    double along = 0;
    for (std::size_t c = 0; c < D; ++c) along += of[h.particle * D + c] * h.direction[c];
    for (std::size_t c = 0; c < D; ++c) of[h.particle * D + c] -= along * h.direction[c];
  }
}

/// Divides forces by masses, then removes the directions that are held.
void AbsorbingSurface::accelerate(Vector& of) const {
  for (std::size_t k = 0; k < of.size(); ++k) of[k] /= particles_[k / static_cast<std::size_t>(D_)].mass;
  remove_held(of);
}

/// Forces of the dashpots on the particles at velocities v, B^T Z (g - B v) [N].
AbsorbingSurface::Vector AbsorbingSurface::dashpots(Vector const& v, bool at_end) const {
  return forces([&](Facet const& facet) {
    Point by = mean(facet, v);
    for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c) by[c] = facet.background[at_end][c] - by[c];
    return drag(facet, by);
  });
}

/// Mean velocity u of a kick of length h = `half`, from (M + h/2 C) u = M v + h/2 B^T Z g.
AbsorbingSurface::Vector AbsorbingSurface::mean_velocity(Vector const& v, double half, bool at_end) {
  double const tau = 0.5 * half;
  auto const D = static_cast<std::size_t>(D_);
  Vector u = v, residual = dashpots(v, at_end);
  for (double& r : residual) r *= tau;
  Vector next = residual;
  accelerate(next);
  double square = product(residual, next);
  double const enough = accuracy * accuracy * square;
  Vector direction = next;
  for (int k = 0; k < most_iterations && square > enough; ++k) {
    Vector image = forces([&](Facet const& facet) { return drag(facet, mean(facet, direction)); });
    for (std::size_t i = 0; i < image.size(); ++i) image[i] = tau * image[i] + particles_[i / D].mass * direction[i];
    double const by = square / product(direction, image);
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] += by * direction[i];
      residual[i] -= by * image[i];
    }
    next = residual;
    accelerate(next);
    double const before = square;
    square = product(residual, next);
    for (std::size_t i = 0; i < u.size(); ++i) direction[i] = next[i] + square / before * direction[i];
  }
  converges_ = converges_ && !(square > enough);
  return u;
}

void AbsorbingSurface::absorb(Motion const& of, double half, bool at_end) {
  PIOLA_EXPECTS(half > 0);
  Vector middle = values(of.v), others = values(of.a);
  remove_held(others);
  for (std::size_t k = 0; k < middle.size(); ++k) middle[k] += (at_end ? -0.5 : 0.5) * half * others[k];
  Vector const mean_v = mean_velocity(middle, half, at_end), force = dashpots(mean_v, at_end);
  record(values(of.x), mean_v, force, half, at_end);
  Vector change = force;
  accelerate(change);
  auto const D = static_cast<std::size_t>(D_);
  for (std::size_t k = 0; k < change.size(); ++k)
    value_at(of.v, slots_[k / D], static_cast<int>(k % D)) += half * change[k];
}

double AbsorbingSurface::square_of_absorbed(Motion const& of) const {
  if (empty()) return 0;
  Vector const a = values(of.a);
  Vector change = dashpots(values(of.v), true);
  accelerate(change);
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum -= particles_[k / static_cast<std::size_t>(D_)].mass * change[k] * (2 * a[k] + change[k]);
  return sum;
}

/// Energies and impulses of a kick.
void AbsorbingSurface::record(Vector const& x, Vector const& mean_v, Vector const& force, double half, bool at_end) {
  auto const D = static_cast<std::size_t>(D_);
  Vector moved = x;
  for (std::size_t k = 0; k < moved.size(); ++k) moved[k] -= particles_[k / D].X[k % D];
  for (Facet const& facet : facets_) {
    if (!facet.acts) continue;
    Point const u = mean(facet, mean_v), away = mean(facet, moved), g = facet.background[at_end];
    Point slip{}, at = facet.of.X;
    for (std::size_t c = 0; c < D; ++c) {
      slip[c] = u[c] - g[c];
      at[c] += away[c];
    }
    Point impulse = drag(facet, slip);
    for (double& p : impulse) p *= -half;
    lost_ -= dot(impulse, slip);
    work_ += dot(impulse, g);
    if (!loads_[facet.of.load].name.empty()) impulses_.push_back({facet.of.load, true, at, impulse});
  }
  for (Held const& h : held_) {
    if (h.support < 0) continue;
    double along = 0;
    Point at = particles_[h.particle].X, reaction = h.direction;
    for (std::size_t c = 0; c < D; ++c) {
      along += force[h.particle * D + c] * h.direction[c];
      at[c] = x[h.particle * D + c];
    }
    for (double& p : reaction) p *= -half * along;
    impulses_.push_back({static_cast<std::size_t>(h.support), false, at, reaction});
    for (std::size_t c = 0; c < D; ++c) work_ += reaction[c] * mean_v[h.particle * D + c];
  }
}

void AbsorbingSurface::end_step(BodyBoundary& to, DeferredGlobalSum& work) {
  if (empty()) return;
  radiated_ += lost_;
  work.add(work_);
  if (own_ && comm::rank() != 0) return;  // impulses are sums over ranks
  for (Impulse const& impulse : impulses_)
    if (impulse.by_load)
      to.add_load_impulse(impulse.of, impulse.x, impulse.p);
    else
      to.add_impulse(impulse.of, impulse.x, impulse.p);
}

}  // namespace piola::nodal
