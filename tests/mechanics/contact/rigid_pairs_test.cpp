// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_pairs.hpp"
#include "piola/math/quaternion.hpp"
#include "piola/mechanics/rigid_mass.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace piola::contact {
namespace {

using Kind = RigidShape::Kind;

RigidShape shape(Kind kind, std::array<double, 3> const& centre, bool free = true) {
  RigidShape s;
  s.name = "it";
  s.kind = kind;
  s.centre = centre;
  s.radius = 0.5;
  s.half_lengths = {0.5, 0.4, 0.3};
  s.free = free;
  s.mass = 2;
  if (kind == Kind::cylinder) s.axis = {0.6, 0.8, 0};
  return s;
}

std::vector<RigidSurface> surfaces(std::vector<RigidShape> const& shapes, int dimension) {
  std::vector<RigidSurface> all;
  for (RigidShape const& s : shapes) all.push_back(surface_of(s, dimension));
  return all;
}

/// Turned about its centre.
RigidSurface turned(RigidSurface s, Vec<3> const& by) {
  Mat<3> const R = matrix_of(turn_by(by));
  s.turn = R * s.turn;
  s.axis = R * s.axis;
  return s;
}

struct Scene {
  std::vector<RigidShape> shapes;
  std::vector<RigidSurface> now;
  int dimension = 3;
};

std::vector<Scene> scenes() {
  auto const plane = shape(Kind::plane, {0, 0, 0}, false);
  std::vector<Scene> all{{{shape(Kind::sphere, {0.1, 0.2, 0.45}), plane}, {}, 3},
                         {{plane, shape(Kind::sphere, {0.1, 0.2, 0.45})}, {}, 3},
                         {{shape(Kind::box, {0.1, 0.2, 0.33}), plane}, {}, 3},
                         {{shape(Kind::cylinder, {0.1, 0.2, 0.48}), plane}, {}, 3},
                         {{shape(Kind::sphere, {0.1, 0.2, 0.3}), shape(Kind::sphere, {0.5, 0.9, 0.5})}, {}, 3},
                         {{shape(Kind::box, {0, 0, 0}), shape(Kind::sphere, {0.1, 0.2, 0.77})}, {}, 3},
                         {{shape(Kind::cylinder, {0, 0, 0}), shape(Kind::sphere, {0.1, 0.2, 0.9})}, {}, 3},
                         {{shape(Kind::sphere, {0, 0, 0}), shape(Kind::box, {0.1, 0.87, 0})}, {}, 2},
                         {{shape(Kind::box, {0, 0, 0}), shape(Kind::box, {0.37, 0.21, 0.58})}, {}, 3},
                         {{shape(Kind::box, {0, 0, 0}), shape(Kind::box, {0.33, 0.72, 0})}, {}, 2},
                         {{shape(Kind::cylinder, {0, 0, 0}), shape(Kind::box, {0.13, 0.21, 0.77})}, {}, 3},
                         {{shape(Kind::cylinder, {0, 0, 0}), shape(Kind::cylinder, {0.13, 0.21, 0.96})}, {}, 3}};
  for (Scene& scene : all) {
    scene.now = surfaces(scene.shapes, scene.dimension);
    for (RigidSurface& s : scene.now)
      if (s.kind != Kind::plane) s = turned(s, scene.dimension == 3 ? Vec<3>{{0.1, -0.07, 0.2}} : Vec<3>{{0, 0, 0.2}});
  }
  return all;
}

TEST(RigidSamples, StandForTheWholeSurface) {
  for (int const dimension : {2, 3}) {
    auto const box = samples_of(shape(Kind::box, {}), dimension);
    double area = 0;
    for (SurfaceSample const& sample : box) {
      area += sample.area;
      EXPECT_NEAR(distance_from(surface_of(shape(Kind::box, {}), dimension), sample.arm).value, 0, 1e-15);
    }
    EXPECT_NEAR(area, dimension == 3 ? 8 * (0.5 * 0.4 + 0.4 * 0.3 + 0.3 * 0.5) : 4 * 0.9, 1e-12);
  }
  double area = 0;
  for (SurfaceSample const& sample : samples_of(shape(Kind::cylinder, {}), 3)) {
    area += sample.area;
    EXPECT_NEAR(distance_from(surface_of(shape(Kind::cylinder, {}), 3), sample.arm).value, 0, 1e-15);
  }
  constexpr double R = 0.5, length = 1;
  EXPECT_NEAR(area, 2 * std::numbers::pi * R * (length + R), 1e-12);
}

// A box that stands on another one is held by the layer over the whole face.
TEST(RigidPairs, FacesPushWithTheirArea) {
  std::vector<RigidShape> both{shape(Kind::box, {0, 0, 0}, false), shape(Kind::box, {0, 0, 0.59})};
  both[0].half_lengths = {1.5, 1.4, 0.3};
  RigidPairs pairs(both, 3, {1000, 0.1, {}});
  pairs.start(surfaces(both, 3));
  double const depth = 0.01, pressure = 1000 * depth * (1 + std::pow(depth / 0.05, 2));
  EXPECT_NEAR(pairs.on(1).force[2], pressure * 0.8, 0.1 * pressure)
      << "a face of 1 x 0.8, half from each side; of the lower one what points lie within, to half an interval";
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(pairs.on(1).moment[c], 0, 1e-12);
}

TEST(RigidPairs, ForcesAndMomentsAreTheSlopesOfTheEnergy) {
  for (Scene const& scene : scenes()) {
    SCOPED_TRACE(static_cast<int>(scene.shapes[0].kind));
    RigidPairs pairs(scene.shapes, scene.dimension, {1000, 0.1, {}});
    pairs.start(scene.now);
    ASSERT_GT(pairs.totals().energy, 0);
    double size = 0;
    for (std::size_t k = 0; k < 2; ++k) size = std::max(size, std::sqrt(dot(pairs.on(k).force, pairs.on(k).force)));
    for (std::size_t k = 0; k < 2; ++k) {
      auto const load = pairs.on(k);
      for (int c = 0; c < 3; ++c) {
        constexpr double h = 1e-7;
        Vec<3> way;
        way[c] = h;
        auto const slope = [&](auto const& change) {
          double energy[2];
          for (int side = 0; side < 2; ++side) {
            auto moved = scene.now;
            moved[k] = change(moved[k], (side == 0 ? -1.0 : 1.0) * way);
            pairs.start(moved);
            energy[side] = pairs.totals().energy;
          }
          return (energy[1] - energy[0]) / (2 * h);
        };
        auto const shifted = [](RigidSurface s, Vec<3> const& d) {
          s.centre = s.centre + d;
          return s;
        };
        if (c < scene.dimension) {
          EXPECT_NEAR(load.force[c], -slope(shifted), 1e-6 * size) << k << " " << c;
        }
        if (c == 2 || scene.dimension == 3) {
          EXPECT_NEAR(load.moment[c], -slope(turned), 1e-6 * size) << k << " " << c;
        }
      }
    }
  }
}

TEST(RigidPairs, FrictionKeepsMomentaAndIsBlindToCommonMotion) {
  for (Scene const& scene : scenes()) {
    RigidPairs pairs(scene.shapes, scene.dimension, {1000, 0.1, {0.5}});
    pairs.start(scene.now);
    auto now = scene.now;
    now[0].centre[0] += 0.01;
    now[1] = turned(now[1], {{0, 0, 0.01}});
    pairs.evaluate(now, 0.01);
    Vec<3> force = pairs.on(0).force + pairs.on(1).force, moment;
    for (std::size_t k = 0; k < 2; ++k) moment = moment + pairs.on(k).moment + cross(now[k].centre, pairs.on(k).force);
    double const size = std::sqrt(dot(pairs.on(0).force, pairs.on(0).force));
    ASSERT_GT(size, 0);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(force[c], 0, 1e-13 * size);
      EXPECT_NEAR(moment[c], 0, 1e-13 * size);
    }
    double const stored = pairs.totals().spring_energy;
    ASSERT_GT(stored, 0);
    Vec<3> const by{{0, 0, 0.4}};
    Mat<3> const R = matrix_of(turn_by(by));
    for (int turns = 0; turns < 5; ++turns) {
      for (RigidSurface& s : now) {
        s = turned(s, by);
        s.centre = R * s.centre + Vec<3>{{0.3, -0.1, {}}};
      }
      pairs.evaluate(now, 0.01);
      EXPECT_NEAR(pairs.totals().spring_energy / stored, 1, 1e-11);
      EXPECT_NEAR(pairs.totals().friction_work, 0, 1e-11 * stored);
    }
  }
}

