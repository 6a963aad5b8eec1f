// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/results_folder.hpp"
#include "piola/base/problems.hpp"
#include "piola/base/version.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/read_case.hpp"
#include "piola/output/files.hpp"
#include "piola/output/folder_lock.hpp"
#include "piola/setup/packing_file.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>
#include <optional>

namespace piola {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_headline = 20000;  // of a log: version and title

// frames.xmf was written by earlier versions.
constexpr std::array own_names{"history.csv", "summary.json", "frames",      "frames.hdf.series",
                               "frames.xmf",  "pictures",     "checkpoints", "case.toml",
                               "log.txt",     "report.html",  kept_files,    unfinished_set_up};

/// Title of the run whose results lie in a folder; nothing if there are none.
std::optional<std::string> title_in(fs::path const& folder) {
  std::ifstream log(folder / "log.txt");
  std::string line(longest_headline, '\0');
  log.read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(std::min(static_cast<std::size_t>(log.gcount()), line.find('\n')));
  auto const colon = line.find(": ");
  if (!line.starts_with("Piola ") || colon == std::string::npos) return std::nullopt;
  return line.substr(colon + 2);
}

/// An empty log counts for nothing: it is what a run leaves that was killed before its first word. What a stopped
/// set-up leaves counts for nothing either.
bool holds_anything(fs::path const& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(), [](fs::directory_entry const& entry) {
    std::error_code no_file;
    auto const name = entry.path().filename();
    return name != lock_name && name != unfinished_set_up && !(name == "log.txt" && entry.file_size(no_file) == 0);
  });
}

/// Whether `inner` lies in the folder `outer`, after all links have been followed.
bool lies_in(fs::path const& inner, fs::path const& outer) {
  std::error_code error;
  fs::path const i = fs::weakly_canonical(inner, error), o = fs::weakly_canonical(outer, error);
  return !error && std::mismatch(o.begin(), o.end(), i.begin(), i.end()).first == o.end();
}

/// Another name of the same file (a link of either kind) counts too.
void protect_case(fs::path const& folder, fs::path const& case_file) {
  if (case_file.empty()) return;
  for (char const* name : own_names) {
    std::error_code not_there;
    if (!fs::equivalent(folder / name, case_file, not_there) && !lies_in(case_file, folder / name)) continue;
    throw InputError(
        fmt::format("{}: is where the results would be written, and the case {} is there itself (allowed: any folder "
                    "whose results do not replace it) - give another folder with --out",
                    (folder / name).string(), case_file.string()));
  }
}

}  // namespace

std::optional<CaseSpec> case_in_results(fs::path const& folder, ParticleSet* particles) {
  std::error_code error;
  if (!fs::exists(folder / "case.toml", error)) return std::nullopt;
  try {
    return read_case(folder / "case.toml", {}, {}, particles);
  } catch (std::runtime_error const&) {  // pictures and pages do without
    return std::nullopt;
  }
}

std::string log_headline(std::string const& title) {
  std::string const line = title.substr(0, title.find('\n'));
  return fmt::format("Piola {}: {}", version(), line);
}

fs::path folder_for_unfinished(fs::path const& results) {
  std::error_code none;
  if (fs::exists(results, none) &&
      (!fs::is_directory(results, none) || (holds_anything(results) && !title_in(results))))
    return {};
  return results / unfinished_set_up;
}

void check_results(fs::path const& folder, ResultsOf const& run) {
  protect_case(folder, run.case_file);
  make_folder(folder);
  if (!holds_anything(folder) || run.force) return;
  auto const there = title_in(folder);
  std::string const headline = log_headline(run.title);
  if (there && *there == headline.substr(headline.find(": ") + 2)) return;
  std::string const what = there ? fmt::format("holds the results of another case, \"{}\"", *there)
                                 : "is not empty and holds no results of Piola";
  throw InputError(fmt::format(
      "{}: {} (an empty or new folder is needed) - give another folder with --out, or --force to use this one",
      folder.string(), what));
}

void clear_results(fs::path const& folder) {
  for (char const* name : own_names) {
    std::error_code error;
    fs::remove_all(folder / name, error);
    if (error) throw FileError(cannot_write(folder / name, error.value()));
  }
}

fs::path default_results(fs::path const& case_file) {
  fs::path const full = fs::absolute(case_file);
  std::string const name = full.stem() == "case" ? full.parent_path().filename().string() : full.stem().string();
  return name + "-results";
}

}  // namespace piola
