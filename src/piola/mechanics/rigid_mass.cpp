// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/rigid_mass.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include <cmath>
#include <limits>

namespace piola {
namespace {

using Kind = RigidShape::Kind;

constexpr double pi = 3.14159265358979323846;

/// Unit vectors of which the first is given.
Mat<3> axes_with(Vec<3> const& first) {
  Vec<3> const other = std::fabs(first[0]) < 0.9 ? Vec<3>{{1, 0, 0}} : Vec<3>{{0, 1, 0}};
  Vec<3> second = other - dot(other, first) * first;
  second = (1 / std::sqrt(dot(second, second))) * second;
  Vec<3> const third = cross(first, second);
  Mat<3> axes;
  for (int c = 0; c < 3; ++c) {
    axes(c, 0) = first[c];
    axes(c, 1) = second[c];
    axes(c, 2) = third[c];
  }
  return axes;
}

/// Principal inertia of a given tensor; in 2D it has one moment.
PrincipalInertia principal(std::array<double, 6> const& given, int dimension) {
  if (dimension < 3) return {{{0, 0, given[2]}}, identity<3>()};
  SymMat<3> I;
  for (std::size_t k = 0; k < 6; ++k) I.c[k] = given[k];
  Eigen<3> const e = symmetric_eigen(I);
  PrincipalInertia inertia;
  for (int k = 0; k < 3; ++k) {
    inertia.moment[k] = e.value[k];
    for (int c = 0; c < 3; ++c) inertia.axes(c, k) = e.vector[k][c];
  }
  return inertia;
}

}  // namespace

double volume_of(RigidShape const& shape, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  double const r = shape.radius;
  auto const& half = shape.half_lengths;
  switch (shape.kind) {
    case Kind::plane: return std::numeric_limits<double>::infinity();
    case Kind::sphere: return dimension == 3 ? 4.0 / 3 * pi * r * r * r : pi * r * r;
    case Kind::cylinder: return pi * r * r * 2 * half[0];
    case Kind::box: break;
  }
  return dimension == 3 ? 8 * half[0] * half[1] * half[2] : 4 * half[0] * half[1];
}

double swept_volume_of(RigidShape const& shape) {
  double const x = shape.centre[0], half = shape.half_lengths[0];
  if (x > 0) return 2 * pi * x * volume_of(shape, 2);  // Pappus
  if (shape.kind == Kind::sphere) return volume_of(shape, 3);
  return shape.kind == Kind::box ? 2 * pi * half * half * shape.half_lengths[1] : volume_of(shape, 2);
}

PrincipalInertia inertia_of(RigidShape const& shape, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(shape.inertia || shape.mass > 0);
  if (shape.inertia) return principal(*shape.inertia, dimension);
  double const m = shape.mass, r2 = shape.radius * shape.radius;
  auto const square = [&](std::size_t c) { return shape.half_lengths[c] * shape.half_lengths[c]; };
  PrincipalInertia inertia{{}, identity<3>()};
  if (shape.kind == Kind::sphere) {
    double const moment = (dimension == 3 ? 0.4 : 0.5) * m * r2;
    inertia.moment = {{moment, moment, moment}};
  } else if (shape.kind == Kind::cylinder) {
    double const across = m * (r2 / 4 + square(0) / 3);
    inertia.moment = {{0.5 * m * r2, across, across}};
    inertia.axes = axes_with({{shape.axis[0], shape.axis[1], shape.axis[2]}});
  } else {
    double const depth = dimension == 3 ? square(2) : 0;
    inertia.moment = {{m / 3 * (square(1) + depth), m / 3 * (square(0) + depth), m / 3 * (square(0) + square(1))}};
  }
  return inertia;
}

}  // namespace piola
