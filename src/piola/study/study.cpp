// SPDX-License-Identifier: Apache-2.0
#include "piola/study/study.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/case_files.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/summary.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

void read_count(Node const& root, char const* key, int& target, Problems& problems) {
  Node const* node = root.find(key);
  if (node == nullptr) return;
  if (node->kind == Node::Kind::integer && node->integer >= 1 && node->integer <= 1024)
    target = static_cast<int>(node->integer);
  else
    problems.add(node->place, fmt::format("{} is not a whole number from 1 to 1024 - correct it", key));
}

/// A value of a dotted key, in which relative paths of files start from the folder of the case in place of that of the
/// study.
Node from_case_folder(std::string const& key, Node value, std::filesystem::path const& study,
                      std::filesystem::path const& of_case) {
  Node holder;  // with the last part of the key, which tells whether the value names files
  holder.entries.push_back({key.substr(key.rfind('.') + 1), {}, std::move(value)});
  each_file_name(holder, [&](Node& text) {
    if (!std::filesystem::path(text.text).is_absolute())
      text.text = std::filesystem::proximate(study / text.text, of_case).string();
  });
  return std::move(holder.entries.front().value);
}

/// The folders of study and case, if they are not the same.
struct Folders {
  std::filesystem::path study, of_case;
};

std::optional<Folders> different_folders(std::filesystem::path const& study_file,
                                         std::filesystem::path const& case_file) {
  std::error_code error;
  auto const absolute = [](std::filesystem::path const& path) {
    return path.empty() ? std::filesystem::current_path() : std::filesystem::absolute(path);
  };
  Folders const folders{
      absolute(study_file.parent_path()),
      absolute(std::filesystem::is_directory(case_file, error) ? case_file : case_file.parent_path())};
  if (std::filesystem::equivalent(folders.study, folders.of_case, error) || error) return {};
  return folders;
}

void read_parameters(Node const& root, std::optional<Folders> const& folders, StudySpec& study, Problems& problems) {
  constexpr std::size_t most = 10'000;
  Node const* node = root.find("parameters");
  if (node == nullptr || !node->is_table() || node->entries.empty()) {
    problems.add(
        node ? node->place : root.place,
        "[parameters] is needed, with a list of values for each key, e.g. \"run.end\" = [\"1 ms\", \"2 ms\"] - "
        "add it");
    return;
  }
  std::size_t runs = 1;
  for (Node::Entry const& entry : node->entries) {
    if (!entry.value.is_array() || entry.value.items.empty()) {
      problems.add(entry.place,
                   fmt::format("{} is not a list of values (a key with dots stands in quotes) - write [..]",
                               in_quotes(entry.key)));
      continue;
    }
    std::vector<std::string> values;
    for (Node const& item : entry.value.items)
      values.push_back(
          toml_value(folders ? from_case_folder(entry.key, item, folders->study, folders->of_case) : item));
    runs = std::min(runs * values.size(), most + 1);
    study.parameters.emplace_back(entry.key, std::move(values));
  }
  if (runs > most) problems.add(node->place, "more than 10,000 runs are asked for - choose fewer values");
}

std::string csv_cell(std::string text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, "\"");
  return "\"" + text + "\"";
}

nlohmann::ordered_json summary_of(std::filesystem::path const& results) {
  auto const summary = nlohmann::ordered_json::parse(summary_text(results), nullptr, false);
  return summary.is_object() ? summary : nlohmann::ordered_json::object();
}

/// The text at a path of keys; empty if there is none.
std::string text_at(nlohmann::ordered_json const& summary, char const* pointer) {
  nlohmann::ordered_json::json_pointer const at(pointer);
  return summary.contains(at) && summary[at].is_string() ? summary[at].get<std::string>() : std::string();
}

std::vector<MeasuredQuantity> quantities_of(nlohmann::ordered_json const& summary) {
  std::vector<MeasuredQuantity> quantities;
  if (!summary.contains("quantities") || !summary["quantities"].is_object()) return quantities;
  for (auto const& [name, entry] : summary["quantities"].items())
    if (entry.is_object() && entry.contains("value") && entry["value"].is_number())
      quantities.push_back({name, entry["value"].get<double>(), text_at(entry, "/unit")});
  return quantities;
}

}  // namespace

