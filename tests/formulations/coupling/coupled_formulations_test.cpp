// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/coupled_formulations.hpp"
#include "piola/setup/contact_surface.hpp"
#include "formulations/small_bodies.hpp"
#include "materials/solid_samples.hpp"
#include <numeric>

namespace piola {
namespace {

using namespace testing;

constexpr double apart = 20;  // metres between bodies: nothing acts between them

/// Tumbling unit boxes in a row, far from each other, of the given formulations.
Assembly row_of_boxes(std::vector<std::string> const& formulations, int n = 5, int dimension = 3) {
  Assembly a;
  for (std::size_t b = 0; b < formulations.size(); ++b) {
    ShapeSpec shape;
    shape.dimension = dimension;
    for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
      shape.max[c] = 1;
      shape.particles[c] = n + static_cast<int>(b);
    }
    shape.min[0] = apart * static_cast<double>(b);
    shape.max[0] = shape.min[0] + 1;
    fill(shape, "box " + std::to_string(b), a.particles);
    bool const solid = formulations[b] == "adaptle";
    a.materials.push_back(solid ? sample_metal("elastic", "elastic") : rubber());
    a.formulations.push_back({formulations[b], {}, {}});
  }
  give_velocity(a, [](Point const& X) { return Point{-9 * X[1] + 3 * X[0], 8 * X[0], 0}; });
  return a;
}

/// The box `b` of the row alone, made from scratch.
Assembly box_alone(Assembly const& row, std::size_t b) {
  Assembly a;
  Body body = row.particles.bodies[b];
  auto const take = [&](auto const& from, auto& to) { to = {from.begin() + body.first, from.begin() + body.last}; };
  a.particles.dimension = row.particles.dimension;
  take(row.particles.X, a.particles.X);
  take(row.particles.lattice_index, a.particles.lattice_index);
  take(row.particles.volume, a.particles.volume);
  take(row.particles.kernel_volume, a.particles.kernel_volume);
  take(row.initial_velocity, a.initial_velocity);
  a.particles.body.assign(a.particles.X.size(), 0);
  body.last -= body.first;
  body.first = 0;
  a.particles.bodies = {body};
  a.materials = {row.materials[b]};
  a.formulations = {row.formulations[b]};
  return a;
}

Values part_of(Values const& whole, Body const& body, std::int64_t components) {
  return {whole.begin() + body.first * components, whole.begin() + body.last * components};
}

std::size_t count(Assembly const& a) { return static_cast<std::size_t>(a.particles.size()); }

TEST(CoupledFormulations, MovesEachBodyAsIfItWereAloneBitForBit) {
  Assembly const row = row_of_boxes({"nodal", "jst_sph", "adaptle", "nodal"});
  auto const together = make_formulation(row);
  double const dt = 0.5 * together->stable_time_step();
  advance(*together, dt, 12);
  Values const x = sample(*together, "Position", count(row)), v = sample(*together, "Velocity", count(row));
  for (std::size_t b : {1U, 2U}) {
    Assembly const own = box_alone(row, b);
    auto const alone = make_formulation(own);
    advance(*alone, dt, 12);
    EXPECT_EQ(part_of(x, row.particles.bodies[b], 3), sample(*alone, "Position", count(own))) << b;
    EXPECT_EQ(part_of(v, row.particles.bodies[b], 3), sample(*alone, "Velocity", count(own))) << b;
  }
  // Two bodies of one formulation move as they do in a run of that formulation.
  Assembly const first = box_alone(row, 0);
  auto const alone = make_formulation(first);
  advance(*alone, dt, 12);
  EXPECT_LT(largest_difference(part_of(v, row.particles.bodies[0], 3), sample(*alone, "Velocity", count(first))),
            1e-9 * largest(v));
}

TEST(CoupledFormulations, TakesTheShortestStep) {
  Assembly const row = row_of_boxes({"nodal", "adaptle"});
  auto const together = make_formulation(row);
  double least = 1e300, settled = 1e300;
  for (std::size_t b : {0U, 1U}) {
    auto const alone = make_formulation(box_alone(row, b));
    least = std::min(least, alone->stable_time_step());
    settled = std::min(settled, alone->step_estimate().stable);
  }
  EXPECT_EQ(together->stable_time_step(), least);
  EXPECT_EQ(together->step_estimate().stable, settled);
  EXPECT_EQ(together->step_estimate().settled, settled);
  EXPECT_NE(together->step_estimate().limit.find("(adaptle)"), std::string::npos) << together->step_estimate().limit;
}

TEST(CoupledFormulations, AddsUpWhatItsPartsHave) {
  Assembly row = row_of_boxes({"jst_sph", "adaptle", "nodal"});
  auto const together = make_formulation(row);
  double const dt = 0.5 * together->stable_time_step();
  advance(*together, dt, 5);
  Diagnostics const d = together->diagnose();
  Diagnostics sum;
  std::size_t bytes = 0;
  ASSERT_EQ(d.bodies.size(), 3U);
  for (std::size_t b = 0; b < 3; ++b) {
    auto const alone = make_formulation(box_alone(row, b));
    advance(*alone, dt, 5);
    Diagnostics const own = alone->diagnose();
    sum.kinetic_energy += own.kinetic_energy;
    sum.strain_energy += own.strain_energy;
    for (std::size_t c = 0; c < 3; ++c) sum.linear_momentum[c] += own.linear_momentum[c];
    for (std::size_t c = 0; c < 3; ++c) sum.angular_momentum[c] += own.angular_momentum[c];
    EXPECT_EQ(d.bodies[b].name, "box " + std::to_string(b));
    EXPECT_NEAR(d.bodies[b].kinetic_energy, own.kinetic_energy, 1e-12 * own.kinetic_energy);
    EXPECT_LE(d.jacobian_min, own.jacobian_min);
    EXPECT_GE(d.jacobian_max, own.jacobian_max);
    EXPECT_GE(d.pressure_max, own.pressure_max);
    bytes += alone->statistics().memory_bytes;
  }
  EXPECT_NEAR(d.kinetic_energy, sum.kinetic_energy, 1e-12 * sum.kinetic_energy);
  EXPECT_NEAR(d.strain_energy, sum.strain_energy, 1e-12 * sum.strain_energy);
  EXPECT_NEAR(together->kinetic_energy(), d.kinetic_energy, 1e-12 * d.kinetic_energy);
  for (std::size_t c = 0; c < 3; ++c) {
    double const scale = std::hypot(sum.angular_momentum[0], sum.angular_momentum[1], sum.angular_momentum[2]);
    EXPECT_NEAR(d.angular_momentum[c], sum.angular_momentum[c], 1e-12 * scale);
    EXPECT_NEAR(d.linear_momentum[c], sum.linear_momentum[c], 1e-12 * scale);
  }
  EXPECT_EQ(together->statistics().memory_bytes, bytes);
  auto const named = [&](std::string_view name) {
    return std::count_if(d.more.begin(), d.more.end(), [&](auto const& column) { return column.first == name; });
  };
  EXPECT_EQ(named("plastic_work"), 1) << "of nodal and adaptle";
  EXPECT_EQ(named("cell_jacobian_min"), 1) << "of nodal";
}

TEST(CoupledFormulations, ShowsZeroWhereAFormulationHasNoSuchField) {
  Assembly const row = row_of_boxes({"nodal", "adaptle"});
  auto const f = make_formulation(row);
  Values const T = sample(*f, "Temperature", count(row));
  EXPECT_EQ(largest(part_of(T, row.particles.bodies[0], 1)), 0);
  EXPECT_GT(largest(part_of(T, row.particles.bodies[1], 1)), 200);
  auto const has = [&](std::size_t body, std::string_view name) {
    auto const fields = f->observables().fields_of(body);
    return std::any_of(fields.begin(), fields.end(), [&](FieldInfo const& info) { return info.name == name; });
  };
  EXPECT_FALSE(has(0, "Temperature"));
  EXPECT_TRUE(has(1, "Temperature"));
  EXPECT_TRUE(has(0, "CellPressure"));
  EXPECT_TRUE(f->observables().fields_of(7).empty());
}

/// Everything that has a name acts: supports, loads and a mirror on different bodies, in an order of their own.
Assembly busy_row() {
  Assembly a = row_of_boxes({"jst_sph", "nodal", "jst_sph"}, 4);
  auto const low = [](double from) {
    return [from](Point const& X) { return X[0] >= from - 1e-9 && X[0] < from + 1e-9; };
  };
  support(a, {true, true, true}, low(apart)).name = "of nodal";
  support(a, {true, true, true}, low(0)).name = "of jst_sph";
  load(a, {"30", "0", "0"}, [](Point const& X) { return X[0] > 2 * apart - 1; }).name = "push";
  load(a, {"0", "1", "0"}, everywhere);
  load(a, {"-70", "0", "0"}, [](Point const& X) { return X[0] > apart - 1 && X[0] < apart + 2; }).name = "pull";
  return a;
}

TEST(CoupledFormulations, TellsActionsInTheOrderOfTheCase) {
  Assembly const row = busy_row();
  auto const f = make_formulation(row);
  f->step(0, 0.5 * f->stable_time_step());
  auto const actions = f->diagnose().actions;
  ASSERT_EQ(actions.size(), 4U);
  EXPECT_EQ(actions[0].name, "of nodal");
  EXPECT_EQ(actions[1].name, "of jst_sph");
  EXPECT_EQ(actions[2].name, "push");
  EXPECT_EQ(actions[3].name, "pull");
  constexpr double mass = 1100;  // kg of a unit box of rubber
  EXPECT_NEAR(actions[2].force[0], 30 * mass, 1e-6 * mass);
  EXPECT_NEAR(actions[3].force[0], -70 * mass, 1e-6 * mass) << "on the particles of the support, too";
}

TEST(CoupledFormulations, ResumesBitForBit) {
  Assembly const row = busy_row();
  auto const whole = make_formulation(row);
  double const dt = 0.5 * whole->stable_time_step();
  advance(*whole, dt, 6);
  SavedState state = saved(*whole);
  auto const resumed = make_formulation(row);
  resumed->load(state);
  for (int k = 6; k < 12; ++k) {
    whole->step(k * dt, dt);
    resumed->step(k * dt, dt);
  }
  EXPECT_EQ(sample(*whole, "Velocity", count(row)), sample(*resumed, "Velocity", count(row)));
  EXPECT_EQ(saved(*whole).values, saved(*resumed).values);
}

TEST(CoupledFormulations, HasTheSameBitsWithAnyNumberOfThreads) {
  Assembly const row = row_of_boxes({"nodal", "jst_sph"}, 8);
  Values first;
  for (int const threads : thread_counts) {
    Threads const shared(threads);
    auto const f = make_formulation(row);
    advance(*f, 0.5 * f->stable_time_step(), 5);
    Values const v = sample(*f, "Velocity", count(row));
    if (first.empty()) first = v;
    EXPECT_EQ(v, first) << threads << " threads";
  }
}

TEST(CoupledFormulations, NamesTheFailedParticleByItsIdInTheWhole) {
  Assembly row = row_of_boxes({"nodal", "jst_sph"});
  Body const& second = row.particles.bodies[1];
  auto const broken = static_cast<std::size_t>(second.first) + 7;
  row.initial_velocity[broken] = {1e7, 1e7, -1e7};
  auto const f = make_formulation(row);
  double const dt = f->stable_time_step();
  for (int k = 0; k < 20 && !f->failure(); ++k) f->step(k * dt, dt);
  auto const failure = f->failure();
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->body, "box 1");
  EXPECT_GE(failure->particle, second.first);
  EXPECT_LT(failure->particle, second.last);
  EXPECT_EQ(failure->X, row.particles.X[static_cast<std::size_t>(failure->particle)]);
}

