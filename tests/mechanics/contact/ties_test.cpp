// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/ties.hpp"
#include "piola/setup/contact_surface.hpp"
#include "exec/thread_count.hpp"
#include "mechanics/contact/blocks.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace piola::contact {
namespace {

/// Two blocks, one on the other, of different spacings and stiffness; the upper one may be jittered.
struct Stack {
  ParticleSet set;
  std::vector<Surface> surfaces;
  int dimension;

  explicit Stack(int D, double gap = 0, double jitter = 0) : dimension(D) {
    add({0, 0, 0}, 5, 1, 0);
    std::array<double, 3> above{0.3, D == 3 ? 0.3 : 0, 0};
    above[D == 3 ? 2 : 1] = 3 + gap;
    add(above, 4, 0.7, jitter);
  }
  void add(std::array<double, 3> const& min, int n, double spacing, double jitter) {
    ShapeSpec shape;
    shape.dimension = dimension;
    shape.min = min;
    shape.jitter = jitter;
    shape.seed = 3;
    for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
      shape.particles[c] = c + 1 == static_cast<std::size_t>(dimension) ? 3 : n;
      shape.max[c] = min[c] + spacing * shape.particles[c];
    }
    shape.placement = ShapeSpec::Placement::cell_centred;
    fill(shape, "block", set);
    surfaces.push_back(contact_surface(shape, set, set.bodies.back()));
    surfaces.back().modulus = surfaces.size() == 1 ? 2e6 : 5e6;
  }
};

struct Held {
  Stack stack;
  HostParticles hosts;
  std::vector<Vec<3>> x;
  Ties ties;

  Held(Stack from, TieRule rule)
      : stack(std::move(from)), hosts(stack.set, stack.surfaces), x(places()), ties(bound(std::move(rule))) {}
  std::vector<Vec<3>> places() const {
    std::vector<Vec<3>> all;
    for (auto const id : hosts.ids()) {
      auto const& X = stack.set.X[static_cast<std::size_t>(id)];
      all.push_back({{X[0], X[1], X[2]}});
    }
    return all;
  }
  Ties bound(TieRule rule) const {
    rule.bodies = {0, 1};
    return {{std::move(rule)}, stack.set, stack.surfaces, hosts, x};
  }
  double energy(std::vector<Vec<3>> const& at) {
    ties.evaluate(hosts, at);
    return ties.totals().energy;
  }
};

TieRule elastic() {
  TieRule rule;
  rule.name = "tie";
  return rule;
}
TieRule brittle() {
  TieRule rule = elastic();
  rule.strength = 1e5;
  rule.toughness = 2e4;  // fails at 0.4 m
  rule.shear_weight = 0.7;
  return rule;
}

/// Deforms, shears, turns and shakes.
void distort(std::vector<Vec<3>>& x, int dimension, double amount) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> some(-1, 1);
  for (Vec<3>& y : x) {
    Vec<3> const X = y;
    y[0] += amount * (0.3 * X[1] + 0.05 * X[0] * X[0]);
    y[1] += amount * (-0.5 * X[0]);
    for (int c = 0; c < dimension; ++c) y[c] += 0.2 * amount * some(random);
  }
}

class TiesIn : public ::testing::TestWithParam<int> {};

TEST_P(TiesIn, HoldTheAreaThatTouches) {
  Held held(Stack(GetParam()), elastic());
  Ties::TieReport const& found = held.ties.found()[0];
  double const side = 4 * 0.7, area = GetParam() == 3 ? side * side : side;
  EXPECT_EQ(found.points[1], GetParam() == 3 ? 16 : 4) << "the whole face of the upper block";
  EXPECT_NEAR(found.area / area, 1, 0.25) << "the points of the lower one beyond the rim count in part";
  EXPECT_LT(found.farthest, 1e-12);
  EXPECT_DOUBLE_EQ(found.stiffness, 2 * (2 * 2e6 * 5e6 / 7e6) / 0.85) << "C_s Mbar / dpbar";
}

TEST_P(TiesIn, HoldNothingBeyondHalfASpacing) {
  EXPECT_GT(Held(Stack(GetParam(), 0.4), elastic()).ties.count(), 0U);
  Held const apart(Stack(GetParam(), 0.6), elastic());
  EXPECT_EQ(apart.ties.count(), 0U);
  EXPECT_NEAR(apart.ties.found()[0].nearest, 0.6 / 0.85, 1e-12);
  EXPECT_FALSE(std::isfinite(Held(Stack(GetParam(), 5), elastic()).ties.found()[0].nearest));
  TieRule half = elastic();
  half.where = Expression("X < 1.5");
  EXPECT_LT(Held(Stack(GetParam()), half).ties.count(), Held(Stack(GetParam()), elastic()).ties.count());
}

