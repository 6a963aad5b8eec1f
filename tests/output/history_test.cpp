// SPDX-License-Identifier: Apache-2.0
#include "piola/output/history.hpp"
#include "piola/base/errors.hpp"
#include "support/key_words.hpp"
#include "support/temporary_folder.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

using test::expect_words;

std::vector<HistoryColumn> const columns{{"time", "s"}, {"energy", "J"}};

TEST(History, StartsWithTheAgreedColumns) {
  Diagnostics d;
  d.more = {{"plastic_work", 1}};
  auto const names = diagnostic_columns(d);
  std::string line;
  for (auto const& c : names) line += (line.empty() ? "" : ",") + c.name;
  EXPECT_EQ(line,
            "time,step,dt,kinetic_energy,strain_energy,total_energy,stabilisation_loss,external_work,linear_momentum_x,"
            "linear_momentum_y,"
            "linear_momentum_z,angular_momentum_x,angular_momentum_y,angular_momentum_z,jacobian_min,jacobian_max,"
            "pressure_min,pressure_max,"
            "pressure_oscillation,projection_loss,damping_loss,plastic_work");
  EXPECT_EQ(diagnostic_values(1, 2, 3, d).size(), names.size());
  EXPECT_EQ(names.back().unit, "J");
}

TEST(History, WritesTheShortestNumbersThatReadBackAsTheSame) {
  testing::TemporaryFolder const folder;
  HistoryFile file(folder / "history.csv", columns);
  file.append({0.1, 1.0 / 3});
  EXPECT_EQ(testing::text_of(folder / "history.csv"), "time,energy\n0.1,0.3333333333333333\n");
  HistoryFile const again(folder / "history.csv", columns, 1);
  EXPECT_EQ(again.table().rows.at(0).at(1), 1.0 / 3);
}

TEST(History, LeavesACellEmptyRatherThanWriteNan) {
  testing::TemporaryFolder const folder;
  HistoryFile file(folder / "history.csv", columns);
  EXPECT_EQ(file.append({1, std::numeric_limits<double>::quiet_NaN()}), std::vector<std::string>{"energy"});
  file.append({std::numeric_limits<double>::infinity(), 2});
  EXPECT_EQ(testing::text_of(folder / "history.csv"), "time,energy\n1,\n,2\n");
  HistoryFile const again(folder / "history.csv", columns, 1);
  EXPECT_TRUE(std::isnan(again.table().rows.at(0).at(1)));
}

TEST(History, IsCutAfterTheTimeOfTheCheckpoint) {
  testing::TemporaryFolder const folder;
  {
    HistoryFile file(folder / "history.csv", columns);
    for (double t : {0.0, 0.1, 0.2, 0.3}) file.append({t, 2 * t});
  }
  {
    HistoryFile file(folder / "history.csv", columns, 0.2);
    EXPECT_EQ(file.table().rows.size(), 3U);
    file.append({0.25, 7});
  }
  EXPECT_EQ(testing::text_of(folder / "history.csv"), "time,energy\n0,0\n0.1,0.2\n0.2,0.4\n0.25,7\n");
}

TEST(History, DropsALineThatWasNotFinished) {
  testing::TemporaryFolder const folder;
  std::ofstream(folder / "history.csv") << "time,energy\n0,1\n0.1,";
  HistoryFile const file(folder / "history.csv", columns, 5);
  EXPECT_EQ(testing::text_of(folder / "history.csv"), "time,energy\n0,1\n");
}

/// Four rows, of which a checkpoint counts on the first three.
HistoryMark written(std::filesystem::path const& path) {
  HistoryFile file(path, columns);
  for (double t : {0.0, 0.1, 0.2}) file.append({t, 2 * t});
  HistoryMark const mark = file.mark();
  file.append({0.3, 0.6});
  return mark;
}

TEST(History, IsContinuedWithoutComplaintWhereTheCheckpointLeftIt) {
  testing::TemporaryFolder const folder;
  HistoryMark const mark = written(folder / "history.csv");
  HistoryFile file(folder / "history.csv", columns, 0.2, mark);
  EXPECT_EQ(file.repair_note(), "");
  EXPECT_EQ(file.mark().bytes, mark.bytes);
  EXPECT_EQ(file.mark().check_sum, mark.check_sum);
  EXPECT_EQ(testing::text_of(folder / "history.csv"), "time,energy\n0,0\n0.1,0.2\n0.2,0.4\n");
  file.append({0.3, 0.6});
  EXPECT_EQ(file.mark().rows, 4U);
}

TEST(History, TellsOfRowsThatAreMissingOrWereChanged) {
  testing::TemporaryFolder const folder;
  HistoryMark const mark = written(folder / "history.csv");
  std::ofstream(folder / "history.csv") << "time,energy\n0,0\n0.2,0.4\n";
  expect_words(HistoryFile(folder / "history.csv", columns, 0.2, mark).repair_note(),
               {"history.csv: 2 rows up to t = 0.2 s", "checkpoint counts on 3", "rows are missing"});
  std::ofstream(folder / "history.csv") << "time,energy\n0,0\n0.1,0.2\n0.2,0.5\n";
  EXPECT_NE(HistoryFile(folder / "history.csv", columns, 0.2, mark).repair_note(), "");
  std::filesystem::remove(folder / "history.csv");
  HistoryFile const anew(folder / "history.csv", columns, 0.2, mark);
  EXPECT_NE(anew.repair_note().find("the file was missing and starts here"), std::string::npos) << anew.repair_note();
  EXPECT_EQ(testing::text_of(folder / "history.csv"), "time,energy\n");
}

TEST(History, GivesColumnsOfThePreviousReleaseTheirPresentNames) {
  testing::TemporaryFolder const folder;
  std::vector<HistoryColumn> const before{{"time", "s"}, {"tie_heat", "J"}, {"stone.turn_z", "rad"}},
      now{{"time", "s"}, {"tie_dissipation", "J"}, {"stone.rotation_z", "rad"}};
  HistoryMark mark;
  {
    HistoryFile file(folder / "history.csv", before);
    for (double const t : {0.0, 0.1, 0.2}) file.append({t, 2 * t, 3 * t});
    mark = file.mark();
  }
  HistoryTable const table = read_history(folder / "history.csv");
  EXPECT_EQ(table.values("tie_dissipation"), (std::vector<double>{0, 0.2, 0.4}));
  EXPECT_TRUE(table.find("stone.rotation_z"));
  HistoryFile resumed(folder / "history.csv", now, 0.2, mark);
  EXPECT_EQ(resumed.repair_note(), "");
  EXPECT_EQ(resumed.table().rows.size(), 3U);
  resumed.append({0.3, 1, 2});
  EXPECT_TRUE(testing::text_of(folder / "history.csv").starts_with("time,tie_dissipation,stone.rotation_z\n0,0,0\n"));
  EXPECT_EQ(read_history(folder / "history.csv").rows.size(), 4U);
}

TEST(History, RefusesAFileWithOtherColumns) {
  testing::TemporaryFolder const folder;
  std::ofstream(folder / "history.csv") << "time,mass\n0,1\n";
  EXPECT_THROW(HistoryFile(folder / "history.csv", columns, 5), FileError);
}

}  // namespace
}  // namespace piola
