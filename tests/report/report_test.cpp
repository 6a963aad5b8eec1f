// SPDX-License-Identifier: Apache-2.0
#include "piola/report/report.hpp"
#include "piola/base/errors.hpp"
#include "piola/report/page.hpp"
#include "piola/report/page_budget.hpp"
#include "piola/simulation/run_case.hpp"
#include "support/fake_formulation.hpp"
#include "support/temporary_folder.hpp"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>

namespace piola::report {
namespace {

using testing::TemporaryFolder;

/// The results of a few particles on springs: five frames.
struct Results {
  TemporaryFolder folder;
  explicit Results(int n = 4) {
    Simulation s = testing::make_springs(n);
    Listener listener;
    std::atomic<int> const none{0};
    run_case(s, {.folder = folder / "r"}, listener, none);
  }
  std::filesystem::path run() const { return folder / "r"; }
};

TEST(Spread, TakesTheFirstTheLastAndSomeEvenlyBetween) {
  using Numbers = std::vector<std::size_t>;
  EXPECT_EQ(spread(5, 9), (Numbers{0, 1, 2, 3, 4}));
  EXPECT_EQ(spread(21, 3), (Numbers{0, 10, 20}));
  EXPECT_EQ(spread(10, 4), (Numbers{0, 3, 6, 9}));
  EXPECT_EQ(spread(7, 1), Numbers{6});
  EXPECT_TRUE(spread(0, 3).empty());
  for (std::size_t count = 2; count < 60; ++count)
    for (std::size_t wanted = 2; wanted <= count; ++wanted) {
      auto const numbers = spread(count, wanted);
      ASSERT_EQ(numbers.size(), wanted);
      EXPECT_EQ(numbers.front(), 0u);
      EXPECT_EQ(numbers.back(), count - 1);
      EXPECT_TRUE(std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) == numbers.end());
    }
}

TEST(FrameStatistics, KnowsTheBoxAndTheExtremesOfEachFrame) {
  Results const results;
  RunFolder const run = open_run(results.run());
  FrameStatistics const statistics = read_statistics(run, {0, 2, 4}, {"Velocity"});
  EXPECT_EQ(statistics.particles, 16u);
  EXPECT_EQ(statistics.dimension, 2);
  EXPECT_EQ(statistics.outside, 0u);
  ASSERT_EQ(statistics.fields.size(), 1u);
  ASSERT_EQ(statistics.fields[0].extremes.size(), 3u);
  FrameReader const frame(run.frames[2].second);
  auto const v = frame.values("Velocity");
  double most = 0;
  for (std::size_t i = 0; i < 16; ++i) most = std::max<double>(most, std::hypot(v[3 * i], v[3 * i + 1]));
  EXPECT_NEAR(statistics.fields[0].extremes[1][1], most, 1e-6 * most);
  for (auto const& point : frame.positions())
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_LE(statistics.low[c], point[c]);
      EXPECT_GE(statistics.high[c], point[c]);
    }
  EXPECT_EQ(statistics.radius.size(), 1u);
  EXPECT_GT(statistics.radius[0], 0.5);
}

TEST(FrameStatistics, CutsTheBoxWhereOneParticleFliesFarAndSaysSo) {
  TemporaryFolder const folder;
  Simulation s = testing::make_springs(60);
  s.particles.X[3599] = {1e6, 0, 0};
  Listener listener;
  std::atomic<int> const none{0};
  run_case(s, {.folder = folder / "r"}, listener, none);
  RunFolder const run = open_run(folder / "r");
  FrameStatistics const statistics = read_statistics(run, {0, 1}, {});
  EXPECT_LT(statistics.high[0], 200);
  EXPECT_EQ(statistics.outside, 1u);
  Lattice const lattice = Lattice::of(statistics.low, statistics.high, 14);
  FrameCodes const codes = codes_of(FrameReader(run.frames[0].second), statistics, lattice, 0, 1);
  EXPECT_EQ(codes.x[0][3599], lattice.missing());
  EXPECT_NE(codes.x[0][3598], lattice.missing());
}

TEST(Plan, GivesUpFieldsThenFramesThenBitsThenParticles) {
  Results const results(40);
  RunFolder const run = open_run(results.run());
  FrameStatistics const statistics = read_statistics(run, {0, 1, 2, 3, 4}, {"Velocity", "Displacement", "Pressure"});
  Plan const all{.frames = {0, 1, 2, 3, 4}, .fields = 3};
  auto const plan = [&](double bytes) {
    return fitting_plan(run, statistics, all, {.bytes = bytes, .least_fields = 1}, {});
  };
  EXPECT_EQ(plan(1e9).fields, 3u);
  EXPECT_TRUE(plan_notes(plan(1e9), all, statistics, 1e9).empty());
  Plan last = plan(1e9);
  bool fields_went = false, bits_went = false, particles_went = false;
  for (double bytes = 1e5; bytes > 300; bytes /= 1.2) {
    Plan const now = plan(bytes);
    EXPECT_LE(now.fields, last.fields);
    EXPECT_LE(now.bits, last.bits);
    EXPECT_GE(now.every, last.every);
    EXPECT_TRUE(now.bits == 14 || now.fields == 1u);
    EXPECT_TRUE(now.every == 1 || now.bits == 12);
    EXPECT_EQ(now.frames.size(), 5u) << "twelve frames are never too many";
    fields_went |= now.fields == 1;
    bits_went |= now.bits == 12;
    particles_went |= now.every > 1;
    last = now;
  }
  EXPECT_TRUE(fields_went && bits_went && particles_went);
  auto const notes = plan_notes(last, all, statistics, 300);
  ASSERT_EQ(notes.size(), 1u);
  for (char const* part : {"1 of 3 fields", "12 bits", "one particle in", "300 B"})
    EXPECT_NE(notes[0].find(part), std::string::npos) << part << " in " << notes[0];
}

