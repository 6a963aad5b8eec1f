// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/run_case.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/image.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/output/frame_reader.hpp"
#include "piola/output/frames.hpp"
#include "piola/simulation/run_summary.hpp"
#include "support/fake_formulation.hpp"
#include "support/key_words.hpp"
#include "support/read_png.hpp"
#include "support/scripted_run.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

using test::expect_words;
using testing::make_springs;
using testing::springs;
using testing::TemporaryFolder;
using testing::text_of;

CaseOutcome run(Simulation& s, std::filesystem::path const& folder, bool resume = false,
                std::atomic<int>* stop = nullptr) {
  Listener listener;
  std::atomic<int> none{0};
  return run_case(s, {.folder = folder, .resume = resume, .force = false}, listener, stop ? *stop : none);
}

Simulation probed() {
  Simulation s = make_springs();
  ProbeSpec probe;
  probe.name = "all";
  probe.body = "plate";
  probe.kind = ProbeSpec::Kind::twist;
  probe.axis = 2;
  s.spec.probes.push_back(probe);
  s.spec.quantities.push_back({.name = "twist",
                               .column = "all.twist_angle",
                               .take = QuantitySpec::Statistic::first_peak,
                               .reference = {},
                               .unit = "degree"});
  return s;
}

/// Files that a resumed run must leave like an uninterrupted one.
void expect_same_results(std::filesystem::path const& a, std::filesystem::path const& b) {
  for (char const* name :
       {"history.csv", "frames.hdf.series", "frames/000000.hdf", "frames/000003.hdf", "frames/000004.hdf"}) {
    EXPECT_TRUE(text_of(a / name) == text_of(b / name)) << name;
  }
  auto const ca = list_checkpoints(a), cb = list_checkpoints(b);
  ASSERT_FALSE(ca.empty());
  ASSERT_FALSE(cb.empty());
  EXPECT_EQ(read_checkpoint(ca[0]).state.arrays(), read_checkpoint(cb[0]).state.arrays());
  EXPECT_EQ(read_checkpoint(ca[0]).observers.arrays(), read_checkpoint(cb[0]).observers.arrays());
}

TEST(RunCase, TheSummaryTellsWhereTheTimeWent) {
  TemporaryFolder const folder;
  Simulation s = make_springs();
  CaseOutcome const outcome = run(s, folder.path());
  auto const summary = nlohmann::json::parse(text_of(folder / "summary.json"));
  EXPECT_EQ(summary["seconds"]["springs"], 0.5 * static_cast<double>(outcome.summary.steps));
  EXPECT_EQ(text_of(folder / "history.csv").find("springs"), std::string::npos);
}

// Warnings of the case are reported before the first step, and by a resumed run again.
TEST(RunCase, TellsTheWarningsOfTheCase) {
  struct Ear : Listener {
    std::vector<std::string> heard;
    void warning(std::string const& text) override { heard.push_back(text); }
  } ear;
  TemporaryFolder const folder;
  std::atomic<int> stop{0};
  for (bool const resume : {false, true}) {
    Simulation s = make_springs();
    s.warnings = {"case.toml:1:1: the springs are odd - choose others"};
    ear.heard.clear();
    run_case(s, {.folder = folder / "r", .resume = resume, .force = false}, ear, stop);
    EXPECT_EQ(ear.heard, s.warnings);
    EXPECT_EQ(nlohmann::json::parse(text_of(folder / "r/summary.json"))["warnings"][0], s.warnings[0]);
    EXPECT_NE(text_of(folder / "r/log.txt").find("warning: " + s.warnings[0]), std::string::npos);
  }
}

TEST(RunCase, MomentaDriftOnlyWhereNothingHoldsOrPushes) {
  TemporaryFolder const folder;
  Simulation s = make_springs();
  EXPECT_TRUE(run(s, folder / "free").summary.linear_drift);
  for (int kind = 0; kind < 3; ++kind) {
    Simulation held = make_springs();
    if (kind == 0) held.spec.supports.emplace_back();
    if (kind == 1) held.spec.loads.emplace_back();
    if (kind == 2) held.spec.mirrors.emplace_back();
    Summary const summary = run(held, folder / std::to_string(kind)).summary;
    EXPECT_FALSE(summary.linear_drift || summary.angular_drift);
  }
}

