// SPDX-License-Identifier: Apache-2.0
// Section 8.2 of Lee et al. (2016): a unit cube on rollers swings in a mode with a closed solution.
#include "piola/materials/laws.hpp"
#include "formulations/small_bodies.hpp"
#include "math/random.hpp"
#include <numbers>

namespace piola {
namespace {

using namespace testing;

constexpr double amplitude = 5e-4, half_pi = std::numbers::pi / 2;

/// The displacement at t = 0 and its gradient; at time t both are multiplied by cos(omega t).
Point shape(Point const& X) {
  double const s[] = {std::sin(half_pi * X[0]), std::sin(half_pi * X[1]), std::sin(half_pi * X[2])};
  double const c[] = {std::cos(half_pi * X[0]), std::cos(half_pi * X[1]), std::cos(half_pi * X[2])};
  return {amplitude * s[0] * c[1] * c[2], amplitude * c[0] * s[1] * c[2], amplitude * c[0] * c[1] * s[2]};
}
Mat<3> shape_gradient(Point const& X) {
  Mat<3> G;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double product = amplitude * half_pi;
      for (int k = 0; k < 3; ++k) {
        double const angle = half_pi * X[static_cast<std::size_t>(k)];
        bool const sine = (k == i) != (k == j);
        product *= sine ? std::sin(angle) : std::cos(angle);
        if (k == j && k != i) product = -product;
      }
      G(i, j) = product;
    }
  return G;
}

Assembly swinging_cube(int n, std::string const& scheme) {
  Assembly a = assemble(unit_box(3, n), rubber("linear_elastic"));
  choose(a, "scheme", scheme);
  for (auto& f : a.formulations) f.numbers.clear();  // the supports of the scheme
  displace(a, shape);
  for (auto const& X : a.particles.X) {
    Mat<3> const F = identity<3>() + shape_gradient(X);
    std::array<double, 9> row;
    std::copy(F.c, F.c + 9, row.begin());
    a.initial_deformation_gradient.push_back(row);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<bool, 3> normal{}, tangential{true, true, true};
    normal[axis] = true;
    tangential[axis] = false;
    support(a, normal, [&](Point const& X) { return X[axis] < 1e-9; });
    support(a, tangential, [&](Point const& X) { return X[axis] > 1 - 1e-9; });
  }
  return a;
}

/// Relative L2 errors of momentum and stress at t = 2 ms, with tributary volumes as weights.
struct Errors {
  double p = 0, P = 0;
};

Errors errors_at_2ms(Assembly const& a) {
  LinearElastic const law(a.materials[0].value);
  double const end = 2e-3, omega = std::sqrt(3.0) * law.p_wave_speed() * half_pi;
  auto const f = make_formulation(a);
  double t = 0;
  while (t < end * (1 - 1e-12)) {
    double const dt = std::min(f->stable_time_step(), end - t);
    f->step(t, dt);
    t += dt;
  }
  auto const count = a.particles.X.size();
  Values const v = sample(*f, "Velocity", count), P = sample(*f, "FirstPiolaStress", count);
  double wrong_v = 0, all_v = 0, wrong_P = 0, all_P = 0;
  for (std::size_t k = 0; k < count; ++k) {
    Point const& X = a.particles.X[k];
    double const V = a.particles.volume[k];
    Point const u = shape(X);
    Mat<3> const exact = law.first_piola(identity<3>() + std::cos(omega * end) * shape_gradient(X));
    for (std::size_t c = 0; c < 3; ++c) {
      double const exact_v = -omega * std::sin(omega * end) * u[c];
      wrong_v += V * (v[3 * k + c] - exact_v) * (v[3 * k + c] - exact_v);
      all_v += V * exact_v * exact_v;
    }
    for (std::size_t c = 0; c < 9; ++c) {
      wrong_P += V * (P[9 * k + c] - exact.c[c]) * (P[9 * k + c] - exact.c[c]);
      all_P += V * exact.c[c] * exact.c[c];
    }
  }
  return {std::sqrt(wrong_v / all_v), std::sqrt(wrong_P / all_P)};
}

TEST(SwingingCube, IsSetUpWithTheGradientOfItsDisplacement) {
  Point const X{0.3, 0.7, 0.55};
  double const step = 1e-5;
  Mat<3> const G = shape_gradient(X);
  for (int j = 0; j < 3; ++j) {
    Point more = X, less = X;
    more[static_cast<std::size_t>(j)] += step;
    less[static_cast<std::size_t>(j)] -= step;
    for (int i = 0; i < 3; ++i) {
      auto const at = static_cast<std::size_t>(i);
      EXPECT_NEAR((shape(more)[at] - shape(less)[at]) / (2 * step), G(i, j), 1e-9 * amplitude);
    }
  }
}

struct Published {
  char const* scheme;
  int n;
  double p, P;  ///< table A.8.2 of the specification, set P
};

/// The table has four digits and claims to be reproducible to a thousandth.
template <class Row>
void expect_published(Errors const& e, Row const& row) {
  EXPECT_NEAR(e.p, row.p, 1e-3 * row.p);
  EXPECT_NEAR(e.P, row.P, 1e-3 * row.P);
}

class SwingingCubeErrors : public ::testing::TestWithParam<Published> {};

TEST_P(SwingingCubeErrors, AreThoseOfTheTrialImplementation) {
  expect_published(errors_at_2ms(swinging_cube(GetParam().n, GetParam().scheme)), GetParam());
}

INSTANTIATE_TEST_SUITE_P(TableA82, SwingingCubeErrors,
                         ::testing::Values(Published{"paper", 5, 1.199e-1, 9.790e-2},
                                           Published{"paper", 9, 4.979e-2, 5.654e-2},
                                           Published{"paper", 17, 1.385e-2, 3.859e-2}),
                         [](auto const& p) { return p.param.scheme + std::to_string(p.param.n); });

class SwingingCubeWithMirrors : public ::testing::TestWithParam<Published> {};

/// All planes as mirrors: those through the origin for rollers, skew ones where the tangential components are zero.
Assembly mirrored_cube(int n, std::string const& scheme) {
  Assembly a = swinging_cube(n, scheme);
  a.supports.clear();
  for (int axis = 0; axis < 3; ++axis) {
    a.mirrors.push_back({0, axis, false, false});
    a.mirrors.push_back({0, axis, true, true});
  }
  return a;
}

TEST_P(SwingingCubeWithMirrors, HasTheErrorsOfTheTrialImplementation) {
  expect_published(errors_at_2ms(mirrored_cube(GetParam().n, GetParam().scheme)), GetParam());
}

INSTANTIATE_TEST_SUITE_P(TableA82, SwingingCubeWithMirrors,
                         ::testing::Values(Published{"paper", 5, 8.439e-2, 7.043e-2},
                                           Published{"paper", 9, 1.964e-2, 1.809e-2},
                                           Published{"paper", 17, 4.678e-3, 4.499e-3}),
                         [](auto const& p) { return p.param.scheme + std::to_string(p.param.n); });

TEST(SwingingCubeWithMirrors, ConvergesToSecondOrderInMomentumAndStress) {
  Errors const coarse = errors_at_2ms(mirrored_cube(9, "paper")), fine = errors_at_2ms(mirrored_cube(17, "paper"));
  EXPECT_NEAR(std::log2(coarse.p / fine.p), 2, 0.2);  // table A.8.2: 2.07 and 2.01
  EXPECT_NEAR(std::log2(coarse.P / fine.P), 2, 0.1);
}

struct PublishedWithMultipliers {
  int n;
  double p, P;  ///< text below table A.8.2, set R75
};

class SwingingCubeWithMultipliers : public ::testing::TestWithParam<PublishedWithMultipliers> {};

TEST_P(SwingingCubeWithMultipliers, IsAsAccurateAsWithDirectSupports) {
  Assembly a = swinging_cube(GetParam().n, "paper");
  choose(a, "gradient_support", 0.75);
  Errors const direct = errors_at_2ms(a);
  choose(a, "supports", "multipliers");
  Errors const e = errors_at_2ms(a);
  expect_published(e, GetParam());
  EXPECT_NE(e.p, direct.p);
  EXPECT_NEAR(e.p, direct.p, 1e-3 * GetParam().p);
}

INSTANTIATE_TEST_SUITE_P(TextBelowTableA82, SwingingCubeWithMultipliers,
                         ::testing::Values(PublishedWithMultipliers{5, 3.132e-2, 3.653e-2},
                                           PublishedWithMultipliers{9, 7.7516e-3, 1.1203e-2}),
                         [](auto const& p) { return std::to_string(p.param.n); });

TEST(SwingingCube, ConvergesToSecondOrderInTheMomentum) {
  double const order =
      std::log2(errors_at_2ms(swinging_cube(5, "filtered")).p / errors_at_2ms(swinging_cube(9, "filtered")).p);
  EXPECT_NEAR(order, 2, 0.15);  // 1.97
}

}  // namespace
}  // namespace piola
