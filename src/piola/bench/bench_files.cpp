// SPDX-License-Identifier: Apache-2.0
#include "piola/bench/bench_files.hpp"
#include "piola/base/read_file.hpp"
#include "piola/base/text.hpp"
#include "piola/input/document.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

namespace fs = std::filesystem;

BenchRowSpec read_row(Node const& table, Problems& problems) {
  BenchRowSpec row;
  for (auto const& [key, place, value] : table.entries) {
    bool const whole = value.kind == Node::Kind::integer && value.integer > 0 && value.integer <= 10000;
    if (key == "name" && value.is_text())
      row.name = value.text;
    else if (key == "set" && value.is_array())
      for (Node const& item : value.items) row.set.push_back(item.text);
    else if (key == "scalar" && value.kind == Node::Kind::flag)
      row.scalar = value.flag;
    else if ((key == "warm_up" || key == "steps") && whole)
      (key == "steps" ? row.steps : row.warm_up) = static_cast<int>(value.integer);
    else
      problems.add(place,
                   fmt::format("{} is no such key of a row (allowed: name, a text; set, a list of \"key=value\"; "
                               "scalar, true or false; warm_up and steps, from 1 to 10000) - correct it",
                               in_quotes(key)));
  }
  if (row.name.empty()) problems.add(table.place, "the row has no name (a text is needed) - add it");
  return row;
}

BenchFile read_benchmark(fs::path const& folder, std::string const& name) {
  fs::path const path = folder / name / "rows.toml";
  Problems problems;
  auto const document = parse_document(read_input_file(path), path.string(), problems);
  problems.raise_if_any();
  BenchFile file{name, folder / name / "case.toml", false, {}};
  for (auto const& [key, place, value] : document->root.entries) {
    if (key == "in_turn" && value.kind == Node::Kind::flag)
      file.in_turn = value.flag;
    else if (key == "row" && value.is_list_of_tables())
      for (Node const& table : value.items) file.rows.push_back(read_row(table, problems));
    else
      problems.add(place, fmt::format("{} is no such key (allowed: in_turn, true or false; row, a list of tables) - "
                                      "correct it",
                                      in_quotes(key)));
  }
  problems.raise_if_any();
  return file;
}

}  // namespace

std::vector<BenchFile> read_benchmarks(fs::path const& folder, std::vector<std::string> const& names) {
  std::vector<std::string> known;
  std::error_code error;
  for (auto const& entry : fs::recursive_directory_iterator(folder, error))
    if (entry.path().filename() == "rows.toml")
      known.push_back(entry.path().parent_path().lexically_relative(folder).generic_string());
  std::sort(known.begin(), known.end());
  std::vector<BenchFile> files;
  for (std::string const& name : names) {
    std::size_t const before = files.size();
    for (std::string const& one : known)
      if (one == name || one.starts_with(name + "/")) files.push_back(read_benchmark(folder, one));
    if (files.size() == before)
      throw InputError(fmt::format("{}: holds no benchmark {} (known: {}) - {}", folder.string(), in_quotes(name),
                                   joined(known), advice_for_name(name, known)));
  }
  return files;
}

}  // namespace piola