TEST_P(TiesIn, AffineMotionCostsNothing) {
  for (double const gap : {0.0, 0.3, -0.3})
    for (TieRule const& rule : {elastic(), brittle()}) {
      Held held(Stack(GetParam(), gap, 0.2), rule);
      Mat<3> F{{1.1, 0.2, 0.1, -0.3, 0.9, 0.05, 0.2, 0.1, 1.3}};
      if (GetParam() == 2) F = {{1.1, 0.2, 0, -0.3, 0.9, 0, 0, 0, 1}};
      auto x = held.x;
      for (Vec<3>& y : x) y = F * y + Vec<3>{{1, 2, 0}};
      // Of E = K jump^2 A / 2 with jumps as large as the blocks.
      EXPECT_LT(held.energy(x), 1e-27 * 1e6 * 100);
    }
}

TEST_P(TiesIn, ForcesAreTheSlopesOfTheEnergy) {
  int const D = GetParam();
  for (TieRule const& rule : {elastic(), brittle()}) {
    Held held(Stack(D, 0, 0.1), rule);
    distort(held.x, D, 0.2);
    held.energy(held.x);
    Ties const kept = held.ties;
    double largest = 0;
    for (Vec<3> const& f : kept.forces()) largest = std::max(largest, std::sqrt(dot(f, f)));
    ASSERT_GT(largest, 0);
    for (std::size_t n = 0; n < kept.loaded_indices().size(); n += 3)
      for (int c = 0; c < D; ++c) {
        constexpr double h = 1e-6;
        auto const i = static_cast<std::size_t>(kept.loaded_indices()[n]);
        auto moved = held.x;
        moved[i][c] += h;
        double high = held.energy(moved);
        held.ties = kept;
        moved[i][c] -= 2 * h;
        double low = held.energy(moved);
        held.ties = kept;
        // Where a tie opens farther the heat is part of what the force does.
        if (rule.fails()) {
          Ties up = kept, down = kept;
          moved[i][c] += 2 * h;
          up.evaluate(held.hosts, moved);
          moved[i][c] -= 2 * h;
          down.evaluate(held.hosts, moved);
          high += up.totals().heat;
          low += down.totals().heat;
        }
        EXPECT_NEAR(kept.forces()[i][c], -(high - low) / (2 * h), 1e-5 * largest);
      }
  }
}

/// All results of a tie between the ends of two plates that a run reads.
std::vector<double> tied_at_both_ends(int D, std::uint32_t seed) {
  Stack plates(D);
  plates.set = {};
  plates.surfaces.clear();
  std::array<double, 3> above{0.3, 0, 0};
  above[D == 3 ? 2 : 1] = 3;
  plates.add({0, 0, 0}, 16, 1, 0);
  plates.add(above, 16, 0.9, 0);
  if (seed > 0)
    for (Surface& surface : plates.surfaces) testing::deal_out(surface, plates.set, 8, seed++);
  TieRule rule = brittle();
  rule.toughness = 1e3;  // fails at 0.02 m
  rule.where = Expression("X < 4 || X > 12");
  Held held(std::move(plates), rule);
  distort(held.x, D, 0.1);
  held.ties.evaluate(held.hosts, held.x);
  Ties::TieReport const& found = held.ties.found()[0];
  Ties::Totals const& totals = held.ties.totals();
  std::vector<double> all{totals.energy, totals.heat, totals.failed, found.area, found.left_area};
  auto const put = [&](Vec<3> const& a) { all.insert(all.end(), a.c, a.c + 3); };
  for (Vec<3> const& f : held.ties.forces()) put(f);
  put(held.ties.resultant_on_first(0).force);
  put(held.ties.resultant_on_first(0).moment);
  return all;
}

TEST_P(TiesIn, NoSumDependsOnTheOrderOfPoints) {
  auto const reference = tied_at_both_ends(GetParam(), 0);
  for (std::size_t k : {0, 1, 2}) ASSERT_GT(reference[k], 0) << k;
  ASSERT_LT(reference[2], 1);
  for (std::uint32_t seed = 1; seed < 40; seed += 3) EXPECT_EQ(tied_at_both_ends(GetParam(), seed), reference) << seed;
}

TEST_P(TiesIn, MomentaAreKept) {
  int const D = GetParam();
  for (TieRule const& rule : {elastic(), brittle()}) {
    Held held(Stack(D, 0.2, 0.1), rule);
    distort(held.x, D, 0.3);
    held.energy(held.x);
    Vec<3> force, moment, resultant_on_first;
    double size = 0;
    for (std::size_t k = 0; k < held.x.size(); ++k) {
      Vec<3> const& f = held.ties.forces()[k];
      force = force + f;
      moment = moment + cross(held.x[k], f);
      size += std::sqrt(dot(f, f));
      if (held.hosts.ids()[k] < held.stack.set.bodies[1].first) resultant_on_first = resultant_on_first + f;
    }
    ASSERT_GT(size, 0);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(force[c], 0, 1e-15 * size);
      EXPECT_NEAR(moment[c], 0, 3e-15 * size) << "arms of 5 m";
      EXPECT_NEAR(held.ties.resultant_on_first(0).force[c], resultant_on_first[c], 1e-14 * size);
    }
  }
}

