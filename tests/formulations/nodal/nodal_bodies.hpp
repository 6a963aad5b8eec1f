// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/materials/laws.hpp"
#include "piola/neighbours/particle_cells.hpp"
#include "formulations/small_bodies.hpp"

/// Small bodies under the nodal formulation.
namespace piola::testing {

inline Assembly nodal_body(ParticleSet set, MaterialParameters const& m = rubber()) {
  Assembly a = assemble(std::move(set), m);
  for (auto& f : a.formulations) f = {"nodal", {}, {}};
  return a;
}

/// A box with edges and particle counts that differ between axes.
inline ParticleSet brick(int dimension, double jitter = 0, std::array<int, 3> n = {4, 5, 6}, std::uint32_t seed = 1) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.min = {-0.2, 0.1, 0};
  shape.max = {0.7, 1.3, 1.1};
  shape.particles = n;
  shape.jitter = jitter;
  shape.seed = seed;
  for (auto c = static_cast<std::size_t>(dimension); c < 3; ++c) shape.min[c] = shape.max[c] = 0;
  ParticleSet set;
  fill(shape, "brick", set);
  return set;
}

/// The state after `steps` is the same for any number of threads, and for a run that goes on from its state at
/// `middle`. make(): a new simulation.
template <class Make>
void expect_same_bits(Make const& make, int middle, int steps) {
  SavedState reference;
  for (int const threads : {1, 3}) {
    Threads const used(threads);
    auto const whole = make(), first = make(), second = make();
    advance_by_itself(*whole.formulation, 0, steps);
    double const time = advance_by_itself(*first.formulation, 0, middle);
    auto state = saved(*first.formulation);
    second.formulation->load(state);
    advance_by_itself(*second.formulation, time, steps - middle);
    EXPECT_EQ(saved(*second.formulation).values, saved(*whole.formulation).values);
    if (threads == 1) reference = saved(*whole.formulation);
    EXPECT_EQ(saved(*whole.formulation).values, reference.values);
  }
}

/// Particle arrangement of a test: a lattice if jitter is 0, jittered otherwise.
struct Cloud {
  double jitter = 0;
  std::uint32_t seed = 1;
};
/// The lattice, and each jitter with the seeds 1 to `seeds`.
inline std::vector<Cloud> clouds(std::vector<double> const& jitters = {0.4}, std::uint32_t seeds = 10) {
  std::vector<Cloud> all{{}};
  for (double const jitter : jitters)
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) all.push_back({jitter, seed});
  return all;
}

/// Reference data of the first body of an assembly, with the particles and the slot order that they refer to.
struct SetUpBody {
  /// failure: cells may fail.
  explicit SetUpBody(Assembly const& a, double least_mass = 0.3, bool failure = false)
      : set(a.particles), order(nodal::slot_order(set, set.bodies[0])), densities(densities_of(a)) {
    nodal::make_reference({set, set.bodies[0], order, a.loads, a.supports, densities, least_mass,
                           *nodal::find_backend(a.backend.c_str()), nullptr, std::nullopt, false, failure},
                          reference);
  }
  static Values densities_of(Assembly const& a) {
    Values densities;
    for (MaterialParameters const& m : materials_of(a, 0)) densities.push_back(m.value[0]);
    return densities;
  }
  ParticleSet set;
  SlotOrder order;
  Values densities;
  nodal::Reference reference;
  Point X(Index slot) const { return set.X[static_cast<std::size_t>(order.id[static_cast<std::size_t>(slot)])]; }
};

/// Forces on the particles of the initial state, by id [N]: mass times acceleration.
inline std::vector<Point> forces(Assembly const& a) {
  auto const D = static_cast<std::size_t>(a.particles.dimension);
  SetUpBody const body(a);
  auto const state = saved(*make_formulation(a)).values.at("body0_acceleration");
  std::vector<Point> force(a.particles.X.size());
  for (Index i = 0; i < body.order.particles; ++i) {
    auto const id = static_cast<std::size_t>(body.order.id[static_cast<std::size_t>(i)]);
    for (std::size_t c = 0; c < D; ++c)
      force[id][c] = body.reference.mass[static_cast<std::size_t>(i)] * state[id * D + c];
  }
  return force;
}

/// Adds a load that asks for lists and does nothing.
inline void take_lists(Assembly& a) {
  Load load;
  load.value = {Expression("0"), Expression("0"), Expression("0")};
  load.pressure = load.follows = true;
  load.normal = Point{1, 0, 0};
  a.loads.push_back(load);
}

inline double largest(std::vector<Point> const& points) {
  double most = 0;
  for (auto const& p : points)
    for (double const c : p) most = std::isfinite(c) ? std::max(most, std::fabs(c)) : c;
  return most;
}

/// The last value of a column that the formulation adds to history.csv.
inline double column(Formulation const& f, std::string_view wanted) {
  for (auto const& [name, value] : f.diagnose().more)
    if (name == wanted) return value;
  ADD_FAILURE() << "no column is named " << wanted;
  return 0;
}

/// State after steps to the last of `stops` [s], resumed by a new run from a checkpoint at each earlier one. Expects
/// that more than `least` cells have failed.
inline auto state_after(Assembly const& a, std::vector<double> const& stops, double least) {
  auto f = make_formulation(a);
  double time = 0;
  for (double const stop : stops) {
    SavedState kept = saved(*f);
    f = make_formulation(a);
    f->load(kept);
    while (time < stop) {
      double const dt = f->stable_time_step();
      f->step(time, dt);
      time += dt;
    }
  }
  EXPECT_GT(column(*f, "failed_particles"), least);
  return saved(*f).values;
}

}  // namespace piola::testing
