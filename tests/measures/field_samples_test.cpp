// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/field_samples.hpp"
#include "support/fake_formulation.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

/// A plate, a cube or a row over [0, 6]^dimension with n particles along each side, shifted by a share of its spacing.
FieldSample lattice(int dimension, int n, double shift, std::function<double(std::array<double, 3> const&)> const& f) {
  FieldSample sample{.field = "Pressure", .time = 0.5, .dimension = dimension};
  double const h = 6.0 / (n - 1);
  int const rows = dimension > 1 ? n : 1, layers = dimension > 2 ? n : 1;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < n; ++i) {
        std::array<double, 3> const X{(i + shift) * h, dimension > 1 ? (j + shift) * h : 0,
                                      dimension > 2 ? (k + shift) * h : 0};
        sample.X.push_back(X);
        sample.values.push_back(f(X));
        sample.volume.push_back(std::pow(h, dimension));
        sample.spacing.push_back(h);
        sample.body.push_back(0);
      }
    }
  }
  return sample;
}

double linear(std::array<double, 3> const& X) { return 3 + X[0] - 2 * X[1] + 0.5 * X[2]; }
double wavy(std::array<double, 3> const& X) { return std::sin(X[0]) * std::cos(0.7 * X[1]) + 2; }

TEST(FieldSamples, SeeLinearFieldsExactly) {
  for (int const dimension : {1, 2, 3}) {
    auto const coarse = lattice(dimension, 5, 0.13, linear), fine = lattice(dimension, 11, 0, linear);
    EXPECT_LT(relative_difference(coarse, fine, nullptr).value_or(1), 1e-13) << dimension;
  }
}

// The fit is of second order in the spacing of the reference: a quarter of the error for half the spacing.
TEST(FieldSamples, ConvergeWithTheReference) {
  auto const at = lattice(2, 7, 0.31, wavy);
  Expression const inside("X < 6 && Y < 6");
  double const coarse = relative_difference(at, lattice(2, 21, 0, wavy), &inside).value_or(-1);
  double const fine = relative_difference(at, lattice(2, 41, 0, wavy), &inside).value_or(-1);
  EXPECT_GT(coarse, 1e-5);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.4);
}

TEST(FieldSamples, TakeTheParticleThatStandsThere) {
  auto const at = lattice(2, 4, 0, wavy);
  auto fine = lattice(2, 7, 0, wavy);
  EXPECT_EQ(relative_difference(at, fine, nullptr), 0.0);
  for (double& v : fine.values) v *= 2;
  EXPECT_NEAR(*relative_difference(at, fine, nullptr), 0.5, 1e-14);
}

TEST(FieldSamples, CompareOnlyWhereTheyAreAsked) {
  auto at = lattice(2, 4, 0, linear);
  auto const fine = lattice(2, 7, 0, linear);
  at.values[0] += 10;  // at the origin
  Expression const elsewhere("X > 0.5");
  EXPECT_GT(*relative_difference(at, fine, nullptr), 0.1);
  EXPECT_EQ(relative_difference(at, fine, &elsewhere), 0.0);
}

TEST(FieldSamples, CannotBeComparedAcrossKindsBodiesOrEmptySpace) {
  auto const at = lattice(2, 4, 0.1, linear);
  auto other_body = lattice(2, 7, 0, linear);
  for (int& body : other_body.body) body = 1;
  EXPECT_FALSE(relative_difference(at, other_body, nullptr));
  auto const solid = lattice(3, 7, 0, linear);
  EXPECT_FALSE(relative_difference(at, solid, nullptr));
  auto stress = lattice(2, 7, 0, linear);
  stress.components = 3;
  EXPECT_FALSE(relative_difference(at, stress, nullptr));
  auto far = lattice(2, 7, 0, linear);
  for (auto& X : far.X) X[0] += 40;
  EXPECT_FALSE(relative_difference(at, far, nullptr));
}

/// Time in every particle.
class Clock : public testing::Springs {
 public:
  using Springs::Springs;
  void sample(std::string_view field, std::span<double> values) const override {
    if (field != "Pressure") return Springs::sample(field, values);
    for (double& v : values) v = now;
  }
  double now = 0;
};

TEST(FieldSampler, LooksBetweenTheStepsAroundATime) {
  ParticleSet const set = testing::make_plate(3);
  Clock clock(set);
  FieldSampler sampler({{"Pressure", 0}, {"Pressure", 0.25}, {"Pressure", 7}, {"Nothing", 0.25}}, set);
  TimeState moment;
  for (double const dt : {0.0, 0.03, 0.05, 0.04, 0.06, 0.05, 0.07, 0.04}) {
    moment.time += dt;
    moment.dt = dt;
    clock.now = 10 * moment.time;
    sampler.observe(clock, moment);
    moment.step += 1;
  }
  ASSERT_EQ(sampler.samples().size(), 2U);
  EXPECT_EQ(sampler.samples()[0].values.at(4), 0);
  EXPECT_EQ(sampler.samples()[1].time, 0.25);
  EXPECT_NEAR(sampler.samples()[1].values.at(4), 2.5, 1e-13);
  EXPECT_EQ(sampler.samples()[1].spacing.at(4), 1);
}

}  // namespace
}  // namespace piola
