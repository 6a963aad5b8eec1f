// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/probe.hpp"
#include "piola/base/errors.hpp"
#include "support/fake_formulation.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <random>

namespace piola {
namespace {

/// A plate turned by an angle about the z axis and stretched along y.
class Turned : public testing::Springs {
 public:
  Turned(ParticleSet const& set, double angle, double stretch)
      : Springs(set), set_(set), angle_(angle), stretch_(stretch) {}
  void sample(std::string_view field, std::span<double> values) const override {
    if (field != "Displacement") return Springs::sample(field, values);
    for (std::size_t i = 0; i < set_.X.size(); ++i) {
      double const X = set_.X[i][0], Y = stretch_ * set_.X[i][1], c = std::cos(angle_), s = std::sin(angle_);
      values[3 * i] = c * X - s * Y - set_.X[i][0];
      values[3 * i + 1] = s * X + c * Y - set_.X[i][1];
      values[3 * i + 2] = 0;
    }
  }

 private:
  ParticleSet set_;
  double angle_, stretch_;
};

ProbeSpec spec(ProbeSpec::Kind kind, std::vector<std::string> quantities = {}) {
  ProbeSpec s;
  s.name = "p";
  s.body = "plate";
  s.kind = kind;
  s.quantities = std::move(quantities);
  return s;
}

std::vector<double> evaluate(ProbeSpec const& s, Formulation const& f, ParticleSet const& set) {
  Probe probe(s, set);
  FieldCache cache(f, set);
  return probe.evaluate(cache);
}

TEST(Probe, TakesThePointNearestToAPlace) {
  ParticleSet const set = testing::make_plate(4);
  auto s = spec(ProbeSpec::Kind::point, {"velocity_x", "velocity_y", "velocity_magnitude", "position_x"});
  s.at = {2.2, 1.1, 0};
  Probe const probe(s, set);
  EXPECT_EQ(probe.ids(), std::vector<std::int64_t>{6});
  EXPECT_EQ(probe.columns()[1].name, "p.velocity_y");
  EXPECT_EQ(probe.columns()[1].unit, "m/s");
  auto const values = evaluate(s, testing::Springs(set), set);
  EXPECT_DOUBLE_EQ(values[0], 0.1);
  EXPECT_DOUBLE_EQ(values[1], -0.2);
  EXPECT_DOUBLE_EQ(values[2], std::hypot(0.1, 0.2));
  EXPECT_DOUBLE_EQ(values[3], 2);
}

/// What a rank owns of a body.
class Share : public testing::Springs {
 public:
  Share(ParticleSet const& set, std::vector<std::int64_t> ids) : Springs(set), ids_(std::move(ids)) {}
  std::optional<std::vector<std::int64_t>> local_particles() const override { return ids_; }
  void sample_local(std::string_view field, std::span<double> values) const override {
    auto const width = static_cast<std::size_t>(info_of(fields(), field).components);
    std::vector<double> all(width * 16);
    sample(field, all);
    for (std::size_t k = 0; k < ids_.size(); ++k)
      std::copy_n(&all[static_cast<std::size_t>(ids_[k]) * width], width, &values[k * width]);
  }

