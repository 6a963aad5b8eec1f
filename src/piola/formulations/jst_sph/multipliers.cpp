// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/multipliers.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/deferred_global_sum.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/math/solve.hpp"
#include "piola/mechanics/constraint_matrix.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace piola::jst_sph {
namespace {

using Point = std::array<double, 3>;

struct NearParticle {
  Index slot;
  Point r;  ///< X_a - X_B, in smoothing lengths
  double w;
};

/// w_a = W_a (a0 + a.r) with sum w = 1 and sum w r = 0, r in smoothing lengths. False if the neighbours do not allow
/// it.
template <int D>
bool correct_linearly(std::vector<NearParticle>& near) {
  double A[(D + 1) * (D + 1)]{}, b[D + 1]{};
  b[0] = 1;
  auto const basis = [](NearParticle const& p, int k) { return k == 0 ? 1 : p.r[static_cast<std::size_t>(k - 1)]; };
  for (auto const& p : near)
    for (int i = 0; i <= D; ++i)
      for (int j = 0; j <= D; ++j) A[i * (D + 1) + j] += p.w * basis(p, i) * basis(p, j);
  if (!(solve_in_place<D + 1>(A, b) > 1e-9)) return false;
  for (auto& p : near) {
    double factor = 0;
    for (int i = 0; i <= D; ++i) factor += b[i] * basis(p, i);
    p.w *= factor;
  }
  return true;
}

/// Particles within reach of the particle in slot B with the weights of a linearly exact interpolation at X_B.
std::vector<NearParticle> interpolation(Cloud const& cloud, CellGrid const& grid, Index B) {
  auto const& X = cloud.X[static_cast<std::size_t>(B)];
  std::vector<NearParticle> near;
  grid.visit(X, [&](Index a) {
    Point r{};
    for (std::size_t c = 0; c < 3; ++c) r[c] = (cloud.X[static_cast<std::size_t>(a)][c] - X[c]) / cloud.h;
    double const q = std::sqrt(dot(r, r));
    if (q < cloud.kernel->support) near.push_back({a, r, cloud.kernel->w(cloud.dimension, q)});
  });
  // By places, which no order in memory changes.
  std::sort(near.begin(), near.end(), [&](auto const& a, auto const& b) {
    return cloud.X[static_cast<std::size_t>(a.slot)] < cloud.X[static_cast<std::size_t>(b.slot)];
  });
  bool const good = cloud.dimension == 3   ? correct_linearly<3>(near)
                    : cloud.dimension == 2 ? correct_linearly<2>(near)
                                           : correct_linearly<1>(near);
  if (!good) near = {{B, {}, 1}};
  return near;
}

}  // namespace

Multipliers::Multipliers(std::span<PrescribedDirection const> held, Cloud const& cloud) : D_(cloud.dimension) {
  PIOLA_EXPECTS(cloud.dimension >= 1 && cloud.dimension <= 3);
  find_weights(held, cloud);
  find_owners(held);
  matrix_ = constraint_matrix(rows_, weights_, slots_.size(), [&](std::size_t a) { return volume_[a]; });
}

void Multipliers::find_owners(std::span<PrescribedDirection const> held) {
  owner_.assign(slots_.size(), 0);
  std::vector<double> largest(slots_.size(), -1);
  for (Row const& row : rows_) {
    auto const support = static_cast<std::size_t>(held[row.held].support);
    if (support >= impulses_.size()) impulses_.resize(support + 1);
    for (auto k = row.first; k < row.last; ++k) {
      auto const a = weights_[k].particle;
      if (!(std::abs(weights_[k].weight) > largest[a])) continue;
      largest[a] = std::abs(weights_[k].weight);
      owner_[a] = support;
    }
  }
}

