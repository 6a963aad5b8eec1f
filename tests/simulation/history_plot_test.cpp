// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/history_plot.hpp"
#include "piola/base/problems.hpp"
#include "piola/output/files.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::TemporaryFolder;

void put_history(std::filesystem::path const& folder, char const* last = "") {
  std::filesystem::create_directories(folder);
  write_whole_file(
      folder / "history.csv",
      "time,step,total_energy,kinetic_energy,strain_energy,external_work,stabilisation_loss,top.velocity_x\n"
      "0,0,5,5,0,0,0,1\n0.1,7,4,3,1,0,1,2\n" +
          std::string(last));
  write_whole_file(folder / "log.txt", "Piola 0.1.0: A spring\nmore\n");
}

TEST(HistoryPlots, ShowTheLedgerOfWhatIsNotZero) {
  TemporaryFolder folder;
  put_history(folder / "r");
  Plot const plot = history_plot(folder / "r", {});
  EXPECT_EQ(plot.title, "A spring");
  EXPECT_EQ(plot.y.unit, "J");
  EXPECT_EQ(plot.x.unit, "s");
  ASSERT_EQ(plot.curves.size(), 4u);
  EXPECT_EQ(plot.curves[3].label, "stabilisation loss");
  EXPECT_EQ(plot.curves[0].y, (std::vector<double>{5, 4}));
}

TEST(HistoryPlots, KnowEnergiesOfContactFromFieldsOfTheSameName) {
  EXPECT_EQ(unit_of_column("friction_heat"), "J");  // the field FrictionHeat is in J/m^2
  EXPECT_EQ(unit_of_column("contact_energy"), "J");
  EXPECT_EQ(unit_of_column("tie_failed"), "1");
  EXPECT_EQ(unit_of_column("place.friction_heat"), "J/m^2");
}

TEST(HistoryPlots, CompareRunsAndKnowUnits) {
  TemporaryFolder folder;
  put_history(folder / "a");
  put_history(folder / "b", "0.2,9,4,2,2,0,1,3\n");
  Plot const plot = history_plot(folder / "a", {.columns = {"top.velocity_x"}, .with = {folder / "b"}});
  ASSERT_EQ(plot.curves.size(), 2u);
  EXPECT_EQ(plot.y.unit, "m/s");
  EXPECT_EQ(plot.curves[1].label, "top.velocity x, b");
  EXPECT_EQ(plot.curves[1].y.size(), 3u);
  EXPECT_EQ(unit_of_column("ground.force_x"), "N");
  EXPECT_EQ(unit_of_column("anything"), "");
}

TEST(HistoryPlots, SayWhatIsWrong) {
  TemporaryFolder folder;
  EXPECT_THROW(history_plot(folder / "nowhere", {}), InputError);
  put_history(folder / "r");
  try {
    history_plot(folder / "r", {.columns = {"totl_energy", "x"}, .against = "tim"});
    FAIL();
  } catch (InputError const& error) {
    std::string const text = error.what();
    EXPECT_NE(text.find("totl_energy"), std::string::npos);
    EXPECT_NE(text.find("total_energy"), std::string::npos);
    EXPECT_NE(text.find("\"tim\""), std::string::npos);
  }
  EXPECT_THROW(history_plot(folder / "r", {.columns = {"total_energy", "top.velocity_x"}}), InputError);
}

}  // namespace
}  // namespace piola
