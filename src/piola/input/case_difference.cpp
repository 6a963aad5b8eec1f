// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_difference.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/input/renamed_keys.hpp"
#include <algorithm>
#include <array>
#include <set>

namespace piola {
namespace {

using Leaf = std::pair<std::string, std::string>;  // dotted path, value as TOML
constexpr char const* nothing = "nothing";

// Key, or section whose keys may all change.
constexpr std::array<std::string_view, 8> changeable{"run.end",      "run.threads",     "run.instruction_set",
                                                     "run.min_step", "run.repartition", "run.guards",
                                                     "output",       "quantity"};

/// Names of the tables of a list; numbers if names are missing or not unique.
std::vector<std::string> steps_of(Node const& list) {
  std::vector<std::string> names, numbers;
  for (Node const& item : list.items) {
    Node const* const name = item.find("name");
    if (name != nullptr && name->is_text()) names.push_back(name->text);
    numbers.push_back(std::to_string(numbers.size()));
  }
  bool const unique = std::set<std::string>(names.begin(), names.end()).size() == list.items.size();
  return unique ? names : numbers;
}

void collect(Node const& node, std::string const& path, std::vector<Leaf>& leaves) {
  auto const below = [&](std::string const& step) { return path.empty() ? step : path + "." + step; };
  if (node.is_table() && !node.entries.empty()) {
    for (Node::Entry const& entry : node.entries) collect(entry.value, below(entry.key), leaves);
  } else if (node.is_list_of_tables()) {
    auto const steps = steps_of(node);
    leaves.emplace_back(path, "[" + joined(steps) + "]");  // their order counts
    for (std::size_t i = 0; i < steps.size(); ++i) collect(node.items[i], below(steps[i]), leaves);
  } else {
    leaves.emplace_back(path, toml_value(node));
  }
}

std::vector<Leaf> leaves_of(std::string_view text, char const* name) {
  Problems problems;
  auto document = parse_document(text, name, problems);
  if (document) use_current_spellings(*document, problems);
  problems.raise_if_any();
  std::vector<Leaf> leaves;
  collect(document->root, "", leaves);
  return leaves;
}

std::string const* value_at(std::vector<Leaf> const& leaves, std::string const& path) {
  auto const found = std::find_if(leaves.begin(), leaves.end(), [&](Leaf const& leaf) { return leaf.first == path; });
  return found == leaves.end() ? nullptr : &found->second;
}

}  // namespace

std::vector<CaseDifference> case_differences(std::string_view before, std::string_view after) {
  if (before == after) return {};
  auto const old_leaves = leaves_of(before, "the case as run"), new_leaves = leaves_of(after, "the case");
  std::vector<CaseDifference> differences;
  for (auto const& [path, value] : new_leaves) {
    std::string const* const old = value_at(old_leaves, path);
    if (old == nullptr || *old != value) differences.push_back({path, old == nullptr ? nothing : *old, value});
  }
  for (auto const& [path, value] : old_leaves) {
    if (value_at(new_leaves, path) == nullptr) differences.push_back({path, value, nothing});
  }
  return differences;
}

bool may_change_on_resume(std::string_view key) {
  return std::any_of(changeable.begin(), changeable.end(), [&](std::string_view allowed) {
    return key == allowed || (key.starts_with(allowed) && key[allowed.size()] == '.');
  });
}

std::string keys_that_may_change() { return joined(changeable); }

}  // namespace piola
