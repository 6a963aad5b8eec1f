// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/blended_planes.hpp"
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace piola::contact {
namespace {

Vec<3> unit(Vec<3> const& a) { return (1 / std::sqrt(dot(a, a))) * a; }

/// A point over a rough face: planes of random places and normals that look at it.
struct Face {
  Plane target;
  std::vector<Plane> sources;
  PairRule rule;
};

Face rough_face(unsigned seed, double height) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> some(-0.2, 0.2);
  Face f;
  f.target = {{{0.1, -0.05, height}}, unit({{0.1, 0.2, -1}})};
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      f.sources.push_back(
          {{{i + some(random), j + some(random), some(random) / 4}}, unit({{some(random), some(random), 1}})});
  f.rule = pair_rule(0.5, 2, 1, 3, 0.8);
  return f;
}

double energy(Face const& f) {
  auto const source = [&](Index k) -> Plane const& { return f.sources[static_cast<std::size_t>(k)]; };
  std::vector<double> weights(f.sources.size());
  Gap const g = blended_gap(f.target, static_cast<Index>(f.sources.size()), source, f.rule.reach, weights.data());
  return 0.7 * layer(g.gap, f.rule.stiffness, f.rule.length).energy *
         fade(g.tau2(), f.rule.fade_from, f.rule.fade_to).value * coverage(g.weight).value;
}

struct Loads {
  PointLoad target;
  std::vector<PointLoad> sources;
};

Loads loads(Face const& f) {
  auto const source = [&](Index k) -> Plane const& { return f.sources[static_cast<std::size_t>(k)]; };
  auto const n = static_cast<Index>(f.sources.size());
  std::vector<double> weights(f.sources.size());
  Gap const g = blended_gap(f.target, n, source, f.rule.reach, weights.data());
  Loads all;
  all.sources.resize(f.sources.size());
  all.target = contact_loads(f.target, 0.7, g, layer(g.gap, f.rule.stiffness, f.rule.length),
                             fade(g.tau2(), f.rule.fade_from, f.rule.fade_to), n, source, f.rule.reach,
                             [&](Index k, PointLoad const& load) { all.sources[static_cast<std::size_t>(k)] = load; });
  return all;
}

TEST(BlendedPlanes, GapFromAFlatFaceIsTheDistance) {
  std::vector<Plane> face;
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j) face.push_back({{{0.9 * i, 1.1 * j, 0}}, {{0, 0, 1}}});
  auto const source = [&](Index k) -> Plane const& { return face[static_cast<std::size_t>(k)]; };
  std::vector<double> weights(face.size());
  for (double const x : {0.0, 0.123, 0.41})
    for (double const z : {-0.3, 0.02, 0.5}) {
      Plane const a{{{x, -2 * x, z}}, {{0, 0, -1}}};
      EXPECT_NEAR(blended_gap(a, static_cast<Index>(face.size()), source, 2.2, weights.data()).gap, z, 1e-15);
    }
}

TEST(BlendedPlanes, FacesThatLookTheSameWayDoNotMeet) {
  EXPECT_EQ(plane_weight(0.1, 0.3), 0);
  EXPECT_EQ(plane_weight(1.0, -1), 0);
  EXPECT_DOUBLE_EQ(plane_weight(0.5, -0.5), 0.125 * 0.25);
}

TEST(BlendedPlanes, LayerIsLinearThenStiffer) {
  EXPECT_EQ(layer(0.1, 5, 0.5).energy, 0);
  EXPECT_EQ(layer(0, 5, 0.5).slope, 0);
  EXPECT_NEAR(layer(-1e-4, 5, 0.5).slope, -5e-4, 1e-10);
  EXPECT_DOUBLE_EQ(layer(-0.5, 5, 0.5).slope, -5.0) << "twice that of a linear one at the depth l";
  EXPECT_DOUBLE_EQ(layer(-0.5, 5, 0.5).energy, 5 * 0.25 * 0.75);
}

TEST(BlendedPlanes, FadeIsSmooth) {
  EXPECT_EQ(fade(0.2 * 0.2, 0.45, 0.75).value, 1);
  EXPECT_EQ(fade(0.8 * 0.8, 0.45, 0.75).value, 0);
  for (double const tau2 : {0.25, 0.35, 0.5}) {
    constexpr double h = 1e-6;
    double const slope = (fade(tau2 + h, 0.45, 0.75).value - fade(tau2 - h, 0.45, 0.75).value) / (2 * h);
    EXPECT_NEAR(fade(tau2, 0.45, 0.75).slope, slope, 1e-8);
  }
}

