// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/results_folder.hpp"
#include "piola/base/problems.hpp"
#include "piola/base/version.hpp"
#include "piola/output/files.hpp"
#include <array>
#include <fmt/format.h>
#include <optional>

namespace piola {
namespace {

namespace fs = std::filesystem;

constexpr std::array own_names{"history.csv", "summary.json", "frames", "frames.hdf.series", "frames.xmf", "pictures",
                               "checkpoints", "case.toml",    "log.txt"};

/// Title of the run whose results lie in a folder; nothing if there are none.
std::optional<std::string> title_of(fs::path const& folder) {
  if (!fs::exists(folder / "log.txt")) return std::nullopt;
  std::string const line = [&] {
    std::string const text = read_text_file(folder / "log.txt");
    return text.substr(0, text.find('\n'));
  }();
  auto const colon = line.find(": ");
  if (!line.starts_with("Piola ") || colon == std::string::npos) return std::nullopt;
  return line.substr(colon + 2);
}

void remove_own(fs::path const& folder) {
  for (char const* name : own_names) {
    std::error_code error;
    fs::remove_all(folder / name, error);
    if (error) throw FileError(cannot_write(folder / name, error.value()));
  }
}

}  // namespace

std::string log_headline(std::string const& title) {
  std::string const line = title.substr(0, title.find('\n'));
  return fmt::format("Piola {}: {}", version(), line);
}

void prepare_results(fs::path const& folder, std::string const& title, bool force) {
  make_folder(folder);
  if (!fs::is_empty(folder)) {
    auto const there = title_of(folder);
    bool const same = there && *there == log_headline(title).substr(log_headline(title).find(": ") + 2);
    if (!same && !force) {
      std::string const what = there ? fmt::format("holds the results of another case, \"{}\"", *there)
                                     : "is not empty and holds no results of Piola";
      throw InputError(fmt::format(
          "{}: {} (an empty or new folder is needed) - give another folder with --out, or --force to use this one",
          folder.string(), what));
    }
    remove_own(folder);
  }
}

fs::path default_results(fs::path const& case_file) {
  fs::path const full = fs::absolute(case_file);
  std::string const name = full.stem() == "case" ? full.parent_path().filename().string() : full.stem().string();
  return name + "-results";
}

}  // namespace piola
