// SPDX-License-Identifier: Apache-2.0
// Short waves of bodies that stay total-Lagrangian: no step may make them grow.
#include "formulations/adaptle/clouds.hpp"

namespace piola {
namespace {

using namespace testing;

/// A body at rest but for velocities that differ from particle to particle, and a setting of its formulation.
struct ShakenBody {
  std::string name;
  int dimension;
  double jitter, poisson;  ///< of positions, in spacings
  std::string key;
  double number;
};

void PrintTo(ShakenBody const& body, std::ostream* out) { *out << body.name; }

Assembly assembly_of(ShakenBody const& body) {
  Assembly a = adaptle_assembly(unit_box(body.dimension, body.dimension == 2 ? 9 : 6, body.jitter),
                                material("elastic", 1000, 1e9, body.poisson));
  choose(a, "description", "total_lagrangian");
  if (!body.key.empty()) choose(a, body.key, body.number);
  Random random(5);
  give_velocity(a, [&](Point const&) {
    return Point{random.in(-0.1, 0.1), random.in(-0.1, 0.1), body.dimension == 3 ? random.in(-0.1, 0.1) : 0};
  });
  return a;
}

class AdaptleShearWaves : public ::testing::TestWithParam<ShakenBody> {};

/// 0.6 is the largest Courant number of compressed lengths, here that of all of the body.
TEST_P(AdaptleShearWaves, DoNotGrowAtTheCourantNumberOfShearedLengths) {
  Assembly a = assembly_of(GetParam());
  a.cfl = 0.6;
  auto const f = make_formulation(a);
  double const start = f->diagnose().kinetic_energy;
  take_steps(*f, 0, 600);
  EXPECT_LT(f->diagnose().kinetic_energy, 0.3 * start);
}

TEST_P(AdaptleShearWaves, KeepTheirEnergyAtTheDefaultStep) {
  auto const f = make_formulation(assembly_of(GetParam()));
  double const start = f->diagnose().kinetic_energy;
  double const time = take_steps(*f, 0, 600);
  double const before = f->diagnose().total_energy();
  take_steps(*f, time, 600);
  EXPECT_LT(f->diagnose().kinetic_energy, 0.3 * start);
  EXPECT_NEAR(f->diagnose().total_energy(), before, 0.01 * start);
}

// With Poisson's ratio 0 shear waves are as fast as they can be beside pressure waves.
INSTANTIATE_TEST_SUITE_P(
    Bodies, AdaptleShearWaves,
    ::testing::Values(ShakenBody{"plane lattice", 2, 0, 0, "", 0}, ShakenBody{"lattice", 3, 0, 0, "", 0},
                      ShakenBody{"irregular plane", 2, 0.2, 0, "", 0}, ShakenBody{"irregular", 3, 0.2, 0, "", 0},
                      ShakenBody{"steel", 3, 0, 0.3, "", 0}, ShakenBody{"nearly incompressible", 3, 0, 0.49, "", 0},
                      ShakenBody{"most damping", 3, 0, 0.49, "hourglass", 0.3},
                      ShakenBody{"no springs", 3, 0, 0, "hourglass_stiffness", 0},
                      ShakenBody{"no viscosity", 3, 0, 0, "alpha", 0}));

}  // namespace
}  // namespace piola
