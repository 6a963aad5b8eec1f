// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/shape_points.hpp"
#include "mechanics/contact/blocks.hpp"
#include <numbers>
#include <set>

namespace piola::contact {
namespace {

using namespace testing;
using Kind = RigidSurface::Kind;

constexpr double pi = std::numbers::pi;

RigidSurface shape(Kind kind, int dimension, Vec<3> const& half, double radius) {
  RigidSurface s;
  s.kind = kind;
  s.dimension = dimension;
  s.half_lengths = half;
  s.radius = radius;
  return s;
}

ShapeRange everything(int dimension) {
  ShapeRange all{{{-1e9, -1e9, -1e9}}, {{1e9, 1e9, 1e9}}};
  if (dimension == 2) all.low[2] = all.high[2] = 0;
  return all;
}

double area_of(std::vector<ShapePoint> const& points) {
  double sum = 0;
  for (ShapePoint const& p : points) sum += p.area;
  return sum;
}

TEST(ShapePoints, OfSmallShapesHaveTheirSurface) {
  struct Case {
    RigidSurface shape;
    double area;
  };
  for (auto const& [s, area] :
       {Case{shape(Kind::box, 2, {{0.2, 0.24, 0}}, 0), 1.76}, Case{shape(Kind::box, 3, {{0.2, 0.24, 0.2}}, 0), 1.088},
        Case{shape(Kind::sphere, 2, {}, 0.3), 0.6 * pi}, Case{shape(Kind::sphere, 3, {}, 0.3), 0.36 * pi},
        Case{shape(Kind::cylinder, 3, {{4, 0, 0}}, 0.2), 2 * pi * 0.2 * (8 + 0.2)}}) {
    ShapePoints const points(s, 0.25);
    std::vector<ShapePoint> const all = points.within(everything(s.dimension));
    EXPECT_NEAR(area_of(all), area, 1e-9 * area);
    Vec<3> sum;
    std::set<std::int64_t> keys;
    for (ShapePoint const& p : all) {
      sum = sum + p.area * p.normal;
      EXPECT_NEAR(dot(p.normal, p.normal), 1, 1e-12);
      EXPECT_NEAR(distance_from(s, p.arm).value, 0, 1e-12) << "it lies on the surface";
      EXPECT_TRUE(keys.insert(p.key).second);
    }
    EXPECT_NEAR(dot(sum, sum), 0, s.kind == Kind::sphere ? 1e-4 : 1e-20) << "the surface is closed";
    EXPECT_EQ(points.cover(), s.kind != Kind::box);
  }
}

// No body feels less than a spacing: what is narrower pushes with the area of that.
TEST(ShapePoints, OfNarrowShapesHaveTheAreaOfASpacing) {
  EXPECT_NEAR(area_of(ShapePoints(shape(Kind::sphere, 3, {}, 0.3), 1).within(everything(3))), pi, 1e-9);
  EXPECT_NEAR(area_of(ShapePoints(shape(Kind::sphere, 2, {}, 0.1), 1).within(everything(2))), pi, 1e-9);
  EXPECT_NEAR(area_of(ShapePoints(shape(Kind::box, 3, {{0.1, 0.2, 0.3}}, 0), 1).within(everything(3))), 6, 1e-9);
}

TEST(ShapePoints, OfLargeShapesAreNearEdgesAlone) {
  ShapePoints const box(shape(Kind::box, 3, {{30, 20, 10}}, 0), 1);
  std::vector<ShapePoint> const all = box.within(everything(3));
  double strips = 0;  // of a face of a x b, within a spacing of its edges and half an interval
  for (auto const& [a, b] : {std::pair{60.0, 40.0}, {60.0, 20.0}, {40.0, 20.0}}) {
    double const wide = 2 * (1 + 1.0 / 6);
    strips += 2 * (a * b - (a - wide) * (b - wide));
  }
  EXPECT_NEAR(area_of(all) / strips, 1, 1e-6);
  EXPECT_TRUE(ShapePoints(shape(Kind::cylinder, 3, {{30, 0, 0}}, 20), 1).any());
  EXPECT_FALSE(ShapePoints(shape(Kind::cylinder, 3, {{30, 0, 0}}, 20), 1).cover());
  EXPECT_FALSE(ShapePoints(shape(Kind::sphere, 3, {}, 2), 1).any());
  EXPECT_FALSE(ShapePoints(shape(Kind::plane, 3, {}, 0), 1).any());
}

TEST(ShapePoints, InARangeAreThoseOfAll) {
  for (RigidSurface const& s : {shape(Kind::box, 3, {{30, 20, 10}}, 0), shape(Kind::box, 2, {{7, 0.3, 0}}, 0),
                                shape(Kind::cylinder, 3, {{9, 0, 0}}, 5)}) {
    ShapePoints const points(s, 1);
    ShapeRange range{{{-8, -19.2, -30}}, {{5, 19.9, 3}}};
    if (s.dimension == 2) range.low[2] = range.high[2] = 0;
    std::vector<std::int64_t> expected, found;
    for (ShapePoint const& p : points.within(everything(s.dimension)))
      if (range.holds(p.arm)) expected.push_back(p.key);
    for (ShapePoint const& p : points.within(range)) found.push_back(p.key);
    EXPECT_EQ(found, expected);
    EXPECT_FALSE(found.empty());
  }
}

// A floor of ten thousand spacings has a million points along its edges, of which none is made that is not near.
TEST(ShapePoints, OfALargeFloorCostWhatIsNear) {
  ShapePoints const floor(shape(Kind::box, 3, {{5e6, 5e6, 1e3}}, 0), 1);
  EXPECT_TRUE(floor.within({{{-20, -20, 999}}, {{20, 20, 1020}}}).empty());
  EXPECT_GT(floor.within({{{4999990, 0, 990}}, {{5000010, 10, 1010}}}).size(), 100U);
}

/// A block, and a rigid shape that is pressed into its upper face where no surface point of the block is.
struct Pressed {
  int D;
  Blocks blocks;
  SurfaceContactSystem system;
  std::vector<Vec<3>> x;