// The energy guard checks `centred_energy`, which must not rise, if one of the formulations has this column.
TEST(CoupledFormulations, CountsTheEnergyOfContactInTheCentredSum) {
  Assembly row = row_of_boxes({"taylor_sph", "nodal"});
  row.materials[0] = rubber("linear_elastic");
  give_velocity(row, [](Point const&) { return Point{}; });
  ShapeSpec shape;
  shape.min[0] = apart;
  shape.max = {apart + 1, 1, 1};
  shape.particles = {6, 6, 6};
  row.surfaces = {{}, contact_surface(shape, row.particles, row.particles.bodies[1])};
  row.surfaces[1].modulus = 2e7;
  RigidShape wall;
  wall.axis = {1, 0, 0};
  wall.centre = {apart + 0.05, 0, 0};
  row.rigid_shapes.push_back(wall);
  Diagnostics const d = make_formulation(row)->diagnose();
  auto const column = [&](std::string_view name) {
    return std::find_if(d.more.begin(), d.more.end(), [&](auto const& c) { return c.first == name; })->second;
  };
  ASSERT_GT(column("contact_energy"), 0);
  EXPECT_NEAR(column("centred_energy"), d.total_energy(), 1e-12 * d.total_energy());
}

TEST(CoupledFormulations, DampsAllOfIt) {
  Assembly const row = row_of_boxes({"nodal", "jst_sph", "adaptle"});
  auto const f = make_formulation(row);
  double const before = f->kinetic_energy();
  f->damp(0.5);
  EXPECT_NEAR(f->kinetic_energy(), 0.25 * before, 1e-12 * before);
  EXPECT_NEAR(f->diagnose().damping_loss, 0.75 * before, 1e-12 * before);
}

