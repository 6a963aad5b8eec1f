// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/distribute_reactions.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/math/envelope_cholesky.hpp"
#include <cmath>

namespace piola {
namespace {

/// Rigid motions about a point; rotations count per `length`, so that all are of like size.
class RigidModes {
 public:
  static constexpr std::size_t count = 6;

  RigidModes(Direction const& centre, double length) : centre_(centre), length_(length) {}
  /// The velocity of mode m at x along d.
  double along(std::size_t m, Direction const& x, Direction const& d) const {
    if (m < 3) return d[m];
    std::size_t const p = (m - 3 + 1) % 3, q = (m - 3 + 2) % 3;
    return ((x[p] - centre_[p]) * d[q] - (x[q] - centre_[q]) * d[p]) / length_;
  }
  /// Component of an impulse in mode m.
  double of(std::size_t m, Impulse const& i) const {
    if (m < 3) return i.linear[m];
    std::size_t const c = m - 3, p = (c + 1) % 3, q = (c + 2) % 3;
    return (i.angular[c] - (centre_[p] * i.linear[q] - centre_[q] * i.linear[p])) / length_;
  }

 private:
  Direction centre_;
  double length_;
};

RigidModes modes_of(std::vector<SupportRow> const& rows) {
  Direction centre{};
  exec::ReproducibleSums<4> sums;  // mass and its first moments
  for (SupportRow const& row : rows) {
    double const of_row[]{row.mass, row.mass * row.x[0], row.mass * row.x[1], row.mass * row.x[2]};
    sums.add(of_row);
  }
  double const mass = sums.value();
  for (std::size_t c = 0; c < 3; ++c) centre[c] = sums.value(static_cast<int>(c) + 1) / mass;
  exec::ReproducibleSum square;
  for (SupportRow const& row : rows)
    for (std::size_t c = 0; c < 3; ++c) square += row.mass * (row.x[c] - centre[c]) * (row.x[c] - centre[c]);
  double const length = std::sqrt(square.value() / mass);
  return {centre, length > 0 ? length : 1};
}

}  // namespace

void share_out(std::vector<SupportRow> const& rows, Impulse const& rest, std::vector<Impulse>& of_support) {
  PIOLA_EXPECTS(!rows.empty() && !of_support.empty());
  RigidModes const modes = modes_of(rows);
  EnvelopeCholesky matrix({0, 0, 0, 0, 0, 0});
  std::array<double, RigidModes::count> z{}, size{};
  for (std::size_t m = 0; m < RigidModes::count; ++m) {
    z[m] = modes.of(m, rest);
    exec::ReproducibleSums<RigidModes::count> products;
    for (SupportRow const& row : rows) {
      double const own = modes.along(m, row.x, row.direction);
      double of_row[RigidModes::count]{};
      for (std::size_t n = 0; n <= m; ++n) of_row[n] = row.mass * own * modes.along(n, row.x, row.direction);
      products.add(of_row);
    }
    size[m] = products.value(static_cast<int>(m));
    for (std::size_t n = 0; n <= m; ++n) matrix.at(m, n) = products.value(static_cast<int>(n));
  }
  matrix.factorise(size);
  matrix.solve(z);
  std::vector<ImpulseSum> shares(of_support.size());
  for (SupportRow const& row : rows) {
    double speed = 0;
    for (std::size_t m = 0; m < RigidModes::count; ++m) speed += z[m] * modes.along(m, row.x, row.direction);
    Direction impulse = row.direction;
    for (double& c : impulse) c *= row.mass * speed;
    shares[row.support].add(row.x, impulse);
  }
  for (std::size_t s = 0; s < shares.size(); ++s) of_support[s].add(shares[s].value());
}

}  // namespace piola
