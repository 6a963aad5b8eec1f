// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/study.hpp"
#include "piola/base/text.hpp"
#include "piola/input/document.hpp"
#include "piola/output/files.hpp"
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

void read_parameters(Node const& root, StudySpec& study, Problems& problems) {
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
    for (Node const& item : entry.value.items) values.push_back(toml_value(item));
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

nlohmann::json summary_of(std::filesystem::path const& results) {
  auto const file = results / "summary.json";
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return {};
  return nlohmann::json::parse(read_text_file(file), nullptr, false);
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
  std::string file;
  for (auto const& [key, target] : {std::pair{"case", &file}, {"out", &study.out}}) {
    Node const* node = root.find(key);
    if (node != nullptr && node->is_text() && !node->text.empty())
      *target = node->text;
    else if (node != nullptr || target == &file)
      problems.add(node ? node->place : root.place, fmt::format("{} = \"...\" is needed, a path - add it", key));
  }
  study.case_file = path.parent_path() / file;
  read_count(root, "jobs", study.jobs, problems);
  read_count(root, "threads", study.threads, problems);
  read_parameters(root, study, problems);
  problems.sort_by_place();
  problems.raise_if_any();
  return study;
}

std::vector<StudyRun> combinations(StudySpec const& study) {
  std::vector<StudyRun> runs{{}};
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
  std::size_t const digits = std::to_string(runs.size()).size();
  for (std::size_t k = 0; k < runs.size(); ++k) runs[k].folder = fmt::format("run-{:0{}}", k + 1, digits);
  return runs;
}

std::string run_status(std::filesystem::path const& results) {
  auto const summary = summary_of(results);
  return summary.is_object() ? summary.value("status", "") : "";
}

void write_study_table(std::filesystem::path const& folder, StudySpec const& study, std::vector<StudyRun> const& runs) {
  std::vector<nlohmann::json> summaries;
  std::vector<std::string> quantities;
  for (StudyRun const& run : runs) {
    summaries.push_back(summary_of(folder / run.folder));
    if (!summaries.back().is_object() || !summaries.back().contains("quantities")) continue;
    for (auto const& [name, entry] : summaries.back()["quantities"].items())
      if (std::find(quantities.begin(), quantities.end(), name) == quantities.end()) quantities.push_back(name);
  }
  std::string text = "folder";
  for (auto const& [key, values] : study.parameters) text += "," + csv_cell(key);
  text += ",status";
  for (std::string const& name : quantities) text += "," + csv_cell(name);
  text += "\n";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    text += runs[k].folder;
    for (std::string value : runs[k].value_text) {
      if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
      text += "," + csv_cell(value);
    }
    nlohmann::json const& summary = summaries[k];
    text += "," + (summary.is_object() ? summary.value("status", "failed") : std::string("failed"));
    for (std::string const& name : quantities) {
      auto const at = nlohmann::json::json_pointer("/quantities/" + name + "/value");
      text += "," + (summary.is_object() && summary.contains(at) && summary[at].is_number()
                         ? fmt::format("{}", summary[at].get<double>())
                         : std::string());
    }
    text += "\n";
  }
  write_whole_file(folder / "study.csv", text);
}

}  // namespace piola
