// SPDX-License-Identifier: Apache-2.0
#include "piola/study/convergence.hpp"
#include "piola/study/convergence_table.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace piola {
namespace {

using Kind = Convergence::Kind;

Convergence of(std::vector<double> const& spacings, std::vector<double> const& values) {
  return convergence_of(spacings, values);
}

/// The values limit + c h^p.
std::vector<double> values_of(std::vector<double> const& spacings, double limit, double c, double p) {
  std::vector<double> values;
  for (double const h : spacings) values.push_back(limit + c * std::pow(h, p));
  return values;
}

TEST(Convergence, FindsTheOrderAndTheLimitOfAPower) {
  std::mt19937 random(3);
  for (int k = 0; k < 200; ++k) {
    auto const draw = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
    double const p = draw(0.6, 1.95), limit = draw(-5, 5), c = draw(0.5, 3) * (k % 2 == 0 ? 1 : -1);
    std::vector<double> const h{1, draw(0.5, 0.8), draw(0.2, 0.4)};  // ratios that are not alike
    Convergence const found = of(h, values_of(h, limit, c, p));
    ASSERT_EQ(found.kind, Kind::monotonic) << k;
    EXPECT_NEAR(*found.order, p, 1e-6) << k;
    EXPECT_NEAR(*found.extrapolated, limit, 1e-6) << k;
    EXPECT_NEAR(found.errors[0], 1.25 * std::abs(c), 1e-5) << k;
  }
}

TEST(Convergence, TakesNoHigherOrderThanThatOfTheFormulations) {
  std::vector<double> const h{1, 0.5, 0.25};
  Convergence const found = of(h, values_of(h, 1, 1, 4));
  EXPECT_NEAR(*found.order, 4, 1e-6);
  double const change = std::pow(0.5, 4) - std::pow(0.25, 4);
  EXPECT_NEAR(found.errors[2], 1.25 * change / 3, 1e-12);  // 3 = 2^2 - 1: four times the true one and more
  EXPECT_GT(found.errors[2], std::pow(0.25, 4));
}

TEST(Convergence, SaysWhereThereIsNone) {
  std::vector<double> const h{1, 0.5, 0.25};
  EXPECT_EQ(of(h, {1, 1.2, 1.1}).kind, Kind::oscillating);
  EXPECT_EQ(of(h, {1, 1.2, 1.2}).kind, Kind::oscillating);
  EXPECT_EQ(of(h, {1, 1.1, 1.3}).kind, Kind::diverging);
  EXPECT_EQ(of(h, values_of(h, 1, 1, 0.3)).kind, Kind::slow);
  EXPECT_EQ(of(h, {1, 1.1}).kind, Kind::missing);
  for (auto const& values : {std::vector<double>{1, 1.1, 1.3}, values_of(h, 1, 1, 0.3), {1, 1.1}}) {
    EXPECT_FALSE(of(h, values).has_errors());
    EXPECT_FALSE(of(h, values).extrapolated);
  }
  Convergence const unordered = of(h, {1, 1.2, 1.1});
  EXPECT_FALSE(unordered.order);
  EXPECT_NEAR(unordered.errors[2], 0.6, 1e-12);
  EXPECT_EQ(of(h, {2, 2 + 1e-14, 2}).kind, Kind::unchanged);
  EXPECT_EQ(of(h, {0, 0, 0}).kind, Kind::unchanged);
  EXPECT_EQ(of(h, {0, 0, 0}).errors[2], 0);
}

TEST(Convergence, OfTwoValuesHasAnErrorAndNoOrder) {
  Convergence const found = of({1, 0.5}, {1.25, 1.0625});  // 1 + h^2 / 4
  EXPECT_EQ(found.kind, Kind::two_values);
  EXPECT_FALSE(found.order);
  EXPECT_NEAR(found.errors[1], 3 * 0.0625, 1e-12);
  EXPECT_GE(of({1, 0.5}, {2, 1.5}).errors[1], 0.5);  // order 1 is covered
}

TEST(ConvergenceTable, TellsOrdersAndErrorsAndWhatDoesNotConverge) {
  auto const outcome = [](double a, double b) { return RunOutcome{"completed", {{"tip", a, "mm"}, {"kink", b, "1"}}}; };
  std::vector<QuantitySpec> quantities(2);
  quantities[0].name = "tip";
  quantities[0].unit = "mm";
  quantities[1].name = "kink";
  ConvergenceTable const table(quantities, {0.004, 0.002, 0.001},
                               {outcome(-1.128, 1), outcome(-1.032, 2), outcome(-1.008, 1)});
  EXPECT_TRUE(table.has_errors());
  std::string const text = table.text();
  for (char const* part : {"4 mm", "-1.128", "2.00", "-1 ", "error at 1 mm", "16 %", " 1 %",
                           "kink: does not converge monotonically", "300 %"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  std::string const csv = table.csv();
  EXPECT_NE(csv.find("tip,mm,-1.128,-1.032,-1.008,monotonic,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("kink,1,1,2,1,oscillating,,,3,3,3\n"), std::string::npos) << csv;
  quantities.resize(1);
  ConvergenceTable const failed(quantities, {0.004, 0.002, 0.001},
                                {outcome(-1.128, 1), {"failed", {{"tip", 5, "mm"}}}, outcome(-1.01, 1)});
  EXPECT_FALSE(failed.has_errors());
  EXPECT_NE(failed.text().find("a run has no value"), std::string::npos);
}

}  // namespace
}  // namespace piola