  Pressed(int dimension, RigidSurface tool, FrictionLaw const& friction = {})
      : D(dimension), blocks(dimension, -50), system(blocks.system({place(tool)}, friction)) {
    x = places(system, blocks.set);
    system.set_masses(std::vector<double>(x.size(), 1.7));
  }
  RigidSurface place(RigidSurface tool) const {
    tool.centre = {{2, D == 3 ? 2.0 : 3.0, D == 3 ? 3.0 : 0.0}};
    tool.inverse_mass = 0.4;
    tool.inverse_inertia = identity<3>();
    return tool;
  }
};

/// A needle, a turned blade and a shot, less than half a spacing wide, as deep as they are wide.
std::vector<RigidSurface> tools(int D) {
  RigidSurface needle = shape(Kind::box, D, {{0.15, 0.15, 0.15}}, 0), blade = needle,
               shot = shape(Kind::sphere, D, {}, 0.3);
  double const c = std::cos(0.6), s = std::sin(0.6);
  blade.half_lengths = {{0.3, 0.05, 0.4}};
  blade.turn = {{c, -s, 0, s, c, 0, 0, 0, 1}};
  std::vector<RigidSurface> all{needle, blade, shot};
  if (D == 3) all.push_back(shape(Kind::cylinder, 3, {{0.4, 0, 0}}, 0.1));
  return all;
}

class OfNarrowShapes : public ::testing::TestWithParam<int> {};

TEST_P(OfNarrowShapes, PushTheBody) {
  int const D = GetParam();
  for (RigidSurface const& tool : tools(D)) {
    Pressed p(D, tool);
    p.system.evaluate(p.x, 1e-3);
    EXPECT_GT(p.system.totals().energy, 0);
    EXPECT_GT(p.system.resultant_on_rigid(0).force[D - 1], 0) << "the body pushes it out";
  }
}

TEST_P(OfNarrowShapes, PushWithTheSlopesOfTheEnergy) {
  int const D = GetParam();
  for (RigidSurface const& tool : tools(D)) {
    Pressed p(D, tool);
    distort(p.x, D, 0.3);
    p.system.rigid(0).centre = p.system.rigid(0).centre + Vec<3>{{0.6, 0, 0}};
    p.system.rigid(0).centre[D - 1] -= 0.15;
    expect_slopes(p.system, p.x, D);
    p.system.evaluate(p.x, 1e-3);
    ForceMoment const load = p.system.resultant_on_rigid(0);
    double const size = std::sqrt(dot(load.force, load.force));
    ASSERT_GT(size, 0);
    RigidSurface const at = p.system.rigid(0);
    auto const slope = [&](auto const& move) {
      constexpr double h = 1e-6;
      double energy[2];
      for (int k = 0; k < 2; ++k) {
        p.system.rigid(0) = at;
        move(p.system.rigid(0), k == 0 ? h : -h);
        p.system.evaluate(p.x, 1e-3);
        energy[k] = p.system.totals().energy;
      }
      p.system.rigid(0) = at;
      return (energy[0] - energy[1]) / (2 * h);
    };
    for (int c = 0; c < D; ++c)
      EXPECT_NEAR(load.force[c], -slope([c](RigidSurface& s, double h) { s.centre[c] += h; }), 1e-5 * size);
    EXPECT_NEAR(load.moment[2], -slope([](RigidSurface& s, double h) {
                  Mat<3> const turn{{std::cos(h), -std::sin(h), 0, std::sin(h), std::cos(h), 0, 0, 0, 1}};
                  s.turn = turn * s.turn;
                  s.axis = turn * s.axis;
                }),
                1e-5 * size);
  }
}

TEST_P(OfNarrowShapes, KeepMomenta) {
  int const D = GetParam();
  for (double const friction : {0.0, 0.4})
    for (RigidSurface const& tool : tools(D)) {
      Pressed p(D, tool, {.kinetic = friction});
      distort(p.x, D, 0.3);
      p.system.rigid(0).centre = p.system.rigid(0).centre + Vec<3>{{0.6, 0, 0}};
      p.system.rigid(0).centre[D - 1] -= 0.15;
      p.system.start(p.x);
      for (Vec<3>& y : p.x) y[0] += 0.02;
      p.system.evaluate(p.x, 1e-3);
      ForceMoment const load = p.system.resultant_on_rigid(0);
      Vec<3> force = load.force, moment = load.moment + cross(p.system.rigid(0).centre, load.force);
      double const size = std::sqrt(dot(force, force));
      ASSERT_GT(size, 0);
      for (std::size_t k = 0; k < p.x.size(); ++k) {
        force = force + p.system.forces()[k];
        moment = moment + cross(p.x[k], p.system.forces()[k]);
      }
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(force[c], 0, 1e-12 * size);
        EXPECT_NEAR(moment[c], 0, 1e-11 * size);
      }
      EXPECT_EQ(p.system.totals().spring_energy > 0, friction > 0);
    }
}

TEST_P(OfNarrowShapes, PushAlikeWheneverListsWereMade) {
  int const D = GetParam();
  Pressed old(D, tools(D)[0]);
  old.system.evaluate(old.x, 1e-3);
  for (Vec<3>& y : old.x) y[0] += 0.11;
  old.system.evaluate(old.x, 1e-3);
  Pressed fresh(D, tools(D)[0]);
  fresh.system.evaluate(old.x, 1e-3);
  for (std::size_t k = 0; k < old.x.size(); ++k)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(old.system.forces()[k][c], fresh.system.forces()[k][c]);
  EXPECT_EQ(old.system.totals().frequency2, fresh.system.totals().frequency2);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, OfNarrowShapes, ::testing::Values(2, 3));

/// A block whose lower face is at 0, before a plate of `thickness` below it; the block moves down to `depth`.
struct OnPlate {
  Blocks blocks;
  SurfaceContactSystem system;
  std::vector<Vec<3>> x;
  int D;

