// SPDX-License-Identifier: Apache-2.0
// Cells that fail under the nodal formulation.
#include "piola/formulations/nodal/crack_lines.hpp"
#include "piola/formulations/nodal/fragment_contact.hpp"
#include "piola/formulations/nodal/refits.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include "support/key_words.hpp"

namespace piola::testing {
namespace {

using test::expect_words;

void set(MaterialParameters& m, std::string_view name, double value) {
  auto const& parameters = law_of(m).parameters;
  auto const at = std::find_if(parameters.begin(), parameters.end(), [&](auto const& p) { return p.name == name; });
  ASSERT_NE(at, parameters.end()) << name;
  m.value[at - parameters.begin()] = value;
}

constexpr double length = 0.1, width = 0.02, speed = 0.05, strength = 3e6, toughness = 50;

MaterialParameters stone(double of_strength = strength) {
  MaterialParameters m = material("elastic", 2450, 32e9, 0);
  set(m, "spall_pressure", unbounded);
  set(m, "tensile_strength", of_strength);
  set(m, "fracture_energy", toughness);
  return m;
}

/// A bar of brittle stone along x, weaker by a tenth in two rows of its middle, that is pulled apart.
Assembly pulled_bar(int dimension, double jitter = 0) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.max = {length, width, dimension > 2 ? width : 0};
  shape.particles = {21, 5, 5};
  shape.jitter = jitter;
  ParticleSet set;
  fill(shape, "bar", set);
  Assembly a = nodal_body(std::move(set), stone());
  give_velocity(a, [](Point const& X) { return Point{speed * (2 * X[0] / length - 1), 0, 0}; });
  support(a, {true, false, false}, [](Point const& X) { return X[0] < 0.003; }).velocity =
      formulas({"-0.05", "0", "0"});
  support(a, {true, false, false}, [](Point const& X) { return X[0] > length - 0.003; }).velocity =
      formulas({"0.05", "0", "0"});
  std::vector<int>& part = a.particles.part.own();
  for (auto const& X : a.particles.X.seen()) part.push_back(X[0] > 0.0476 && X[0] < 0.0574 ? 1 : 0);
  a.parts = {{stone(0.9 * strength)}};
  return a;
}

/// Advances to `end` [s] from `time` [s].
void advance_to(Formulation& f, double time, double end) {
  while (time < end) {
    double const dt = std::min(f.stable_time_step(), end - time);
    f.step(time, dt);
    time += dt;
  }
  EXPECT_FALSE(f.failure().has_value());
}

struct Bar {
  int dimension;
  double jitter;
};

/// Two rows of cells break, and softening takes the fracture energy per area of the section, with the energy balance of
/// steps that nothing breaks in.
TEST(NodalFailure, CrackTakesTheFractureEnergy) {
  for (Bar const bar : {Bar{2, 0}, Bar{2, 0.2}, Bar{3, 0}}) {
    auto const f = make_formulation(pulled_bar(bar.dimension, bar.jitter));
    double const section = bar.dimension == 2 ? width : width * width;
    double const before = f->diagnose().total_energy();
    advance_to(*f, 0, 500e-6);
    EXPECT_NEAR(column(*f, "failed_particles"), bar.dimension == 2 ? 10 : 50, bar.jitter > 0 ? 1 : 0);
    EXPECT_NEAR(column(*f, "crack_area"), section, bar.jitter > 0 ? 0.1 * section : 1e-9 * section);
    EXPECT_NEAR(column(*f, "fracture_energy"), toughness * section, 0.06 * toughness * section);
    Diagnostics const d = f->diagnose();
    EXPECT_NEAR(d.total_energy() - before, d.external_work, 3e-4 * d.external_work);
  }
}

TEST(NodalFailure, HasTheSameBitsOnThreadsAndFromCheckpoints) {
  Assembly const a = pulled_bar(2, 0.2);
  auto const run = [&](std::vector<double> const& stops) { return state_after(a, stops, 0); };
  auto const alone = [&] {
    Threads const one(1);
    return run({400e-6});
  }();
  Threads const three(3);
  EXPECT_EQ(run({400e-6}), alone);
  EXPECT_EQ(run({300e-6, 330e-6, 400e-6}), alone);
}

/// Whatever has failed around, gradients of intact cells are exact for linear fields, and depend on the conditions
/// alone, not on the order in which cells have failed.
TEST(NodalFailure, GradientsFollowTheConditionsOfCells) {
  for (int const dimension : {2, 3}) {
    auto const D = static_cast<std::size_t>(dimension);
    Assembly const a = nodal_body(brick(dimension, 0.2, {9, 8, 7}), stone());
    SetUpBody at_once(a, 0.3, true), one_by_one(a, 0.3, true);
    nodal::Refits::Change const broken[]{{static_cast<Index>(D == 2 ? 30 : 230), nodal::CellCondition::broken},
                                         {static_cast<Index>(D == 2 ? 31 : 231), nodal::CellCondition::broken},
                                         {static_cast<Index>(D == 2 ? 40 : 240), nodal::CellCondition::detached}};
    std::vector<double> const before = at_once.reference.gradient;
    auto const found = at_once.reference.refits->set({broken[0], broken[1], broken[2]});
    for (std::size_t const k : {2u, 0u, 1u}) one_by_one.reference.refits->set({broken[k]});
    nodal::Reference const& r = at_once.reference;
    EXPECT_FALSE(found.changed.empty());
    EXPECT_NE(r.gradient, before);
    EXPECT_EQ(r.gradient, one_by_one.reference.gradient);
    EXPECT_EQ(r.reaction, one_by_one.reference.reaction);
    EXPECT_EQ(r.weight, one_by_one.reference.weight);
    EXPECT_EQ(r.back_weight, one_by_one.reference.back_weight);
    for (Index const slot : found.changed) {
      if (slot == broken[2].slot) continue;  // detached
      double sum[3][3]{};
      for (auto k = static_cast<std::size_t>(r.begin[slot]); k < static_cast<std::size_t>(r.begin[slot + 1]); ++k)
        for (std::size_t c = 0; c < D; ++c)
          for (std::size_t J = 0; J < D; ++J)
            sum[c][J] += (at_once.X(r.neighbour[k])[c] - at_once.X(slot)[c]) * r.gradient[k * D + J];
      for (std::size_t c = 0; c < D; ++c)
        for (std::size_t J = 0; J < D; ++J) ASSERT_NEAR(sum[c][J], c == J ? 1 : 0, 1e-9) << dimension << ' ' << slot;
    }
  }
}

/// On a line of particles a cell that opens or has broken hides what is behind it, except from nearest neighbours.
TEST(NodalFailure, BrokenCellsHideWhatIsBehindThem) {
  nodal::Points const X{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  nodal::CrackLines lines(X);
  auto const hides = [&](std::size_t a, std::size_t b) { return nodal::CrackLines::View(lines, a).hides(b); };
  EXPECT_FALSE(hides(0, 2));
  lines.set(1, nodal::CellCondition::opening);
  EXPECT_TRUE(hides(0, 2));
  lines.set(0, nodal::CellCondition::opening);
  EXPECT_FALSE(hides(0, 2)) << "opening cells see past each other";
  EXPECT_TRUE(hides(2, 0));
  lines.set(1, nodal::CellCondition::broken);
  EXPECT_TRUE(hides(0, 2));
  EXPECT_TRUE(hides(2, 0));
  EXPECT_FALSE(hides(0, 1));
  EXPECT_FALSE(hides(0, 3));
  lines.set(4, nodal::CellCondition::detached);
  EXPECT_TRUE(hides(0, 4));
}

/// Pieces that come near push each other apart by minus the derivative of an energy, and keep both momenta. Particles
/// that were near in the reference configuration do not.
TEST(NodalFailure, PiecesPushEachOtherApart) {
  for (int const dimension : {2, 3}) {
    Assembly const a = nodal_body(brick(dimension, 0, {9, 8, 7}), stone());
    nodal::Backend const& backend = *nodal::find_backend(a.backend.c_str());
    nodal::NodalBody body(a, a.particles, 0, nodal::read_options(a.formulations[0], a.materials, dimension, NAN),
                          backend);
    nodal::FragmentContact contact(body);
    Index const pair[]{0, body.particles() - 1}, near = 1;
    for (Index const slot : {pair[0], pair[1], near}) contact.add(slot);
    auto const& x = body.state().x;
    double const h = *std::min_element(body.body().spacing.begin(), body.body().spacing.begin() + dimension);
    contact.evaluate();
    EXPECT_EQ(contact.energy(), 0);
    auto const place = [&](double along) {
      for (int c = 0; c < dimension; ++c)
        value_at(x, pair[1], c) = value_at(x, pair[0], c) - (c == 0 ? along : 0.1) * h;
      contact.evaluate();
      return contact.energy();
    };
    double const further = place(0.501), nearer = place(0.499);
    EXPECT_GT(place(0.5), 0);
    EXPECT_GT(contact.frequency2(), 0);
    std::vector<double> before;
    for (Index const slot : pair)
      for (int c = 0; c < dimension; ++c) before.push_back(value_at(body.state().v, slot, c));
    contact.kick(1e-9);
    double impulse[2][3]{};
    for (int n = 0; n < 2; ++n)
      for (int c = 0; c < dimension; ++c)
        impulse[n][c] = body.mass(pair[n]) * (value_at(body.state().v, pair[n], c) - before[n * dimension + c]);
    for (int c = 0; c < dimension; ++c) EXPECT_NEAR(impulse[0][c], -impulse[1][c], 1e-12 * std::abs(impulse[0][c]));
    EXPECT_NEAR(impulse[1][0] / 1e-9, (further - nearer) / (0.002 * h), 1e-4 * std::abs(impulse[1][0]) / 1e-9);
    EXPECT_EQ(value_at(body.state().v, near, 0), 0);
    // What is near when it is added stores no energy, but pushes when it comes nearer, also from a checkpoint.
    nodal::FragmentContact late(body), loaded(body);
    for (nodal::FragmentContact* one : {&late, &loaded}) {
      one->add(pair[0]);
      one->add(pair[1]);
    }
    late.evaluate();
    EXPECT_EQ(late.energy(), 0);
    loaded.load(late.state());
    place(0.4);
    late.evaluate();
    loaded.evaluate();
    EXPECT_GT(late.energy(), 0);
    EXPECT_LT(late.energy(), contact.energy());
    EXPECT_EQ(loaded.energy(), late.energy());
  }
}

TEST(NodalFailure, RefusesNumbersThatDoNotBelongTogether) {
  auto const refused = [](auto const& change) {
    MaterialParameters m = stone();
    Assembly a = nodal_body(brick(2), m);
    change(a, m);
    a.materials.assign(1, m);
    return refusal(a);
  };
  expect_words(refused([](Assembly&, MaterialParameters& m) { set(m, "fracture_energy", 0); }),
               {"tensile_strength", "fracture_energy", "both"});
  expect_words(refused([](Assembly&, MaterialParameters& m) { set(m, "fracture_displacement", 1e-3); }),
               {"fracture_displacement", "damage"});
  expect_words(refused([](Assembly& a, MaterialParameters&) {
                 a.particles.part.own().assign(a.particles.X.size(), 0);
                 a.particles.part.own().front() = 1;
                 a.parts = {{rubber()}};
               }),
               {"fails", "hyperelastic", "tie"});
  expect_words(refused([](Assembly& a, MaterialParameters&) { choose(a, "fluctuation_viscosity", 0.05); }),
               {"fluctuation_viscosity", "tensile_strength"});
  expect_words(refused([](Assembly& a, MaterialParameters&) {
                 a.formulations[0] = {"adaptle", {}, {}};
               }),
               {"tensile_strength", "nodal"});
}

}  // namespace
}  // namespace piola::testing
