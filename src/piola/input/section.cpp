// SPDX-License-Identifier: Apache-2.0
#include "piola/input/section.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/input/synonyms.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

// Example value for the message about a missing key.
std::string example_of(KeyInfo const& info) {
  std::string const unit(info.unit);
  switch (info.kind) {
    case KeyInfo::Kind::text:
      if (info.key == "title") return "\"A title\"";
      return info.key == "unit" ? "\"mm\"" : "\"...\"";
    case KeyInfo::Kind::name: return "\"column\"";
    case KeyInfo::Kind::word: return in_quotes(info.words.front());
    case KeyInfo::Kind::quantity: return unit == "1" ? "0.5" : "\"1 " + unit + "\"";
    case KeyInfo::Kind::whole: return "1";
    case KeyInfo::Kind::flag: return "true";
    case KeyInfo::Kind::point: return "[\"0 " + unit + "\", ...]";
    case KeyInfo::Kind::formula: return "\"Y <= 0\"";
    case KeyInfo::Kind::formulas: return "[\"0\", ...]";
    case KeyInfo::Kind::list: return "[...]";
    case KeyInfo::Kind::table: return "{ ... }";
  }
  return "";
}

/// By meaning, where that is known; else by spelling.
std::string advice_for_key(std::string_view key, std::span<std::string const> known) {
  auto const synonym = advice_for_synonym(key, known);
  bool const elsewhere = synonym.starts_with("that is");
  return synonym.empty() || (elsewhere && nearest_name(key, known)) ? advice_for_name(key, known) : synonym;
}

}  // namespace

Section::Section(Node const& node, std::string section, Problems& problems)
    : node_(node), section_(std::move(section)), problems_(problems) {
  PIOLA_EXPECTS(node.is_table());
}

Place Section::place_of(std::string_view key) const {
  Node const* const value = node_.find(key);
  return value != nullptr ? value->place : node_.place;
}

Place Section::base_of(std::string_view key) const {
  Node const* const value = node_.find(key);
  Node const& node = value != nullptr ? *value : node_;
  return node.base.empty() ? node.place : Place{node.base, 0, 0};
}

std::string Section::name_of(std::string_view key) const {
  return section_.empty() ? std::string(key) : section_ + "." + std::string(key);
}

KeyInfo const& Section::info_of(std::string_view key) const { return key_info(section_, key); }

void Section::refuse_count(std::string_view owner, std::ptrdiff_t given, std::string_view kinds) const {
  PIOLA_EXPECTS(given != 1);
  problems().add(place(), given == 0 ? fmt::format("{} needs one of {} (has none) - add one", owner, kinds)
                                     : fmt::format("{} has {} of {} (allowed: one) - keep one", owner, given, kinds));
}

void Section::refuse(std::string_view key, std::string const& reason) const {
  if (has(key)) problems_.add(place_of(key), name_of(key) + " " + reason + " - remove it");
}

void Section::report_missing(std::string_view key, std::string_view about, std::string_view example) const {
  std::string const who = section_.empty() ? "the case" : section_;
  problems_.add(node_.place,
                who + " needs " + in_quotes(key) + " (" + std::string(about) + ") - add " + std::string(example));
}

std::optional<Value> Section::find(std::string_view key) const {
  KeyInfo const& info = key_info(section_, key);
  if (Node const* const value = node_.find(key)) return Value{*value, name_of(key)};
  if (info.required()) {
    bool const top = section_.empty() && (info.kind == KeyInfo::Kind::table || info.kind == KeyInfo::Kind::list);
    std::string const bracket = info.kind == KeyInfo::Kind::list ? "[[" : "[";
    std::string const close = info.kind == KeyInfo::Kind::list ? "]]" : "]";
    report_missing(key, info.meaning,
                   top ? bracket + std::string(key) + close : std::string(key) + " = " + example_of(info));
  }
  return std::nullopt;
}

std::optional<Section> Section::table(std::string_view key) const {
  auto const value = find(key);
  if (!value) return std::nullopt;
  if (value->node.is_table()) return Section(value->node, name_of(key), problems_);
  problems_.add(value->node.place, value->name + " is " + shown(value->node) + " (allowed: a table such as " +
                                       std::string(key) + " = { ... })");
  return std::nullopt;
}

bool Section::read(std::string_view key, double& target) const {
  auto const value = find(key);
  if (!value) return false;
  KeyInfo const& info = key_info(section_, key);
  auto const number = read_number(*value, info.unit, info.allowed, problems_);
  if (number) target = *number;
  return number.has_value();
}

bool Section::read(std::string_view key, std::string& target) const {
  auto const value = find(key);
  if (!value) return false;
  KeyInfo const& info = key_info(section_, key);
  auto const text =
      info.words.empty() ? read_text(*value, problems_) : read_word(*value, to_strings(info.words), problems_);
  if (!text) return false;
  if (info.kind == KeyInfo::Kind::name && !is_name(*text)) {
    problems_.add(value->node.place, value->name + " is " + in_quotes(*text) +
                                         " (allowed: letters, digits and _, not starting with a digit, at most 64)");
    return false;
  }
  target = *text;
  return true;
}

int Section::word_index(std::string_view key) const {
  std::string word;
  if (!read(key, word)) return -1;
  auto const words = info_of(key).words;
  return static_cast<int>(std::find(words.begin(), words.end(), std::string_view(word)) - words.begin());
}

bool Section::read(std::string_view key, bool& target) const {
  auto const value = find(key);
  if (!value) return false;
  if (value->node.kind != Node::Kind::flag) {
    problems_.add(value->node.place, value->name + " is " + shown(value->node) + " (allowed: true, false)");
    return false;
  }
  target = value->node.flag;
  return true;
}

std::optional<std::int64_t> Section::whole(std::string_view key) const {
  auto const value = find(key);
  if (!value) return std::nullopt;
  return read_whole(*value, key_info(section_, key).allowed, problems_);
}

std::optional<Expression> Section::formula(std::string_view key, Names const& names) const {
  auto const value = find(key);
  if (!value) return std::nullopt;
  return read_formula(*value, key_info(section_, key).unit, names, problems_);
}

std::optional<std::vector<double>> Section::point(std::string_view key) const {
  auto const value = find(key);
  if (!value) return std::nullopt;
  auto const items = read_list(*value, 1, 3, problems_);
  if (!items) return std::nullopt;
  KeyInfo const& info = key_info(section_, key);
  std::vector<double> numbers;
  for (Value const& item : *items) {
    if (auto const number = read_number(item, info.unit, info.allowed, problems_)) numbers.push_back(*number);
  }
  if (numbers.size() < items->size()) return std::nullopt;
  return numbers;
}

void Section::refuse_unknown(std::vector<std::string> const& more, std::vector<std::string> const& reported) const {
  std::vector<std::string> known;
  for (KeyInfo const& info : keys_of(section_)) known.emplace_back(info.key);
  known.insert(known.end(), more.begin(), more.end());
  for (Node::Entry const& entry : node_.entries) {
    auto const has = [&](std::vector<std::string> const& keys) {
      return std::find(keys.begin(), keys.end(), entry.key) != keys.end();
    };
    if (has(known) || has(reported)) continue;
    std::string const where = section_.empty() ? "a case" : section_;
    problems_.add(entry.place, in_quotes(entry.key) + " is not a key of " + where + " (allowed: " + joined(known) +
                                   ") - " + advice_for_key(entry.key, known));
  }
}

}  // namespace piola