  OnPlate(int dimension, double thickness, bool disc = false)
      : blocks(dimension, -50), system(blocks.system({plate(dimension, thickness, disc)})), D(dimension) {
    x = places(system, blocks.set);
    system.set_masses(std::vector<double>(x.size(), 1.7));
    system.start(x);
  }
  static RigidSurface plate(int D, double thickness, bool disc) {
    RigidSurface s = shape(disc ? Kind::cylinder : Kind::box, D, {{20, 20, 20}}, 20);
    s.half_lengths[disc ? 0 : D - 1] = 0.5 * thickness;
    s.centre[D - 1] = -0.5 * thickness;
    return s;
  }
  double push(double depth) {
    auto moved = x;
    for (Vec<3>& y : moved) y[D - 1] -= depth;
    system.evaluate(moved, 1e-3);
    return -system.resultant_on_rigid(0).force[D - 1];
  }
};

TEST_P(OfNarrowShapes, PlatesPushBackToTheSideThatAPointCameFrom) {
  int const D = GetParam();
  for (bool const disc : {false, true}) {
    if (disc && D == 2) continue;
    for (double const step : {0.05, 0.7}) {  // slowly, and from before it to behind it at once
      OnPlate thin(D, 0.2, disc), thick(D, 8, disc);
      for (double depth = 0; depth < 1.3; depth += step) {
        double const expected = thick.push(depth);
        EXPECT_NEAR(thin.push(depth), expected, 1e-9 * expected + 1e-6) << depth;
        EXPECT_NEAR(thin.system.totals().deepest, thick.system.totals().deepest, 1e-12);
      }
      for (double depth = 1.3; depth > -0.1; depth -= 0.05) thin.push(depth);
      EXPECT_EQ(thin.push(-0.1), 0) << "it is out again";
      EXPECT_TRUE(thin.system.passed().empty());
    }
  }
}

TEST_P(OfNarrowShapes, PlatesTellWhoWentPastTheirRim) {
  int const D = GetParam();
  OnPlate p(D, 0.2);
  p.push(0.6);
  EXPECT_TRUE(p.system.passed().empty());
  p.system.rigid(0).centre[0] -= 30;  // the plate is drawn away from behind the block
  p.push(0.6);
  ASSERT_EQ(p.system.passed().size(), 1U);
  EXPECT_EQ(p.system.passed()[0].of, 0U);
  EXPECT_EQ(p.system.passed()[0].through, 2U);
  EXPECT_GT(p.system.passed()[0].points, 4);
}

TEST_P(OfNarrowShapes, ANeedleThatGoesThroughAFaceIsTold) {
  int const D = GetParam();
  RigidSurface needle = shape(Kind::box, D, {{0.15, 0.15, 0.15}}, 0);
  needle.half_lengths[D - 1] = 2;
  Pressed p(D, needle);
  p.system.rigid(0).centre[D - 1] += 2;
  p.system.start(p.x);
  for (double depth = 0; depth < 2.8; depth += 0.1) {
    p.system.rigid(0).centre[D - 1] -= 0.1;
    EXPECT_TRUE(depth > 0.9 || p.system.passed().empty()) << depth;
    p.system.evaluate(p.x, 1e-3);
  }
  ASSERT_EQ(p.system.passed().size(), 1U);
  EXPECT_EQ(p.system.passed()[0].of, 2U);
  EXPECT_EQ(p.system.passed()[0].through, 0U);
}

TEST_P(OfNarrowShapes, SidesAreInTheState) {
  int const D = GetParam();
  OnPlate whole(D, 0.2), resumed(D, 0.2);
  whole.push(0.15);
  whole.push(0.25);
  auto moved = whole.x;
  for (Vec<3>& y : moved) y[D - 1] -= 0.25;
  resumed.system.restore(moved, whole.system.state());
  EXPECT_EQ(resumed.system.state(), whole.system.state());
  EXPECT_EQ(resumed.push(0.3), whole.push(0.3));
  EXPECT_GT(whole.push(0.3), 0);
}

}  // namespace
}  // namespace piola::contact
