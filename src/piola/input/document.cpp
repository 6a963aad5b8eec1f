// SPDX-License-Identifier: Apache-2.0
// The only file that knows toml++; its header comes first because it sets how the parser fails.
#include "piola/input/document.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/input/document_limits.hpp"
#include "piola/input/toml_library.hpp"
#include <algorithm>
#include <sstream>

namespace piola {
namespace {

class Converter {
 public:
  Converter(std::string_view text, std::string file) : file_(std::move(file)) {
    while (!text.empty()) {
      std::size_t const end = text.find('\n');
      lines_.push_back(text.substr(0, end));
      text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
  }

  Node node(toml::node const& from) const {
    Node to;
    to.place = place(from.source());
    if (auto const* table = from.as_table())
      fill_table(*table, to);
    else if (auto const* array = from.as_array())
      fill_array(*array, to);
    else
      fill_value(from, to);
    return to;
  }

 private:
  Place place(toml::source_region const& region) const {
    return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  }

  void fill_table(toml::table const& from, Node& to) const {
    to.kind = Node::Kind::table;
    for (auto const& [key, value] : from) {
      to.entries.push_back({std::string(key.str()), place(key.source()), node(value)});
    }
    // toml++ keeps keys sorted by name; people think in the order in which they wrote them.
    std::stable_sort(to.entries.begin(), to.entries.end(), [](Node::Entry const& a, Node::Entry const& b) {
      return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
    });
  }

  void fill_array(toml::array const& from, Node& to) const {
    to.kind = Node::Kind::array;
    for (toml::node const& item : from) to.items.push_back(node(item));
  }

  void fill_value(toml::node const& from, Node& to) const {
    if (auto const* text = from.as_string()) {
      to.kind = Node::Kind::text;
      to.text = text->get();
      to.text_offset = text_offset(to);
    } else if (auto const* integer = from.as_integer()) {
      to.kind = Node::Kind::integer;
      to.integer = integer->get();
    } else if (auto const* real = from.as_floating_point()) {
      to.kind = Node::Kind::real;
      to.real = real->get();
    } else if (auto const* flag = from.as_boolean()) {
      to.kind = Node::Kind::flag;
      to.flag = flag->get();
    } else {
      std::ostringstream out;
      if (auto const* date = from.as_date()) out << date->get();
      if (auto const* time = from.as_time()) out << time->get();
      if (auto const* both = from.as_date_time()) out << both->get();
      to.kind = Node::Kind::date;
      to.text = out.str();
    }
  }

  // Columns count characters, so this holds only if the text is literal in the file: no escapes, nothing beyond ASCII
  // before it on the line.
  int text_offset(Node const& node) const {
    auto const line = static_cast<std::size_t>(node.place.line), column = static_cast<std::size_t>(node.place.column);
    if (line == 0 || line > lines_.size() || column == 0) return 0;
    std::string_view const source = lines_[line - 1];
    return source.size() > column && source.substr(column, node.text.size()) == node.text ? 1 : 0;
  }

  std::string file_;
  std::vector<std::string_view> lines_;
};

bool parser_gives_up(std::string_view text) {
  try {
    static_cast<void>(toml::parse(text));
  } catch (toml::parse_error const&) {
    return false;
  } catch (std::logic_error const&) {
    return true;
  }
  return false;
}

// The parser reads from top to bottom, so the first line that makes it give up can be bracketed.
int line_of_giving_up(std::string_view text) {
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') ends.push_back(i + 1);
  }
  ends.push_back(text.size());
  std::size_t low = 0, high = ends.size() - 1;
  while (low < high) {
    std::size_t const half = (low + high) / 2;
    if (parser_gives_up(text.substr(0, ends[half])))
      high = half;
    else
      low = half + 1;
  }
  return static_cast<int>(low) + 1;
}

std::string lower_start(std::string_view text) {
  std::string lowered(text);
  if (!lowered.empty() && lowered[0] >= 'A' && lowered[0] <= 'Z') lowered[0] = static_cast<char>(lowered[0] + 32);
  return lowered;
}

/// The first number with a unit at the start of a value on a line, outside quotes; empty if there is none.
std::string unquoted_quantity(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    char const c = line[i];
    if (quote != 0 || c == '"' || c == '\'') {
      quote = quote == 0 ? c : quote == c ? '\0' : quote;
      continue;
    }
    if (c == '#') return {};
    if (c != '=' && c != ',' && c != '[') continue;
    std::string_view value = line.substr(i + 1, line.find_first_of("=,[]{}#\"'", i + 1) - i - 1);
    value.remove_prefix(std::min(value.find_first_not_of(" \t"), value.size()));
    value = value.substr(0, value.find_last_not_of(" \t\r") + 1);
    bool const has_unit = value.find_first_not_of("0123456789+-._eE") != std::string_view::npos;
    if (has_unit && !read_any_quantity(value).problem) return std::string(value);
  }
  return {};
}

std::string line_of(std::string_view text, unsigned line) {
  for (unsigned k = 1; k < line; ++k) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return std::string(text.substr(0, text.find('\n')));
}

}  // namespace

std::optional<Document> parse_document(std::string_view text, std::string const& name, Problems& problems) {
  std::size_t const before = problems.count();
  refuse_dangerous_text(text, name, problems);
  if (problems.count() > before) return std::nullopt;
  try {
    toml::table const table = toml::parse(text);
    Document document{Converter(text, name).node(table), std::string(text)};
    refuse_unusable_texts(document.root, problems);
    if (problems.count() > before) return std::nullopt;
    return document;
  } catch (toml::parse_error const& error) {
    auto const& begin = error.source().begin;
    auto const quote = find_open_quote(text, name);
    if (quote && quote->line <= static_cast<int>(begin.line)) {
      problems.add(*quote,
                   "this is not TOML: the quoted text that begins here does not end - close it with the same "
                   "quote, or put the whole value in quotes");
      return std::nullopt;
    }
    std::string const quantity = unquoted_quantity(line_of(text, begin.line));
    std::string const what = "this is not TOML: " + lower_start(error.description());
    problems.add({name, static_cast<int>(begin.line), static_cast<int>(begin.column)},
                 quantity.empty()
                     ? what + " - see docs/user/case-file.md"
                     : "this is not TOML: a quantity with a unit stands in quotes - write " + in_quotes(quantity));
  } catch (std::logic_error const&) {
    problems.add({name, line_of_giving_up(text), 0},
                 "this is not TOML: a stray character in a key or a [header] - see docs/user/case-file.md");
  }
  return std::nullopt;
}

}  // namespace piola