TEST(RunCase, WritesAllThatAUserExpects) {
  TemporaryFolder const folder;
  Simulation s = probed();
  s.spec.output.pictures.every = 0.5;
  s.spec.output.pictures.width = 300;
  s.spec.output.pictures.height = 240;
  CaseOutcome const outcome = run(s, folder / "r");
  EXPECT_EQ(outcome.ending, RunStatus::completed);
  for (char const* name : {"history.csv", "summary.json", "frames.hdf.series", "case.toml", "log.txt",
                           "frames/000004.hdf", "pictures/Pressure-000002.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "r" / name)) << name;
  }
  EXPECT_EQ(outcome.last_picture.filename(), "Pressure-000002.png");
  auto const summary = nlohmann::json::parse(text_of(folder / "r/summary.json"));
  EXPECT_EQ(summary["status"], "completed");
  EXPECT_EQ(summary["end_time"], 1.0);
  EXPECT_EQ(summary["particles"], 16);
  EXPECT_EQ(summary["quantities"]["twist"]["unit"], "degree");
  EXPECT_GT(summary["stages_per_second"], 0.0);
  EXPECT_TRUE(text_of(folder / "r/log.txt").starts_with("Piola "));
  EXPECT_EQ(list_frames(folder / "r").back().first, 1.0);
}

/// The colour bar with its numbers.
std::vector<Colour> bar_of(Image const& image) {
  std::vector<Colour> pixels;
  for (int y = image.height / 5; y < image.height; ++y)
    for (int x = image.width - 100; x < image.width; ++x) pixels.push_back(image.at(x, y));
  return pixels;
}

Simulation pictured() {
  Simulation s = probed();
  s.spec.output.pictures.every = 0.25;
  s.spec.output.pictures.field = "Displacement";  // starts at zero: the first range is not that of the run
  return s;
}

TEST(RunCase, DrawsAllPicturesWithTheColoursOfTheWholeRun) {
  TemporaryFolder const folder;
  Simulation s = pictured();
  run(s, folder / "r");
  Image const first = testing::read_png(folder / "r/pictures/Displacement-000000.png");
  EXPECT_EQ(bar_of(first), bar_of(testing::read_png(folder / "r/pictures/Displacement-000003.png")));
  Simulation given = pictured();
  given.spec.output.pictures.range = std::array{0.0, 1.0};
  run(given, folder / "given");
  EXPECT_NE(bar_of(first), bar_of(testing::read_png(folder / "given/pictures/Displacement-000000.png")));
}

TEST(RunCase, WritesAFrameForEachPicture) {
  TemporaryFolder const folder;
  Simulation both = pictured(), alone = pictured(), failed = pictured();
  both.spec.output.frames_every = 0.5;
  run(both, folder / "both");
  std::vector<double> times;
  for (auto const& [time, path] : list_frames(folder / "both")) times.push_back(time);
  ASSERT_EQ(times.size(), 5U) << "one where both are due";
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_TRUE(FrameReader(folder / "both/frames/000001.hdf").knows("Velocity"));

  alone.spec.output.frames_every = failed.spec.output.frames_every = 0;
  run(alone, folder / "alone");
  EXPECT_EQ(FrameReader(folder / "alone/frames/000004.hdf").fields(),
            (std::vector<std::string>{"Body", "Displacement", "Id", "Volume"}));
  for (char const* number : {"000000", "000003", "000004"}) {
    auto const picture = std::string("pictures/Displacement-").append(number).append(".png");
    EXPECT_TRUE(text_of(folder / "both" / picture) == text_of(folder / "alone" / picture)) << number;
  }

  springs(failed).fail_at = 40;
  EXPECT_EQ(run(failed, folder / "failed").last_picture.filename(), "Displacement-000002.png");
  EXPECT_TRUE(FrameReader(folder / "failed/frames/000002.hdf").knows("Velocity")) << "the last state has all fields";
}

TEST(RunCase, DrawsWhatItCanIfAnEarlierFrameIsMissing) {
  TemporaryFolder const folder;
  Simulation first = pictured(), second = pictured();
  std::atomic<int> stop{0};
  springs(first).stop_at = 57;
  springs(first).stop = &stop;
  run(first, folder / "r", false, &stop);
  std::filesystem::remove(folder / "r/frames/000001.hdf");
  CaseOutcome const outcome = run(second, folder / "r", true);
  EXPECT_EQ(outcome.ending, RunStatus::completed);
  EXPECT_EQ(outcome.last_picture.filename(), "Displacement-000004.png");
  EXPECT_TRUE(std::any_of(outcome.summary.warnings.begin(), outcome.summary.warnings.end(), [](auto const& warning) {
    return warning.find("pictures: 1 of 4 frames are not drawn: ") != std::string::npos;
  }));
}

TEST(RunCase, DrawsTheSamePicturesAfterAStop) {
  TemporaryFolder const folder;
  Simulation whole = pictured(), first = pictured(), second = pictured();
  run(whole, folder / "whole");
  std::atomic<int> stop{0};
  springs(first).stop_at = 57;
  springs(first).stop = &stop;
  run(first, folder / "parts", false, &stop);
  EXPECT_TRUE(std::filesystem::exists(folder / "parts/pictures/Displacement-000002.png"))
      << "the last one does not wait";
  run(second, folder / "parts", true);
  for (char const* name : {"000000", "000002", "000004"}) {
    auto const picture = std::string("pictures/Displacement-") + name + ".png";
    EXPECT_TRUE(text_of(folder / "whole" / picture) == text_of(folder / "parts" / picture)) << name;
  }
}

/// Half of the plate sets off along x: it is drawn out to 2.55 times its spacing at the fourth picture, and is back at
/// 2.41 at the last one.
Simulation torn() {
  Simulation s = pictured();
  s.spec.output.pictures.labels = false;
  std::vector<double> u(3 * s.particles.X.size()), v = u;
  for (std::size_t i = 0; i < s.particles.X.size(); ++i)
    if (s.particles.X[i][0] > 1.5) v[3 * i] = 3.1;
  NamedState state;
  state.put("u", u);
  state.put("v", v);
  state.put("steps", std::array{0.0});
  s.formulation->load(state);
  return s;
}

// The last picture shows it torn only because it was torn before the stop.
TEST(RunCase, RemembersWhatIsTornOverAStop) {
  TemporaryFolder const folder;
  Simulation whole = torn(), first = torn(), second = torn();
  run(whole, folder / "whole");
  std::atomic<int> stop{0};
  springs(first).stop_at = 85;
  springs(first).stop = &stop;
  run(first, folder / "parts", false, &stop);
  run(second, folder / "parts", true);
  std::string const last = "pictures/Displacement-000004.png";
  Image const image = testing::read_png(folder / "whole" / last);
  EXPECT_EQ(image.at(image.width / 2, image.height / 2), (Colour{255, 255, 255})) << "a gap between the halves";
  EXPECT_TRUE(text_of(folder / "whole" / last) == text_of(folder / "parts" / last));

  Simulation never = torn();  // has no picture of the moment when it is torn
  never.spec.output.pictures.every = 0.5;
  run(never, folder / "never");
  Image const closed = testing::read_png(folder / "never/pictures/Displacement-000002.png");
  EXPECT_NE(closed.at(closed.width / 2, closed.height / 2), (Colour{255, 255, 255}));
}

/// Two panels: the same field from two sides, or two fields.
Simulation pictured_twice(std::string const& other_field) {
  Simulation s = pictured();
  auto& pictures = s.spec.output.pictures;
  pictures.panels.assign(2, pictures);
  pictures.panels[1].field = other_field;
  pictures.panels[1].roll = 90;
  return s;
}

TEST(RunCase, DrawsPanelsThatStayTheSameAfterAStop) {
  for (char const* const other : {"Displacement", "Velocity"}) {
    TemporaryFolder const folder;
    Simulation whole = pictured_twice(other), first = pictured_twice(other), second = pictured_twice(other);
    run(whole, folder / "whole");
    std::atomic<int> stop{0};
    springs(first).stop_at = 57;
    springs(first).stop = &stop;
    run(first, folder / "parts", false, &stop);
    run(second, folder / "parts", true);
    std::string const name = other == std::string("Velocity") ? "Displacement-Velocity-" : "Displacement-";
    for (char const* number : {"000000", "000002", "000004"}) {
      auto const picture = std::string("pictures/").append(name).append(number).append(".png");
      ASSERT_TRUE(std::filesystem::exists(folder / "whole" / picture)) << picture;
      EXPECT_TRUE(text_of(folder / "whole" / picture) == text_of(folder / "parts" / picture)) << picture;
    }
  }
}

TEST(RunCase, DrawsMomentsIntoOnePictureAtTheEnd) {
  TemporaryFolder const folder;
  Simulation s = pictured(), other = pictured(), none = pictured();
  s.spec.output.pictures.times = {0, 0.3, 9};
  other.spec.output.pictures.times = {0.01, 0.25, 1};
  run(s, folder / "r");
  run(other, folder / "other");
  run(none, folder / "none");
  std::string const strip = "pictures/Displacement-times.png";
  Image const image = testing::read_png(folder / "r" / strip);
  EXPECT_EQ(image.rgb, testing::read_png(folder / "other" / strip).rgb) << "the same pictures are the nearest";
  EXPECT_GT(image.width, testing::read_png(folder / "none/pictures/Displacement-000000.png").width);
  EXPECT_FALSE(std::filesystem::exists(folder / "none" / strip));
  for (char const* number : {"000000", "000003"}) {
    auto const picture = std::string("pictures/Displacement-").append(number).append(".png");
    EXPECT_TRUE(text_of(folder / "r" / picture) == text_of(folder / "none" / picture)) << "the others are as before";
  }
}

TEST(RunCase, DrawsAComponent) {
  TemporaryFolder const folder;
  Simulation s = pictured();
  s.spec.output.pictures.component = "x";
  run(s, folder / "r");
  EXPECT_TRUE(std::filesystem::exists(folder / "r/pictures/Displacement-x-000004.png"));
  Simulation none = pictured();
  none.spec.output.pictures.component = "xx";
  CaseOutcome const outcome = run(none, folder / "none");
  ASSERT_EQ(outcome.summary.warnings.size(), 1u);
  EXPECT_NE(outcome.summary.warnings[0].find("no field 'Displacement' with a component 'xx'"), std::string::npos);
}

TEST(RunCase, HitsTheEndTimeAndWritesRowsAtDueTimes) {
  TemporaryFolder const folder;
  Simulation s = make_springs();
  run(s, folder / "r");
  HistoryFile const history(folder / "r/history.csv", diagnostic_columns(s.formulation->diagnose()), 2);
  auto const times = history.table().values("time");
  EXPECT_EQ(times.size(), 21U);
  EXPECT_EQ(times.front(), 0);
  EXPECT_EQ(times.back(), 1);
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_GE(times[k], 0.05 * static_cast<double>(k) - 1e-12);
    EXPECT_LT(times[k], 0.05 * static_cast<double>(k) + 0.013);
  }
}

