// SPDX-License-Identifier: Apache-2.0
#include "piola/base/formula_text.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include <algorithm>

namespace piola {
namespace {

constexpr std::size_t longest_text = 4000;

/// Functions of formulas; expression.cpp defines them.
constexpr std::array<std::string_view, 14> functions{"sin", "cos", "tan",  "asin", "acos", "atan", "atan2",
                                                     "exp", "log", "sqrt", "abs",  "pow",  "min",  "max"};
constexpr std::array<std::string_view, 5> own_variables{"X", "Y", "Z", "t", "pi"};

[[noreturn]] void fail(std::string text, std::size_t position) {
  throw ExpressionError{std::move(text), static_cast<int>(position) + 1};
}

bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

struct Word {
  std::string text;
  std::size_t position;
};

// First character after the number or word that starts at `i`; 1e-5 is one number.
std::size_t end_of_token(std::string const& text, std::size_t i) {
  auto const digit = [&](std::size_t k) { return k < text.size() && text[k] >= '0' && text[k] <= '9'; };
  if (digit(i) || text[i] == '.') {
    while (digit(i) || (i < text.size() && text[i] == '.')) ++i;
    bool const exponent = i < text.size() && (text[i] == 'e' || text[i] == 'E');
    bool const sign = i + 1 < text.size() && (text[i + 1] == '+' || text[i + 1] == '-');
    if (exponent && digit(i + (sign ? 2 : 1))) i += sign ? 2 : 1;
  }
  while (i < text.size() && is_word_character(text[i])) ++i;
  return i;
}

// Names in a formula; numbers are stepped over.
std::vector<Word> words_of(std::string const& text) {
  std::vector<Word> words;
  for (std::size_t i = 0; i < text.size();) {
    bool const number = text[i] == '.' || (text[i] >= '0' && text[i] <= '9');
    if (!number && !is_word_character(text[i])) {
      ++i;
      continue;
    }
    std::size_t const end = end_of_token(text, i);
    if (!number) words.push_back({text.substr(i, end - i), i});
    i = end;
  }
  return words;
}

std::vector<std::string> known_names(Names const& names) {
  std::vector<std::string> known = to_strings(own_variables);
  known.insert(known.end(), names.variables.begin(), names.variables.end());
  for (auto const& [name, value] : names.constants) known.push_back(name);
  for (Definition const& definition : names.definitions) known.push_back(definition.name);
  for (auto const& [name, value] : names.places) known.push_back(name);
  for (std::string_view const function : functions) known.emplace_back(function);
  return known;
}

struct Suggestion {
  std::string_view written, advice;
};
/// Operators and functions of other languages, for advice in messages.
constexpr std::array other_tongues{
    Suggestion{"if", "\"if\" is not a function - write condition ? value : other_value"},
    Suggestion{"and", "\"and\" is not an operator - write &&"},
    Suggestion{"or", "\"or\" is not an operator - write ||"},
    Suggestion{"not", "\"not\" is not an operator - write !"},
    Suggestion{"x",
               "\"x\" is not known (the position in the reference configuration is X, Y, Z) - did you mean \"X\"?"},
    Suggestion{"y",
               "\"y\" is not known (the position in the reference configuration is X, Y, Z) - did you mean \"Y\"?"},
    Suggestion{"z",
               "\"z\" is not known (the position in the reference configuration is X, Y, Z) - did you mean \"Z\"?"},
    Suggestion{"T", "\"T\" is not known (the time is t) - did you mean \"t\"?"},
};

/// The character before a position that is not blank; a blank if there is none.
char before(std::string const& text, std::size_t position) {
  std::size_t const found = position == 0 ? std::string::npos : text.find_last_not_of(" \t", position - 1);
  return found == std::string::npos ? ' ' : text[found];
}

[[noreturn]] void fail_unit(std::string const& unit, std::size_t position) {
  fail(in_quotes(unit) +
           " is a unit, which cannot stand in a formula (numbers are in SI) - write the number in SI, or " +
           "name the quantity in constants, e.g. a = \"5 " + unit + "\"",
       position);
}

/// A word right after a number, or a factor of two letters or more, that can be read as a unit.
void refuse_unit(std::string const& text, Word const& word) {
  char const left = before(text, word.position);
  bool const after_number = left == ')' || left == '.' || (left >= '0' && left <= '9');
  bool const factor = (left == '*' || left == '/') && word.text.size() > 1;
  if ((after_number || factor) && is_unit(word.text)) fail_unit(word.text, word.position);
}

[[noreturn]] void fail_unknown(std::string const& text, Word const& word, Names const& names) {
  for (Suggestion const& meant : other_tongues) {
    if (word.text == meant.written) fail(std::string(meant.advice), word.position);
  }
  refuse_unit(text, word);
  std::vector<std::string> const known = known_names(names);
  auto const near = nearest_name(word.text, known);
  std::string const advice =
      near ? "did you mean " + in_quotes(*near) + "?" : "use one of these or add it to define or constants";
  fail(in_quotes(word.text) + " is not known (known: " + joined(known) + ") - " + advice, word.position);
}

// Refuses names with two possible meanings.
void refuse_two_meanings(Word const& word, Names const& names) {
  auto const& given = names.variables;
  if (std::find(given.begin(), given.end(), word.text) == given.end()) return;
  bool const defined = std::any_of(names.definitions.begin(), names.definitions.end(),
                                   [&](Definition const& d) { return d.name == word.text; });
  if (!defined && !names.constants.contains(word.text)) return;
  fail(in_quotes(word.text) + " is a variable of this formula and a name in define or constants, too - choose " +
           "another name there",
       word.position);
}

// Assignments would let one formula change the variables of another; muParser allows them.
void refuse_assignment(std::string const& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
      continue;
    }
    bool const comparison = i > 0 && (text[i - 1] == '<' || text[i - 1] == '>' || text[i - 1] == '!');
    if (!comparison) fail("\"=\" assigns, which a formula cannot do - write == to compare", i);
  }
}