TEST_P(TiesIn, TheMomentIsThatOfTheForces) {
  Held held(Stack(GetParam()), brittle());
  distort(held.x, GetParam(), 0.3);
  held.energy(held.x);
  Vec<3> moment;
  double size = 0;
  for (std::size_t k = 0; k < held.x.size(); ++k) {
    size += std::sqrt(dot(held.ties.forces()[k], held.ties.forces()[k]));
    if (held.hosts.ids()[k] < held.stack.set.bodies[1].first) moment = moment + cross(held.x[k], held.ties.forces()[k]);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(held.ties.resultant_on_first(0).moment[c], moment[c], 1e-14 * size);
}

// What holds is released, point by point, and takes its toughness.
TEST_P(TiesIn, PulledApartTheyTakeTheirToughness) {
  int const D = GetParam();
  Held held(Stack(D), brittle());
  double work = 0, last = 0;
  std::size_t released = 0;
  constexpr int steps = 4000;
  for (int k = 0; k <= steps; ++k) {
    held.ties.evaluate(held.hosts, held.x);
    double const now = held.ties.resultant_on_first(0).force[D - 1];
    if (k > 0) work += 0.5 * (last + now) * 0.5 / steps;
    last = now;
    released += held.ties.released().size();
    for (std::size_t i = 0; i < held.x.size(); ++i)
      if (held.hosts.ids()[i] >= held.stack.set.bodies[1].first) held.x[i][D - 1] += 0.5 / steps;
  }
  double const area = held.ties.found()[0].area;
  EXPECT_NEAR(work / (2e4 * area), 1, 1e-5);
  EXPECT_NEAR(held.ties.totals().heat / (2e4 * area), 1, 1e-12);
  EXPECT_EQ(held.ties.totals().failed, 1);
  EXPECT_EQ(held.ties.totals().energy, 0);
  EXPECT_EQ(last, 0);
  EXPECT_EQ(released, held.ties.count()) << "each once";
}

TEST_P(TiesIn, FrequencyIsABound) {
  Held held(Stack(GetParam(), 0, 0.1), elastic());
  std::vector<double> inverse(held.x.size());
  for (std::size_t k = 0; k < inverse.size(); ++k) inverse[k] = 1 / (1.0 + 0.3 * static_cast<double>(k % 4));
  double const bound = held.ties.frequency2(inverse);
  // Power iteration in one direction: forces are linear in displacements.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> some(-1, 1);
  std::vector<double> v(inverse.size());
  for (double& value : v) value = some(random);
  double growth = 0;
  for (int round = 0; round < 300; ++round) {
    auto x = held.x;
    for (std::size_t k = 0; k < v.size(); ++k) x[k][0] += v[k];
    held.ties.evaluate(held.hosts, x);
    double before = 0, after = 0;
    for (std::size_t k = 0; k < v.size(); ++k) {
      double const next = -held.ties.forces()[k][0] * inverse[k];
      before += v[k] * v[k];
      after += next * next;
      v[k] = next;
    }
    growth = std::sqrt(after / before);
    for (double& value : v) value /= std::sqrt(after);
  }
  EXPECT_GT(bound, growth * (1 - 1e-9));
  EXPECT_LT(bound, 1.6 * growth) << "and not far from the truth";
}

TEST_P(TiesIn, RestoredStateGoesOnBitForBitWithAnyNumberOfThreads) {
  int const D = GetParam();
  std::vector<double> first;
  for (int const threads : piola::testing::thread_counts) {
    piola::testing::Threads const shared(threads);
    Held whole(Stack(D), brittle()), resumed(Stack(D), brittle());
    auto const move = [&](std::vector<Vec<3>>& x) {
      for (std::size_t k = 0; k < x.size(); ++k)
        if (whole.hosts.ids()[k] >= whole.stack.set.bodies[1].first) x[k][D - 1] += 0.01 * (1 + 0.3 * x[k][0]);
    };
    for (int k = 0; k < 12; ++k) {
      whole.energy(whole.x);
      move(whole.x);
    }
    ASSERT_GT(whole.ties.totals().heat, 0);
    ASSERT_LT(whole.ties.totals().failed, 1);
    resumed.ties.restore(whole.ties.state());
    std::vector<double> numbers;
    for (int k = 0; k < 12; ++k) {
      whole.energy(whole.x);
      resumed.energy(whole.x);
      EXPECT_EQ(whole.ties.state(), resumed.ties.state());
      EXPECT_EQ(whole.ties.totals().heat, resumed.ties.totals().heat);
      for (Vec<3> const& f : whole.ties.forces()) numbers.insert(numbers.end(), f.c, f.c + 3);
      move(whole.x);
    }
    EXPECT_GT(whole.ties.totals().failed, 0);
    if (first.empty()) first = numbers;
    EXPECT_EQ(numbers, first) << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, TiesIn, ::testing::Values(2, 3));

}  // namespace
}  // namespace piola::contact
