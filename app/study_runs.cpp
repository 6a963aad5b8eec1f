// SPDX-License-Identifier: Apache-2.0
#include "study_runs.hpp"
#include "piola/base/text.hpp"
#include "piola/model/read_case.hpp"
#include "piola/output/atomic_file.hpp"
#include "commands.hpp"
#include "run_support.hpp"
#include "signals.hpp"
#include "streams.hpp"
#include <algorithm>
#include <chrono>
#include <csignal>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <mutex>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace piola::app {
namespace {

namespace fs = std::filesystem;

/// How a process ended.
struct Ended {
  int code = internal_error;  ///< exit code
  int signal = 0;             ///< that ended it; 0: none
};

/// Runs this program as a child process; its output goes to a file.
Ended run_program(std::vector<std::string> words, fs::path const& says) {
  write_whole_file(says, "");  // replaces a link, which is never written through
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, says.c_str(), O_WRONLY | O_NOFOLLOW | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  int const error = ::posix_spawn(&child, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw FileError(fmt::format("the program cannot be started ({})", std::generic_category().message(error)));
  int status = 0;
  bool is_stopped = false;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (stop_signal != 0 && !is_stopped) is_stopped = ::kill(child, SIGTERM) == 0;  // it writes a checkpoint
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (WIFEXITED(status)) return {.code = WEXITSTATUS(status), .signal = 0};
  return {.code = internal_error, .signal = WTERMSIG(status)};
}

/// The status that a run with this exit code has in its summary.json; empty if it has none.
std::string_view status_of(Ended const& ended) {
  if (ended.signal != 0) return "";
  switch (ended.code) {
    case completed: return "completed";
    case physics_failed: return "failed";
    case stopped_by_signal: return "stopped";
    default: return "";
  }
}

/// The last line of the output of a run, without "piola: "; empty if there is none.
std::string last_words(fs::path const& says) {
  constexpr std::uint64_t most = 10'000'000;
  constexpr std::size_t longest = 300;
  std::string text = read_text_file(says, most);
  text.erase(text.find_last_not_of('\n') + 1);
  std::string line = text.substr(text.rfind('\n') + 1);
  if (line.starts_with("piola: ")) line.erase(0, 7);
  return line.size() > longest ? line.substr(0, longest) + " ..." : line;
}

/// The runs of a study, taken by several threads one after the other.
class Pool {
 public:
  Pool(StudySpec const& study, fs::path folder, std::vector<StudyRun> const& runs,
       std::vector<std::string> const& identities)
      : study_(study),
        folder_(std::move(folder)),
        runs_(runs),
        identities_(identities),
        outcomes_(runs.size(), {"not run", {}, "the study was stopped before"}) {}

  void work() {
    try {
      work_off();
    } catch (...) {
      std::scoped_lock const lock(guard_);
      if (!error_) error_ = std::current_exception();
      next_ = runs_.size();
    }
  }
  /// Outcomes of all runs. Throws the first error of the threads.
  std::vector<RunOutcome> const& outcomes() const {
    if (error_) std::rethrow_exception(error_);
    return outcomes_;
  }

 private:
  void work_off() {
    for (std::size_t k = take(); k < runs_.size(); k = take()) {
      StudyRun const& run = runs_[k];
      auto const before = outcome_in(folder_ / run.folder, identities_[k]);
      bool const done_before = before && before->status == "completed";
      outcomes_[k] = done_before ? *before : start(run, identities_[k]);
      std::string const& why = outcomes_[k].why;
      std::scoped_lock const lock(guard_);
      print_result("{} ({}): {}{}{}\n", run.folder, description(run), outcomes_[k].status, done_before ? " before" : "",
                   why.empty() ? "" : ", " + why);
    }
  }

  std::string description(StudyRun const& run) const {
    std::vector<std::string> values;
    for (std::size_t p = 0; p < run.value_text.size(); ++p)
      values.push_back(study_.parameters[p].first + "=" + run.value_text[p]);
    return joined(values);
  }

  std::size_t take() {
    std::scoped_lock const lock(guard_);
    return stop_signal != 0 ? runs_.size() : next_++;
  }

  RunOutcome start(StudyRun const& run, std::string const& identity) const {
    fs::path const results = folder_ / run.folder, says = folder_ / (run.folder + ".txt");
    std::vector<std::string> words{"piola",   "run",       study_.case_file.string(),     "--out", results.string(),
                                   "--quiet", "--threads", std::to_string(study_.threads)};
    for (std::string const& setting : run.settings) words.insert(words.end(), {"--set", setting});
    std::string const summary = summary_text(results);
    Ended const ended = run_program(words, says);
    RunOutcome outcome = outcome_of(results, {identity, summary, status_of(ended)});
    if (outcome.why.empty()) return outcome;
    std::string const words_of_run = last_words(says);
    if (ended.signal != 0)
      outcome.why = fmt::format("signal {} ended it", ended.signal);
    else if (ended.code != completed && !words_of_run.empty())
      outcome.why = words_of_run;
    return outcome;
  }

  StudySpec const& study_;
  fs::path folder_;
  std::vector<StudyRun> const& runs_;
  std::vector<std::string> const& identities_;
  std::vector<RunOutcome> outcomes_;
  std::mutex guard_;
  std::size_t next_ = 0;
  std::exception_ptr error_;
};

}  // namespace

std::vector<std::string> identities_of(StudySpec const& study, std::vector<StudyRun> const& runs) {
  fs::path const file = case_file(study.case_file);
  std::vector<std::string> identities;
  for (StudyRun const& run : runs) {
    try {
      identities.push_back(read_case(file, run.settings).identity.run);
    } catch (InputError const& error) {
      throw InputError(fmt::format("with {}:\n{}", joined(run.settings), error.what()));
    }
  }
  return identities;
}

std::vector<RunOutcome> make_runs(StudySpec const& study, fs::path const& folder, std::vector<StudyRun> const& runs,
                                  std::vector<std::string> const& identities) {
  make_folder(folder);
  catch_stop_signals();
  print_result("{} runs, {} at a time on {} thread{} each, in {}\n", runs.size(), study.jobs, study.threads,
               study.threads == 1 ? "" : "s", folder.string());
  Pool pool(study, folder, runs, identities);
  {
    std::vector<std::jthread> workers;
    for (int j = 0; j < study.jobs; ++j) workers.emplace_back([&pool] { pool.work(); });
  }
  auto const& outcomes = pool.outcomes();
  write_study_table(folder, study, runs, outcomes);
  auto const good = std::count_if(outcomes.begin(), outcomes.end(),
                                  [](RunOutcome const& outcome) { return outcome.status == "completed"; });
  print_result("{} of {} completed; values and quantities in {}\n", good, runs.size(), (folder / "study.csv").string());
  return outcomes;
}

int share_of_cores(int jobs) { return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / jobs); }

int code_of(std::vector<RunOutcome> const& outcomes) {
  if (stop_signal != 0) return stopped_by_signal;
  bool const good = std::all_of(outcomes.begin(), outcomes.end(),
                                [](RunOutcome const& outcome) { return outcome.status == "completed"; });
  return good ? completed : physics_failed;
}

}  // namespace piola::app
