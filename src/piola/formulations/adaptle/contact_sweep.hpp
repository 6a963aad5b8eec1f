// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/component_views.hpp"
#include "piola/formulations/adaptle/records.hpp"

/// Contact between bodies, and with rigid shapes: central, frictionless repulsion.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Force and stiffness of one pair at distance r.
struct ContactForce {
  double force = 0;      ///< repulsion [N]
  double stiffness = 0;  ///< bound of its derivative [N/m]
  double overlap = 0;    ///< 1 - r / dp
  double energy = 0;     ///< U [J]
};

/// F = -dU/dr, U = eps (W(r)/W(dp))^n: eqs. (15), (16) with constant coefficient.
template <int D>
PIOLA_FN ContactForce kernel_contact(KernelContactPair const& p, double r) {
  Kernel<D> const kernel(p.h);
  double s, W;
  kernel.evaluate(r * r, s, W);
  if (!(W > 0)) return {};
  double const reference = kernel(p.dp), w = W / reference, slope = s * r / reference, exponent = p.exponent;
  double const power = std::pow(w, exponent - 2);
  double const bend = 3 * kernel.norm * kernel.inverse_h * kernel.inverse_h / reference;
  return {p.eps * exponent * power * w * slope, p.eps * exponent * power * ((exponent - 1) * slope * slope + w * bend),
          1 - r / p.dp, p.eps * power * w * w};
}

/// F = eps (dp - r) / dp^2 below dp: a linear spring with the stiffness of the material.
PIOLA_FN ContactForce linear_contact(KernelContactPair const& p, double r) {
  if (!(r < p.dp)) return {};
  return {p.eps * (p.dp - r) / (p.dp * p.dp), p.eps / (p.dp * p.dp), 1 - r / p.dp,
          0.5 * p.eps * (1 - r / p.dp) * (1 - r / p.dp)};
}

template <int D>
struct ContactSweep {
  ContactTable table;
  Index const* slot;  ///< of sorted particles
  BodyConstants const* body;
  int const* body_of;
  int bodies;
  Components x, v_half, volume_half;
  OwnComponents force, sums;  ///< sums: in the order of ContactSum
  bool axisymmetric;
  Index particles;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index t = block.first; t < block.last; ++t) visit(t);
  }

 private:
  PIOLA_FN ContactForce force_of(KernelContactPair const& pair, Index i, Index j, double r) const {
    if (table.law == ContactLaw::linear) return linear_contact(pair, r);
    if (table.law == ContactLaw::kernel) return kernel_contact<D>(pair, r);
    KernelContactPair published = pair;
    published.eps = table.published_stiffness * volume_half.at(i) * volume_half.at(j);
    return kernel_contact<D>(published, r);
  }

  /// Factor by which the law is steeper than for n = 4, for which steps are set.
  PIOLA_FN double sharpness(KernelContactPair const& pair) const {
    return table.law != ContactLaw::linear && pair.exponent > 4 ? pair.exponent / 4 : 1;
  }

  /// Closing speed of two particles at the distance r [m/s].
  PIOLA_FN double approach(Index i, Index j, double r) const {
    double sum = 0;
    for (int c = 0; c < D; ++c) sum += (v_half.at(j, c) - v_half.at(i, c)) * (x.at(i, c) - x.at(j, c));
    return sum > 0 ? sum / r : 0;
  }

  PIOLA_FN void visit(Index t) const {
    Index const i = slot[table.target[t]];
    Index const* const row = table.list + static_cast<std::ptrdiff_t>(t) * table.capacity;
    for (Index k = 0; k < table.length[t]; ++k) {
      Index const j = slot[row[k]];
      KernelContactPair const& pair = table.pair[body_of[i] * bodies + body_of[j]];
      if (!table.acts(pair, i, source_of(j, particles))) continue;
      double square = 0;
      for (int c = 0; c < D; ++c) {
        double const d = x.at(i, c) - x.at(j, c);
        square += d * d;
      }
      double const r = std::sqrt(square);
      ContactForce f = force_of(pair, i, j, r);
      if (!(f.stiffness > 0)) continue;
      if (axisymmetric) act_on_rings(i, j, f);
      raise(i, ContactSum::closing, approach(i, j, r) * sharpness(pair) / pair.dp);
      double power = 0;
      for (int c = 0; c < D; ++c) {
        double const push = f.force * (x.at(i, c) - x.at(j, c)) / (r > 0 ? r : 1);
        force.at(i, c) += push;
        power += 0.5 * (v_half.at(j, c) - v_half.at(i, c)) * push;
      }
      sums.at(i, ContactSum::power) += power;
      sums.at(i, ContactSum::stiffness) += f.stiffness;
      raise(i, ContactSum::overlap, f.overlap);
    }
  }
  /// U is per unit length of the mean of both circles, pi (r_a + r_b), and so acts on the radii.
  PIOLA_FN void act_on_rings(Index i, Index j, ContactForce& f) const {
    double const around = 0.5 * circle(x.at(i) + std::fabs(x.at(j))), inwards = 0.5 * circle(f.energy);
    f.force *= around;
    f.stiffness *= around;
    force.at(i) -= inwards;
    sums.at(i, ContactSum::power) += inwards * v_half.at(i);
  }
  PIOLA_FN void raise(Index i, int which, double value) const { sums.at(i, which) = maximum(sums.at(i, which), value); }
};

