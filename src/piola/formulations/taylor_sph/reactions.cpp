// SPDX-License-Identifier: Apache-2.0
// What supports and loads do to a body: their impulses in the last step.
#include "piola/formulations/prescribed.hpp"
#include "piola/formulations/taylor_sph/body.hpp"
#include "piola/math/envelope_cholesky.hpp"
#include <cmath>

namespace piola::taylor_sph {
namespace {

using Point = std::array<double, 3>;

/// A prescribed velocity of one particle.
struct Row {
  std::size_t support;
  Point x, direction;
  double mass;
};

/// Rigid motions about a point; rotations count per `length`, so that all are of like size.
class RigidModes {
 public:
  static constexpr std::size_t count = 6;

  RigidModes(Point const& centre, double length) : centre_(centre), length_(length) {}
  /// The velocity of mode m at x along d.
  double along(std::size_t m, Point const& x, Point const& d) const {
    if (m < 3) return d[m];
    std::size_t const p = (m - 3 + 1) % 3, q = (m - 3 + 2) % 3;
    return ((x[p] - centre_[p]) * d[q] - (x[q] - centre_[q]) * d[p]) / length_;
  }
  /// What an impulse does in mode m.
  double of(std::size_t m, Impulse const& i) const {
    if (m < 3) return i.linear[m];
    std::size_t const c = m - 3, p = (c + 1) % 3, q = (c + 2) % 3;
    return (i.angular[c] - (centre_[p] * i.linear[q] - centre_[q] * i.linear[p])) / length_;
  }

 private:
  Point centre_;
  double length_;
};

RigidModes modes_of(std::vector<Row> const& rows) {
  Point centre{};
  double mass = 0, square = 0;
  for (Row const& row : rows) {
    mass += row.mass;
    for (std::size_t c = 0; c < 3; ++c) centre[c] += row.mass * row.x[c];
  }
  for (double& c : centre) c /= mass;
  for (Row const& row : rows)
    for (std::size_t c = 0; c < 3; ++c) square += row.mass * (row.x[c] - centre[c]) * (row.x[c] - centre[c]);
  double const length = std::sqrt(square / mass);
  return {centre, length > 0 ? length : 1};
}

/// Impulses m (d.z) d of the rows, z being the rigid motion for which they sum to `rest` in all that the rows hold.
void share(std::vector<Row> const& rows, Impulse const& rest, std::vector<Impulse>& of_support) {
  RigidModes const modes = modes_of(rows);
  EnvelopeCholesky matrix({0, 0, 0, 0, 0, 0});
  std::array<double, RigidModes::count> z{}, size{};
  for (std::size_t m = 0; m < RigidModes::count; ++m) {
    z[m] = modes.of(m, rest);
    for (Row const& row : rows) {
      double const own = modes.along(m, row.x, row.direction);
      size[m] += row.mass * own * own;
      for (std::size_t n = 0; n <= m; ++n) matrix.at(m, n) += row.mass * own * modes.along(n, row.x, row.direction);
    }
  }
  matrix.factorise(size);
  matrix.solve(z);
  for (Row const& row : rows) {
    double speed = 0;
    for (std::size_t m = 0; m < RigidModes::count; ++m) speed += z[m] * modes.along(m, row.x, row.direction);
    Point impulse = row.direction;
    for (double& c : impulse) c *= row.mass * speed;
    of_support[row.support].add(row.x, impulse);
  }
}

}  // namespace

/// Momentum and moment of momentum of the body.
Impulse TaylorBody::momentum() {
  double now[MotionSums::size];
  machine_->motion(state_, now);
  Impulse r;
  for (int c = 0; c < 3; ++c) {
    r.linear[static_cast<std::size_t>(c)] = now[MotionSums::v + c];
    r.angular[static_cast<std::size_t>(c)] = now[MotionSums::moment + c];
  }
  return r;
}

/// The scheme prescribes velocities and evaluates stress, so that no force of a support enters it. Supports bear what
/// loads do not explain of the change of momentum. Among several supports the traction of the stress on their surface
/// decides; what is left is shared out as by a rigid motion of what they hold.
void TaylorBody::find_reactions(Impulse const& before, double dt) {
  of_support_.assign(of_support_.size(), {});
  if (free_) return;
  Impulse rest = momentum();
  auto const take_out = [&](Impulse const& i) {
    for (std::size_t c = 0; c < 3; ++c) {
      rest.linear[c] -= i.linear[c];
      rest.angular[c] -= i.angular[c];
    }
  };
  take_out(before);
  for (Impulse const& load : of_load_) take_out(load);
  std::vector<Row> rows;
  for (std::size_t k = 0; k < boundary_.particles().size(); ++k) {
    Index const particle = boundary_.particles()[k];
    BoundaryItem const& item = state_.items[k];
    if (item.held == 0) continue;
    Point const x = this->x(particle), f = boundary_.force_on_sides(particle, record_stress(particle));
    for (int h = 0; h < item.held; ++h) {
      Point const d{item.direction[h][0], item.direction[h][1], item.direction[h][2]};
      rows.push_back({static_cast<std::size_t>(item.support[h]), x, d, mass_[at(particle)]});
      Point impulse = d;
      for (double& c : impulse) c *= dt * dot(f, d);
      of_support_[rows.back().support].add(x, impulse);
    }
  }
  if (rows.empty()) return;
  for (Impulse const& support : of_support_) take_out(support);
  share(rows, rest, of_support_);
}

void TaylorBody::add_actions(Actions& actions) const {
  for (std::size_t k = 0; k < actions.supports.size(); ++k) actions.supports[k].add(of_support_[k]);
  for (std::size_t k = 0; k < actions.loads.size(); ++k) actions.loads[k].add(of_load_[k]);
}

}  // namespace piola::taylor_sph
