// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "formulations/mirrored_parts.hpp"
#include <numbers>

namespace piola {
namespace {

using namespace testing;

struct Setting {
  int dimension;
  std::string scheme, variables;
  double eps4_volume = 0;
};

/// A part of a body with mirror planes against the whole body, which moves symmetrically.
class Mirrored : public ::testing::TestWithParam<Setting> {
 protected:
  Assembly assembly(ParticleSet set) const {
    Assembly a = assemble(std::move(set), rubber("neo_hookean", GetParam().scheme == "filtered" ? 0.47 : 0.3));
    choose(a, "scheme", GetParam().scheme);
    choose(a, "variables", GetParam().variables);
    choose(a, "eps4_volume", GetParam().eps4_volume);
    return a;
  }
  std::array<double, 3> ones(double value) const {
    int const D = GetParam().dimension;
    return {value, D > 1 ? value : 0, D > 2 ? value : 0};
  }
};

INSTANTIATE_TEST_SUITE_P(All, Mirrored,
                         ::testing::Values(Setting{1, "filtered", "pF"}, Setting{2, "filtered", "pF"},
                                           Setting{3, "filtered", "pF"}, Setting{1, "paper", "pF"},
                                           Setting{2, "paper", "pF"}, Setting{3, "paper", "pF"},
                                           Setting{2, "paper", "displacement"}, Setting{2, "paper", "pFJ", 0.125},
                                           Setting{3, "paper", "pFHJ", 0.125}),
                         [](auto const& p) {
                           auto const& s = p.param;
                           return std::to_string(s.dimension) + "D_" + s.scheme + "_" + s.variables;
                         });

TEST_P(Mirrored, APartMovesAsTheWhole) {
  int const D = GetParam().dimension;
  Assembly whole = assembly(box_between(D, ones(-1), ones(1), {11, 11, 11})),
           part = assembly(box_between(D, {}, ones(1), {6, 6, 6}));
  for (int axis = 0; axis < D; ++axis) part.mirrors.push_back({0, axis, false});
  for (Assembly* a : {&whole, &part}) {
    choose(*a, "eps2_momentum", GetParam().variables == "displacement" ? 0.0 : 1.0 / 32);
    if (D == 1 && GetParam().scheme == "filtered") {
      // Its ends stretch: two principal stretches are then 1, and the smallest, in the stabilisation, is known to 1e-8.
      choose(*a, "eps2_momentum", 0.0);
      choose(*a, "eps4_momentum", 0.0);
    }
    give_velocity(*a, [&](Point const& X) {
      return Point{-20 * X[0] * (1 + X[1] * X[1] - X[2] * X[2]), -30 * X[1] * (1 + X[0] * X[0]),
                   9 * X[2] * X[2] * X[2]};
    });
    displace(*a, [](Point const& X) { return Point{-0.05 * X[0], -0.03 * X[1] * X[0] * X[0], 0.02 * X[2]}; });
    load(*a, {"1e4 * X", "0", "0"}, everywhere);
  }
  auto const f = make_formulation(part), g = make_formulation(whole);
  EXPECT_NEAR(f->stable_time_step() / g->stable_time_step(), 1, 0.02);  // the same operator, fewer modes
  double const dt = 0.5 * g->stable_time_step();
  advance(*f, dt, 20);
  advance(*g, dt, 20);
  EXPECT_LT(apart(part, *f, whole, *g, "Velocity", 3), 1e-10);
  EXPECT_LT(apart(part, *f, whole, *g, "DeformationGradient", 9), 1e-12);
  EXPECT_LT(apart(part, *f, whole, *g, "Pressure", 1), 1e-4);  // of some MPa
  auto const d = f->diagnose(), e = g->diagnose();
  double const times = 1 << D;
  EXPECT_NEAR(times * d.kinetic_energy / e.kinetic_energy, 1, 1e-11);
  EXPECT_NEAR(times * d.strain_energy / e.strain_energy, 1, 1e-11);
  EXPECT_NEAR(times * d.external_work / e.external_work, 1, 1e-10);
  EXPECT_NEAR(times * d.stabilisation_loss, e.stabilisation_loss, 1e-9 * e.kinetic_energy);
}

/// Two planes three particles apart: the kernel reaches images of images.
TEST_P(Mirrored, AThinPartBetweenTwoPlanesMovesAsALongOne) {
  int const D = GetParam().dimension;
  Assembly part = assembly(box_between(D, {}, ones(1), {3, 3, 3})),
           whole = assembly(box_between(D, {}, {4, ones(1)[1], ones(1)[2]}, {9, 3, 3}));
  for (Assembly* a : {&part, &whole}) {
    choose(*a, "laplacian_support", 1.2);
    a->mirrors.push_back({0, 0, true});
    a->mirrors.push_back({0, 0, false});
    give_velocity(*a, [](Point const& X) {
      double const s = std::sin(std::numbers::pi * X[0]), c = std::cos(std::numbers::pi * X[0]);
      return Point{9 * s * (1 + X[1]), 20 * X[1] * X[1] * c, 5 * X[2] + c};
    });
  }
  auto const f = make_formulation(part), g = make_formulation(whole);
  double const dt = 0.5 * g->stable_time_step();
  advance(*f, dt, 10);
  advance(*g, dt, 10);
  EXPECT_LT(apart(part, *f, whole, *g, "Velocity", 3), 1e-11);
  Values const x = sample(*f, "Position", part.particles.X.size()), v = sample(*f, "Velocity", part.particles.X.size());
  for (std::size_t k = 0; k < part.particles.X.size(); ++k) {
    double const X = part.particles.X[k][0];
    if (X > 0.1 && X < 0.9) continue;
    EXPECT_EQ(v[3 * k], 0);
    EXPECT_EQ(x[3 * k], X);
  }
}

/// What moves along a plane is free.
TEST_P(Mirrored, ABodyFallsAlongItsPlane) {
  if (GetParam().dimension == 1) GTEST_SKIP() << "no direction along the plane";
  Assembly a = assembly(box_between(GetParam().dimension, {}, ones(1), {5, 5, 5}));
  a.mirrors.push_back({0, 0, false});
  load(a, {"0", "-10", "0"}, everywhere);
  auto const f = make_formulation(a);
  advance(*f, 1e-4, 10);
  Values const v = sample(*f, "Velocity", a.particles.X.size());
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    EXPECT_NEAR(v[3 * k], 0, 1e-12);
    EXPECT_NEAR(v[3 * k + 1], -1e-2, 1e-12);
  }
}

TEST_P(Mirrored, RunsContinueAndRepeatWithTheSameBits) {
  expect_same_bits_of_runs([&] {
    Assembly a = assembly(box_between(GetParam().dimension, {}, ones(1), {5, 5, 5}));
    for (int axis = 0; axis < GetParam().dimension; ++axis) a.mirrors.push_back({0, axis, axis == 1});
    give_velocity(a, [](Point const& X) { return Point{9 * X[0], 3 - X[1] * X[1], X[2]}; });
    return a;
  });
}

/// On every machine; the portable one reads lists without lanes.
TEST(MirrorPlanes, GiveTheSameOnEveryMachine) {
  Assembly a = assemble(box_between(3, {}, {1, 1, 1}, {5, 5, 5}));
  for (int axis = 0; axis < 3; ++axis) a.mirrors.push_back({0, axis, false});
  give_velocity(a, [](Point const& X) { return Point{9 * X[0], -3 * X[1], X[2]}; });
  std::vector<Values> ends;
  for (auto const& backend : backends()) {
    a.backend = backend;
    auto const f = make_formulation(a);
    advance(*f, 1e-4, 10);
    ends.push_back(sample(*f, "Velocity", a.particles.X.size()));
    EXPECT_LT(largest_difference(ends.back(), ends.front()), 1e-11) << backend;
  }
}

TEST(MirrorPlanes, GiveTheirParticlesTheNeighboursOfInnerOnes) {
  Assembly a = assemble(box_between(3, {}, {1, 1, 1}, {6, 6, 6}));
  for (int axis = 0; axis < 3; ++axis) a.mirrors.push_back({0, axis, axis == 2});
  Values const neighbours = sample(*make_formulation(a), "Neighbours", 216);
  for (std::size_t k = 0; k < 216; ++k) {
    Point const& X = a.particles.X[k];
    if (X[0] < 0.5 && X[1] < 0.5 && X[2] > 0.5) {
      EXPECT_EQ(neighbours[k], 56);  // jst-sph.md, A.0: h = 1.2 spacings
    }
  }
}

/// A skew plane continues small motions with the opposite sign: sin(pi X / 2) on [0, 1] is half of that on [0, 2].
TEST(SkewMirrorPlanes, ContinueSmallMotionsTheOppositeWay) {
  constexpr double size = 1e-6;  // m/s: the law is linear, wave speeds are so up to the strain
  for (auto const* const scheme : {"filtered", "paper"}) {
    Assembly half = assemble(box_between(2, {}, {1, 1, 0}, {6, 6, 1}), rubber("linear_elastic"));
    Assembly whole = assemble(box_between(2, {}, {2, 1, 0}, {11, 6, 1}), rubber("linear_elastic"));
    half.mirrors = {{0, 0, false, false}, {0, 0, true, true}};
    whole.mirrors = {{0, 0, false, false}, {0, 0, true, false}};
    for (Assembly* a : {&half, &whole}) {
      choose(*a, "scheme", scheme);
      give_velocity(*a, [](Point const& X) {
        double const angle = std::numbers::pi / 2 * X[0];
        return Point{size * std::sin(angle) * X[1], size * std::cos(angle) * X[1] * X[1], 0};
      });
    }
    auto const f = make_formulation(half), g = make_formulation(whole);
    double const dt = 0.5 * g->stable_time_step();
    advance(*f, dt, 20);
    advance(*g, dt, 20);
    EXPECT_LT(apart(half, *f, whole, *g, "Velocity", 3), 1e-6 * size) << scheme;
    EXPECT_GT(largest(sample(*f, "Velocity", 36)), 0.1 * size);
  }
}

TEST(MirrorPlanes, AreRefusedWhereTheyCannotWork) {
  Assembly a = assemble(box_between(2, {}, {1, 1, 0}, {6, 6, 1}));
  a.mirrors = {{0, 2, false, false}};
  EXPECT_NE(refusal(a).find("across Z in 2 dimensions"), std::string::npos) << refusal(a);
  a.mirrors = {{0, 0, false, false}};
  EXPECT_EQ(refusal(a), "");
  choose(a, "supports", "multipliers");
  EXPECT_NE(refusal(a).find("multipliers"), std::string::npos);
  choose(a, "supports", "direct");
  choose(a, "scheme", "filtered");
  a.materials = {rubber("neo_hookean", 0.49)};
  EXPECT_EQ(refusal(a), "");
  a.mirrors[0].skew = true;
  EXPECT_NE(refusal(a).find("volumetric filter"), std::string::npos);
}

}  // namespace
}  // namespace piola