TEST(RunCase, IsTheSameWithAndWithoutOutput) {
  TemporaryFolder const folder;
  Simulation loud = probed(), quiet = make_springs();
  quiet.spec.output = {};
  quiet.spec.output.history_every = 1;
  run(loud, folder / "loud");
  run(quiet, folder / "quiet");
  EXPECT_EQ(read_checkpoint(list_checkpoints(folder / "loud")[0]).state.arrays(),
            read_checkpoint(list_checkpoints(folder / "quiet")[0]).state.arrays());
}

TEST(RunCase, ContinuesBitForBitAfterAStop) {
  TemporaryFolder const folder;
  Simulation whole = probed(), first = probed(), second = probed();
  run(whole, folder / "whole");
  std::atomic<int> stop{0};
  springs(first).stop_at = 57;
  springs(first).stop = &stop;
  CaseOutcome const outcome = run(first, folder / "parts", false, &stop);
  EXPECT_EQ(outcome.ending, RunStatus::stopped);
  EXPECT_EQ(outcome.summary.steps, 57);
  EXPECT_EQ(nlohmann::json::parse(text_of(folder / "parts/summary.json"))["status"], "stopped");
  EXPECT_EQ(run(second, folder / "parts", true).ending, RunStatus::completed);
  expect_same_results(folder / "whole", folder / "parts");
}

