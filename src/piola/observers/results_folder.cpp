// SPDX-License-Identifier: Apache-2.0
#include "piola/observers/results_folder.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/read_file.hpp"
#include "piola/base/version.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/history_names.hpp"
#include "piola/model/read_case.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/output/folder_lock.hpp"
#include "piola/setup/packing_file.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace piola {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_headline = 20000;  // of a log: version and title

// frames.xmf was written by earlier versions.
constexpr std::array own_files{"history.csv", "summary.json", "frames.hdf.series", "frames.xmf",
                               "case.toml",   "log.txt",      "report.html"};
constexpr std::array own_folders{"frames", "pictures", "checkpoints", kept_files, unfinished_set_up};

bool is_number(std::string_view text, std::size_t digits) {
  return text.size() >= digits && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// FIELD-000012, FIELD-xx-OTHER-000012, FIELD-times: a field, its component or other fields, and a number.
bool is_picture(std::string_view stem) {
  auto const is_field = [](std::string_view word) {
    auto const names = field_names();
    return std::any_of(names.begin(), names.end(), [&](FieldName const& field) { return field.name == word; });
  };
  std::size_t words = 0;
  for (;; ++words) {
    std::size_t const end = stem.find('-');
    if (end == std::string_view::npos) break;
    std::string_view const word = stem.substr(0, end);
    constexpr std::size_t longest_component = 9;  // magnitude
    if (!is_field(word) && (words == 0 || word.size() > longest_component)) return false;
    stem.remove_prefix(end + 1);
  }
  return words > 0 && (stem == "times" || is_number(stem, 6));
}

/// Whether Piola gives this name to files in that folder of its results; "NAME.part" while it writes them.
bool is_own_name(std::string_view folder, fs::path name) {
  if (name.extension() == ".part") name = name.stem();
  std::string const text = name.string(), stem = name.stem().string(), ending = name.extension().string();
  if (folder == "frames") return ending == ".hdf" && is_number(stem, 6);
  if (folder == "pictures") return ending == ".png" && is_picture(stem);
  if (folder == "checkpoints")
    return (ending == ".h5" && (stem == "failed" || is_number(stem, 9))) || text == durations_name;
  return text == kept_list || text.starts_with("packed-");
}

void remove_file(fs::path const& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw FileError(write_error_text(path, error.value()));
}

/// The list of copies; one that cannot be read lists none.
std::vector<KeptFile> listed_copies(fs::path const& results) {
  try {
    return read_kept_list(results);
  } catch (std::runtime_error const&) {
    return {};
  }
}

/// Removes Piola's files, and the folder if it is then empty. A link is removed, not its target.
void clear_folder(fs::path const& results, char const* name) {
  fs::path const folder = results / name;
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return remove_file(folder);
  std::vector<fs::path> own;
  std::set<std::string> copies;
  if (name == std::string_view(kept_files))
    for (KeptFile const& file : listed_copies(results)) copies.insert(file.kept);
  for (auto const& entry : fs::directory_iterator(folder)) {
    fs::path const file = entry.path().filename();
    bool const ours = is_own_name(name, file) || copies.contains(file.string());
    if (ours && !fs::is_directory(entry.symlink_status())) own.push_back(entry.path());
  }
  for (fs::path const& file : own) remove_file(file);
  if (fs::is_empty(folder)) remove_file(folder);
}

/// Title of the run whose results are in a folder; empty if there are none.
std::optional<std::string> title_in(fs::path const& folder) {
  FileToRead log(folder / "log.txt");
  std::string line(longest_headline, '\0');
  line.resize(log.read(line));
  line.resize(std::min(line.size(), line.find('\n')));
  auto const colon = line.find(": ");
  if (!line.starts_with("Piola ") || colon == std::string::npos) return std::nullopt;
  return line.substr(colon + 2);
}

/// Ignores an empty log, left by a run that was killed before its first line, and the files of a stopped set-up.
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
  std::vector<char const*> names(own_files.begin(), own_files.end());
  names.insert(names.end(), own_folders.begin(), own_folders.end());
  for (char const* name : names) {
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
    return read_case(folder / "case.toml", {}, {.of_results = true}, particles);
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
  PIOLA_EXPECTS(!folder.empty());
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
  PIOLA_EXPECTS(!folder.empty());
  for (char const* name : own_folders) clear_folder(folder, name);
  for (char const* name : own_files) remove_file(folder / name);
}

fs::path default_results(fs::path const& case_file) {
  fs::path const full = fs::absolute(case_file);
  std::string const name = full.stem() == "case" ? full.parent_path().filename().string() : full.stem().string();
  return name + "-results";
}

}  // namespace piola
