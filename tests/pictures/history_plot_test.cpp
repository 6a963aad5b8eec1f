// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/history_plot.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
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
  EXPECT_EQ(unit_of_column("tie_failed_fraction"), "1");
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

TEST(HistoryPlots, NameTheSignOnTheAxis) {
  EXPECT_EQ(sign_of_column("pressure_min"), "tension positive");
  EXPECT_EQ(sign_of_column("tip.compressive_pressure"), "compression positive");
  EXPECT_EQ(sign_of_column("tip.cauchy_stress_xx"), "tension positive");
  EXPECT_EQ(sign_of_column("tip.cauchy_stress_xy"), "");
  EXPECT_EQ(sign_of_column("pressure_oscillation"), "");
  TemporaryFolder folder;
  write_whole_file(folder / "history.csv", std::string("time,pressure_min,pressure_max\n0,0,0\n1,-5,7\n"));
  EXPECT_EQ(history_plot(folder.path(), {.columns = {"pressure_max"}}).y.name, "pressure max, tension positive");
  EXPECT_EQ(history_plot(folder.path(), {.columns = {"pressure_min", "pressure_max"}}).y.name,
            "value, tension positive");
}

TEST(HistoryPlots, DrawRoundOffAsZeroAndSaySo) {
  TemporaryFolder folder;
  write_whole_file(folder / "history.csv",
                   std::string("time,kinetic_energy,damping_loss,linear_momentum_x,linear_momentum_y,tip.velocity_x,"
                               "tip.velocity_y,pressure_max\n"
                               "0,50,0,1e-14,0,2,1e-16,1e-5\n1,40,-3e-15,-4e-13,2e-14,3,-2e-16,2e-5\n"));
  auto const plot = [&](std::vector<std::string> columns, bool log_y = false) {
    return history_plot(folder.path(), {.columns = std::move(columns), .log_y = log_y});
  };
  EXPECT_EQ(plot({"linear_momentum_x"}).remark, "") << "nothing is known to compare it with";
  write_whole_file(folder / "summary.json", std::string(R"({"scales": {"kg m/s": 10, "Pa": 2e11}})"));
  for (char const* name : {"damping_loss", "linear_momentum_x", "tip.velocity_y", "pressure_max"}) {
    Plot const flat = plot({name});
    EXPECT_EQ(flat.curves[0].y, (std::vector<double>{0, 0})) << name;
    EXPECT_NE(flat.remark.find("zero to rounding (below "), std::string::npos) << name;
  }
  EXPECT_EQ(plot({"tip.velocity_x"}).remark, "");
  EXPECT_EQ(plot({"tip.velocity_x", "tip.velocity_y"}).curves[1].y[1], -2e-16) << "beside what is none";
  EXPECT_EQ(plot({"pressure_max"}, true).curves[0].y[1], 2e-5) << "a logarithmic axis shows what there is";
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