TEST(RunCase, ContinuesBitForBitFromAnEarlierCheckpoint) {
  TemporaryFolder const folder;
  Simulation whole = probed(), killed = probed(), second = probed();
  run(whole, folder / "whole");
  run(killed, folder / "parts");
  std::filesystem::remove(list_checkpoints(folder / "parts")[0]);  // as if killed after the last but one
  EXPECT_LT(read_checkpoint(list_checkpoints(folder / "parts")[0]).time, 1);
  run(second, folder / "parts", true);
  expect_same_results(folder / "whole", folder / "parts");
}

TEST(RunCase, WritesACheckpointWhenAskedAndGoesOn) {
  TemporaryFolder const folder;
  Simulation quiet = probed(), asked = probed();
  quiet.spec.output.checkpoints_every = asked.spec.output.checkpoints_every = 0;
  run(quiet, folder / "quiet");
  std::atomic<int> request{0}, none{0};
  springs(asked).stop = &request;
  springs(asked).stop_at = 37;
  Listener listener;
  struct GuardInput : Observer {
    std::filesystem::path folder;
    std::vector<std::filesystem::path> found;
    void observe(Formulation const&, TimeState const& moment) override {
      if (moment.step == 38) found = list_checkpoints(folder);
    }
  } look;
  look.folder = folder / "asked";
  CaseOutcome const outcome =
      run_case(asked, {.folder = look.folder, .also = &look, .checkpoint_request = &request}, listener, none);
  EXPECT_EQ(outcome.ending, RunStatus::completed);
  EXPECT_EQ(request, 0);
  EXPECT_EQ(look.found, std::vector{checkpoint_path(look.folder, 37)});
  EXPECT_NE(text_of(folder / "asked/log.txt").find("checkpoint at step 37"), std::string::npos);
  expect_same_results(folder / "quiet", folder / "asked");
}

