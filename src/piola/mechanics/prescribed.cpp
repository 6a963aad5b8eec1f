// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/prescribed.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>

namespace piola {

bool has_ended(double until, double time) { return time >= until * (1 - 1e-9); }

bool is_steady(std::array<Expression, 3> const& formulas) {
  return std::none_of(formulas.begin(), formulas.end(), [](Expression const& e) { return e.depends_on_time(); });
}

double dot(Direction const& a, Direction const& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool make_orthogonal(Direction& d, std::vector<Direction> const& to) {
  for (auto const& q : to) {
    double const part = dot(d, q);
    for (std::size_t c = 0; c < 3; ++c) d[c] -= part * q[c];
  }
  double const length = std::sqrt(dot(d, d));
  if (!(length > 1e-6)) return false;
  for (double& c : d) c /= length;
  return true;
}

std::vector<Direction> directions_of(Support::Frame frame, std::array<bool, 3> const& fix, Direction normal, int D) {
  PIOLA_EXPECTS(D >= 1 && D <= 3);
  static constexpr Direction axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Direction> held;
  auto const n = static_cast<std::size_t>(D);
  if (frame == Support::Frame::axes) {
    for (std::size_t c = 0; c < n; ++c)
      if (fix[c]) held.push_back(axes[c]);
    return held;
  }
  std::vector<Direction> basis;
  std::fill(normal.begin() + D, normal.end(), 0);
  for (std::size_t c = 0; c < n; ++c)
    if (std::abs(std::abs(normal[c]) - 1) < 1e-12) normal = axes[c];
  if (make_orthogonal(normal, {})) basis.push_back(normal);
  if (frame == Support::Frame::normal) return basis;
  auto const along_normal = basis.size();
  for (std::size_t c = 0; c < n && basis.size() < n; ++c) {
    Direction d = axes[c];
    if (make_orthogonal(d, basis)) basis.push_back(d);
  }
  return {basis.begin() + static_cast<std::ptrdiff_t>(along_normal), basis.end()};
}

std::vector<PrescribedAxis> hold_along(std::vector<Direction> const& rows) {
  std::vector<PrescribedAxis> held;
  std::vector<Direction> chosen;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Direction d = rows[row];
    if (!make_orthogonal(d, chosen)) continue;
    // row = sum_k (row.q_k) q_k + length d, so that speed = (speed of the row - sum_k (row.q_k) speed_k) / length.
    double const length = dot(rows[row], d);
    std::vector<double> of_row(row + 1, 0);
    of_row[row] = 1;
    for (PrescribedAxis const& h : held) {
      double const part = dot(rows[row], h.direction);
      for (std::size_t k = 0; k < h.count; ++k) of_row[h.of[k]] -= part * h.weight[k];
    }
    PrescribedAxis next{d, row, {}, {}, 0};
    for (std::size_t r = 0; r < of_row.size(); ++r) {
      if (of_row[r] == 0) continue;
      next.of[next.count] = r;
      next.weight[next.count++] = of_row[r] / length;
    }
    held.push_back(next);
    chosen.push_back(d);
  }
  PIOLA_ENSURES(held.size() <= 3);
  return held;
}

double speed_along(std::array<Expression, 3> const& velocity, Direction const& d, Direction const& X, double time) {
  double speed = 0;
  for (std::size_t c = 0; c < 3; ++c)
    if (d[c] != 0) speed += d[c] * velocity[c](X, time);
  return speed;
}

Direction acceleration_by(std::array<Expression, 3> const& value, std::optional<Direction> const& normal, double factor,
                          std::array<double, 3> const& X, double time) {
  Direction a{};
  if (normal) {
    double const push = -factor * value[0](X, time);
    for (std::size_t c = 0; c < 3; ++c) a[c] = push * (*normal)[c];
  } else {
    for (std::size_t c = 0; c < 3; ++c) a[c] = factor * value[c](X, time);
  }
  return a;
}

double clip_step_to_end_time(double dt, double rest) {
  constexpr double last_steps = 20;
  double const steps = std::ceil(rest / dt * (1 - 1e-6));
  if (steps <= 1) return std::max(rest, 1e-3 * dt);
  return steps <= last_steps ? rest / steps : dt;
}

}  // namespace piola
