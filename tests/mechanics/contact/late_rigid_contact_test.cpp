// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/surface_contact.hpp"
#include "blocks.hpp"
#include <gtest/gtest.h>
#include <memory>

namespace piola::contact::testing {
namespace {

/// Two blocks over a sphere whose top is at `height` [m]; all particles of the lower block have lost their surface.
struct Scene {
  explicit Scene(int dimension, double height) : up(dimension == 3 ? 2 : 1), blocks(dimension, -1) {
    RigidSurface sphere;
    sphere.kind = RigidSurface::Kind::sphere;
    sphere.dimension = dimension;
    sphere.radius = 8;
    sphere.centre[0] = 2.2;
    if (dimension == 3) sphere.centre[1] = 1.7;
    sphere.centre[static_cast<int>(up)] = height - sphere.radius;
    sphere.inverse_mass = 1e-3;
    system = std::make_unique<SurfaceContactSystem>(blocks.system({sphere}));
    x = places(*system, blocks.set);
    std::vector<Index> at;
    for (std::size_t k = 0; k < x.size(); ++k) {
      bool const is_lower = system->ids()[k] < blocks.set.bodies[0].last;
      lost.push_back(is_lower ? 1 : 0);
      if (is_lower) at.push_back(static_cast<Index>(k));
    }
    system->set_masses(std::vector<double>(x.size(), 1000));
    system->late_rigids().set_particles(0, at, std::vector<double>(at.size(), 1));
    lose();
  }
  void lose() {
    system->drop(lost);
    system->late_rigids().add_targets(lost);
    system->late_rigids().set_masses(std::vector<double>(x.size(), 1000));
  }
  double energy_at_height(double height) {
    system->rigid(0).centre[static_cast<int>(up)] = height - system->rigid(0).radius;
    system->evaluate(x, 1e-3);
    return system->totals().energy;
  }

  std::size_t up;
  Blocks blocks;
  std::unique_ptr<SurfaceContactSystem> system;
  std::vector<Vec<3>> x;
  std::vector<char> lost;
};

class LateRigid : public ::testing::TestWithParam<int> {};

/// Particles inside a shape when they lose their surface store nothing; deeper ones push by how much deeper they are.
/// Force and reaction are the derivative of the energy, also from a checkpoint.
TEST_P(LateRigid, ParticlesPushFromWhereTheyLostTheirSurface) {
  Scene scene(GetParam(), 0.2);
  auto const up = static_cast<int>(scene.up);
  EXPECT_EQ(scene.energy_at_height(0.2), 0);
  EXPECT_TRUE(scene.system->late_rigids().loaded_indices().empty());
  double const less = scene.energy_at_height(0.3 - 1e-6), more = scene.energy_at_height(0.3 + 1e-6);
  EXPECT_GT(scene.energy_at_height(0.3), 0);
  ForceMoment const on_rigid = scene.system->resultant_on_rigid(0);
  double const slope = (more - less) / 2e-6;
  EXPECT_NEAR(on_rigid.force[up], -slope, 1e-5 * slope);
  Vec<3> force, moment;
  for (Index const k : scene.system->late_rigids().loaded_indices()) {
    Vec<3> const& f = scene.system->late_rigids().forces()[static_cast<std::size_t>(k)];
    force = force + f;
    moment = moment + cross(scene.x[static_cast<std::size_t>(k)] - scene.system->rigid(0).centre, f);
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(force[c], -on_rigid.force[c], 1e-12 * slope);
    EXPECT_NEAR(moment[c], -on_rigid.moment[c], 1e-11 * slope);
  }
  EXPECT_GT(scene.system->totals().frequency2, 0);
  EXPECT_GT(scene.system->frequencies(0).of_shape, 0);
  std::vector<Vec<3>> v(scene.x.size());
  for (Vec<3>& one : v) one[up] = -10;
  EXPECT_NEAR(scene.system->contact_time_step(v), 0.1 / 10, 2e-3);

  Scene resumed(GetParam(), 0.3);
  resumed.system->late_rigids().load(scene.system->late_rigids().state());
  resumed.system->restore(resumed.x, scene.system->state());
  for (std::size_t k = 0; k < scene.x.size(); ++k)
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(resumed.system->late_rigids().forces()[k][c], scene.system->late_rigids().forces()[k][c]);
  EXPECT_EQ(resumed.energy_at_height(0.4), scene.energy_at_height(0.4));
}

/// Particles that come out push from the face of the shape, half a spacing away, when they return.
TEST_P(LateRigid, DepthIsForgottenOutside) {
  Scene scene(GetParam(), 0.2);
  EXPECT_EQ(scene.energy_at_height(0.2), 0);
  EXPECT_EQ(scene.energy_at_height(-0.1), 0);
  EXPECT_GT(scene.energy_at_height(0.1), 0);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, LateRigid, ::testing::Values(2, 3));

}  // namespace
}  // namespace piola::contact::testing
