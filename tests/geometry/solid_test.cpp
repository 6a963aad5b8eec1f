// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/boolean_solid.hpp"
#include "piola/geometry/extruded_revolved.hpp"
#include "piola/geometry/level_set.hpp"
#include "piola/geometry/patch_measures.hpp"
#include "piola/geometry/primitives.hpp"
#include "piola/geometry/transformed_solid.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

using namespace piola;
using namespace piola::geometry;

namespace {

constexpr double pi = std::numbers::pi;

double length(Vec<3> const& a) { return std::sqrt(dot(a, a)); }

SolidPtr turned(SolidPtr solid) {
  return placed(std::move(solid), {2, rotation_about({{0.6, 0, 0.8}}, 0.7), {{1, -2, 0.5}}});
}

/// An L of 1 x 1 with legs of 0.4 and a hole in one.
SolidPtr bracket(bool solid) {
  std::vector<std::string> names;
  std::vector<std::vector<ProfileEdge>> const loops{
      polygon_loop({{{0, 0}}, {{1, 0}}, {{1, 0.4}}, {{0.4, 0.4}}, {{0.4, 1}}, {{0, 1}}}, false, 0.5, names),
      polygon_loop({{{0.6, 0.1}}, {{0.8, 0.1}}, {{0.8, 0.3}}, {{0.6, 0.3}}}, true, 0.5, names)};
  Profile profile(loops, names);
  if (solid) return std::make_shared<Extruded>(std::move(profile), -0.2, 0.3);
  return std::make_shared<Flat>(std::move(profile));
}

struct Known {
  std::string name;
  SolidPtr solid;
  double volume, area;
};

std::vector<Known> known_solids() {
  double const bracket_area = 0.64 - 0.04, bracket_outline = 4 + 0.8;
  return {
      {"box", box({{0, 0, 0}}, {{1, 2, 3}}, 3), 6, 22},
      {"rectangle", box({{0, 0, 0}}, {{1, 2, 0}}, 2), 2, 6},
      {"ball", ball({{1, 0, 0}}, 0.5, 0, 3), pi / 6, pi},
      {"shell", ball({}, 1, 0.5, 3), 4 * pi / 3 * 0.875, 4 * pi * 1.25},
      {"disc", ball({}, 1, 0, 2), pi, 2 * pi},
      {"ring", ball({}, 1, 0.5, 2), 0.75 * pi, 3 * pi},
      {"rod", cylinder({}, {{1, 0, 0}}, 3, 0.5, 0), 0.75 * pi, 3.5 * pi},
      {"tube", cylinder({}, {{0, 0, 1}}, 2, 1, 0.5), 1.5 * pi, 7.5 * pi},
      {"cone", cone({}, {{0, 0, 1}}, 4, 3, 0), 12 * pi, 24 * pi},
      {"spike", cone({}, {{0, 0, 1}}, 4, 0, 3), 12 * pi, 24 * pi},
      {"frustum", cone({}, {{0, 1, 0}}, 4, 4, 1), 28 * pi, 17 * pi + 25 * pi},
      {"torus", torus({}, {{0, 0, 1}}, 1, 0.4), 2 * pi * pi * 0.16, 4 * pi * pi * 0.4},
      {"capsule", capsule({}, {{2, 0, 0}}, 0.5, 3), pi / 6 + 0.5 * pi, 3 * pi},
      {"stadium", capsule({}, {{0, 2, 0}}, 0.5, 2), pi / 4 + 2, 4 + pi},
      {"bracket", bracket(true), bracket_area * 0.5, bracket_outline * 0.5 + 2 * bracket_area},
      {"bracket in the plane", bracket(false), bracket_area, bracket_outline},
      {"a box elsewhere", turned(box({{0, 0, 0}}, {{1, 2, 3}}, 3)), 48, 88},
  };
}

std::vector<Vec<3>> places_around(Solid const& solid, int count) {
  std::mt19937 engine(7);
  auto const random = [&] { return (static_cast<double>(engine()) + 0.5) / 4294967296.0; };
  Bounds const box = solid.bounds();
  std::vector<Vec<3>> places;
  for (int k = 0; k < count; ++k) {
    Vec<3> X;
    for (int c = 0; c < solid.dimension(); ++c) {
      double const width = box.max[c] - box.min[c];
      X[c] = box.min[c] - 0.3 * width + 1.6 * width * random();
    }
    places.push_back(X);
  }
  return places;
}

TEST(Solids, HaveTheVolumesAndAreasOfFormulas) {
  for (Known const& known : known_solids()) {
    SCOPED_TRACE(known.name);
    ASSERT_TRUE(known.solid->exact_volume().has_value());
    EXPECT_NEAR(*known.solid->exact_volume() / known.volume, 1, 1e-12);
    double area = 0;
    Vec<3> sum;
    std::vector<SurfacePiece> pieces;
    known.solid->cut_surface(0.1, pieces);
    for (SurfacePiece const& piece : pieces) {
      area += length(piece.area);
      sum = sum + piece.area;
      EXPECT_LT(std::abs(known.solid->at(piece.X).distance), 0.02);
      ASSERT_LT(piece.patch, static_cast<int>(known.solid->patches().size()));
    }
    // Half circles within flat outlines are cut into chords.
    double const chords = known.name == "stadium" ? 1e-3 : 1e-12;
    EXPECT_NEAR(area / known.area, 1, chords);
    EXPECT_LT(length(sum), 1e-12 * area);
  }
}

TEST(Solids, TellDistancesThatLeadToTheSurface) {
  for (Known const& known : known_solids()) {
    SCOPED_TRACE(known.name);
    for (Vec<3> const& X : places_around(*known.solid, 500)) {
      Foot const foot = known.solid->at(X);
      EXPECT_NEAR(length(foot.normal), 1, 1e-12);
      Vec<3> const on = X - foot.distance * foot.normal;
      EXPECT_NEAR(known.solid->at(on).distance, 0, 1e-9);
      // No place is nearer: distances change by no more than places do.
      Vec<3> const Y = X + 1e-3 * foot.normal;
      EXPECT_LE(std::abs(known.solid->at(Y).distance - foot.distance), 1e-3 * (1 + 1e-9));
    }
  }
}

TEST(Solids, DistancesAreThoseOfTheNearestPieceOfSurface) {
  for (Known const& known : known_solids()) {
    SCOPED_TRACE(known.name);
    std::vector<SurfacePiece> pieces;
    double const edge = 0.05;
    known.solid->cut_surface(edge, pieces);
    for (Vec<3> const& X : places_around(*known.solid, 20)) {
      double least = 1e300;
      for (SurfacePiece const& piece : pieces) least = std::min(least, length(X - piece.X));
      double const distance = std::abs(known.solid->at(X).distance);
      EXPECT_LE(distance, least + 2e-3);
      EXPECT_GE(distance, least - edge);
    }
  }
}

TEST(Solids, GridVolumesAgreeWithExactOnes) {
  // Nothing but the distance is known of a union of one.
  for (Known const& known : known_solids()) {
    SCOPED_TRACE(known.name);
    EXPECT_NEAR(volume_of(*combined(BooleanOperation::join, {known.solid}), 0.1) / known.volume, 1, 1e-3);
  }
}

TEST(CombinedSolids, PlateWithAHole) {
  auto const plate = combined(BooleanOperation::cut,
                              {box({{-1, -1, 0}}, {{1, 1, 0.5}}, 3), cylinder({{0, 0, -1}}, {{0, 0, 1}}, 3, 0.5, 0)});
  EXPECT_NEAR(volume_of(*plate, 0.1), 2 - 0.125 * pi, 2e-4);
  EXPECT_NEAR(plate->at({{0.6, 0, 0.25}}).distance, -0.1, 1e-12);
  EXPECT_NEAR(plate->at({{0.4, 0, 0.25}}).distance, 0.1, 1e-12);
  EXPECT_NEAR(plate->at({{0.4, 0, 0.25}}).normal[0], -1, 1e-12);
  for (PatchFacts const& patch : patch_facts(*plate, 0.02)) {
    if (patch.name == "2.outer") {
      EXPECT_NEAR(patch.area, 0.5 * pi, 0.002);
    } else if (patch.name == "1.+z") {
      EXPECT_NEAR(patch.area, 4 - 0.25 * pi, 0.002);
    } else if (patch.name == "1.-x") {
      EXPECT_NEAR(patch.area, 1, 1e-3);
    }
    EXPECT_NE(patch.name, "2.start");  // it lies outside the plate
  }
}

TEST(CombinedSolids, PartsThatShareAFaceAreOne) {
  auto const both =
      combined(BooleanOperation::join, {box({{0, 0, 0}}, {{1, 1, 1}}, 3), box({{1, 0, 0}}, {{2, 1, 1}}, 3)});
  double area = 0;
  for (PatchFacts const& patch : patch_facts(*both, 0.05)) {
    area += patch.area;
    EXPECT_NE(patch.name, "1.+x");
    EXPECT_NE(patch.name, "2.-x");
  }
  EXPECT_NEAR(area, 10, 1e-9);
  EXPECT_NEAR(volume_of(*both, 0.1), 2, 1e-9);
}

TEST(CombinedSolids, HalfSpacesEndInOthers) {
  auto const half = combined(BooleanOperation::common, {ball({}, 1, 0, 3), half_space({}, {{0, 0, 1}}, 3)});
  EXPECT_NEAR(volume_of(*half, 0.1), 2 * pi / 3, 1e-3);
  double flat = 0;
  for (PatchFacts const& patch : patch_facts(*half, 0.05))
    if (patch.name == "2.plane") flat = patch.area;
  EXPECT_NEAR(flat, pi, 0.01);
}

TEST(LevelSets, EllipsoidHasItsVolumeAndDistance) {
  auto const level = level_of("(X/2)^2 + Y^2 + Z^2 < 1");
  ASSERT_TRUE(level.has_value());
  auto const solid = level_set(Expression(*level), {{{-2.1, -1.1, -1.1}}, {{2.1, 1.1, 1.1}}}, 0.1, 3);
  EXPECT_NEAR(volume_of(*solid, 0.1) / (8 * pi / 3), 1, 1e-3);
  EXPECT_NEAR(solid->at({{1.9, 0, 0}}).distance, -0.1, 1e-4);
  EXPECT_NEAR(solid->at({{0, 1.2, 0}}).distance, 0.2, 2e-4);
  double area = 0;
  Vec<3> sum;
  std::vector<SurfacePiece> pieces;
  solid->cut_surface(0.1, pieces);
  for (SurfacePiece const& piece : pieces) {
    area += length(piece.area);
    sum = sum + piece.area;
    EXPECT_GT(dot(piece.area, solid->at(piece.X).normal), 0);
  }
  // Prolate: 2 pi (1 + 2 asin(e)/e), e^2 = 3/4.
  double const e = std::sqrt(0.75);
  EXPECT_NEAR(area / (2 * pi * (1 + 2 * std::asin(e) / e)), 1, 2e-3);
  EXPECT_LT(length(sum), 1e-12);
}

TEST(LevelSets, ComparisonsAreSplit) {
  EXPECT_EQ(level_of("X < 1").value_or(""), "(X ) - ( 1)");
  EXPECT_EQ(level_of("2 >= X").value_or(""), "( X) - (2 )");
  for (std::string const bad : {"X", "X < 1 && Y < 1", "0 < X < 1", "max(X < 1, 2)"})
    EXPECT_FALSE(level_of(bad).has_value()) << bad;
}

}  // namespace
