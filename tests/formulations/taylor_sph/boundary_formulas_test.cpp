// SPDX-License-Identifier: Apache-2.0
// What is done at one particle with prescribed values.
#include "piola/formulations/taylor_sph/boundary_passes.hpp"
#include "math/random.hpp"
#include <gtest/gtest.h>

namespace piola::taylor_sph {
namespace {

using testing::Random;

constexpr double E = 210, nu = 0.3;
constexpr double shear = E / (2 * (1 + nu)), lame = E * nu / ((1 + nu) * (1 - 2 * nu));

LinearElastic law() {
  double const values[] = {8000, E, nu, 0};
  return LinearElastic(values);
}

TEST(MandelBasis, IsOrthonormalInTheContractionOfTensors) {
  Random random(1);
  for (int k = 0; k < 20; ++k) {
    SymMat<3> a, b;
    for (int c = 0; c < 6; ++c) {
      a.c[c] = random.in(-1, 1);
      b.c[c] = random.in(-1, 1);
    }
    double expected = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) expected += a(i, j) * b(i, j);
    EXPECT_NEAR(Mandel<3>::dot(Mandel<3>::of(a).c, Mandel<3>::of(b).c), expected, 1e-15 * 10);
    SymMat<3> const back = Mandel<3>::of(a).tensor();
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(back.c[c], a.c[c], 1e-15);
  }
  EXPECT_EQ(Mandel<2>::of({{1, 2, 3}}).c[2], 3 * std::sqrt(2.0));
  EXPECT_EQ(Mandel<1>::of({{4}}).c[0], 4);
}

constexpr double weakest = 0.002;

TEST(Pseudoinverse, OfAFullMatrixIsItsInverse) {
  Random random(2);
  for (int k = 0; k < 50; ++k) {
    Mat<3> const A = testing::diagonal(2, -2, 3) + random.matrix(0.5);
    Vec<3> const q = random.vector(1), c = PseudoInverse<3>(A, weakest, 1)(q), expected = inverse(transpose(A)) * q;
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(c[a], expected[a], 1e-12);
  }
}

TEST(Pseudoinverse, LeavesOutDirectionsThatAMatrixDoesNotSee) {
  // A = 3 t (x) t with the unit vector t: of q only its part along t counts, divided by 3.
  Vec<3> const t{{2.0 / 3, -1.0 / 3, 2.0 / 3}}, q{{1, 5, -2}};
  Vec<3> const c = PseudoInverse<3>(3 * outer(t, t), weakest, 1)(q);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(c[a], dot(t, q) / 3 * t[a], 1e-14);
  // Squares of 0.04 and 0.05 are on both sides of 0.002.
  auto const solved = [](double second, double share) {
    return PseudoInverse<2>(Mat<2>{{1, 0, 0, second}}, share, 1)(Vec<2>{{1, 1}});
  };
  EXPECT_NEAR(solved(0.04, weakest)[0], 1, 1e-15);
  EXPECT_EQ(solved(0.04, weakest)[1], 0);
  EXPECT_NEAR(solved(0.05, weakest)[1], 20, 1e-13);
  EXPECT_NEAR(solved(0.04, 1e-8)[1], 25, 1e-13);
}

/// What is round-off of numbers that cancel is nothing, even if it is all there is.
TEST(Pseudoinverse, LeavesOutRoundOff) {
  EXPECT_EQ(PseudoInverse<1>(Mat<1>{{1e-14}}, weakest, 1)(Vec<1>{{1}})[0], 0);
  EXPECT_NEAR(PseudoInverse<1>(Mat<1>{{1e-8}}, weakest, 1)(Vec<1>{{1}})[0], 1e8, 1e-6);
  EXPECT_NEAR(PseudoInverse<1>(Mat<1>{{1e-14}}, weakest, 1e-12)(Vec<1>{{1}})[0], 1e14, 1) << "a small body";
  EXPECT_EQ(PseudoInverse<2>(Mat<2>{}, weakest, 0)(Vec<2>{{1, 1}})[0], 0);
}

/// One source has a value but no gradient.
TEST(FreeEstimate, OfOneSourceIsItsValue) {
  KernelSums<1, Lanes> sums{};
  Lanes const source[] = {0.1003, 0.7, 3.3, 1000.1};
  add_source<1, CubicSpline>(source, Vec<1, Lanes>{{Lanes(0.0)}}, Lanes(7.0), sums);
  auto const e = estimate_free<1>(lane_of<1>(sums, 0));
  EXPECT_NEAR(e.f[0], 3.3, 1e-14);
  EXPECT_NEAR(e.f[1], 1000.1, 1e-11);
  EXPECT_EQ(e.gradient[0][0], 0);
}

/// Prescribes the tractions on a side with the normal n (an axis) along all axes: their values change by `change`.
template <int D>
BoundaryItem traction_on_axis(int n, Vec<D> const& change) {
  BoundaryItem item{};
  item.rows = D;
  for (int d = 0; d < D; ++d) {
    int const c = SymMat<D>::at(d, n);
    item.row[d][c] = 1;
    item.after[d] = Mandel<D>::factor(c) * change[d];
    item.along[d][d] = 1;
    item.normal[d][n] = 1;
  }
  return item;
}

TEST(MissingDerivatives, FollowFromTheTractionOnAnEdge) {
  // Tangent x, normal y:  L_nn = (ds_nn/dt - D12 L_ss) / D11,  L_sn = -L_ns + (ds_sn/dt) / G.
  double const dt = 0.1, ds_sn = 3, ds_nn = -7;
  BoundaryItem const item = traction_on_axis<2>(1, {{ds_sn * dt, ds_nn * dt}});
  for (double const lateral : {0.0, lame / (lame + 2 * shear)}) {
    double const D11 = lateral > 0 ? E / (1 - nu * nu) : lame + 2 * shear, D12 = lateral > 0 ? nu * D11 : lame;
    Mat<2> L{{0.4, 99, -0.3, 77}};  // the second column is not known
    add_missing_derivatives<2>(law(), lateral, item, dt, L);
    EXPECT_NEAR(L(0, 0), 0.4, 1e-15);
    EXPECT_NEAR(L(1, 0), -0.3, 1e-15);
    EXPECT_NEAR(L(1, 1), (ds_nn - D12 * 0.4) / D11, 1e-12);
    EXPECT_NEAR(L(0, 1), 0.3 + ds_sn / shear, 1e-12);
  }
}

TEST(MissingDerivatives, FollowFromTheTractionOnAFace) {
  double const dt = 0.2;
  Vec<3> const rate{{1, -2, 4}};
  BoundaryItem const item = traction_on_axis<3>(2, dt * rate);
  Random random(3);
  Mat<3> L = random.matrix(1);
  Mat<3> const before = L;
  add_missing_derivatives<3>(law(), 0, item, dt, L);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) EXPECT_EQ(L(i, j), before(i, j)) << "what lies along the face stays";
  EXPECT_NEAR(L(2, 2), (rate[2] - lame * (L(0, 0) + L(1, 1))) / (lame + 2 * shear), 1e-12);
  EXPECT_NEAR(L(0, 2), rate[0] / shear - L(2, 0), 1e-12);
  EXPECT_NEAR(L(1, 2), rate[1] / shear - L(2, 1), 1e-12);
}

