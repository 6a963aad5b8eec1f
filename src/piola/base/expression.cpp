// SPDX-License-Identifier: Apache-2.0
#include "piola/base/expression.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include <algorithm>
#include <cmath>
#include <muParser.h>
#include <numbers>
#include <set>

namespace piola {
namespace {

constexpr std::size_t longest_text = 4000;

struct Function {
  char const* name;
  int arguments;  ///< 0: one or more
};
constexpr std::array functions{Function{"sin", 1},  Function{"cos", 1},  Function{"tan", 1},   Function{"asin", 1},
                               Function{"acos", 1}, Function{"atan", 1}, Function{"atan2", 2}, Function{"exp", 1},
                               Function{"log", 1},  Function{"sqrt", 1}, Function{"abs", 1},   Function{"pow", 2},
                               Function{"min", 0},  Function{"max", 0}};
constexpr std::array<std::string_view, 5> own_variables{"X", "Y", "Z", "t", "pi"};

double minimum(double const* values, int count) { return *std::min_element(values, values + count); }
double maximum(double const* values, int count) { return *std::max_element(values, values + count); }
double negation(double value) { return value == 0 ? 1 : 0; }
double conjunction(double a, double b) { return a != 0 && b != 0 ? 1 : 0; }
double disjunction(double a, double b) { return a != 0 || b != 0 ? 1 : 0; }

// Only what the manual lists: muParser's own set is larger, and differs between its versions.
void define_functions(mu::Parser& parser) {
  parser.ClearFun();
  parser.ClearConst();
  parser.DefineFun(
      "sin", +[](double x) { return std::sin(x); });
  parser.DefineFun(
      "cos", +[](double x) { return std::cos(x); });
  parser.DefineFun(
      "tan", +[](double x) { return std::tan(x); });
  parser.DefineFun(
      "asin", +[](double x) { return std::asin(x); });
  parser.DefineFun(
      "acos", +[](double x) { return std::acos(x); });
  parser.DefineFun(
      "atan", +[](double x) { return std::atan(x); });
  parser.DefineFun(
      "atan2", +[](double y, double x) { return std::atan2(y, x); });
  parser.DefineFun(
      "exp", +[](double x) { return std::exp(x); });
  parser.DefineFun(
      "log", +[](double x) { return std::log(x); });
  parser.DefineFun(
      "sqrt", +[](double x) { return std::sqrt(x); });
  parser.DefineFun(
      "abs", +[](double x) { return std::abs(x); });
  parser.DefineFun(
      "pow", +[](double x, double y) { return std::pow(x, y); });
  parser.DefineFun("min", minimum);
  parser.DefineFun("max", maximum);
  parser.DefineInfixOprt("!", negation);
  parser.DefineOprt("&", conjunction, mu::prLAND, mu::oaLEFT, true);
  parser.DefineOprt("|", disjunction, mu::prLOR, mu::oaLEFT, true);
}

// Between constants, muParser's own && and || truncate to whole numbers: 0.5 && 1 is 0. Replaces them by operators of
// Piola with other names; the blank keeps the columns of the following text.
std::string with_own_operators(std::string text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if ((text[i] == '&' || text[i] == '|') && text[i + 1] == text[i]) text[++i] = ' ';
  }
  return text;
}

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
  for (Function const& function : functions) known.emplace_back(function.name);
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

void check_text(std::string const& text, Names const& names) {
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

std::string explain(mu::Parser::exception_type const& error) {
  std::string text = error.GetToken();
  bool const logical = text.starts_with('&') || text.starts_with('|');
  if (logical) text = std::string(2, text[0]);  // what was typed; see with_own_operators
  std::string const token = in_quotes(text);
  if (logical && error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
    return "the operator " + token + " has nothing to work on";
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_OPERATOR: return "the operator " + token + " has nothing to work on";
    case mu::ecUNEXPECTED_EOF: return "the formula ends too early";
    case mu::ecUNEXPECTED_ARG_SEP:
    case mu::ecUNEXPECTED_ARG: return "a comma is not expected here";
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN: return "an operator is missing before " + token;
    case mu::ecUNEXPECTED_PARENS: return "the bracket " + token + " is not expected here";
    case mu::ecMISSING_PARENS: return "a closing bracket is missing";
    case mu::ecTOO_MANY_PARAMS: return "the function " + token + " has too many arguments";
    case mu::ecTOO_FEW_PARAMS: return "the function " + token + " has too few arguments";
    case mu::ecUNEXPECTED_CONDITIONAL: return "\"?\" is not expected here";
    case mu::ecMISSING_ELSE_CLAUSE: return "\"?\" has no \":\" with the other value";
    case mu::ecMISPLACED_COLON: return "\":\" has no \"?\" before it";
    case mu::ecUNASSIGNABLE_TOKEN: return token + " is not understood";
    default: return "the formula is not understood";
  }
}

}  // namespace

/// Parsers hold pointers to the variables beside them, so every copy compiles its formula again.
struct Expression::Compiled {
  std::string text = "0";
  Names names;
  Function function;  ///< instead of the formula, if there is one
  double X = 0, Y = 0, Z = 0, t = 0;
  std::vector<double> values;        ///< of the variables in `names`; never resized once parsers point to them
  std::vector<double> place_values;  ///< of the numbers of places in `names`; never resized either
  bool needs_values = false;
  bool constant = true;
  double constant_value = 0;
  struct Part {
    mu::Parser parser;
    double value = 0;
  };
  std::vector<std::unique_ptr<Part>> definitions;  ///< only those that are used, in order
  mu::Parser parser;

