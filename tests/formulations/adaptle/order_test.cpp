// SPDX-License-Identifier: Apache-2.0
// Particles of AdapTLE stand anywhere: checkpoints, supports, loads and pushes go by id.
#include "piola/particles/ordering.hpp"
#include "formulations/adaptle/clouds.hpp"

namespace piola::testing {
namespace {

/// A bar that is pulled, pushed and held, and flies into another one.
Assembly two_bars() {
  ParticleSet set;
  for (double const start : {0.0, 2.4}) {
    ShapeSpec shape;
    shape.min[0] = start;
    shape.max = {start + 2.3, 0.4, 0.4};
    shape.particles = {24, 5, 5};
    fill(shape, "bar", set);
  }
  Assembly a = adaptle_assembly(std::move(set), sample_metal("perfectly_plastic", "elastic"));
  give_velocity(a, [](Point const& X) { return Point{X[0] > 2.35 ? -200.0 : 50 * X[1], 0, 0}; });
  support(a, {true, true, false}, [](Point const& X) { return X[0] < 0.1; });
  load(a, {"1e6*(1 + Y)", "-2e5", "0"}, [](Point const& X) { return X[2] > 0.25; }).name = "wind";
  return a;
}

/// As long as it lives, bodies that are made are dealt out.
class SlotPermutation {
 public:
  explicit SlotPermutation(int owners, std::int64_t* moved = nullptr) : before_(set_shuffle({owners, 5, moved})) {}
  SlotPermutation(SlotPermutation const&) = delete;
  SlotPermutation& operator=(SlotPermutation const&) = delete;
  ~SlotPermutation() { set_shuffle(before_); }

 private:
  Shuffle before_;
};

std::unique_ptr<Formulation> made(Assembly const& a, int owners) {
  std::int64_t moved = 0;
  SlotPermutation const dealt(owners, &moved);
  auto f = make_formulation(a);
  EXPECT_EQ(moved > 0, owners > 0);
  return f;
}

TEST(OrderOfAdaptle, ACheckpointOfOneOwnerGoesOnWithSeveral) {
  Assembly const a = two_bars();
  auto const whole = made(a, 0);
  double const half = take_steps(*whole, 0, 10);
  auto const dealt = made(a, 3);
  EXPECT_EQ(take_steps(*dealt, 0, 10), half);
  SavedState state = saved(*dealt);
  EXPECT_EQ(state.values, saved(*whole).values);
  double const end = take_steps(*whole, half, 10);
  for (int const owners : {0, 5}) {
    auto const resumed = made(a, owners);
    resumed->load(state);
    EXPECT_EQ(take_steps(*resumed, half, 10), end);
    EXPECT_EQ(saved(*resumed).values, saved(*whole).values) << owners;
  }
}

TEST(OrderOfAdaptle, PushesGoToTheParticlesThatAreMeant) {
  Assembly const a = two_bars();
  std::vector<std::int64_t> const ids{0, 70, 140, 599, 600, 800};
  std::vector<double> mass[2];
  std::vector<Point> x[2], v[2];
  for (int const k : {0, 1}) {
    auto const f = made(a, 4 * k);
    std::vector<Point> change;
    for (auto const id : ids) change.push_back({1.0 * static_cast<double>(id), 2, 3});
    f->add_velocities(ids, change);
    mass[k].resize(ids.size());
    x[k].resize(ids.size());
    v[k].resize(ids.size());
    f->read_masses(ids, mass[k]);
    f->read_motion(ids, x[k], v[k]);
  }
  EXPECT_EQ(mass[0], mass[1]);
  EXPECT_EQ(x[0], x[1]);
  EXPECT_EQ(v[0], v[1]);
  EXPECT_EQ(x[1][1], Point(a.particles.X[70]));
  EXPECT_EQ(v[1][5][0], 800 - 200);
}

TEST(OrderOfAdaptle, TheFirstFailureIsThatOfTheLowestId) {
  Assembly a = two_bars();
  for (std::size_t const id : {std::size_t{130}, std::size_t{300}, std::size_t{700}}) a.initial_velocity[id][1] = 1e40;
  std::optional<Failure> first;  // of a neighbour of 130, which sees it before the first step
  for (int const owners : {0, 2, 7}) {
    auto const f = made(a, owners);
    f->step(0, 1e-9);
    auto const failure = f->failure();
    ASSERT_TRUE(failure) << owners;
    if (!first) first = failure;
    EXPECT_EQ(failure->particle, first->particle) << owners;
    EXPECT_LE(failure->particle, 130) << owners;
    EXPECT_EQ(failure->what, first->what) << owners;
    EXPECT_EQ(failure->X, Point(a.particles.X[static_cast<std::size_t>(failure->particle)])) << owners;
  }
}

}  // namespace
}  // namespace piola::testing