TEST(MissingDerivatives, AtTheFreeEndOfABarLeaveNoStrainRate) {
  BoundaryItem const item = traction_on_axis<1>(0, {{0}});
  Mat<1> L{{5}};
  add_missing_derivatives<1>(law(), nu, item, 0.1, L);
  EXPECT_NEAR(L(0, 0), 0, 1e-15);
  Mat<1> untouched{{5}};
  add_missing_derivatives<1>(law(), nu, BoundaryItem{}, 0.1, untouched);
  EXPECT_EQ(untouched(0, 0), 5) << "nothing is prescribed";
}

TEST(Impose, GivesWhatIsPrescribedAndLeavesTheRest) {
  using R = Record<2>;
  double real[2 * R::stride] = {};
  double* const own = real + R::stride;
  double const values[R::values] = {0.5, 0.6, 1, 3, 4, 10, 20, 30};  // x, volume, v, stress
  std::copy(std::begin(values), std::end(values), own);
  BoundaryItem item{};
  item.held = 1;
  item.direction[0][0] = 0.6;
  item.direction[0][1] = 0.8;
  item.speed_after[0] = -1;
  item.rows = 1;
  item.row[0][2] = 1;
  item.after[0] = 5 * std::sqrt(2.0);
  Impose<2>{real, &item, 1}(0);
  EXPECT_NEAR(0.6 * own[R::v] + 0.8 * own[R::v + 1], -1, 1e-14);
  EXPECT_NEAR(-0.8 * own[R::v] + 0.6 * own[R::v + 1], -0.8 * 3 + 0.6 * 4, 1e-14) << "across";
  EXPECT_EQ(own[R::s], 10);
  EXPECT_EQ(own[R::s + 1], 20);
  EXPECT_NEAR(own[R::s + 2], 5, 1e-14);
  for (int c = 0; c <= R::volume; ++c) EXPECT_EQ(own[c], values[c]);
  for (int c = 0; c < R::stride; ++c) EXPECT_EQ(real[c], 0) << "another particle";
}

}  // namespace
}  // namespace piola::taylor_sph
