// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/chatter.hpp"
#include "mechanics/contact/blocks.hpp"
#include <numeric>

namespace piola::contact {
namespace {

using namespace testing;

/// Two blocks in motion. The surface points of the first half of the host particles slide with friction.
class Chatter : public ::testing::TestWithParam<int> {
 protected:
  Chatter() : blocks_(GetParam(), 0.0), hosts_(blocks_.set, blocks_.surfaces) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> some(-1, 1);
    for (auto const id : hosts_.ids()) {
      auto const& X = blocks_.set.X[static_cast<std::size_t>(id)];
      Vec<3> x{{X[0], X[1], X[2]}}, v;
      for (int c = 0; c < GetParam(); ++c) {
        x[c] += 0.1 * some(random);
        v[c] = some(random);
      }
      x_.push_back(x);
      v_.push_back(v);
      inverse_masses_.push_back(1 / (1 + 0.5 * some(random)));
    }
    heat_.resize(at(hosts_.count()));
    for (std::size_t k = 0; k < heat_.size() / 2; ++k) heat_[k] = 1e-3 * (1 + some(random));
  }
  ChatterDamping damping(double share) const { return {hosts_, blocks_.surfaces, {share, share}, GetParam()}; }
  ChatterDamping::State state(double dt) const { return {x_, v_, inverse_masses_, heat_, dt}; }
  /// Kinetic energy that the impulses take [J].
  double taken(ChatterDamping const& damping) const {
    double sum = 0;
    for (Index const k : damping.damped()) {
      Vec<3> const& f = damping.impulses()[at(k)];
      sum -= dot(f, v_[at(k)] + (0.5 * inverse_masses_[at(k)]) * f);
    }
    return sum;
  }
  double heat() const { return std::accumulate(heat_.begin(), heat_.end(), 0.0); }

  Blocks blocks_;
  HostParticles hosts_;
  std::vector<Vec<3>> x_, v_;
  std::vector<double> inverse_masses_, heat_;
};

TEST_P(Chatter, KeepsMomenta) {
  auto d = damping(1);
  d.evaluate(hosts_, state(1e-3));
  Vec<3> sum, moment;
  double size = 0;
  for (Index const k : d.damped()) {
    Vec<3> const& f = d.impulses()[at(k)];
    sum = sum + f;
    moment = moment + cross(x_[at(k)], f);
    size += std::sqrt(square_of(f));
  }
  ASSERT_GT(size, 0);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum[c], 0, 1e-13 * size);
    EXPECT_NEAR(moment[c], 0, 1e-12 * size);
  }
}

TEST_P(Chatter, TakesAtMostItsShareOfTheHeat) {
  for (double const share : {0.01, 0.2}) {
    auto d = damping(share);
    d.evaluate(hosts_, state(1e-2));
    EXPECT_LE(taken(d), share * heat());
    EXPECT_GE(taken(d), 0.5 * share * heat()) << "there is more to take than it may";
  }
}

TEST_P(Chatter, NeverFeedsEnergyHoweverLongTheStep) {
  for (double& h : heat_) h = 1e9;
  for (double const dt : {1e-5, 1e-2, 1e3}) {
    auto d = damping(1);
    d.evaluate(hosts_, state(dt));
    double energy = 0;
    for (std::size_t k = 0; k < v_.size(); ++k) energy += 0.5 * square_of(v_[k]) / inverse_masses_[k];
    EXPECT_GT(taken(d), 0);
    EXPECT_LT(taken(d), energy);
  }
}

TEST_P(Chatter, LeavesRigidMotionAndWhatDoesNotRub) {
  Vec<3> const spin = GetParam() == 3 ? Vec<3>{{1, -2, 3}} : Vec<3>{{0, 0, 3}};
  auto const shaken = v_;
  for (std::size_t k = 0; k < v_.size(); ++k) v_[k] = Vec<3>{{5, -1, 0}} + cross(spin, x_[k]);
  auto d = damping(1);
  d.evaluate(hosts_, state(1e-2));
  for (Index const k : d.damped()) EXPECT_LT(square_of(d.impulses()[at(k)]), 1e-24);
  v_ = shaken;
  for (double& h : heat_) h = 0;
  d.evaluate(hosts_, state(1e-2));
  EXPECT_TRUE(d.damped().empty());
  EXPECT_FALSE(damping(0).any());
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Chatter, ::testing::Values(2, 3));

}  // namespace
}  // namespace piola::contact