TEST(Plan, LeavesBallsRoundBeforeAllElse) {
  Results const results(40);
  RunFolder const run = open_run(results.run());
  FrameStatistics const statistics = read_statistics(run, {0, 4}, {"Velocity"});
  Plan const all{.frames = {0, 1}, .fields = 1, .stretched = true};
  Plan const less = fitting_plan(run, statistics, all, {.bytes = 100, .least_fields = 1}, {});
  EXPECT_FALSE(less.stretched);
  EXPECT_NE(plan_notes(less, all, statistics, 100).at(0).find("round balls"), std::string::npos);
}

TEST(PageSurfaces, PackNumbersBelowTwoToTheThirtyTwo) {
  auto const bytes = encode_large_numbers({5, 70000, 4294967295});
  EXPECT_EQ(bytes.size(), 12u);
  EXPECT_EQ(bytes[0], 10u);  // + 5, the sign in the lowest bit
}

TEST(Plan, LetsBallsGrowWhereSomeAreLeftOut) {
  Results const results;
  RunFolder const run = open_run(results.run());
  FrameStatistics const statistics = read_statistics(run, {0, 4}, {});
  auto const about = about_frames(run, statistics, {.frames = {0, 1}, .every = 4});
  EXPECT_EQ(about["particles"], 4);
  EXPECT_DOUBLE_EQ(about["bodies"][0]["radius"].get<double>(), 2 * statistics.radius[0]);  // a plate: two dimensions
  EXPECT_EQ(about["bodies"][0]["name"], "body 0");                                         // its case cannot be read
}

TEST(Report, KeepsItsBudget) {
  Results const results(100);
  auto const page = results.folder / "page.html";
  auto const whole = write_report(results.run(), page, {});
  EXPECT_TRUE(whole.notes.empty()) << whole.notes.front();
  auto const small = write_report(results.run(), page, {.budget = 0.9 * whole.bytes});
  EXPECT_LE(small.bytes, 0.9 * whole.bytes);
  EXPECT_EQ(small.bytes, static_cast<double>(std::filesystem::file_size(page)));
  EXPECT_EQ(small.notes.size(), 1u);
}

TEST(Report, IsWrittenOfARunThatGoesOn) {
  Results const results;
  auto const page = results.folder / "page.html";
  std::filesystem::remove(results.run() / "summary.json");
  EXPECT_EQ(write_report(results.run(), page, {.reload = 7}).status, "broken off");
  EXPECT_NE(testing::text_of(page).find("\"reload\":0"), std::string::npos);
  std::ofstream(results.run() / "lock") << "1";
  EXPECT_EQ(write_report(results.run(), page, {.reload = 7}).status, "running");
  EXPECT_NE(testing::text_of(page).find("\"reload\":7"), std::string::npos);
}

TEST(Report, LeavesTheOldPageIfItCannotBeWritten) {
  Results const results;
  EXPECT_THROW(write_report(results.run(), results.folder / "nowhere/page.html", {}), FileError);
  EXPECT_THROW(write_report(results.run(), results.folder / "page.html", {.fields = {"Colour"}}), InputError);
  EXPECT_FALSE(std::filesystem::exists(results.folder / "page.html"));
  EXPECT_FALSE(std::filesystem::exists(results.folder / "page.html.part"));
}

TEST(Report, ExplainsAFailure) {
  Results const results;
  std::ofstream(results.run() / "summary.json") << R"({"status": "failed", "title": "Springs"})";
  std::ofstream(results.run() / "log.txt") << "Piola 0.1.0: Springs\nstopped at step 7, t = 1 s: particle 12 (body "
                                              "'plate', X = (0, 0, 0) m) is inverted\n  why\n";
  RunFolder const run = open_run(results.run());
  EXPECT_EQ(failed_particle(run.failure), 12);
  EXPECT_EQ(about_run(run)["failure"].get<std::string>().substr(0, 17), "stopped at step 7");
  EXPECT_EQ(failed_particle("stopped at step 7: the energy is not finite"), -1);
}

TEST(Page, EscapesWhatIsNotItsOwn) {
  EXPECT_EQ(escaped("<a href='x'>&\"</a>"), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;&lt;/a&gt;");
  std::string const text = script_text(Json{{"title", "</script><!-- <script>"}});
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(Json::parse(text)["title"], "</script><!-- <script>");
  EXPECT_EQ(Json::parse(script_text(Json("\xff"))), "\xef\xbf\xbd");
}

}  // namespace
}  // namespace piola::report
