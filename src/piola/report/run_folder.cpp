// SPDX-License-Identifier: Apache-2.0
#include "piola/report/run_folder.hpp"
#include "piola/base/errors.hpp"
#include "piola/observers/results_folder.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/folder_lock.hpp"
#include "piola/output/frames.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <regex>

namespace piola::report {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_bytes = 100'000'000;  // of the texts of a run

std::string text_if_there(fs::path const& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) ? read_text_file(file, most_bytes) : "";
}

/// "Piola 0.1.0: Twisting column" is the first line of log.txt.
std::string title_in_log(std::string const& log) {
  std::string const first = log.substr(0, log.find('\n'));
  auto const colon = first.find(": ");
  return colon == std::string::npos ? "" : first.substr(colon + 2);
}

/// The last lines of log.txt, from the line with the step at which the run stopped.
std::string failure_in_log(std::string const& log) {
  auto const at = log.rfind("\nstopped at step ");
  if (at == std::string::npos) return "";
  std::string text = log.substr(at + 1);
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

void read_summary(RunFolder& run) {
  auto const json = nlohmann::json::parse(run.summary, nullptr, false);
  if (!json.is_object()) {
    run.summary.clear();
    return;
  }
  auto const text = [&](char const* key) {
    return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : std::string();
  };
  run.status = text("status");
  if (!text("title").empty()) run.title = text("title");
}

/// Whether the lock file exists and summary.json is missing or older than history.csv. A killed run leaves its lock
/// file and is reported as running.
bool goes_on(RunFolder const& run) {
  std::error_code error;
  if (!fs::exists(run.path / lock_name, error)) return false;
  auto const written = fs::last_write_time(run.path / "history.csv", error);
  return run.summary.empty() || (!error && written > fs::last_write_time(run.path / "summary.json", error));
}

}  // namespace

void read_texts(RunFolder& run) {
  std::error_code error;
  run.log = text_if_there(run.path / "log.txt");
  run.case_text = text_if_there(run.path / "case.toml");
  run.summary = text_if_there(run.path / "summary.json");
  run.title = title_in_log(run.log);
  run.status = "broken off";
  if (!run.summary.empty()) read_summary(run);
  if (goes_on(run)) run.status = "running";
  if (run.title.empty()) run.title = fs::weakly_canonical(run.path, error).filename().string();
  run.failure = run.status == "failed" ? failure_in_log(run.log) : "";
}

RunFolder open_run(fs::path const& folder) {
  std::error_code error;
  bool const has_frames = fs::exists(folder / "frames.hdf.series", error);
  if (!has_frames && !fs::exists(folder / "history.csv", error) && !fs::exists(folder / "summary.json", error))
    throw InputError(
        fmt::format("{}: holds no run (frames.hdf.series, history.csv or summary.json is needed) - give "
                    "the folder that 'piola run' wrote to",
                    folder.string()));
  RunFolder run{.path = folder};
  read_texts(run);
  run.spec = case_in_results(folder);
  if (has_frames) run.frames = list_frames(folder);
  return run;
}

long failed_particle(std::string const& failure) {
  std::smatch found;
  bool const named = std::regex_search(failure, found, std::regex(R"(: particle ([0-9]{1,15}) )"));
  return named ? std::stol(found[1].str()) : -1;
}

}  // namespace piola::report
