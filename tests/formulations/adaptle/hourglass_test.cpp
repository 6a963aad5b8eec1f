// SPDX-License-Identifier: Apache-2.0
// Springs against displacements of total-Lagrangian particles that no deformation gradient sees.
#include "formulations/adaptle/clouds.hpp"

namespace piola {
namespace {

using namespace testing;

Assembly springy(int dimension, double stiffness) {
  Assembly a = adaptle_assembly(unit_box(dimension, dimension == 2 ? 9 : 6, 0.1));
  choose(a, "description", "total_lagrangian");
  choose(a, "hourglass", 0.0);
  choose(a, "hourglass_stiffness", stiffness);
  choose(a, "alpha", 0.0);
  choose(a, "beta", 0.0);
  return a;
}

/// kappa/4 sum_ab V0_a V0_b s |x_b - x_a - F_a (X_b - X_a)|^2, from the lists and the deformation gradients.
double stored(Cloud const& cloud) {
  System const& s = cloud.system();
  double const kappa = s.body[0].hourglass_stiffness * s.body[0].shear_modulus;
  double sum = 0;
  for (Index i = 0; i < cloud.size(); ++i)
    for (auto k = s.material.begin[i]; k < s.material.begin[i + 1]; ++k) {
      Index const j = s.material.neighbour[k];
      if (j >= cloud.size()) continue;
      double square = 0;
      for (int p = 0; p < s.dimension; ++p) {
        double e = s.position[3 * j + p] - s.position[3 * i + p];
        for (int q = 0; q < s.dimension; ++q)
          e -= cloud.deformation(i).F[3 * p + q] *
               (cloud.X(j)[static_cast<std::size_t>(q)] - cloud.X(i)[static_cast<std::size_t>(q)]);
        square += e * e;
      }
      sum += 0.25 * kappa * cloud.volume(i) * cloud.volume(j) * static_cast<double>(s.material.gradient[k]) * square;
    }
  return sum;
}

class AdaptleHourglass : public ::testing::TestWithParam<int> {};

TEST_P(AdaptleHourglass, LinearDeformationsAndRotationsFeelNoSprings) {
  Cloud with(springy(GetParam(), 5)), without(springy(GetParam(), 0));
  for (Cloud* cloud : {&with, &without}) {
    for (Index i = 0; i < cloud->size(); ++i) {
      Components const x = cloud->state[i].x;
      double const X = x[0], Y = x[1];
      x[0] = 0.6 * X - 0.8 * Y;
      x[1] = 0.88 * X + 0.66 * Y;  // turned by 53 degrees, then stretched by 1.1
    }
    cloud->changed();
    cloud->evaluate();
  }
  double most = 0, difference = 0;
  for (Index i = 0; i < with.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      most = std::max(most, std::fabs(without.sums(i).force[c]));
      difference = std::max(difference, std::fabs(with.sums(i).force[c] - without.sums(i).force[c]));
    }
  EXPECT_GT(most, 0);
  EXPECT_LT(difference, 1e-9 * most);
}

TEST_P(AdaptleHourglass, PowerIsTheRateOfTheStoredEnergy) {
  double energy[2]{}, power = 0;
  for (int k = -1; k <= 1; ++k) {
    Cloud cloud(springy(GetParam(), 2));
    Random random(11);
    double const step = 1e-5 * k;
    for (Index i = 0; i < cloud.size(); ++i)
      for (int c = 0; c < GetParam(); ++c) {
        double const v = random.in(-1, 1);
        cloud.state[i].x[c] += random.in(-0.01, 0.01) + step * v;
        cloud.state[i].v[c] = v;
      }
    cloud.changed();
    cloud.evaluate();
    if (k == 0)
      for (Index i = 0; i < cloud.size(); ++i) power += cloud.sums(i).hourglass;
    else
      energy[(k + 1) / 2] = stored(cloud);
  }
  EXPECT_GT(energy[0], 0);
  EXPECT_NEAR(power, (energy[1] - energy[0]) / 2e-5, 1e-6 * std::fabs(power));
}

INSTANTIATE_TEST_SUITE_P(Both, AdaptleHourglass, ::testing::Values(2, 3));

}  // namespace
}  // namespace piola