 private:
  std::vector<std::int64_t> ids_;
};

TEST(Probe, LooksAtItsShareAlone) {
  ParticleSet const set = testing::make_plate(4);
  Share const share(set, {9, 2, 14, 5});
  auto const of_share = [&](ProbeSpec const& s) {
    Probe probe(s, set);
    EXPECT_TRUE(probe.is_reducible());
    probe.share(share.local_particles());
    FieldCache cache(share, set, FieldCache::Of::local);
    return probe.evaluate(cache);
  };
  auto s = spec(ProbeSpec::Kind::maximum, {"position_x", "position_y", "velocity_magnitude"});
  auto const largest = of_share(s);
  EXPECT_EQ(largest[0], 2);
  EXPECT_EQ(largest[1], 3);
  EXPECT_DOUBLE_EQ(largest[2], std::hypot(0.3, 0.2));  // velocities are (Y, -X) / 10
  s.kind = ProbeSpec::Kind::average;
  s.where.emplace("X > 0.5");
  EXPECT_DOUBLE_EQ(of_share(s)[0], (1 + 2 + 2 + 1) / 4.0);
  s.where.emplace("X > 1.5");
  EXPECT_DOUBLE_EQ(of_share(s)[1], (0 + 3) / 2.0);
  s.kind = ProbeSpec::Kind::point;
  s.where.reset();
  s.at = {2.2, 2.9, 0};
  EXPECT_EQ(of_share(s)[1], 3);
  s.at = {0, 0, 0};
  EXPECT_EQ(of_share(s)[1], 0);  // the nearest particle is on another rank
}

TEST(Probe, ExtremaDoNotDependOnTheOrder) {
  ParticleSet const set = testing::make_plate(2);
  class Odd : public testing::Springs {
   public:
    using Springs::Springs;
    void sample(std::string_view, std::span<double> values) const override {
      double const v[]{std::nan(""), 0.0, -0.0, -0.0};
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = v[i / 3];
    }
  };
  for (auto const kind : {ProbeSpec::Kind::minimum, ProbeSpec::Kind::maximum}) {
    double const value = evaluate(spec(kind, {"velocity_y"}), Odd(set), set)[0];
    EXPECT_EQ(value, 0);
    EXPECT_FALSE(std::signbit(value));
  }
}

TEST(Probe, WeightsAnAverageByTributaryVolume) {
  ParticleSet set = testing::make_plate(2);
  set.volume = {1, 3, 0, 0};
  auto s = spec(ProbeSpec::Kind::average, {"velocity_y"});
  EXPECT_DOUBLE_EQ(evaluate(s, testing::Springs(set), set)[0], -0.075);
  s.kind = ProbeSpec::Kind::minimum;
  EXPECT_DOUBLE_EQ(evaluate(s, testing::Springs(set), set)[0], -0.1);
  s.kind = ProbeSpec::Kind::maximum;
  EXPECT_DOUBLE_EQ(evaluate(s, testing::Springs(set), set)[0], 0);
}

TEST(Probe, CountsOnlyTheParticlesOfItsRegion) {
  ParticleSet const set = testing::make_plate(4);
  auto s = spec(ProbeSpec::Kind::maximum, {"position_y"});
  s.where = Expression("Y < 1.5");
  EXPECT_DOUBLE_EQ(evaluate(s, testing::Springs(set), set)[0], 1);
  s.where = Expression("Y > 100");
  EXPECT_THROW(Probe(s, set), InputError);
}

TEST(Probe, MeasuresTwistWithSign) {
  ParticleSet const set = testing::make_plate(4);
  auto s = spec(ProbeSpec::Kind::twist);
  s.axis = 2;
  for (double angle : {-3.0, -0.5, 0.0, 0.7, 3.1})
    EXPECT_NEAR(evaluate(s, Turned(set, angle, 1), set)[0], angle, 1e-12);
  EXPECT_EQ(Probe(s, set).columns()[0].name, "p.twist_angle");
}

TEST(Probe, CountsFullTurns) {
  ParticleSet const set = testing::make_plate(4);
  auto s = spec(ProbeSpec::Kind::twist);
  s.axis = 2;
  Probe probe(s, set);
  double angle = 0;
  for (int k = 0; k < 30; ++k) {
    angle -= 0.5;
    Turned const turned(set, angle, 1);
    FieldCache cache(turned, set);
    EXPECT_NEAR(probe.evaluate(cache)[0], angle, 1e-12);
  }
  Probe again(s, set);
  again.restore(probe.state());
  Turned const turned(set, angle - 0.5, 1);
  FieldCache cache(turned, set);
  EXPECT_NEAR(again.evaluate(cache)[0], angle - 0.5, 1e-12);
}

TEST(Probe, MeasuresTheExtentAlongAnAxis) {
  ParticleSet const set = testing::make_plate(4);
  auto s = spec(ProbeSpec::Kind::extent);
  s.axis = 1;
  EXPECT_NEAR(evaluate(s, Turned(set, 0, 1.5), set)[0], 4.5, 1e-12);
}

// Springs have the velocity (Y, -X, 0)/10. Against (Y, 0, 0)/10 the difference is (0, -X, 0)/10, so that the relative
// error is sqrt(sum V X^2 / sum V Y^2); over the upper half of a 2 x 2 plate with Y = 1 that is sqrt(V_3/(V_2 + V_3)).
TEST(Probe, MeasuresTheRelativeErrorOfAField) {
  ParticleSet set = testing::make_plate(2);
  set.volume = {1, 1, 1, 3};
  auto s = spec(ProbeSpec::Kind::error, {"relative_error"});
  s.field = "Velocity";
  s.reference = {Expression("Y/10"), Expression("-X/10"), Expression("0")};
  EXPECT_NEAR(evaluate(s, testing::Springs(set), set)[0], 0, 1e-15);
  s.reference[1] = Expression("0");
  s.where = Expression("Y > 0.5");
  EXPECT_NEAR(evaluate(s, testing::Springs(set), set)[0], std::sqrt(3.0 / 4), 1e-15);
  s.where = {};
  EXPECT_NEAR(evaluate(s, testing::Springs(set), set)[0], std::sqrt((1.0 + 3) / (1 + 3)), 1e-15);
  set.volume = {1, 5, 1, 3};
  EXPECT_NEAR(evaluate(s, testing::Springs(set), set)[0], std::sqrt((5.0 + 3) / (1 + 3)), 1e-15);
  EXPECT_EQ(Probe(s, set).columns()[0].name, "p.relative_error");
  EXPECT_EQ(Probe(s, set).columns()[0].unit, "1");
}

/// A plate whose particles are numbered in another order.
ParticleSet renumbered(ParticleSet const& set, std::mt19937& random) {
  std::vector<std::size_t> order(set.X.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), random);
  ParticleSet other = set;
  for (std::size_t k = 0; k < order.size(); ++k) {
    other.X[k] = set.X[order[k]];
    other.volume[k] = set.volume[order[k]];
    other.lattice_index[k] = set.lattice_index[order[k]];
  }
  return other;
}

TEST(Probe, DoesNotDependOnTheOrderOfParticles) {
  std::mt19937 random(6);
  ParticleSet set = testing::make_plate(12);
  for (double& v : set.volume.own()) v = 1 + static_cast<double>(random()) / 5e9;
  auto average = spec(ProbeSpec::Kind::average, {"velocity_y"}), twist = spec(ProbeSpec::Kind::twist),
       error = spec(ProbeSpec::Kind::error);
  twist.axis = 2;
  error.field = "Velocity";
  error.reference = {Expression("Y/9"), Expression("X"), Expression("0.3")};
  for (ProbeSpec const& s : {average, twist, error}) {
    double const reference = evaluate(s, Turned(set, 0.7, 1.1), set)[0];
    for (int k = 0; k < 30; ++k) {
      ParticleSet const other = renumbered(set, random);
      EXPECT_EQ(evaluate(s, Turned(other, 0.7, 1.1), other)[0], reference);
    }
  }
}

TEST(Probe, ComparesWithAFormulaAtTheTimeOfTheRow) {
  ParticleSet const set = testing::make_plate(3);
  auto s = spec(ProbeSpec::Kind::error);
  s.field = "Velocity";
  s.reference = {Expression("t*Y/10"), Expression("-t*X/10"), Expression("0")};
  testing::Springs const springs(set);
  FieldCache cache(springs, set);
  Probe probe(s, set);
  EXPECT_NEAR(probe.evaluate(cache, 1)[0], 0, 1e-15);
  EXPECT_NEAR(probe.evaluate(cache, 4)[0], 0.75, 1e-15);  // |1 - 4|/4
}

TEST(Probe, CountsTheShearOfASymmetricTensorTwice) {
  class Sheared : public testing::Springs {
   public:
    using Springs::Springs;
    void sample(std::string_view, std::span<double> values) const override {
      for (std::size_t k = 0; k < values.size(); ++k) values[k] = std::array<double, 6>{3, 4, 0, 0, 2, 0}[k % 6];
    }
  };
  ParticleSet const set = testing::make_plate(2);
  auto s = spec(ProbeSpec::Kind::error);
  s.field = "CauchyStress";
  for (char const* const formula : {"3", "4", "0", "0", "0", "0"}) s.reference.emplace_back(formula);
  EXPECT_NEAR(evaluate(s, Sheared(set), set)[0], std::sqrt(2 * 4.0 / 25), 1e-15);
}

TEST(Probe, AgreementWithNothingIsNoError) {
  ParticleSet const set = testing::make_plate(2);
  auto s = spec(ProbeSpec::Kind::error);
  s.field = "Displacement";  // zero at the start
  for (int c = 0; c < 3; ++c) s.reference.emplace_back("t");
  EXPECT_EQ(evaluate(s, testing::Springs(set), set)[0], 0);
}

/// The stress of a crack tip at (3, 3) with K = 5, on the line ahead in the direction (0.6, 0.8): s_nn = K/sqrt(2 pi
/// r), with 7 along the line and no shear there.
class Cracked : public testing::Springs {
 public:
  explicit Cracked(ParticleSet const& set) : Springs(set), set_(set) {}
  void sample(std::string_view, std::span<double> values) const override {
    for (std::size_t i = 0; i < set_.X.size(); ++i) {
      double const r = std::hypot(set_.X[i][0] - 3, set_.X[i][1] - 3);
      double const across = 5 / std::sqrt(2 * std::numbers::pi * r), along = 7;
      values[6 * i] = along * 0.36 + across * 0.64;
      values[6 * i + 1] = along * 0.64 + across * 0.36;
      values[6 * i + 3] = (along - across) * 0.48;
    }
  }