TEST(BlendedPlanes, PlanesComeIntoSightWithoutAJump) {
  EXPECT_EQ(coverage(0).value, 0);
  EXPECT_EQ(coverage(0.5).value, 1);
  for (double const weight : {0.05, 0.15, 0.29}) {
    constexpr double h = 1e-6;
    EXPECT_NEAR(coverage(weight).slope, (coverage(weight + h).value - coverage(weight - h).value) / (2 * h), 1e-8);
  }
  // A few planes far off their normals: the slopes of the energy still hold.
  Face face = rough_face(11, -0.2);
  face.sources.resize(2);
  for (Plane& b : face.sources) b.n = unit({{0.9, 0.3, 0.25}});
  Loads const exact = loads(face);
  for (int c = 0; c < 3; ++c) {
    constexpr double h = 1e-7;
    face.target.y[c] += h;
    double const up = energy(face);
    face.target.y[c] -= 2 * h;
    double const down = energy(face);
    face.target.y[c] += h;
    EXPECT_NEAR(exact.target.force[c], -(up - down) / (2 * h), 1e-7);
  }
}

TEST(BlendedPlanes, StiffnessIsThatOfHalfALayer) {
  PairRule const rule = pair_rule(0.5, 2, 1, 6, 3);
  EXPECT_DOUBLE_EQ(rule.stiffness, 0.5 * 0.5 * 3 / 2) << "q C_s Mbar / dpbar";
  EXPECT_DOUBLE_EQ(rule.reach, 6);
  EXPECT_DOUBLE_EQ(rule.length, 1);
  EXPECT_DOUBLE_EQ(frequency2(2 * rule.stiffness, 4, -0.5, 1, 0.25), 2.5 * 0.75 * 4 * 1.75 * 0.25);
}

TEST(BlendedPlanes, ForcesAndNormalLoadsAreTheSlopesOfTheEnergy) {
  for (double const height : {-0.1, -0.3}) {
    Face face = rough_face(7, height);
    Loads const exact = loads(face);
    constexpr double h = 1e-6;
    auto const slope = [&](double& coordinate) {
      double const kept = coordinate;
      coordinate = kept + h;
      double const up = energy(face);
      coordinate = kept - h;
      double const down = energy(face);
      coordinate = kept;
      return (up - down) / (2 * h);
    };
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(exact.target.force[c], -slope(face.target.y[c]), 1e-8);
      EXPECT_NEAR(exact.target.by_normal[c], slope(face.target.n[c]), 1e-8);
      for (std::size_t k = 0; k < face.sources.size(); ++k) {
        EXPECT_NEAR(exact.sources[k].force[c], -slope(face.sources[k].y[c]), 1e-8);
        EXPECT_NEAR(exact.sources[k].by_normal[c], slope(face.sources[k].n[c]), 1e-8);
      }
    }
  }
}

TEST(BlendedPlanes, ForcesBalance) {
  Loads const all = loads(rough_face(3, -0.2));
  Vec<3> sum = all.target.force;
  double size = 0;
  for (PointLoad const& load : all.sources) {
    sum = sum + load.force;
    size += std::sqrt(dot(load.force, load.force));
  }
  EXPECT_GT(size, 0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], 0, 1e-14 * size);
}

TEST(BlendedPlanes, CoupleIsTheSlopeByTheDeformationGradient) {
  Vec<3> const S{{0.1, -0.2, 0.3}}, N = unit({{1, 2, -2}}), x{{1, 2, 3}};
  Mat<3> F{{1.2, 0.1, -0.2, 0.3, 0.9, 0.1, 0.2, -0.1, 1.1}};
  Vec<3> const a{{0.3, -1, 2}}, b{{2, 1, 0.5}};  // E = a.y + b.n
  auto const energy_at = [&](Mat<3> const& G) { return dot(a, x + G * S) + dot(b, unit(transpose(inverse(G)) * N)); };
  Mat<3> const T = couple(S, N, F, {-1.0 * a, b});
  for (int k = 0; k < 9; ++k) {
    constexpr double h = 1e-6;
    Mat<3> up = F, down = F;
    up.c[k] += h;
    down.c[k] -= h;
    EXPECT_NEAR(T.c[k], (energy_at(up) - energy_at(down)) / (2 * h), 1e-8) << k;
  }
}

}  // namespace
}  // namespace piola::contact
