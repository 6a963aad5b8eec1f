// SPDX-License-Identifier: Apache-2.0
// What checks expect, drawn into plots.
#include "piola/report/plot_references.hpp"
#include <gtest/gtest.h>
#include <numbers>

namespace piola::report {
namespace {

QuantitySpec quantity(std::string name, std::string column, QuantitySpec::Statistic take) {
  QuantitySpec q;
  q.name = std::move(name);
  q.column = std::move(column);
  q.take = take;
  return q;
}

VerificationRow row(std::string quantity, double reference, std::string unit, std::string tolerance = "within 1 %") {
  VerificationRow r;
  r.quantity = std::move(quantity);
  r.reference = reference;
  r.unit = std::move(unit);
  r.tolerance = std::move(tolerance);
  r.evidence = "published";
  return r;
}

RunFolder run() {
  RunFolder run;
  run.spec.emplace();
  run.spec->quantities = {quantity("peak", "top.twist_angle", QuantitySpec::Statistic::maximum),
                          quantity("when", "top.twist_angle", QuantitySpec::Statistic::time_of_maximum),
                          quantity("change", "top.twist_angle", QuantitySpec::Statistic::change),
                          quantity("other", "kinetic_energy", QuantitySpec::Statistic::maximum)};
  return run;
}

Plot plot() {
  Plot p;
  p.curves = {{.label = "twist", .x = {0, 0.1, 0.2}, .y = {0, 3, 1}}};
  return p;
}

TEST(PlotReferences, AreLinesAcrossAndUpright) {
  Plot p = plot();
  EXPECT_EQ(add_references(p, run(), {row("peak", 180, "degree"), row("when", 100, "ms")}, {"top.twist_angle"}), 2);
  ASSERT_EQ(p.curves.size(), 3U);
  EXPECT_EQ(p.curves[1].x, (std::vector<double>{0, 0.2}));
  EXPECT_NEAR(p.curves[1].y[0], std::numbers::pi, 1e-12);
  EXPECT_EQ(p.curves[1].y[0], p.curves[1].y[1]);
  EXPECT_EQ(p.curves[1].label, "published");
  EXPECT_NEAR(p.curves[2].x[0], 0.1, 1e-15);
  EXPECT_EQ(p.curves[2].y, (std::vector<double>{0, 3}));
}

TEST(PlotReferences, AreRingsAtTimesAndCurvesOfFormulas) {
  RunFolder with = run();
  with.spec->quantities.push_back(quantity("then", "top.twist_angle", QuantitySpec::Statistic::at_time));
  with.spec->quantities.back().time = 0.05;
  with.spec->quantities.push_back(quantity("off", "top.twist_angle", QuantitySpec::Statistic::relative_error));
  with.spec->quantities.back().reference = Expression("3 * t");
  with.spec->quantities.back().from = 0.1;
  Plot p = plot();
  EXPECT_EQ(add_references(p, with, {row("then", 2, "rad"), row("off", 0.01, "1", "below"), row("then", 2, "rad")},
                           {"top.twist_angle"}),
            2);
  ASSERT_EQ(p.curves.size(), 3U);
  EXPECT_TRUE(p.curves[1].marks);
  EXPECT_EQ(p.curves[1].x, std::vector<double>{0.05});
  EXPECT_EQ(p.curves[1].y, std::vector<double>{2});
  EXPECT_FALSE(p.curves[2].marks);
  EXPECT_EQ(p.curves[2].x.front(), 0.1);
  EXPECT_EQ(p.curves[2].x.back(), 0.2);
  EXPECT_NEAR(p.curves[2].y.back(), 0.6, 1e-15);
}

TEST(PlotReferences, LeaveOutWhatIsNoValueOfTheColumn) {
  Plot p = plot();
  EXPECT_EQ(add_references(p, run(),
                           {row("change", 1, "rad"), row("other", 1, "J"), row("unknown", 1, "1"),
                            row("peak", 3, "rad", "below"), row("peak", 3, "kg")},
                           {"top.twist_angle"}),
            0);
  EXPECT_EQ(p.curves.size(), 1U);
  RunFolder without = run();
  without.spec.reset();
  EXPECT_EQ(add_references(p, without, {row("peak", 3, "rad")}, {"top.twist_angle"}), 0);
}

}  // namespace
}  // namespace piola::report