StudySpec read_study(std::filesystem::path const& path) {
  Problems problems;
  auto const document = parse_document(read_input_file(path), path.string(), problems);
  problems.raise_if_any();
  Node const& root = document->root;
  StudySpec study;
  std::vector<std::string> const known{"case", "out", "jobs", "threads", "parameters"};
  for (Node::Entry const& entry : root.entries)
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      problems.add(entry.place, fmt::format("{} is not a key of a study (known: {}) - {}", in_quotes(entry.key),
                                            joined(known), advice_for_name(entry.key, known)));
  std::string file, out;
  for (auto const& [key, target] : {std::pair{"case", &file}, {"out", &out}}) {
    Node const* node = root.find(key);
    if (node != nullptr && node->is_text() && !node->text.empty())
      *target = node->text;
    else if (node != nullptr || target == &file)
      problems.add(node ? node->place : root.place, fmt::format("{} = \"...\" is needed, a path - add it", key));
  }
  study.case_file = path.parent_path() / file;
  if (!out.empty()) study.out = path.parent_path() / out;
  read_count(root, "jobs", study.jobs, problems);
  read_count(root, "threads", study.threads, problems);
  read_parameters(root, different_folders(path, study.case_file), study, problems);
  problems.sort_by_place();
  problems.raise_if_any();
  return study;
}

std::vector<std::string> run_folders(std::size_t count) {
  std::vector<std::string> names;
  std::size_t const digits = std::to_string(count).size();
  for (std::size_t k = 0; k < count; ++k) names.push_back(fmt::format("run-{:0{}}", k + 1, digits));
  return names;
}

std::vector<StudyRun> combinations(StudySpec const& study) {
  std::vector<StudyRun> runs{{{}, study.settings, {}}};
  for (auto const& [key, values] : study.parameters) {
    std::vector<StudyRun> more;
    for (StudyRun const& run : runs)
      for (std::string const& value : values) {
        more.push_back(run);
        more.back().settings.push_back(key + "=" + value);
        more.back().value_text.push_back(value);
      }
    runs = std::move(more);
  }
  auto const folders = run_folders(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) runs[k].folder = folders[k];
  return runs;
}

std::string summary_text(std::filesystem::path const& results) {
  auto const file = results / "summary.json";
  std::error_code error;
  return std::filesystem::exists(file, error) ? read_text_file(file, most_summary_bytes) : std::string();
}

std::optional<RunOutcome> outcome_in(std::filesystem::path const& results, std::string const& identity) {
  auto const summary = summary_of(results);
  if (identity.empty() || text_at(summary, "/identity/run") != identity) return std::nullopt;
  return RunOutcome{text_at(summary, "/status"), quantities_of(summary)};
}

RunOutcome outcome_of(std::filesystem::path const& results, EndedRun const& run) {
  auto const failed = [](char const* why) { return RunOutcome{"failed", {}, why}; };
  if (run.ended_as.empty()) return failed("it did not run to an end of its own");
  if (summary_text(results) == run.summary_before) return failed("it wrote no summary.json");
  auto const summary = summary_of(results);
  if (text_at(summary, "/identity/run") != run.identity)
    return failed("the case, a file that it names or the program has changed since the study began");
  RunOutcome outcome{text_at(summary, "/status"), quantities_of(summary)};
  // The exit code decides: a run that ended with another one than 0 is not completed.
  if (outcome.status == "completed" && run.ended_as != "completed") outcome.status = run.ended_as;
  if (run.ended_as == "completed" && outcome.status != "completed")
    return failed("its summary.json is of no completed run");
  return outcome;
}

void write_study_table(std::filesystem::path const& folder, StudySpec const& study, std::vector<StudyRun> const& runs,
                       std::vector<RunOutcome> const& outcomes) {
  PIOLA_EXPECTS(outcomes.size() == runs.size());
  std::vector<std::string> names;
  for (RunOutcome const& outcome : outcomes)
    for (MeasuredQuantity const& quantity : outcome.quantities)
      if (std::find(names.begin(), names.end(), quantity.name) == names.end()) names.push_back(quantity.name);
  std::string text = "folder";
  for (auto const& [key, values] : study.parameters) text += "," + csv_cell(key);
  text += ",status";
  for (std::string const& name : names) text += "," + csv_cell(name);
  text += "\n";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    text += runs[k].folder;
    for (std::string value : runs[k].value_text) {
      if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
      text += "," + csv_cell(value);
    }
    text += "," + outcomes[k].status;
    auto const& quantities = outcomes[k].quantities;
    for (std::string const& name : names) {
      auto const found =
          std::find_if(quantities.begin(), quantities.end(), [&](auto const& q) { return q.name == name; });
      text += "," + (found == quantities.end() ? std::string() : fmt::format("{}", found->value));
    }
    text += "\n";
  }
  write_whole_file(folder / "study.csv", text);
}

}  // namespace piola