TEST(RunCase, StopsBeforeItsWallTimeIsOver) {
  TemporaryFolder const folder;
  Simulation s = probed(), whole = probed();
  run(whole, folder / "whole");
  std::atomic<int> none{0};
  Listener listener;
  auto const now = WallLimit::Clock::now();
  RunOptions options{.folder = folder / "parts", .wall_time = 60, .started = now - std::chrono::seconds(61)};
  CaseOutcome const outcome = run_case(s, options, listener, none);
  EXPECT_EQ(outcome.ending, RunStatus::stopped);
  EXPECT_TRUE(outcome.out_of_time);
  EXPECT_EQ(outcome.summary.steps, 1);
  EXPECT_EQ(read_checkpoint(list_checkpoints(folder / "parts").at(0)).step, 1);
  EXPECT_NE(text_of(folder / "parts/log.txt").find("the wall time is used up"), std::string::npos);
  options.resume = true;
  options.started = now;
  Simulation again = probed();
  EXPECT_EQ(run_case(again, options, listener, none).ending, RunStatus::completed);
  expect_same_results(folder / "whole", folder / "parts");
}

TEST(RunCase, LeavesACompletedRunAsItIsWhenResumed) {
  TemporaryFolder const folder;
  Simulation first = probed(), second = probed();
  run(first, folder / "r");
  std::string const before = text_of(folder / "r/history.csv");
  EXPECT_EQ(run(second, folder / "r", true).ending, RunStatus::completed);
  EXPECT_EQ(text_of(folder / "r/history.csv"), before);
}

TEST(RunCase, RefusesToResumeAnotherCase) {
  TemporaryFolder const folder;
  Simulation first = make_springs(), second = make_springs();
  run(first, folder / "r");
  second.spec.source = "title = \"Other springs\"\n";
  EXPECT_THROW(run(second, folder / "r", true), InputError);
}

TEST(RunCase, KeepsTheLastStateOfAFailedRunAndExplains) {
  TemporaryFolder const folder;
  Simulation s = make_springs();
  springs(s).fail_at = 40;
  CaseOutcome const outcome = run(s, folder / "r");
  EXPECT_EQ(outcome.ending, RunStatus::failed);
  for (char const* part :
       {"stopped at step 40, t = ",
        "particle 3 (body 'plate', X = (3, 0, 0) m, x = (0.5, 0.25, 0) m) is inverted, det F = -0.02, neighbours = 27",
        "limited by the formulation", "docs/user/when-it-stops.md"}) {
    EXPECT_NE(outcome.failure.find(part), std::string::npos) << part << "\n" << outcome.failure;
  }
  EXPECT_EQ(nlohmann::json::parse(text_of(folder / "r/summary.json"))["status"], "failed");
  EXPECT_EQ(read_checkpoint(folder / "r" / failed_checkpoint).step, 40);
  EXPECT_EQ(list_frames(folder / "r").back().first, outcome.summary.end_time);
}

