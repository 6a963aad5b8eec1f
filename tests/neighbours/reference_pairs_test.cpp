// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/reference_pairs.hpp"
#include "piola/base/errors.hpp"
#include "exec/thread_count.hpp"
#include "math/random.hpp"
#include "neighbours/decode.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <string>

namespace piola {
namespace {

using testing::SeenPairs;
using testing::supports;
using testing::unit_box;

struct Setting {
  int dimension;
  double jitter, gradient, laplacian;
  int lanes;
};

/// Regular and jittered bodies of every dimension, the supports of both schemes, one and several lanes.
class CorrectedOperators : public ::testing::TestWithParam<Setting> {
 protected:
  static constexpr int n = 7;
  ParticleSet const set = unit_box(GetParam().dimension, n, GetParam().jitter);
  SeenPairs const seen{set, supports(n, GetParam().gradient, GetParam().laplacian, GetParam().lanes)};
  double const dx = 1.0 / (n - 1);
};

TEST_P(CorrectedOperators, DifferentiateLinearFieldsExactly) {
  auto const f = [](auto const& X) { return 3 + 2 * X[0] - 5 * X[1] + 0.5 * X[2]; };
  double const slope[] = {2, -5, 0.5};
  for (Index a = 0; a < seen.order.particles; ++a) {
    auto const g = seen.gradient(a, f);
    for (int c = 0; c < 3; ++c)  // spec A.0: 2e-15 to 1e-12; sums of up to 80 terms f / dx of size 30
      EXPECT_NEAR(g[static_cast<std::size_t>(c)], c < GetParam().dimension ? slope[c] : 0, 1e-12) << "slot " << a;
  }
}

TEST_P(CorrectedOperators, HaveNoLaplacianOfLinearFields) {
  auto const f = [](auto const& X) { return 3 + 2 * X[0] - 5 * X[1] + 0.5 * X[2]; };
  for (Index a = 0; a < seen.order.particles; ++a) {
    double size = 0;
    for (auto const& p : seen.at(a)) size += std::fabs(seen.laplacian_weight(a, p) * (f(seen.X(p.b)) - f(seen.X(a))));
    EXPECT_NEAR(seen.laplacian(a, f), 0, 1e-12 * (size + 1 / (dx * dx)))
        << "slot " << a;  // cancelling terms of that size
  }
}

TEST_P(CorrectedOperators, HaveTheLaplacianOfTheSquaredDistance) {
  auto const f = [](auto const& X) { return squared({X[0] - 0.3, X[1] - 0.4, X[2] - 0.5}); };
  for (Index a = 0; a < seen.order.particles; ++a)
    EXPECT_NEAR(seen.laplacian(a, f), 2 * GetParam().dimension, 1e-10) << "slot " << a;  // spec A.0
}

TEST_P(CorrectedOperators, SumTheirWeightsIntoTheDiagonal) {
  auto const& c = seen.pairs.corrections();
  for (Index a = 0; a < seen.order.particles; ++a) {
    double sum = 0, size = 0;
    std::array<double, 3> G{};
    for (auto const& p : seen.at(a)) {
      sum += seen.laplacian_weight(a, p);
      size += std::fabs(seen.laplacian_weight(a, p));
      for (std::size_t k = 0; k < 3; ++k) G[k] += p.sr[k];
    }
    EXPECT_NEAR(c.diagonal[c.at(a)], sum, 1e-12 * size);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(c.G[c.at(a)][k], G[k], 1e-12 / dx);
    EXPECT_EQ(c.neighbours_of(a), static_cast<int>(seen.at(a).size()));
  }
}

/// With equal kernel volumes, s_ab = s_ba and l_ab = l_ba: the internal force is then the adjoint of the gradient.
TEST_P(CorrectedOperators, HaveSymmetricRawWeights) {
  for (Index a = 0; a < seen.order.particles; ++a)
    for (auto const& p : seen.at(a)) {
      auto const& back = seen.at(p.b);
      auto const q = std::find_if(back.begin(), back.end(), [&](auto const& other) { return other.b == a; });
      ASSERT_NE(q, back.end());
      EXPECT_EQ(q->inner, p.inner);
      EXPECT_NEAR(q->l, p.l, 1e-13 * std::fabs(p.l));
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(q->sr[c], -p.sr[c], 1e-13 / dx);
    }
}

TEST_P(CorrectedOperators, HaveExactlyThePairsWithinTheSupport) {
  double const edge = 1 - 1e-9;  // particles at the support itself do not count
  double const inner = 2 * GetParam().gradient * dx * edge, outer = 2 * GetParam().laplacian * dx * edge;
  for (Index a = 0; a < seen.order.particles; ++a) {
    std::vector<std::pair<Index, bool>> expected, found;
    for (Index b = 0; b < seen.order.particles; ++b) {
      auto const &A = seen.X(a), &B = seen.X(b);
      double const r = std::sqrt(squared({B[0] - A[0], B[1] - A[1], B[2] - A[2]}));
      if (b != a && r <= outer) expected.push_back({b, r <= inner});
    }
    for (auto const& p : seen.at(a)) found.push_back({p.b, p.inner});
    EXPECT_EQ(found, expected) << "slot " << a;
  }
  for (Index a = seen.order.particles; a < seen.order.slots(); ++a) EXPECT_TRUE(seen.at(a).empty()) << "padding " << a;
}

std::vector<Setting> all_settings() {
  std::vector<Setting> r;
  for (int dimension = 1; dimension <= 3; ++dimension)
    for (double const jitter : {0.0, 0.2})
      for (double const gradient : {0.8, 1.0, 1.2})
        for (int const lanes : {1, 2, 4, 8}) {
          // Above jitter, the compact gradient needs a little more reach to keep neighbours on both sides.
          double const h = jitter > 0 && gradient < 1 ? 0.9 : gradient;
          r.push_back({dimension, jitter, h, 1.2, lanes});
        }
  return r;
}

INSTANTIATE_TEST_SUITE_P(All, CorrectedOperators, ::testing::ValuesIn(all_settings()), [](auto const& p) {
  auto const& s = p.param;
  return std::to_string(s.dimension) + "D_" + (s.jitter > 0 ? "jittered" : "regular") + "_h" +
         std::to_string(static_cast<int>(100 * s.gradient)) + "_lanes" + std::to_string(s.lanes);
});

/// Supports other than 2h: all the pairs within, no others, and exact derivatives from them.
class OtherKernels : public ::testing::TestWithParam<std::tuple<Kernel, double>> {};

TEST_P(OtherKernels, HavePairsWithinTheirSupportsAndExactGradients) {
  auto const& [kernel, jitter] = GetParam();
  int const n = 8;
  double const dx = 1.0 / (n - 1), edge = 1 - 1e-9;
  for (int dimension = 1; dimension <= 3; ++dimension)
    for (int const lanes : {1, 4}) {
      ParticleSet const set = unit_box(dimension, n, jitter);
      PairOptions options = supports(n, 0.9, 1.2, lanes);
      options.kernel = &kernel;
      SeenPairs const seen(set, options);
      auto const f = [](auto const& X) { return 3 + 2 * X[0] - 5 * X[1] + 0.5 * X[2]; };
      double const slope[] = {2, -5, 0.5};
      for (Index a = 0; a < seen.order.particles; ++a) {
        std::size_t inner = 0, outer = 0, found_inner = 0;
        for (Index b = 0; b < seen.order.particles; ++b) {
          auto const &A = seen.X(a), &B = seen.X(b);
          double const r = std::sqrt(squared({B[0] - A[0], B[1] - A[1], B[2] - A[2]}));
          outer += b != a && r <= kernel.support * 1.2 * dx * edge ? 1 : 0;
          inner += b != a && r <= kernel.support * 0.9 * dx * edge ? 1 : 0;
        }
        for (auto const& p : seen.at(a)) found_inner += p.inner ? 1 : 0;
        ASSERT_EQ(seen.at(a).size(), outer) << "slot " << a;
        ASSERT_EQ(found_inner, inner) << "slot " << a;
        auto const g = seen.gradient(a, f);
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(g[c], static_cast<int>(c) < dimension ? slope[c] : 0, 1e-11) << "slot " << a;
        auto const square = [](auto const& X) { return squared({X[0] - 0.3, X[1] - 0.4, X[2] - 0.5}); };
        ASSERT_NEAR(seen.laplacian(a, square), 2 * dimension, 1e-9) << "slot " << a;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(All, OtherKernels,
                         ::testing::Combine(::testing::ValuesIn(kernels().begin(), kernels().end()),
                                            ::testing::Values(0.0, 0.2)),
                         [](auto const& p) {
                           return std::string(std::get<0>(p.param).name) +
                                  (std::get<1>(p.param) > 0 ? "_jittered" : "_regular");
                         });

/// Slot of the particle in the middle of a box.
Index middle(SeenPairs const& seen) {
  for (Index a = 0; a < seen.order.particles; ++a)
    if (std::fabs(seen.X(a)[0] - 0.5) + std::fabs(seen.X(a)[1] - 0.5) + std::fabs(seen.X(a)[2] - 0.5) < 1e-9) return a;
  return -1;
}

struct Symbol {
  double h;
  int neighbours;
  double edge, face, corner;  ///< lambda dx^2 of (pi,0,0), (pi,pi,0), (pi,pi,pi)
};

/// Moves the particles on faces about. At h/dx <= 1 the neighbours of a lattice corner all satisfy r.r = dx (x + y +
/// z), so that the Laplacian of a regular box is refused there; the middle keeps its regular neighbours.
void shake_faces(ParticleSet& set, int n) {
  testing::Random random(1);
  for (std::size_t k = 0; k < set.X.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      if (set.lattice_index[k][c] == 0 || set.lattice_index[k][c] == n - 1)
        for (double& x : set.X[k]) x += random.in(-0.1, 0.1) / (n - 1);
  set.bodies[0].regular = false;
}

class LatticeSymbol : public ::testing::TestWithParam<std::tuple<Symbol, bool>> {};

/// Numbers of the table in Appendix A.0 of the specification: cubic spline, Brookshaw's Laplacian.
TEST_P(LatticeSymbol, IsThatOfTheTable) {
  auto const [expected, stencils] = GetParam();
  int const n = 9;
  ParticleSet set = unit_box(3, n);
  if (expected.h < 1.05 && stencils) GTEST_SKIP() << "the Laplacian has no solution at the corners of a regular box";
  if (expected.h < 1.05) shake_faces(set, n);
  SeenPairs const seen(set, supports(n, expected.h, expected.h, 4, stencils));
  ASSERT_EQ(seen.pairs.regular(), stencils);
  Index const a = middle(seen);
  ASSERT_GE(a, 0);
  EXPECT_EQ(seen.at(a).size(), static_cast<std::size_t>(expected.neighbours));
  double const dx = 1.0 / (n - 1), pi = std::numbers::pi;
  auto const symbol = [&](double i, double j, double k) {
    double sum = 0;
    for (auto const& p : seen.at(a))
      sum += seen.laplacian_weight(a, p) * (std::cos((i * p.r[0] + j * p.r[1] + k * p.r[2]) / dx) - 1);
    return sum * dx * dx;
  };
  EXPECT_NEAR(symbol(pi, 0, 0), expected.edge, 1e-3);
  EXPECT_NEAR(symbol(pi, pi, 0), expected.face, 1e-3);
  EXPECT_NEAR(symbol(pi, pi, pi), expected.corner, 1e-3);
}

TEST(ReferencePairs, OfALatticeCornerAtSmallSupportHaveNoLaplacian) {
  ParticleSet const set = unit_box(3, 5);
  for (double const h : {0.75, 1.0})
    for (bool const stencils : {true, false}) EXPECT_THROW(SeenPairs(set, supports(5, h, h, 1, stencils)), InputError);
}

INSTANTIATE_TEST_SUITE_P(TableA0, LatticeSymbol,
                         ::testing::Combine(::testing::Values(Symbol{0.75, 18, -4.000, -6.804, -8.413},
                                                              Symbol{1.0, 26, -4.000, -5.635, -5.989},
                                                              Symbol{1.2, 56, -3.621, -4.149, -4.245},
                                                              Symbol{1.5, 92, -2.636, -2.691, -2.649}),
                                            ::testing::Bool()),
                         [](auto const& p) {
                           return "h" + std::to_string(static_cast<int>(100 * std::get<0>(p.param).h)) +
                                  (std::get<1>(p.param) ? "_stencil" : "_list");
                         });

TEST(ReferencePairs, OfABarWithNearestNeighboursAreSecondDifferences) {
  // What Appendix C of the paper assumes: L u = (u+ - 2u + u-) / dx^2.
  int const n = 11;
  double const dx = 0.1;
  ParticleSet set = unit_box(1, n);
  // An end particle needs two neighbours for its own Laplacian: its neighbours come nearer.
  set.bodies[0].regular = false;
  for (std::size_t const k : {1U, 2U}) {
    set.X[k][0] -= 0.05;
    set.X[10 - k][0] += 0.05;
  }
  SeenPairs const seen(set, supports(n, 1.0, 1.0));
  for (Index a = 4; a <= 6; ++a) {
    ASSERT_EQ(seen.at(a).size(), 2U);
    for (auto const& p : seen.at(a)) EXPECT_NEAR(seen.laplacian_weight(a, p) * dx * dx, 1, 1e-12);
  }
}

std::string refusal(ParticleSet const& set, PairOptions const& options) {
  SlotOrder const order = pencil_order(set, set.bodies[0]);
  try {
    ReferencePairs const pairs(set, set.bodies[0], order, options);
  } catch (InputError const& e) {
    return e.what();
  }
  return "";
}

TEST(ReferencePairs, OfASingleRowInThreeDimensionsAreRefused) {
  ParticleSet const row = testing::box({1, 0.1, 0.1}, {11, 1, 1});
  PairOptions const options{find_kernel("cubic_spline"), 0.12, 0.12, 4, true};
  std::string const text = refusal(row, options);
  EXPECT_NE(text.find("body 'box'"), std::string::npos) << text;
  EXPECT_NE(text.find("too few"), std::string::npos) << text;
  EXPECT_NE(text.find("3 dimensions"), std::string::npos) << text;
  EXPECT_NE(text.find(" - use more particles across the body"), std::string::npos) << text;
}

TEST(ReferencePairs, OfASingleParticleAreRefusedWithItsPlaceAndNumber) {
  ParticleSet set = testing::box({1, 1, 1}, {1, 1, 1});
  for (bool const stencils : {true, false}) {
    std::string const text = refusal(set, {find_kernel("cubic_spline"), 1.2, 1.2, 1, stencils});
    EXPECT_NE(text.find("particle 0 at (0.5, 0.5, 0.5) m has 0 neighbours"), std::string::npos) << text;
  }
}

TEST(ReferencePairs, OfALayerInThreeDimensionsAreRefused) {
  ParticleSet const layer = testing::box({1, 1, 0.25}, {5, 5, 1});
  EXPECT_NE(refusal(layer, {find_kernel("cubic_spline"), 0.3, 0.3, 1, false}), "");
}

TEST(ReferencePairs, OfTwoParticlesInABarAreEnoughForAGradient) {
  ParticleSet const bar = unit_box(1, 2);
  EXPECT_EQ(refusal(bar, {find_kernel("cubic_spline"), 0.8, 0, 1, true}), "");
}

TEST(ReferencePairs, MentionBothTheGradientAndTheLaplacian) {
  // Two particles give a gradient, but linear and quadratic parts of the Laplacian cannot be distinguished.
  ParticleSet const bar = unit_box(1, 2);
  std::string const text = refusal(bar, {find_kernel("cubic_spline"), 1.2, 1.2, 1, true});
  EXPECT_NE(text.find("corrected Laplacian"), std::string::npos) << text;
}

// 27 corners, edges, faces and the inside at each of the two distances from them that the support reaches.
TEST(ReferencePairs, StoreTheCorrectionsOfALatticeOnceForEachPlaceInIt) {
  ParticleSet const set = testing::unit_box(3, 20);
  PairOptions options;
  options.kernel = find_kernel("cubic_spline");
  options.h_gradient = options.h_laplacian = 1.2 / 19;
  options.lanes = 4;
  testing::SeenPairs const seen(set, options);
  auto const& c = seen.pairs.corrections();
  EXPECT_LT(c.C.size(), 4000U);  // the pencils of a part of the body lie elsewhere in memory, too
  // Wherever two particles stand, both three or more layers inside, they have the same neighbours.
  auto const deep = [&](Index slot) {
    auto const& at = set.lattice_index[static_cast<std::size_t>(seen.order.id[static_cast<std::size_t>(slot)])];
    return std::all_of(at.begin(), at.end(), [](int n) { return n >= 3 && n <= 16; });
  };
  Index first = -1;
  for (Index a = 0; a < seen.order.particles; ++a) {
    if (!deep(a)) continue;
    if (first < 0) first = a;
    EXPECT_EQ(c.C[c.at(a)], c.C[c.at(first)]);
    EXPECT_EQ(c.diagonal[c.at(a)], c.diagonal[c.at(first)]);
  }
}

TEST(ReferencePairs, AreTheSameForAnyNumberOfThreads) {
  for (double const jitter : {0.0, 0.3}) {
    ParticleSet const set = testing::unit_box(3, 21, jitter);
    SlotOrder const order = pencil_order(set, set.bodies[0]);
    PairOptions options;
    options.kernel = find_kernel("cubic_spline");
    options.h_gradient = 1.1 / 20;
    options.h_laplacian = 1.3 / 20;
    options.lanes = 8;
    options.kernel_table = true;
    std::vector<double> const volume(static_cast<std::size_t>(order.slots()), 1.0 / 9261);
    auto const made = [&](int threads) {
      testing::Threads const some(threads);
      return std::make_unique<ReferencePairs>(set, set.bodies[0], order, options);
    };
    auto const one = made(1), three = made(3);
    EXPECT_EQ(one->corrections().kind, three->corrections().kind);
    EXPECT_EQ(one->corrections().C, three->corrections().C);
    EXPECT_EQ(one->corrections().diagonal, three->corrections().diagonal);
    EXPECT_EQ(one->make_filter(volume).scale, three->make_filter(volume).scale);
    if (jitter == 0) continue;
    ListTable const a = one->list(), b = three->list();
    for (std::int64_t k = 0; k < a.begin[order.slots()]; ++k) {
      ASSERT_EQ(a.neighbour[k], b.neighbour[k]);
      ASSERT_EQ(a.s[k], b.s[k]);
      ASSERT_EQ(a.l[k], b.l[k]);
    }
  }
}

}  // namespace
}  // namespace piola
