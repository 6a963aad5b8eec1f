// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/local_fits.hpp"
#include "exec/thread_count.hpp"
#include "formulations/nodal/nodal_bodies.hpp"

namespace piola::testing {
namespace {

/// A box on a lattice, its longest edge along each direction in turn, spacings that differ, bent.
Assembly bent_lattice(int dimension, int longest) {
  std::array<int, 3> n{4, 5, 7};
  std::rotate(n.begin(), n.begin() + (2 - longest + 3) % 3, n.end());
  for (auto c = static_cast<std::size_t>(dimension); c < 3; ++c) n[c] = 1;
  Assembly a = nodal_body(brick(dimension, 0, n));
  displace(a, [&](Point const& X) {
    Point u{0.04 * X[0] + 0.05 * X[0] * X[0], 0, 0};
    if (dimension > 1) u = {0.1 * X[1] + 0.1 * X[0] * X[1], -0.06 * X[0] + 0.1 * X[0] * X[0] * X[1], 0};
    if (dimension > 2) u[2] = 0.05 * X[0] * X[2] - 0.04 * X[1];
    return u;
  });
  give_velocity(a, [](Point const& X) { return Point{X[1], -2 * X[0] * X[2], X[0]}; });
  return a;
}

/// The assembly without its lattice: neighbours come from lists, cells from sampling.
Assembly as_cloud(Assembly a) {
  a.particles.bodies[0].regular = false;
  return a;
}

constexpr double of_rounding = 1e-11;

TEST(NodalLattice, HasTheForcesOfListsOnEveryMachineAndInEveryOrientation) {
  for (int D = 1; D <= 3; ++D)
    for (int longest = 0; longest < D; ++longest)
      for (auto const& backend : backends()) {
        Assembly a = bent_lattice(D, longest);
        a.backend = backend;
        EXPECT_FALSE(SetUpBody(a).reference.lattice.empty());
        EXPECT_TRUE(SetUpBody(as_cloud(a)).reference.lattice.empty());
        auto const lattice = forces(a), lists = forces(as_cloud(a));
        double const scale = largest(lists);
        EXPECT_GT(scale, 0);
        for (std::size_t id = 0; id < lists.size(); ++id)
          for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(lattice[id][c], lists[id][c], of_rounding * scale) << D << longest << backend << id;
      }
}

TEST(NodalLattice, MovesAsWithLists) {
  for (int D = 1; D <= 3; ++D) {
    Assembly a = bent_lattice(D, D - 1);
    a.cfl = 0.3;
    Assembly with_lists = a;
    take_lists(with_lists);
    auto const lattice = make_formulation(a), lists = make_formulation(with_lists);
    advance(*lattice, 1e-4, 50);
    advance(*lists, 1e-4, 50);
    auto const n = a.particles.X.size();
    EXPECT_LT(largest_difference(sample(*lattice, "Position", n), sample(*lists, "Position", n)), of_rounding) << D;
    EXPECT_NEAR(lattice->diagnose().strain_energy, lists->diagnose().strain_energy,
                1e-9 * lists->diagnose().strain_energy);
  }
}

TEST(NodalLattice, IsTheSameForAnyNumberOfThreads) {
  Assembly const a = [] {
    Assembly big = nodal_body(unit_box(2, 70));  // enough particles for three threads
    give_velocity(big, [](Point const& X) { return Point{5 * X[1], -4 * X[0] * X[0], 0}; });
    return big;
  }();
  SavedState reference;
  for (int const threads : {1, 2, 3}) {
    Threads const used(threads);
    auto const f = make_formulation(a);  // set-up, too
    for (int k = 0; k < 3; ++k) f->step(k * 1e-5, 1e-5);
    if (threads == 1) reference = saved(*f);
    EXPECT_EQ(saved(*f).values, reference.values) << threads;
  }
}

TEST(NodalLattice, IsOneOnlyWithoutGaps) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.radius = 0.5;
  shape.spacing = 0.2;
  ParticleSet set;
  fill(shape, "ball", set);
  Body const& ball = set.bodies[0];
  EXPECT_FALSE(nodal::lattice_shape(set, ball, nodal::slot_order(set, ball)));
  ParticleSet const box = brick(3);
  auto const order = nodal::slot_order(box, box.bodies[0]);
  auto const found = nodal::lattice_shape(box, box.bodies[0], order);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->count, (std::array{5, 4, 6}));
  EXPECT_EQ(found->axis, (std::array<std::size_t, 3>{1, 0, 2}));
}

TEST(NodalLattice, KnowsItsPairsWithoutASearch) {
  Assembly const a = bent_lattice(3, 1);
  auto const order = nodal::slot_order(a.particles, a.particles.bodies[0]);
  auto const shape = nodal::lattice_shape(a.particles, a.particles.bodies[0], order);
  ASSERT_TRUE(shape);
  nodal::Points X;
  for (Index i = 0; i < order.particles; ++i) {
    X.push_back(a.particles.X[static_cast<std::size_t>(order.id[static_cast<std::size_t>(i)])]);
    for (std::size_t c = 0; c < 3; ++c) X.back()[c] /= a.particles.bodies[0].spacing[c];
  }
  nodal::IndexSet const all(order.particles);
  for (double const reach : {2.4, 3.0}) {
    auto const known = nodal::lattice_pairs(*shape, reach, all),
               found = nodal::find_pairs(X, std::vector<double>(X.size(), reach), all);
    EXPECT_EQ(known.begin, found.begin);
    EXPECT_EQ(known.neighbour, found.neighbour);
  }
}

TEST(NodalSetUp, IsTheSameForAnyNumberOfThreads) {
  for (bool const cloud : {false, true}) {
    Assembly a = nodal_body(brick(3, 0, {7, 8, 9}));
    if (cloud) a = as_cloud(a);
    auto const reference = [&](int threads) {
      Threads const used(threads);
      return SetUpBody(a).reference;
    };
    auto const one = reference(1);
    for (int const threads : thread_counts) {
      auto const other = reference(threads);
      EXPECT_EQ(one.mass, other.mass);
      EXPECT_EQ(one.gradient, other.gradient);
      EXPECT_EQ(one.reaction, other.reaction);
      EXPECT_EQ(one.lattice.motion, other.lattice.motion);
      EXPECT_EQ(one.lattice.force, other.lattice.force);
      EXPECT_EQ(one.own, other.own);
      EXPECT_EQ(one.weight, other.weight);
      EXPECT_EQ(one.neighbour, other.neighbour);
    }
  }
}

/// Slots of a lattice that hold no particle hold no numbers; they must not count, on any machine.
TEST(NodalLattice, MeasuresTheChangesOfItsParticlesAlone) {
  constexpr Index slots = 192;
  Field change("ChangeSinceMeasurement", "1", 2, Role::derived);
  change.allocate_tiled(slots);
  for (Index i = 0; i < slots; ++i) change.at(i, 0) = i % 3 == 1 ? std::nan("") : 0.001 * i;
  Values partial(slots);
  nodal::BodyState body;
  body.slots = {0, slots};
  body.change = change.ref();
  body.partial = partial.data();
  for (auto names = nodal::backend_names(); *names != nullptr; ++names)
    EXPECT_EQ(nodal::find_backend(*names)->largest_change(body), 0.001 * (slots - 1)) << *names;
}

}  // namespace
}  // namespace piola::testing
