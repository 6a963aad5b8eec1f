// SPDX-License-Identifier: Apache-2.0
#include "piola/study/identification_plot.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::TemporaryFolder;

TEST(IdentificationPlot, HasThreeCurvesForEachNameWithGapsWhereNumbersAreMissing) {
  TemporaryFolder folder;
  EXPECT_TRUE(identified_curves_at(folder / "").empty());
  write_whole_file(folder / "curves.csv",
                   "curve,\"log(1, x)\",force,start,fitted\n"
                   "slow,0.1,200,210,201\nslow,0.2,250,,251\nfast,0.1,300,310,nan\n");
  std::filesystem::path const table = identified_curves_at(folder / "");
  ASSERT_EQ(table, folder / "curves.csv");
  Plot const plot = identification_plot(table, true, false);
  EXPECT_EQ(plot.x.name, "log(1, x)");
  EXPECT_TRUE(plot.x.logarithmic);
  EXPECT_EQ(plot.y.name, "force");
  ASSERT_EQ(plot.curves.size(), 6u);
  EXPECT_TRUE(plot.curves[0].marks);
  EXPECT_EQ(plot.curves[0].y, (std::vector<double>{200, 250}));
  EXPECT_EQ(plot.curves[1].y[0], 210);
  EXPECT_TRUE(std::isnan(plot.curves[1].y[1]));
  EXPECT_EQ(plot.curves[2].label, "slow");
  EXPECT_EQ(plot.curves[2].y, (std::vector<double>{201, 251}));
  EXPECT_EQ(plot.curves[5].label, "fast");
  EXPECT_NE(plot.curves[5].colour, plot.curves[2].colour);
}

TEST(IdentificationPlot, RefusesOtherTables) {
  TemporaryFolder folder;
  for (char const* const text : {"", "time,force\n1,2\n", "curve,x,y\n"}) {
    write_whole_file(folder / "curves.csv", text);
    EXPECT_THROW(identification_plot(folder / "curves.csv", false, false), InputError) << text;
  }
}

}  // namespace
}  // namespace piola