// Operators that look right and are not.
void refuse_operators(std::string const& text) {
  if (std::size_t const at = text.find("**"); at != std::string::npos)
    fail("\"**\" is not an operator - write ^ for powers", at);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '&' && text[i] != '|') continue;
    bool const twice = i + 1 < text.size() && text[i + 1] == text[i];
    if (!twice) fail(in_quotes(std::string(1, text[i])) + " is not an operator - write " + std::string(2, text[i]), i);
    ++i;
  }
}

// A unit that sticks to its number, as in 5mm.
void refuse_glued_units(std::string const& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    bool const number = text[i] == '.' || (text[i] >= '0' && text[i] <= '9');
    if (!number && !is_word_character(text[i])) continue;
    std::size_t const end = end_of_token(text, i);
    std::string const token = text.substr(i, end - i);
    std::size_t const letters = token.find_last_of("0123456789.") + 1;
    if (number && letters < token.size() && is_unit(token.substr(letters)))
      fail_unit(token.substr(letters), i + letters);
    i = end - 1;
  }
}

void refuse_characters(std::string const& text) {
  constexpr std::string_view marks = " \t+-*/^().,<>=!&|?:";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_word_character(text[i]) || marks.find(text[i]) != std::string_view::npos) continue;
    bool const printable = text[i] > ' ' && text[i] < 0x7f;
    fail((printable ? in_quotes(text.substr(i, 1)) : "a character outside ASCII") +
             std::string(" cannot stand in a formula"),
         i);
  }
}

}  // namespace

void check_formula_text(std::string const& text, Names const& names) {
  if (text.find_first_not_of(" \t") == std::string::npos) throw ExpressionError{"the formula is empty", 0};
  if (text.size() > longest_text) throw ExpressionError{"the formula is too long (at most 4000 characters)", 0};
  refuse_characters(text);
  refuse_assignment(text);
  refuse_operators(text);
  refuse_glued_units(text);
  std::vector<std::string> const known = known_names(names);
  for (Word const& word : words_of(text)) {
    if (std::find(known.begin(), known.end(), word.text) == known.end()) fail_unknown(text, word, names);
    refuse_two_meanings(word, names);
  }
}

std::vector<std::string> expression_words(std::string const& text) {
  std::vector<std::string> words;
  for (Word const& word : words_of(text)) words.push_back(word.text);
  return words;
}

bool is_reserved_name(std::string_view name) {
  return std::find(own_variables.begin(), own_variables.end(), name) != own_variables.end() ||
         std::find(functions.begin(), functions.end(), name) != functions.end();
}

}  // namespace piola
