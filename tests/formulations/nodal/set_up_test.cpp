// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/setting_warnings.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include "support/key_words.hpp"

namespace piola::testing {
namespace {

using test::expect_words;

/// Integral over the body of 1, X_i and X_i X_j, from its bounds.
double box_moment(Body const& body, std::size_t D, int i, int j) {
  double product = 1;
  for (std::size_t c = 0; c < D; ++c) {
    int const power = (static_cast<int>(c) == i ? 1 : 0) + (static_cast<int>(c) == j ? 1 : 0);
    double const a = body.outline.min[c], b = body.outline.max[c];
    product *= power == 0 ? b - a : power == 1 ? (b * b - a * a) / 2 : (b * b * b - a * a * a) / 3;
  }
  return product;
}

double mass_moment(SetUpBody const& body, int i, int j) {
  double sum = 0;
  for (Index slot = 0; slot < body.order.particles; ++slot) {
    auto const X = body.X(slot);
    sum += body.reference.mass[static_cast<std::size_t>(slot)] * (i < 0 ? 1 : X[static_cast<std::size_t>(i)]) *
           (j < 0 ? 1 : X[static_cast<std::size_t>(j)]);
  }
  return sum / 1100;
}

TEST(NodalMasses, HaveTheExactMomentsOfABoxUpToTheSecond) {
  for (int D = 1; D <= 3; ++D) {
    SetUpBody const body(nodal_body(brick(D)), 0.05);  // so small that nothing is restrained
    auto const& of = body.set.bodies[0];
    auto const d = static_cast<std::size_t>(D);
    double const volume = box_moment(of, d, -1, -1);
    EXPECT_NEAR(mass_moment(body, -1, -1), volume, 1e-13);
    for (int i = 0; i < D; ++i) {
      EXPECT_NEAR(mass_moment(body, i, -1), box_moment(of, d, i, -1), 1e-13) << D;
      for (int j = 0; j < D; ++j) EXPECT_NEAR(mass_moment(body, i, j), box_moment(of, d, i, j), 1e-13) << D << i << j;
    }
  }
}

TEST(NodalMasses, AreGregorysWeightsInOneDimension) {
  // James Gregory's rule with first and second differences: 3/8, 7/6, 23/24, 1, ...
  SetUpBody const body(nodal_body(unit_box(1, 11)), 0.05);
  double const h = 0.1 * 1100;
  std::vector<double> const expected{3.0 / 8, 7.0 / 6, 23.0 / 24, 1, 1, 1, 1, 1, 23.0 / 24, 7.0 / 6, 3.0 / 8};
  for (Index slot = 0; slot < body.order.particles; ++slot) {
    auto const id = static_cast<std::size_t>(body.order.id[static_cast<std::size_t>(slot)]);
    EXPECT_NEAR(body.reference.mass[static_cast<std::size_t>(slot)], expected[id] * h, 2e-3 * h) << id;
  }
}

TEST(NodalMasses, StayAboveTheFloorAndKeepTheTotalOnAnIrregularCloud) {
  for (Cloud const& cloud : clouds({0.2, 0.4})) {
    SetUpBody const body(nodal_body(brick(3, cloud.jitter, {4, 5, 6}, cloud.seed)));
    auto const& of = body.set.bodies[0];
    for (Index slot = 0; slot < body.order.particles; ++slot) {
      auto const k = static_cast<std::size_t>(slot);
      EXPECT_GE(body.reference.mass[k], 0.3 * 1100 * body.reference.V[k] * (1 - 1e-12));
    }
    EXPECT_NEAR(mass_moment(body, -1, -1), box_moment(of, 3, -1, -1), 1e-12);
  }
}

/// Deformations x(X) = A X + X.B.X with their gradient at any place.
struct Quadratic2 {
  int D;
  Point at(Point const& X) const {
    Point x{};
    for (int i = 0; i < D; ++i)
      for (int J = 0; J < D; ++J) {
        x[static_cast<std::size_t>(i)] += A(i, J) * X[static_cast<std::size_t>(J)];
        for (int K = 0; K < D; ++K)
          x[static_cast<std::size_t>(i)] +=
              B(i, J, K) * X[static_cast<std::size_t>(J)] * X[static_cast<std::size_t>(K)];
      }
    return x;
  }
  double gradient(int i, int J, Point const& X) const {
    double F = A(i, J);
    for (int K = 0; K < D; ++K) F += (B(i, J, K) + B(i, K, J)) * X[static_cast<std::size_t>(K)];
    return F;
  }
  static double A(int i, int J) { return (i == J ? 1.1 : 0) + 0.03 * i - 0.05 * J; }
  static double B(int i, int J, int K) { return 0.01 * (1 + i + 2 * J - 3 * K); }
};

TEST(NodalGradient, IsExactForQuadraticFieldsAtTheCentroidsOfCells) {
  for (int D = 1; D <= 3; ++D)
    for (Cloud const& cloud : clouds({0.4}, 4)) {
      Assembly a = nodal_body(brick(D, cloud.jitter, {4, 5, 6}, cloud.seed));
      Quadratic2 const field{D};
      displace(a, [&](Point const& X) {
        Point u = field.at(X);
        for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) u[c] -= X[c];
        return u;
      });
      auto const cells = measure_cells(a.particles, a.particles.bodies[0]);
      auto const F = sample(*make_formulation(a), "DeformationGradient", a.particles.X.size());
      for (std::size_t id = 0; id < a.particles.X.size(); ++id) {
        Point centroid = a.particles.X[id];
        for (std::size_t c = 0; c < 3; ++c) centroid[c] += cells.cell[id].centroid[c];
        for (int i = 0; i < D; ++i)
          for (int J = 0; J < D; ++J)
            EXPECT_NEAR(F[9 * id + static_cast<std::size_t>(3 * i + J)], field.gradient(i, J, centroid), 1e-11);
      }
    }
}

/// Tractions P N on every face of a box, for the uniform deformation F.
Assembly pulled_box(ParticleSet const& set, Mat<3> const& F, Mat<3> const& P) {
  Assembly a = nodal_body(set);
  auto const D = static_cast<std::size_t>(set.dimension);
  displace(a, [&](Point const& X) {
    Point u{};
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t J = 0; J < D; ++J)
        u[i] += (F(static_cast<int>(i), static_cast<int>(J)) - (i == J ? 1 : 0)) * X[J];
    return u;
  });
  for (std::size_t axis = 0; axis < D; ++axis)
    for (bool const upper : {false, true}) {
      Load load;
      load.normal = Point{};
      (*load.normal)[axis] = upper ? 1 : -1;
      for (std::int64_t id = 0; id < set.size(); ++id) {
        auto const at = set.lattice_index[static_cast<std::size_t>(id)][axis];
        if (at == (upper ? set.bodies[0].lattice[axis] - 1 : 0)) load.particles.push_back(id);
      }
      double area = 1;  // of the face, in equal parts
      for (std::size_t c = 0; c < D; ++c)
        if (c != axis) area *= set.bodies[0].spacing[c] * (set.bodies[0].lattice[c] - 1);
      for (std::int64_t const id : load.particles)
        load.factor.push_back(area / (static_cast<double>(load.particles.size()) * rubber().value[0] *
                                      set.volume[static_cast<std::size_t>(id)]));
      for (std::size_t i = 0; i < 3; ++i)
        load.value[i] = Expression(std::to_string((upper ? 1 : -1) * P(static_cast<int>(i), static_cast<int>(axis))));
      a.loads.push_back(load);
    }
  return a;
}