/// A point in a box or cylinder: distances from the centre along axes towards the point, and half the lengths there.
struct BoxCoordinates {
  int axes = 0;
  double q[3]{}, bound[3]{};
  double direction[3][3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

/// r: from the centre; along: its component along the axis.
PIOLA_FN BoxCoordinates coordinates_in_cylinder(RigidPoseAtHalfTime const& shape, double const* r, double along) {
  BoxCoordinates at;
  at.axes = 2;
  double across = 0;
  for (int c = 0; c < 3; ++c) {
    at.direction[0][c] = shape.axis[c] * (along < 0 ? -1 : 1);
    at.direction[1][c] = r[c] - along * shape.axis[c];
    across += at.direction[1][c] * at.direction[1][c];
  }
  across = std::sqrt(across);
  for (int c = 0; c < 3; ++c) at.direction[1][c] = across > 0 ? at.direction[1][c] / across : 0;
  at.q[0] = std::fabs(along);
  at.q[1] = across;
  at.bound[0] = shape.half[0];
  at.bound[1] = shape.radius;
  return at;
}

template <int D>
PIOLA_FN BoxCoordinates coordinates_in_box(RigidPoseAtHalfTime const& shape, double const* r) {
  BoxCoordinates at;
  at.axes = D;
  for (int c = 0; c < D; ++c) {
    if (r[c] < 0) at.direction[c][c] = -1;
    at.q[c] = std::fabs(r[c]);
    at.bound[c] = shape.half[c];
  }
  return at;
}

/// Outside: from the nearest point of the box; inside: from the nearest face.
PIOLA_FN double distance_to_box(BoxCoordinates const& at, double* normal) {
  double outside = 0, nearest = -1e300;
  int face = 0;
  for (int c = 0; c < at.axes; ++c) {
    double const d = at.q[c] - at.bound[c];
    if (d > 0) outside += d * d;
    if (d > nearest) {
      nearest = d;
      face = c;
    }
  }
  for (int k = 0; k < 3; ++k) normal[k] = at.direction[face][k];
  if (!(outside > 0)) return nearest;
  outside = std::sqrt(outside);
  for (int k = 0; k < 3; ++k) normal[k] = 0;
  for (int c = 0; c < at.axes; ++c)
    for (int k = 0; k < 3; ++k)
      if (at.q[c] > at.bound[c]) normal[k] += (at.q[c] - at.bound[c]) / outside * at.direction[c][k];
  return outside;
}

/// Distance of a point from the surface of a rigid shape, negative inside, and the outward normal there.
template <int D>
PIOLA_FN double distance_to(RigidPoseAtHalfTime const& shape, double const* x, double* normal) {
  double r[3]{}, along = 0;
  for (int c = 0; c < D; ++c) {
    r[c] = x[c] - shape.centre[c];
    along += r[c] * shape.axis[c];
  }
  if (shape.kind == 0) {
    for (int c = 0; c < 3; ++c) normal[c] = shape.axis[c];
    return along;
  }
  if (shape.kind == 1) {
    double const length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    for (int c = 0; c < 3; ++c) normal[c] = length > 0 ? r[c] / length : (c == 0 ? 1 : 0);
    return length - shape.radius;
  }
  return distance_to_box(shape.kind == 2 ? coordinates_in_cylinder(shape, r, along) : coordinates_in_box<D>(shape, r),
                         normal);
}

/// A particle closer than dp/2 to a rigid shape is repelled as by its mirror image under the linear law: F = 2 K
/// dp^(D-2) (dp/2 - d).
template <int D>
struct RigidSweep {
  RigidPoseAtHalfTime const* shape;
  int shapes;
  double scale;
  BodyConstants const* body;
  int const* body_of;
  Components x, v_half;
  OwnComponents force, sums;  ///< sums: in the order of ContactSum
  double* power_on_bodies;    ///< per slot: power of the moving shapes [W]
  double* action;             ///< [block][shape]: force [N] and moment about the origin [N m]
  bool axisymmetric;

  PIOLA_FN void operator()(Range block, Index number) const {
    double* const of_block = action + static_cast<std::ptrdiff_t>(number) * shapes * 6;
    for (int c = 0; c < 6 * shapes; ++c) of_block[c] = 0;
    for (Index i = block.first; i < block.last; ++i) {
      power_on_bodies[i] = 0;
      for (int k = 0; k < shapes; ++k) push_off(i, shape[k], of_block + std::ptrdiff_t{6} * k);
    }
  }

 private:
  PIOLA_FN void push_off(Index i, RigidPoseAtHalfTime const& s, double* sum) const {
    double normal[3];
    BodyConstants const& b = body[body_of[i]];
    double const stand_off = 0.5 * b.spacing, place[3]{x.at(i), x.at(i, 1), x.at(i, 2)},
                 distance = distance_to<D>(s, place, normal);
    if (distance < 4 * stand_off) {
      double closing = 0;
      for (int c = 0; c < D; ++c) closing += (s.velocity[c] - v_half.at(i, c)) * normal[c];
      raise(i, ContactSum::closing, closing / b.spacing);
    }
    if (!(distance < stand_off)) return;
    double k = 2 * scale * b.bulk_modulus;
    for (int c = 2; c < D; ++c) k *= b.spacing;
    if (axisymmetric)
      return push_ring_off(i, s, circle(ring_radius(place[0], b.spacing)) * k, stand_off - distance, normal, sum);
    for (int c = 0; c < D; ++c) {
      double const f = k * (stand_off - distance) * normal[c];
      force.at(i, c) += f;
      sum[c] += f;
      sum[3 + (c + 1) % 3] += place[(c + 2) % 3] * f;
      sum[3 + (c + 2) % 3] -= place[(c + 1) % 3] * f;
      sums.at(i, ContactSum::power) -= f * (v_half.at(i, c) - s.velocity[c]);
      power_on_bodies[i] += f * s.velocity[c];
    }
    sums.at(i, ContactSum::stiffness) += k;
    raise(i, ContactSum::overlap, 1 - distance / stand_off);
  }

  /// k: of the ring, whose energy k depth^2/2 grows with its radius. On the shape only the axial force remains.
  PIOLA_FN void push_ring_off(Index i, RigidPoseAtHalfTime const& s, double k, double depth, double const* normal,
                              double* sum) const {
    double const radius = x.at(i), least = 0.25 * body[body_of[i]].spacing;
    double const inwards = radius > least ? 0.5 * k * depth * depth / radius : 0;
    for (int c = 0; c < 2; ++c) {
      double const f = k * depth * normal[c] - (c == 0 ? inwards : 0);
      force.at(i, c) += f;
      sums.at(i, ContactSum::power) -= f * (v_half.at(i, c) - s.velocity[c]);
      power_on_bodies[i] += f * s.velocity[c];
      if (c == 1) sum[c] += f;
    }
    sums.at(i, ContactSum::stiffness) += k;
    raise(i, ContactSum::overlap, 2 * depth / body[body_of[i]].spacing);
  }
  PIOLA_FN void raise(Index i, int which, double value) const { sums.at(i, which) = maximum(sums.at(i, which), value); }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
