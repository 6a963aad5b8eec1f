// SPDX-License-Identifier: Apache-2.0
#include "piola/report/watch.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>
#include <limits>

namespace piola::report {
namespace {

using testing::TemporaryFolder;

TEST(LinePlot, RisesFromTheLowestToTheHighestBlock) {
  EXPECT_EQ(line_plot({0, 1}, {0, 7}, 2), "\u2581\u2588");
  EXPECT_EQ(line_plot({0, 1, 2, 3}, {0, 1, 2, 3}, 4), "\u2581\u2583\u2586\u2588");
  EXPECT_EQ(line_plot({0, 1, 2}, {5, 5, 5}, 3), "\u2581\u2581\u2581");
}

TEST(LinePlot, HoldsTheLastValueBetweenRowsAndIsBlankBeforeTheFirst) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(line_plot({0, 4}, {0, 1}, 5), "\u2581\u2581\u2581\u2581\u2588");
  EXPECT_EQ(line_plot({0, 1, 2}, {none, 1, 2}, 3), " \u2581\u2588");
  EXPECT_EQ(line_plot({}, {}, 5), "");
  EXPECT_EQ(line_plot({3}, {none}, 2), "  ");
}

void put_run(std::filesystem::path const& folder, std::string const& rows) {
  std::filesystem::create_directories(folder);
  write_whole_file(folder / "history.csv",
                   "time,step,total_energy,kinetic_energy,external_work,dt,top.velocity_x\n" + rows);
  write_whole_file(folder / "log.txt", "Piola 0.1.0: A spring\nmore\n");
  write_whole_file(folder / "lock", "1");
}

TEST(Watch, TellsEnergiesAndTheLastRow) {
  TemporaryFolder folder;
  put_run(folder / "r", "0,0,8,8,0,0.01,1\n0.5,50,8,2,0,0.01,-3\n");
  Watch watch(folder / "r", "top.velocity_x");
  auto const [text, over] = watch.look(80);
  EXPECT_FALSE(over);
  for (char const* part :
       {"A spring", "running, t = 500 ms, step 50", "kinetic energy                      2 J    25.00 %",
        "top.velocity x from -3 m/s to 1 m/s", "dt                       10 ms"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  EXPECT_EQ(text.find("external work"), std::string::npos) << "zero";
}

TEST(Watch, SeesThatTheRunHasEnded) {
  TemporaryFolder folder;
  put_run(folder / "r", "");
  Watch watch(folder / "r", "kinetic_energy");
  EXPECT_NE(watch.look(80).text.find("no row yet"), std::string::npos);
  write_whole_file(folder / "r/summary.json", R"({"status": "completed", "title": "A spring"})");
  std::filesystem::remove(folder / "r/lock");
  EXPECT_TRUE(watch.look(80).over);
}

TEST(Watch, RefusesColumnsAndFoldersThatAreNotThere) {
  TemporaryFolder folder;
  put_run(folder / "r", "0,0,8,8,0,0.01,1\n");
  EXPECT_THROW(Watch(folder / "r", "total_energi").look(80), InputError);
  EXPECT_THROW(Watch(folder / "nothing", "dt"), InputError);
}

}  // namespace
}  // namespace piola::report