TEST(NodalForces, VanishUnderUniformStrainWithTheTractionsThatBelongToIt) {
  for (int D = 1; D <= 3; ++D) {
    Mat<3> F = identity<3>();
    for (int i = 0; i < D; ++i)
      for (int J = 0; J < D; ++J) F(i, J) += 0.1 * (1 + i) - 0.07 * J;
    Mat<3> const P = NeoHookean(rubber().value).first_piola(F);
    double const stress = std::sqrt(contract(P, P));
    for (Cloud const& cloud : clouds({0.2, 0.4})) {
      auto const set = brick(D, cloud.jitter, {4, 5, 6}, cloud.seed);
      double h2 = 1;
      for (std::size_t c = 0; c + 1 < static_cast<std::size_t>(D); ++c) h2 *= set.bodies[0].spacing[c];
      EXPECT_LT(largest(forces(pulled_box(set, F, P))), 1e-10 * stress * h2) << D << " " << cloud.jitter;
    }
  }
}

double check_of(nodal::Reference const& reference, std::string const& name) {
  auto const& checks = reference.checks;
  auto const found = std::ranges::find(checks, name, &SetUpCheck::name);
  return found == checks.end() ? std::nan("") : found->value;
}

TEST(NodalGradient, FulfilsTheDivergenceTheoremOnAnyCloudAndAtAnyLength) {
  std::vector<ParticleSet> sets{unit_box(1, 501), unit_box(1, 4001), brick(2, 0, {4, 301, 1}), brick(3, 0, {3, 3, 101}),
                                brick(3, 0.2, {5, 5, 60})};
  for (int D = 1; D <= 3; ++D)
    for (Cloud const& cloud : clouds({0.2, 0.4}, 3)) sets.push_back(brick(D, cloud.jitter, {4, 5, 6}, cloud.seed));
  for (ParticleSet const& set : sets) {
    SetUpBody const body(nodal_body(set));
    std::string const& name = set.bodies[0].name;
    EXPECT_LT(check_of(body.reference, name + ".divergence_error"), 1e-12) << set.size();
    EXPECT_LT(check_of(body.reference, name + ".gradient_error"), 1e-11) << set.size();
    EXPECT_LT(check_of(body.reference, name + ".largest_gradient"), 5) << set.size();
  }
}

