// SPDX-License-Identifier: Apache-2.0
#include "piola/base/expression.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/formula_text.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <cmath>
#include <muParser.h>
#include <numbers>
#include <optional>
#include <set>

namespace piola {
namespace {

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
  Function function;                    ///< instead of the formula, if there is one
  std::function<double(double)> outer;  ///< instead of the formula, with its argument
  std::optional<Expression> argument;
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
    check_formula_text(text, known);
    keep_used(known);
    for (Definition const& definition : names.definitions) add_definition(definition);
    prepare(parser, text);
    for (std::size_t i = 0; i < definitions.size(); ++i) {
      parser.DefineVar(names.definitions[i].name, &definitions[i]->value);
    }
    compile(parser);
    auto const used = expression_words(text);
    constant = definitions.empty() && !needs_values && names.places.empty() &&
               std::none_of(used.begin(), used.end(), [](std::string const& word) {
                 return word == "X" || word == "Y" || word == "Z" || word == "t";
               });
    if (constant) constant_value = parser.Eval();
  }

  // A formula carries only the names it needs: copies stay small and evaluation does no idle work.
  void keep_used(Names const& known) {
    std::set<std::string> needed;
    for (std::string const& word : expression_words(text)) needed.insert(word);
    std::for_each(known.definitions.rbegin(), known.definitions.rend(), [&](Definition const& d) {
      if (!needed.contains(d.name)) return;
      names.definitions.insert(names.definitions.begin(), d);
      for (std::string const& word : expression_words(d.text)) needed.insert(word);
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

Expression::Expression(std::string text, std::function<double(double)> outer, Expression argument)
    : compiled_(std::make_unique<Compiled>()) {
  PIOLA_EXPECTS(outer != nullptr);
  compiled_->text = std::move(text);
  compiled_->outer = std::move(outer);
  compiled_->argument = std::move(argument);
  compiled_->constant = false;
}

Expression::Expression(Expression const& other) {
  PIOLA_EXPECTS(other.compiled_ != nullptr);
  Compiled const& c = *other.compiled_;
  if (c.function)
    *this = Expression(c.text, c.function);
  else if (c.argument)
    *this = Expression(c.text, c.outer, *c.argument);
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
  if (c.argument) return c.outer((*c.argument)(X, t, variables));
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

bool Expression::uses(std::string_view variable) const {
  PIOLA_EXPECTS(compiled_ != nullptr);
  if (compiled_->function) return true;
  if (compiled_->argument) return compiled_->argument->uses(variable);
  auto const occurs_in = [&](std::string const& text) {
    auto const words = expression_words(text);
    return std::find(words.begin(), words.end(), variable) != words.end();
  };
  auto const& definitions = compiled_->names.definitions;
  return occurs_in(compiled_->text) ||
         std::any_of(definitions.begin(), definitions.end(), [&](Definition const& d) { return occurs_in(d.text); });
}

bool Expression::holds_anywhere() const {
  PIOLA_EXPECTS(compiled_ != nullptr);
  return !compiled_->function && (!compiled_->argument || compiled_->argument->holds_anywhere());
}

bool Expression::is_formula() const {
  PIOLA_EXPECTS(compiled_ != nullptr);
  return !compiled_->function && !compiled_->argument;
}

}  // namespace piola