  Compiled() = default;
  Compiled(std::string const& formula, Names const& known) : text(formula) {
    check_text(text, known);
    keep_used(known);
    for (Definition const& definition : names.definitions) add_definition(definition);
    prepare(parser, text);
    for (std::size_t i = 0; i < definitions.size(); ++i) {
      parser.DefineVar(names.definitions[i].name, &definitions[i]->value);
    }
    compile(parser);
    auto const used = words_of(text);
    constant = definitions.empty() && !needs_values && names.places.empty() &&
               std::none_of(used.begin(), used.end(), [](Word const& word) {
                 return word.text == "X" || word.text == "Y" || word.text == "Z" || word.text == "t";
               });
    if (constant) constant_value = parser.Eval();
  }

  // A formula carries only the names it needs: copies stay small and evaluation does no idle work.
  void keep_used(Names const& known) {
    std::set<std::string> needed;
    for (Word const& word : words_of(text)) needed.insert(word.text);
    std::for_each(known.definitions.rbegin(), known.definitions.rend(), [&](Definition const& d) {
      if (!needed.contains(d.name)) return;
      names.definitions.insert(names.definitions.begin(), d);
      for (Word const& word : words_of(d.text)) needed.insert(word.text);
    });
    for (auto const& [name, value] : known.constants) {
      if (needed.contains(name)) names.constants.emplace(name, value);
    }
    for (auto const& [name, value] : known.places) {
      if (needed.contains(name)) names.places.emplace(name, value);
    }
    place_values.resize(names.places.size());
    names.variables = known.variables;
    values.resize(known.variables.size());
    needs_values = std::any_of(known.variables.begin(), known.variables.end(),
                               [&](std::string const& name) { return needed.contains(name); });
  }

  void add_definition(Definition const& definition) {
    auto part = std::make_unique<Part>();
    prepare(part->parser, definition.text);
    for (std::size_t i = 0; i < definitions.size(); ++i) {
      part->parser.DefineVar(names.definitions[i].name, &definitions[i]->value);
    }
    compile(part->parser);
    definitions.push_back(std::move(part));
  }