void Multipliers::find_weights(std::span<PrescribedDirection const> held, Cloud const& cloud) {
  // Rows with common particles should be near each other in the matrix: axis by axis, then along the body.
  std::vector<std::size_t> order(held.size());
  for (std::size_t k = 0; k < held.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (held[a].axis != held[b].axis) return held[a].axis < held[b].axis;
    return cloud.X[static_cast<std::size_t>(held[a].slot)] < cloud.X[static_cast<std::size_t>(held[b].slot)];
  });
  CellGrid const grid(cloud.X, cloud.kernel->support * cloud.h);
  std::map<Index, std::size_t> known;
  for (auto const k : order) {
    PrescribedDirection const& h = held[k];
    auto const first = weights_.size();
    for (auto const& p : interpolation(cloud, grid, h.slot)) {
      auto const [at, is_new] = known.try_emplace(p.slot, slots_.size());
      if (is_new) {
        slots_.push_back(p.slot);
        volume_.push_back(cloud.volume[static_cast<std::size_t>(p.slot)]);
      }
      weights_.push_back({at->second, p.w});
    }
    rows_.push_back({k, {h.direction[0], h.direction[1], h.direction[2]}, first, weights_.size()});
  }
}

/// Rigid motions of the particles about the centre of their mean distance, so that the modes are of like size.
void Multipliers::set_modes(std::vector<Point> const& x) {
  Point centre{};
  double total = 0, square = 0;
  for (std::size_t a = 0; a < x.size(); ++a) {
    total += volume_[a];
    for (std::size_t c = 0; c < 3; ++c) centre[c] += volume_[a] * x[a][c];
  }
  for (double& c : centre) c /= total;
  modes_.assign(x.size(), {});
  for (std::size_t a = 0; a < x.size(); ++a)
    for (std::size_t c = 0; c < 3; ++c) square += volume_[a] * (x[a][c] - centre[c]) * (x[a][c] - centre[c]);
  double const length = std::sqrt(square / total);
  for (std::size_t a = 0; a < x.size(); ++a) {
    Point r{};
    for (std::size_t c = 0; c < 3; ++c) r[c] = length > 0 ? (x[a][c] - centre[c]) / length : 0;
    auto& m = modes_[a];
    for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c) m[c][c] = 1;
    if (D_ > 1) m[D_ == 2 ? 2 : 3] = {-r[1], r[0], 0};
    if (D_ > 2) {
      m[4] = {0, -r[2], r[1]};
      m[5] = {r[2], 0, -r[0]};
    }
  }
  mode_rows_.assign(rows_.size(), {});
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (auto k = rows_[r].first; k < rows_[r].last; ++k)
      for (std::size_t m = 0; m < most_modes; ++m)
        mode_rows_[r][m] += weights_[k].weight * dot(rows_[r].direction, modes_[weights_[k].particle][m]);
}

/// The correction V^-1 A^T beta + Z eta of v that gives the rows A their values and has no rigid part, Z being the
/// rigid motions:   S beta + R eta = wanted - A v,   R^T beta + N eta = 0,   S = A V^-1 A^T,  R = A Z,  N = Z^T V Z.
void Multipliers::correct(std::vector<Point> const& v, std::vector<double> const& wanted) {
  std::vector<double> beta(rows_.size());
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    Point value{};
    for (auto k = rows_[r].first; k < rows_[r].last; ++k)
      for (std::size_t c = 0; c < 3; ++c) value[c] += weights_[k].weight * v[weights_[k].particle][c];
    beta[r] = wanted[r] - dot(rows_[r].direction, value);
  }
  matrix_.solve(beta);
  std::array<std::vector<double>, most_modes> of_mode;
  EnvelopeCholesky schur({0, 0, 0, 0, 0, 0});
  std::array<double, most_modes> eta{}, size_of_mode{};
  for (std::size_t m = 0; m < most_modes; ++m) {
    for (auto const& row : mode_rows_) of_mode[m].push_back(row[m]);
    matrix_.solve(of_mode[m]);
    for (std::size_t r = 0; r < rows_.size(); ++r) eta[m] -= mode_rows_[r][m] * beta[r];
    for (std::size_t n = 0; n <= m; ++n) {
      double& entry = schur.at(m, n);
      for (std::size_t a = 0; a < slots_.size(); ++a) entry += volume_[a] * dot(modes_[a][m], modes_[a][n]);
      size_of_mode[m] = entry;  // in the end that of n = m
      for (std::size_t r = 0; r < rows_.size(); ++r) entry -= mode_rows_[r][n] * of_mode[m][r];
    }
  }
  // A rigid motion that the rows prescribe has no momentum constraint: the prescribed values take precedence.
  schur.factorise(size_of_mode);
  schur.solve(eta);
  for (std::size_t m = 0; m < most_modes; ++m)
    for (std::size_t r = 0; r < rows_.size(); ++r) beta[r] -= of_mode[m][r] * eta[m];
  change_.assign(slots_.size(), {});
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (auto k = rows_[r].first; k < rows_[r].last; ++k) {
      auto const a = weights_[k].particle;
      for (std::size_t c = 0; c < 3; ++c)
        change_[a][c] += beta[r] * weights_[k].weight / volume_[a] * rows_[r].direction[c];
    }
  for (std::size_t a = 0; a < slots_.size(); ++a)
    for (std::size_t m = 0; m < most_modes; ++m)
      for (std::size_t c = 0; c < static_cast<std::size_t>(D_); ++c) change_[a][c] += eta[m] * modes_[a][m][c];
}