 private:
  ParticleSet set_;
};

TEST(Probe, FitsTheStressIntensityAheadOfATip) {
  ParticleSet const set = testing::make_plate(20);
  auto s = spec(ProbeSpec::Kind::stress_intensity);
  s.at = {3.1, 2.8, 0};
  s.direction = {0.6, 0.8, 0};
  s.from = 5;
  s.to = 15;
  Probe const probe(s, set);
  EXPECT_EQ(probe.ids(), (std::vector<std::int64_t>{7 * 20 + 6, 11 * 20 + 9, 15 * 20 + 12}));
  EXPECT_EQ(probe.columns().at(0).name, "p.stress_intensity");
  EXPECT_EQ(probe.columns().at(0).unit, "Pa m^0.5");
  EXPECT_NEAR(evaluate(s, Cracked(set), set).at(0), 5, 1e-13);
  s.to = 5 * (1 - 1e-9);
  s.from = s.to;
  EXPECT_EQ(Probe(s, set).ids().size(), 1u);
  EXPECT_NEAR(evaluate(s, Cracked(set), set).at(0), 5, 1e-14);
  s.from = s.to = 6;
  EXPECT_THROW(Probe(s, set), InputError);
  s.direction = {-0.6, -0.8, 0};
  s.from = s.to = 5;
  EXPECT_THROW(Probe(s, set), InputError);
}

TEST(Probe, GivesNoNumberForAFieldThatTheFormulationDoesNotHave) {
  ParticleSet const set = testing::make_plate(4);
  EXPECT_TRUE(std::isnan(evaluate(spec(ProbeSpec::Kind::average, {"damage"}), testing::Springs(set), set)[0]));
}

}  // namespace
}  // namespace piola