TEST(RigidPairs, RubMoreAtRestIfTheLawSaysSo) {
  for (double const dt : {1e6, 1e-6}) {
    Scene scene = scenes()[0];
    RigidPairs pairs(scene.shapes, 3, {1000, 0.1, {0.3, 0.6, 1e-3}});
    pairs.start(scene.now);
    scene.now[0].centre[0] += 0.1;
    pairs.evaluate(scene.now, dt);
    Vec<3> const f = pairs.on(0).force;
    EXPECT_NEAR(-f[0] / f[2], dt > 1 ? 0.6 : 0.3, 1e-4);
  }
}

TEST(RigidPairs, RestoredStateGoesOnBitForBit) {
  Scene scene = scenes()[2];
  RigidPairs whole(scene.shapes, 3, {1000, 0.1, {0.5}}), resumed(scene.shapes, 3, {1000, 0.1, {0.5}});
  whole.start(scene.now);
  resumed.start(scene.now);
  auto now = scene.now;
  auto const move = [&] { now[0] = turned(now[0], {{0, 0.002, 0.01}}); };
  for (int k = 0; k < 3; ++k) {
    move();
    whole.evaluate(now, 0.01);
  }
  resumed.restore(now, whole.state());
  EXPECT_EQ(resumed.state(), whole.state());
  for (int k = 0; k < 5; ++k) {
    move();
    whole.evaluate(now, 0.01);
    resumed.evaluate(now, 0.01);
    EXPECT_EQ(resumed.state(), whole.state());
  }
}