/// Replicates the motion of all particles within reach, so that the solution is replicated too. Collective.
void Multipliers::complete(BodyState const& body, bool kick, bool stage) const {
  auto const merge = [&](FieldRef const& field) { allgather_selected_slots(field, body.slots, slots_, D_); };
  merge(body.x);
  merge(body.v);
  if (stage) merge(body.v_n);
  if (kick) merge(body.rate);
}

Multipliers::Motion Multipliers::motion(BodyState const& body, MultiplierCall const& call) const {
  Motion of;
  for (auto const slot : slots_) {
    Point& x = of.x.emplace_back(point_at(body.x, slot, D_));
    Point& v = of.v.emplace_back(point_at(body.v, slot, D_));
    for (std::size_t k = 0; k < static_cast<std::size_t>(D_); ++k) {
      int const c = static_cast<int>(k);
      // Arms of the first stage are x^n = x^(n+1) - dt/2 (v^n + v*), eq. (45).
      if (call.when == MultiplierCall::When::stage_1) x[k] -= 0.5 * call.dt * (value_at(body.v_n, slot, c) + v[k]);
      if (call.when == MultiplierCall::When::first_kick) v[k] += 0.5 * call.dt * value_at(body.rate, slot, c);
    }
  }
  return of;
}

void Multipliers::enforce(BodyState& body, MultiplierCall const& call) {
  if (rows_.empty()) return;
  double const dt = call.dt;
  bool const kick = call.when == MultiplierCall::When::first_kick, stage = call.when == MultiplierCall::When::stage_1;
  if (body.halo != nullptr) complete(body, kick, stage);
  auto const [x, v] = motion(body, call);
  std::vector<double> wanted;
  for (auto const& row : rows_) {
    PrescribedDirection const& h = body.boundary.held[row.held];
    wanted.push_back(kick ? 0.5 * (h.start_speed + h.speed) : h.speed);
  }
  set_modes(x);
  correct(v, wanted);
  std::vector<ImpulseSum> impulses(impulses_.size());
  exec::ReproducibleSum work;
  double const share = stage ? 0.5 : 1.0;  // of a change of v* in that of v^(n+1)
  for (std::size_t a = 0; a < slots_.size(); ++a) {
    Point impulse = change_[a];
    for (double& c : impulse) c *= share * body.constants.rho0 * volume_[a];
    if (call.when != MultiplierCall::When::start) impulses[owner_[a]].add(x[a], impulse);
    for (int c = 0; c < D_; ++c) {
      auto const k = static_cast<std::size_t>(c);
      double const change = change_[a][k];
      work += volume_[a] * change * (v[a][k] + 0.5 * change);
      if (kick)
        value_at(body.rate, slots_[a], c) += 2 * change / dt;
      else
        value_at(body.v, slots_[a], c) += change;
      if (stage) value_at(body.x, slots_[a], c) += 0.5 * dt * change;
    }
  }
  if (call.when == MultiplierCall::When::start) return;
  for (std::size_t s = 0; s < impulses.size(); ++s) impulses_[s].add(impulses[s].value());
  body.external_work->add(share * body.constants.rho0 * work.value());
}

std::size_t Multipliers::bytes() const {
  return matrix_.bytes() + weights_.size() * sizeof(Weight) + rows_.size() * sizeof(Row) +
         slots_.size() * (sizeof(Index) + sizeof(double) + sizeof(modes_[0]) + sizeof(Point));
}

}  // namespace piola::jst_sph