TEST(CoupledFormulations, RefusesWhatNoneOfItsFormulationsKnows) {
  Assembly row = row_of_boxes({"nodal", "jst_sph"});
  row.rigid_shapes.resize(1);
  EXPECT_NE(refusal(row).find("knows no rigid shapes"), std::string::npos) << refusal(row);
  Assembly other = row_of_boxes({"nodal", "alchemy"});
  EXPECT_NE(refusal(other).find("alchemy"), std::string::npos) << refusal(other);
}

// Columns of the same name in two formulations are added, which is correct for additive quantities only.
/// Columns of one name are added up.
TEST(CoupledFormulations, FormulationsShareOnlyColumnsOfEnergyAndCounts) {
  auto const all = formulations();
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b)
      for (DiagnosticInfo const& one : all[a].diagnostics)
        for (DiagnosticInfo const& other : all[b].diagnostics) {
          if (one.name != other.name || one.name == "failed_particles" || one.name == "eulerian_particles") continue;
          EXPECT_EQ(one.unit, "J") << one.name;
          EXPECT_EQ(other.unit, "J") << other.name;
        }
}

TEST(FormulationGroup, TranslatesIdsBothWays) {
  Assembly const row = row_of_boxes({"nodal", "jst_sph", "nodal"}, 3);
  auto const parts = split_by_formulation(row);
  ASSERT_EQ(parts.size(), 2U);
  std::vector<std::int64_t> seen;
  for (FormulationGroup const& part : parts)
    for (std::int64_t id = 0; id < part.assembly.particles.size(); ++id) {
      std::int64_t const there = part.id_in_whole(id);
      seen.push_back(there);
      EXPECT_EQ(part.id_in_part(there), id);
      EXPECT_EQ(part.assembly.particles.X[static_cast<std::size_t>(id)],
                row.particles.X[static_cast<std::size_t>(there)]);
    }
  std::sort(seen.begin(), seen.end());
  std::vector<std::int64_t> all(static_cast<std::size_t>(row.particles.size()));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(seen, all);
  EXPECT_FALSE(parts[1].id_in_part(0).has_value()) << "a particle of nodal";
  EXPECT_EQ(parts[0].body_in_part(2), 1U);
  EXPECT_FALSE(parts[0].body_in_part(1).has_value());
}

}  // namespace
}  // namespace piola
