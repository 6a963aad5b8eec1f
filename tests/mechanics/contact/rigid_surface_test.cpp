// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_surface.hpp"
#include <gtest/gtest.h>

namespace piola::contact {
namespace {

using Kind = RigidSurface::Kind;

RigidSurface shape(Kind kind, int dimension = 3) {
  RigidSurface s;
  s.kind = kind;
  s.dimension = dimension;
  s.centre = {{0.1, 0.2, dimension == 3 ? 0.3 : 0}};
  s.axis = {{0.6, 0.8, 0}};
  s.half_lengths = {{1, 2, 3}};
  s.radius = 1.5;
  return s;
}

TEST(RigidSurface, NormalIsTheSlopeOfTheDistance) {
  for (Kind const kind : {Kind::plane, Kind::sphere, Kind::cylinder, Kind::box})
    for (Vec<3> const& x :
         {Vec<3>{{1.9, 0.7, -0.4}}, Vec<3>{{0.4, -0.5, 0.9}}, Vec<3>{{-3, 4, 5}}, Vec<3>{{0.2, 2.9, 0}}}) {
      RigidSurface const s = shape(kind);
      Distance const d = distance_from(s, x);
      EXPECT_NEAR(dot(d.normal, d.normal), 1, 1e-14);
      for (int c = 0; c < 3; ++c) {
        constexpr double h = 1e-6;
        Vec<3> up = x, down = x;
        up[c] += h;
        down[c] -= h;
        EXPECT_NEAR(d.normal[c], (distance_from(s, up).value - distance_from(s, down).value) / (2 * h), 1e-7)
            << static_cast<int>(kind);
      }
    }
}

TEST(RigidSurface, ChangeOfTheNormalIsItsSlope) {
  Vec<3> const along{{0.3, -0.5, 0.7}};
  for (Kind const kind : {Kind::plane, Kind::sphere, Kind::cylinder, Kind::box})
    for (Vec<3> const& x : {Vec<3>{{-0.3, -0.5, 0.9}}, Vec<3>{{1.0, -0.6, 0.4}}, Vec<3>{{-0.5, 0.1, 1.2}}}) {
      RigidSurface const s = shape(kind);
      Distance const d = distance_from(s, x);
      ASSERT_LT(d.value, 0) << "inside";
      Vec<3> const change = normal_change(s, x, d.normal, along);
      constexpr double h = 1e-6;
      Vec<3> const up = distance_from(s, x + h * along).normal, down = distance_from(s, x - h * along).normal;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(change[c], (up[c] - down[c]) / (2 * h), 1e-8) << static_cast<int>(kind);
    }
}

TEST(RigidSurface, DistancesOfKnownPoints) {
  RigidSurface box = shape(Kind::box, 2);
  EXPECT_NEAR(distance_from(box, {{0.1, 0.2, 0}}).value, -1, 1e-15) << "in the middle";
  EXPECT_NEAR(distance_from(box, {{4.1, 6.2, 0}}).value, 5, 1e-15) << "off a corner by 3 and 4";
  EXPECT_NEAR(distance_from(box, {{0.1, -3, 99}}).value, 1.2, 1e-15) << "the third axis does not exist";
  EXPECT_NEAR(distance_from(shape(Kind::sphere), {{0.1, 0.2, 2.3}}).value, 0.5, 1e-15);
  EXPECT_NEAR(distance_from(shape(Kind::cylinder), {{0.1, 0.2, 0.3}}).value, -1, 1e-15) << "nearest its ends";
}

}  // namespace
}  // namespace piola::contact
