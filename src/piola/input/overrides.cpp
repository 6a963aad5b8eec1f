// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/document.hpp"
#include "piola/input/document_limits.hpp"
#include "piola/input/renamed_keys.hpp"
#include <algorithm>
#include <charconv>

namespace piola {

Node const* Node::find(std::string_view key) const {
  auto const entry = std::find_if(entries.begin(), entries.end(), [&](Entry const& e) { return e.key == key; });
  return entry == entries.end() ? nullptr : &entry->value;
}

bool Node::is_list_of_tables() const {
  return is_array() && !items.empty() &&
         std::all_of(items.begin(), items.end(), [](Node const& item) { return item.is_table(); });
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(static_cast<Node const*>(this)->find(key)); }

Node text_node(std::string_view text) {
  Node node;
  node.kind = Node::Kind::text;
  node.text = text;
  return node;
}

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::vector<std::string> path_of(std::string_view text) {
  std::vector<std::string> path;
  for (std::size_t start = 0; start <= text.size();) {
    std::size_t const dot = std::min(text.find('.', start), text.size());
    path.emplace_back(trimmed(text.substr(start, dot - start)));
    start = dot + 1;
  }
  return path;
}

void set_place(Node& node, Place const& place, std::string const& base) {
  node.place = place;
  node.base = base;
  node.text_offset = 0;
  for (Node::Entry& entry : node.entries) {
    entry.place = place;
    set_place(entry.value, place, base);
  }
  for (Node& item : node.items) set_place(item, place, base);
}

/// One setting on its way into a document.
struct Setting {
  Place place;  ///< file is "--set path=value"
  std::vector<std::string> path;
  Node value;
};

// A text that looks like the start of a structured value must be TOML; any other text that is not TOML is a bare word.
std::optional<Node> value_of(std::string_view text, Place const& place, Problems& problems) {
  Problems found;
  bool const one_line = text.find('\n') == std::string_view::npos;
  auto document = one_line ? parse_document("value = " + std::string(text), "value", found) : std::nullopt;
  if (document && document->root.entries.size() == 1) return document->root.entries.front().value;
  bool const structured = !text.empty() && std::string_view("[{\"'").find(text.front()) != std::string_view::npos;
  if (!structured) return text_node(text);
  problems.add(place, "the value " + in_quotes(text) +
                          " is not TOML (allowed: a number, a text, [..], {..}, true, "
                          "false) - mind the quotes of the shell");
  return std::nullopt;
}

/// `file`: that of the case.
std::optional<Setting> setting_of(std::string const& text, std::string const& file, Problems& problems) {
  Place const place{"--set " + std::string(text.substr(0, 200)), 0, 0};
  std::size_t const equals = text.find('=');
  std::vector<std::string> path = path_of(std::string_view(text).substr(0, equals));
  bool const empty_step = std::any_of(path.begin(), path.end(), [](std::string const& step) { return step.empty(); });
  if (equals == std::string::npos || empty_step || path.size() > 32) {
    problems.add(place,
                 "not of the form path=value - write for example --set run.end=\"0.5 s\" or "
                 "--set body.0.material.poissons_ratio=0.499");
    return std::nullopt;
  }
  auto value = value_of(trimmed(std::string_view(text).substr(equals + 1)), place, problems);
  if (!value) return std::nullopt;
  set_place(*value, place, file);
  refuse_unusable_texts(*value, problems);
  return Setting{place, std::move(path), std::move(*value)};
}

std::vector<std::string> names_of(Node const& array) {
  std::vector<std::string> names;
  for (Node const& item : array.items) {
    Node const* const name = item.find("name");
    if (name != nullptr && name->is_text()) names.push_back(name->text);
  }
  return names;
}

Node* item_of(Node& array, std::string const& step, std::string const& where, Setting const& setting,
              Problems& problems) {
  std::size_t number = 0;
  auto const [end, error] = std::from_chars(step.data(), step.data() + step.size(), number);
  if (error == std::errc{} && end == step.data() + step.size()) {
    if (number < array.items.size()) return &array.items[number];
    std::string const count = std::to_string(array.items.size());
    problems.add(setting.place, in_quotes(where) + " has " + count + (array.items.size() == 1 ? " item" : " items") +
                                    " (they count from 0) - use a smaller number than " + step);
    return nullptr;
  }
  for (Node& item : array.items) {
    Node const* const name = item.find("name");
    if (name != nullptr && name->is_text(step)) return &item;
  }
  std::vector<std::string> const names = names_of(array);
  problems.add(setting.place, "no " + where + " has the name " + in_quotes(step) + " (" +
                                  (names.empty() ? "they have numbers from 0" : "known: " + joined(names)) + ") - " +
                                  (names.empty() ? "use a number" : advice_for_name(step, names)));
  return nullptr;
}

void apply(Document& document, Setting const& setting, Problems& problems) {
  Node* at = &document.root;
  std::string where, section;
  for (std::size_t i = 0; i < setting.path.size(); ++i) {
    std::string step = setting.path[i];
    bool const last = i + 1 == setting.path.size();
    if (at->is_array()) {
      at = item_of(*at, step, where, setting, problems);
      if (at == nullptr) return;
    } else if (at->is_table()) {
      if (auto const now = renamed_key(section, step)) {
        note_old_spelling(document, setting.place, step, *now);
        step = *now;
      }
      section = section_below(section, step);
      if (at->find(step) == nullptr) {
        Node table;
        set_place(table, setting.place, setting.value.base);
        at->entries.push_back({step, setting.place, table});
      }
      at = at->find(step);
    } else {
      problems.add(setting.place,
                   in_quotes(where) + " is a single value and has no " + in_quotes(step) + " - shorten the path");
      return;
    }
    where += (where.empty() ? "" : ".") + step;
    if (last) *at = setting.value;
  }
}

}  // namespace

void apply_overrides(Document& document, std::span<std::string const> overrides, Problems& problems) {
  use_current_spellings(document, problems);
  if (overrides.empty()) return;
  for (std::string const& text : overrides) {
    if (auto const setting = setting_of(text, document.root.place.file, problems)) apply(document, *setting, problems);
  }
  use_current_spellings(document, problems);
  document.source = toml_text(document.root);
}

}  // namespace piola