TEST(NodalSetUp, RefusesBodiesOfTwoParticlesAcross) {
  expect_words(refusal(nodal_body(brick(3, 0, {5, 2, 5}))),
               {"body 'brick': particle 0 at (-0.2, 0.1, 0) m", "quadratic field"});
}

TEST(NodalDoubts, AreAboutPressuresThatFollowAFaceAndVaryAlongIt) {
  auto const count = [](char const* pressure, bool follows, bool viscous) {
    Assembly a = nodal_body(brick(2, 0, {9, 5, 1}));
    if (viscous) a.formulations[0].numbers["fluctuation_viscosity"] = 0.05;
    Load load;
    load.value = {Expression(pressure), Expression("0"), Expression("0")};
    load.pressure = true;
    load.follows = follows;
    load.normal = Point{1, 0, 0};
    for (std::int64_t id = 0; id < a.particles.size(); ++id) load.particles.push_back(id);
    a.loads.push_back(load);
    return setting_warnings(a).size();
  };
  EXPECT_EQ(count("1000*(Y - 0.7)*min(t/30, 1)", true, false), 1U);
  EXPECT_EQ(count("1000*(Y - 0.7)", true, true), 0U);
  EXPECT_EQ(count("1000*(Y - 0.7)", false, false), 0U);
  EXPECT_EQ(count("1000*min(t/30, 1)", true, false), 0U);
}

TEST(NodalDoubts, AreAboutThreeParticlesAcrossNearIncompressibility) {
  auto const count = [](int across, double ratio) {
    return setting_warnings(nodal_body(brick(3, 0, {across, 5, 6}), rubber("neo_hookean", ratio))).size();
  };
  EXPECT_EQ(count(3, 0.499), 1U);
  EXPECT_EQ(count(4, 0.499), 0U);
  EXPECT_EQ(count(3, 0.45), 0U);
}

}  // namespace
}  // namespace piola::testing