TEST(RigidPairs, ClosingShortensTheStepBeforeTheyMeet) {
  Scene scene = scenes()[0];
  scene.now[0].centre = {{0, 0, 1.5}};
  RigidPairs pairs(scene.shapes, 3, {1000, 0.1, {}});
  pairs.start(scene.now);
  EXPECT_EQ(pairs.totals().energy, 0);
  EXPECT_TRUE(std::isinf(pairs.contact_time_step(scene.now)));
  scene.now[0].velocity = {{0, 0, -10}};
  EXPECT_NEAR(pairs.contact_time_step(scene.now), 0.051, 1e-12) << "half the gap and a tenth of a spacing";
}

TEST(RigidPairs, AFreeCylinderOnItsEndStaysThere) {
  std::vector<RigidShape> const shapes{shape(Kind::cylinder, {0, 0, 0.49}), shape(Kind::plane, {0, 0, 0}, false)};
  auto now = surfaces(shapes, 3);
  now[0].axis = {{0, 0, 1}};
  RigidPairs pairs(shapes, 3, {1000, 0.1, {}});
  pairs.start(now);
  EXPECT_GT(pairs.on(0).force[2], 0);
  EXPECT_EQ(dot(pairs.on(0).moment, pairs.on(0).moment), 0);
  now[0] = turned(now[0], {{0.1, 0, 0}});
  pairs.start(now);
  EXPECT_LT(pairs.on(0).moment[0], 0) << "the rim holds it";
}

}  // namespace
}  // namespace piola::contact
