// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/exec/threads.hpp"
#include "piola/input/read_case.hpp"
#include "piola/output/files.hpp"
#include "piola/simulation/study.hpp"
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
#include <memory>
#include <mutex>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace piola::app {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
  std::string file, out;
  int jobs = 0, threads = 0;
};

/// Runs this very program; what it says goes to a file. Returns its exit status, or 1 if it ended otherwise.
int run_program(std::vector<std::string> words, fs::path const& says) {
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
  bool told = false;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (stop_signal != 0 && !told) told = ::kill(child, SIGTERM) == 0;  // it writes a checkpoint
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// The runs of a study, taken by several threads one after the other.
class Pool {
 public:
  Pool(StudySpec const& study, fs::path folder, std::vector<StudyRun> const& runs)
      : study_(study), folder_(std::move(folder)), runs_(runs) {}

  void work() {
    try {
      work_off();
    } catch (...) {
      std::scoped_lock const lock(guard_);
      if (!error_) error_ = std::current_exception();
      next_ = runs_.size();
    }
  }
  /// What went wrong first, if anything did.
  void raise() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void work_off() {
    for (std::size_t k = take(); k < runs_.size(); k = take()) {
      StudyRun const& run = runs_[k];
      bool const done_before = is_done(run);
      if (!done_before) start(run);
      std::string const status = run_status(folder_ / run.folder);
      std::scoped_lock const lock(guard_);
      say("{} ({}): {}{}\n", run.folder, joined(run.settings), status.empty() ? "failed" : status,
          done_before ? " before" : "");
    }
  }

  std::size_t take() {
    std::scoped_lock const lock(guard_);
    return stop_signal != 0 ? runs_.size() : next_++;
  }

  std::string words_of(StudyRun const& run) const {
    std::string text = read_text_file(case_file(study_.case_file)) + "\n";
    for (std::string const& setting : run.settings) text += setting + "\n";
    return text;
  }

  /// Completed, with this very case and these settings.
  bool is_done(StudyRun const& run) const {
    auto const note = folder_ / run.folder / "study.txt";
    std::error_code error;
    return fs::exists(note, error) && read_text_file(note) == words_of(run) &&
           run_status(folder_ / run.folder) == "completed";
  }

  void start(StudyRun const& run) const {
    std::vector<std::string> words{
        "piola",   "run",       study_.case_file.string(),     "--out", (folder_ / run.folder).string(),
        "--quiet", "--threads", std::to_string(study_.threads)};
    for (std::string const& setting : run.settings) words.insert(words.end(), {"--set", setting});
    int const code = run_program(words, folder_ / (run.folder + ".txt"));
    if (code == completed) write_whole_file(folder_ / run.folder / "study.txt", words_of(run));
  }

  StudySpec const& study_;
  fs::path folder_;
  std::vector<StudyRun> const& runs_;
  std::mutex guard_;
  std::size_t next_ = 0;
  std::exception_ptr error_;
};

/// Every case of the study is read before the first one runs.
void check_all(StudySpec const& study, std::vector<StudyRun> const& runs) {
  fs::path const file = case_file(study.case_file);
  for (StudyRun const& run : runs) {
    try {
      read_case(file, run.settings);
    } catch (InputError const& error) {
      throw InputError(fmt::format("with {}:\n{}", joined(run.settings), error.what()));
    }
  }
}

int study(StudyArguments const& options) {
  StudySpec spec = read_study(options.file);
  if (options.jobs > 0) spec.jobs = options.jobs;
  if (options.threads > 0) spec.threads = options.threads;
  if (spec.threads == 0) spec.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / spec.jobs);
  fs::path folder = !options.out.empty() ? options.out : spec.out;
  if (folder.empty()) folder = fs::path(options.file).stem().string() + "-study";
  auto const runs = combinations(spec);
  check_all(spec, runs);
  make_folder(folder);
  catch_stop_signals();
  say("{} runs, {} at a time on {} thread{} each, in {}\n", runs.size(), spec.jobs, spec.threads,
      spec.threads == 1 ? "" : "s", folder.string());
  Pool pool(spec, folder, runs);
  {
    std::vector<std::jthread> workers;
    for (int j = 0; j < spec.jobs; ++j) workers.emplace_back([&pool] { pool.work(); });
  }
  pool.raise();
  write_study_table(folder, spec, runs);
  auto const good = std::count_if(runs.begin(), runs.end(),
                                  [&](StudyRun const& run) { return run_status(folder / run.folder) == "completed"; });
  say("{} of {} completed; values and quantities in {}\n", good, runs.size(), (folder / "study.csv").string());
  if (stop_signal != 0) return stopped_by_signal;
  return good == static_cast<std::ptrdiff_t>(runs.size()) ? completed : physics_failed;
}

}  // namespace

void add_study(CLI::App& program, Action& action) {
  auto const options = std::make_shared<StudyArguments>();
  CLI::App* command = program.add_subcommand("study", "Run a case with every combination of some values");
  command->add_option("file", options->file, "The study: case = \"...\" and [parameters] with lists of values")
      ->required();
  command->add_option("--out,-o", options->out, "Folder for the runs and study.csv (default: NAME-study)");
  command->add_option("--jobs", options->jobs, "Runs at a time (default 2)")->check(CLI::Range(1, 1024));
  command->add_option("--threads", options->threads, "Threads of each run (default: the cores divided by the jobs)")
      ->check(CLI::Range(1, 1024));
  command->callback([options, &action] { action = [options] { return study(*options); }; });
}

}  // namespace piola::app