TEST(RunCase, TakesACollapsedStepForAFailure) {
  TemporaryFolder const folder;
  Simulation s = make_springs();
  springs(s).collapse_at = 40;
  CaseOutcome const outcome = run(s, folder / "r");
  EXPECT_EQ(outcome.ending, RunStatus::failed);
  EXPECT_NE(outcome.failure.find("the time step collapsed, stable step [s] = 1e-30"), std::string::npos)
      << outcome.failure;
}

TEST(RunCase, WarnsOfCellsThatAreNotNumbers) {
  TemporaryFolder const folder;
  Simulation s = make_springs();
  springs(s).nan_at = 50;
  CaseOutcome const outcome = run(s, folder / "r");
  ASSERT_EQ(outcome.summary.warnings.size(), 1U);
  EXPECT_NE(outcome.summary.warnings[0].find("history.csv: not a number in pressure_max at t = "), std::string::npos);
  EXPECT_EQ(text_of(folder / "r/history.csv").find("nan"), std::string::npos);
}

TEST(RunCase, ListsColumnsWithoutNumbersInOneWarning) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  testing::Script script;
  script.more = [=](double t) {
    return std::vector<std::pair<std::string, double>>{{"first", t > 0.305 ? nan : 0},
                                                       {"second", t > 0.305 ? nan : 0},
                                                       {"third", t > 0.605 ? nan : 0},
                                                       {"fourth", t > 0.705 ? nan : 0}};
  };
  testing::Outcome const outcome = testing::run(script);
  EXPECT_EQ(outcome.shown, outcome.of.summary.warnings);
  ASSERT_EQ(outcome.shown.size(), 2U) << "that of the first row with empty cells, and of what followed";
  std::string const start = "history.csv: not a number in ", end = " s; such cells are left empty";
  expect_words(outcome.shown[0], {start + "first, second at t = 0.31", end});
  expect_words(outcome.shown[1], {start + "third at t = 0.61", " s, then fourth at t = 0.71", end});
}

TEST(RunCase, ReplacesItsOwnResultsOnly) {
  TemporaryFolder const folder;
  Simulation first = make_springs(), again = make_springs(), other = make_springs();
  run(first, folder / "r");
  std::ofstream(folder / "r/notes.txt") << "mine";
  EXPECT_NO_THROW(run(again, folder / "r"));
  EXPECT_TRUE(std::filesystem::exists(folder / "r/notes.txt"));
  other.spec.title = "Another";
  try {
    run(other, folder / "r");
    FAIL();
  } catch (InputError const& error) {
    EXPECT_NE(std::string(error.what()).find("holds the results of another case, \"Springs\""), std::string::npos)
        << error.what();
  }
  std::filesystem::create_directories(folder / "mine");
  std::ofstream(folder / "mine/thesis.tex") << "x";
  EXPECT_THROW(run(again, folder / "mine"), InputError);
}

TEST(RunCase, KeepsTheStepBelowTheBoundOfTheUser) {
  TemporaryFolder const folder;
  Simulation s = make_springs();
  s.spec.run.max_step = 0.001;
  EXPECT_EQ(run(s, folder / "r").summary.steps, 1000);
}

TEST(EnergyChange, IsTheLargestRiseAboveOrFallBelowAnyEarlierRow) {
  HistoryTable const history{{{"total_energy", "J"}, {"external_work", "J"}},
                             {{10, 0}, {6, 0}, {20, 11}, {9, 2}, {8, 2}}};  // own energy: 10, 6, 9, 7, 6
  EXPECT_DOUBLE_EQ(energy_increase(history), 3.0 / 20);
  HistoryTable const falling{{{"total_energy", "J"}, {"external_work", "J"}}, {{10, 0}, {6, 0}, {5, 0}}};
  EXPECT_EQ(energy_increase(falling), 0);
  EXPECT_DOUBLE_EQ(energy_decrease(history), 4.0 / 20);
  EXPECT_DOUBLE_EQ(energy_decrease(falling), 5.0 / 10);
}

}  // namespace
}  // namespace piola