  void prepare(mu::Parser& target, std::string const& formula) {
    define_functions(target);
    target.DefineConst("pi", std::numbers::pi);
    for (auto const& [name, value] : names.constants) target.DefineConst(name, value);
    target.DefineVar("X", &X);
    target.DefineVar("Y", &Y);
    target.DefineVar("Z", &Z);
    target.DefineVar("t", &t);
    for (std::size_t i = 0; i < values.size(); ++i) target.DefineVar(names.variables[i], &values[i]);
    auto value = place_values.begin();
    for (auto const& [name, of_place] : names.places) target.DefineVar(name, &*value++);
    target.SetExpr(with_own_operators(formula));
  }

  // The first evaluation compiles; muParser reports errors only then.
  static void compile(mu::Parser& target) {
    try {
      int results = 0;
      target.Eval(results);
      if (results != 1) throw ExpressionError{"a comma is not expected here: a formula has one value", 0};
    } catch (mu::Parser::exception_type const& error) {
      // muParser ends its own copy of the formula with a space.
      int const position = error.GetPos(), size = static_cast<int>(target.GetExpr().size()) - 1;
      throw ExpressionError{explain(error), position < 0 ? 0 : std::min(position, size) + 1};
    }
  }
};

Expression::Expression() : compiled_(std::make_unique<Compiled>()) {}

Expression::Expression(std::string const& text, Names const& names) {
  try {
    compiled_ = std::make_unique<Compiled>(text, names);
  } catch (mu::Parser::exception_type const& error) {
    throw ExpressionError{explain(error), 0};
  }
}

Expression::Expression(std::string text, Function function) : compiled_(std::make_unique<Compiled>()) {
  PIOLA_EXPECTS(function != nullptr);
  compiled_->text = std::move(text);
  compiled_->function = std::move(function);
  compiled_->constant = false;
}

Expression::Expression(Expression const& other) {
  PIOLA_EXPECTS(other.compiled_ != nullptr);
  Compiled const& c = *other.compiled_;
  if (c.function)
    *this = Expression(c.text, c.function);
  else if (c.constant && c.text == "0")
    compiled_ = std::make_unique<Compiled>();
  else
    compiled_ = std::make_unique<Compiled>(c.text, c.names);
}
Expression& Expression::operator=(Expression const& other) {
  if (this != &other) *this = Expression(other);
  return *this;
}
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

double Expression::operator()(std::array<double, 3> const& X, double t) const { return (*this)(X, t, {}); }

double Expression::operator()(std::array<double, 3> const& X, double t, std::span<double const> variables) const {
  Compiled& c = *compiled_;
  if (c.constant) return c.constant_value;
  if (c.function) return c.function(X, t);
  PIOLA_EXPECTS(!c.needs_values || variables.size() == c.values.size());
  if (c.needs_values) std::copy(variables.begin(), variables.end(), c.values.begin());
  c.X = X[0];
  c.Y = X[1];
  c.Z = X[2];
  c.t = t;
  auto value = c.place_values.begin();
  for (auto const& [name, function] : c.names.places) *value++ = function(X);
  for (auto const& part : c.definitions) part->value = part->parser.Eval();
  return c.parser.Eval();
}

std::string const& Expression::text() const {
  PIOLA_EXPECTS(compiled_ != nullptr);
  return compiled_->text;
}

bool Expression::depends_on_time() const {
  PIOLA_EXPECTS(compiled_ != nullptr);
  if (compiled_->function) return true;
  auto const uses_time = [](std::string const& text) {
    auto const words = words_of(text);
    return std::any_of(words.begin(), words.end(), [](Word const& word) { return word.text == "t"; });
  };
  auto const& definitions = compiled_->names.definitions;
  return uses_time(compiled_->text) ||
         std::any_of(definitions.begin(), definitions.end(), [&](Definition const& d) { return uses_time(d.text); });
}

std::vector<std::string> expression_words(std::string const& text) {
  std::vector<std::string> words;
  for (Word const& word : words_of(text)) words.push_back(word.text);
  return words;
}

bool is_reserved_name(std::string_view name) {
  bool const variable = std::find(own_variables.begin(), own_variables.end(), name) != own_variables.end();
  return variable || std::any_of(functions.begin(), functions.end(), [&](Function const& f) { return name == f.name; });
}

}  // namespace piola
