// SPDX-License-Identifier: Apache-2.0
#include "piola/input/document_limits.hpp"
#include "piola/base/controls.hpp"
#include "piola/base/text.hpp"
#include <algorithm>

namespace piola {
namespace {

constexpr std::size_t longest_text = 10'000, longest_key = 200;
constexpr int most_dots = 64, most_brackets = 64;

Place place_of(std::string_view text, std::size_t position, std::string const& name) {
  std::string_view const before = text.substr(0, position);
  auto const lines = std::count(before.begin(), before.end(), '\n');
  std::size_t const start = before.rfind('\n');
  std::size_t const column = start == std::string_view::npos ? position : position - start - 1;
  return {name, static_cast<int>(lines) + 1, static_cast<int>(column) + 1};
}

// End of the quoted text that starts at `i`: strings hold dots and brackets that do not nest anything. The end of the
// line, or of the text, if it is not closed.
std::size_t end_of_string(std::string_view text, std::size_t i, bool& closed) {
  char const quote = text[i];
  bool const three = text.substr(i, 3) == std::string(3, quote);
  std::string const close(three ? 3 : 1, quote);
  closed = true;
  for (std::size_t k = i + close.size(); k < text.size(); ++k) {
    if (!three && text[k] == '\n') {
      closed = false;
      return k;
    }
    if (quote == '"' && text[k] == '\\' && text.substr(k + 1, 1) != "\n") {
      ++k;
    } else if (text.substr(k, close.size()) == close) {
      k += close.size() - 1;
      // A long text may end with quotes of its own, at most two.
      for (int more = 0; three && more < 2 && text.substr(k + 1, 1) == close.substr(0, 1); ++more) ++k;
      return k;
    }
  }
  closed = false;
  return text.size();
}

/// First positions, npos: none.
struct Findings {
  std::size_t long_key = std::string_view::npos;    ///< the first dot beyond the limit in one key
  std::size_t deep = std::string_view::npos;        ///< the first bracket beyond the allowed depth of nesting
  std::size_t open_quote = std::string_view::npos;  ///< where a quoted text begins that does not end
};

/// One pass over the text.
Findings scan(std::string_view text) {
  Findings found;
  auto const note = [](std::size_t& first, std::size_t i) { first = std::min(first, i); };
  int dots = 0, depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char const c = text[i];
    if (c == '.' && ++dots > most_dots) note(found.long_key, i);
    if ((c == '[' || c == '{') && ++depth > most_brackets) note(found.deep, i);
    if (c == ']' || c == '}') depth = std::max(depth - 1, 0);
    if (c == '"' || c == '\'') {
      bool closed = true;
      std::size_t const end = end_of_string(text, i, closed);
      if (!closed) note(found.open_quote, i);
      i = end;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
    }
    if (c == '\n' || c == '#' || std::string_view("=,[]{}").find(c) != std::string_view::npos) dots = 0;
  }
  return found;
}

void refuse_controls(std::string_view text, std::string const& what, Place const& place, Problems& problems) {
  std::size_t const at = find_control(text);
  if (at == std::string_view::npos) return;
  problems.add(place, what + " with the control character " + without_controls(text.substr(at, 2)).substr(0, 4) +
                          " (allowed: printable characters, tabs, ends of lines) - remove it");
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
  Findings const found = scan(text);
  if (found.long_key != std::string_view::npos)
    problems.add(place_of(text, found.long_key, name), "a key with more than 64 dots - is this a case file?");
  if (found.deep != std::string_view::npos)
    problems.add(place_of(text, found.deep, name), "brackets in more than 64 others - is this a case file?");
}

std::optional<Place> find_open_quote(std::string_view text, std::string const& name) {
  std::size_t const quote = scan(text).open_quote;
  if (quote == std::string_view::npos) return std::nullopt;
  return place_of(text, quote, name);
}

void refuse_unusable_texts(Node const& node, Problems& problems) {
  if (node.text.size() > longest_text) {
    problems.add(node.place,
                 "a text of " + count_text(static_cast<std::int64_t>(node.text.size())) +
                     " characters (allowed: at most 10,000) - shorten it; long formulas can be divided with "
                     "'define'");
  }
  refuse_controls(node.text, "a text", node.place, problems);
  for (Node::Entry const& entry : node.entries) {
    refuse_controls(entry.key, "a key", entry.place, problems);
    if (entry.key.size() > longest_key) {
      problems.add(entry.place, "a key of " + count_text(static_cast<std::int64_t>(entry.key.size())) +
                                    " characters (allowed: at most 200) - shorten it");
    }
    refuse_unusable_texts(entry.value, problems);
  }
  for (Node const& item : node.items) refuse_unusable_texts(item, problems);
}

}  // namespace piola
