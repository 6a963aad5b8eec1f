// SPDX-License-Identifier: Apache-2.0
#include "piola/input/document_guard.hpp"
#include "piola/base/text.hpp"
#include <algorithm>

namespace piola {
namespace {

constexpr std::size_t longest_text = 10'000, longest_key = 200;
constexpr int most_dots = 64;

Place place_of(std::string_view text, std::size_t position, std::string const& name) {
  std::string_view const before = text.substr(0, position);
  auto const lines = std::count(before.begin(), before.end(), '\n');
  std::size_t const start = before.rfind('\n');
  std::size_t const column = start == std::string_view::npos ? position : position - start - 1;
  return {name, static_cast<int>(lines) + 1, static_cast<int>(column) + 1};
}

// End of the quoted text that starts at `i`: strings hold dots that do not nest anything.
std::size_t end_of_string(std::string_view text, std::size_t i) {
  char const quote = text[i];
  bool const three = text.substr(i, 3) == std::string(3, quote);
  std::string const close(three ? 3 : 1, quote);
  for (std::size_t k = i + close.size(); k < text.size(); ++k) {
    if (quote == '"' && text[k] == '\\')
      ++k;
    else if (text.substr(k, close.size()) == close)
      return k + close.size() - 1;
    else if (!three && text[k] == '\n')
      return k;
  }
  return text.size();
}

// Position of the first dot too many in one dotted key; npos if there is none.
std::size_t find_long_key(std::string_view text) {
  int dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char const c = text[i];
    if (c == '.' && ++dots > most_dots) return i;
    if (c == '"' || c == '\'')
      i = end_of_string(text, i);
    else if (c == '#')
      i = std::min(text.find('\n', i), text.size());
    if (c == '\n' || c == '#' || std::string_view("=,[]{}").find(c) != std::string_view::npos) dots = 0;
  }
  return std::string_view::npos;
}

}  // namespace

void refuse_dangerous_text(std::string_view text, std::string const& name, Problems& problems) {
  if (text.size() > most_case_bytes) {
    problems.add({name, 0, 0}, "the file has more than 4 MB (allowed: at most that) - is this a case file?");
    return;
  }
  if (std::size_t const nul = text.find('\0'); nul != std::string_view::npos) {
    problems.add(place_of(text, nul, name), "a NUL byte, which no text file holds - is this a case file?");
    return;
  }
  if (std::size_t const dot = find_long_key(text); dot != std::string_view::npos) {
    problems.add(place_of(text, dot, name), "a key with more than 64 dots - is this a case file?");
  }
}

void refuse_long_texts(Node const& node, Problems& problems) {
  if (node.text.size() > longest_text) {
    problems.add(node.place,
                 "a text of " + count_text(static_cast<std::int64_t>(node.text.size())) +
                     " characters (allowed: at most 10,000) - shorten it; long formulas can be divided with "
                     "'define'");
  }
  for (Node::Entry const& entry : node.entries) {
    if (entry.key.size() > longest_key) {
      problems.add(entry.place, "a key of " + count_text(static_cast<std::int64_t>(entry.key.size())) +
                                    " characters (allowed: at most 200) - shorten it");
    }
    refuse_long_texts(entry.value, problems);
  }
  for (Node const& item : node.items) refuse_long_texts(item, problems);
}

}  // namespace piola
