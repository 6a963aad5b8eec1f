// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// A named expression that later expressions may use (`define` in a case file).
struct Definition {
  std::string name;
  std::string text;
};

/// Names that an expression may use in addition to X, Y, Z (reference position [m]), t (time [s]) and pi.
struct Names {
  /// A number that belongs to a reference position [m], such as its depth in a body. Each Expression has a copy, so one
  /// function object is called by one thread at a time.
  using OfPlace = std::function<double(std::array<double, 3> const& X)>;
  std::map<std::string, double> constants;  ///< SI values
  std::vector<Definition> definitions;      ///< in order; each may use those before it
  std::vector<std::string> variables = {};  ///< further variables, whose values are given at each evaluation
  std::map<std::string, OfPlace> places = {};
};

/// A formula in X, Y, Z, t, compiled once (muParser). Copies are independent and share nothing mutable; one object must
/// not be evaluated by two threads at once. Conditions are expressions whose value is not zero;
/// comparisons and logical operators give 1 or 0.
/// Functions: sin cos tan asin acos atan atan2 exp log (natural) sqrt abs min max pow; operators: + - * / ^, == != < <=
/// > >=, && || !, condition ? value : other. Assignments are refused.
class Expression {
 public:
  Expression();  ///< the constant 0
  /// Throws ExpressionError (with a column in `text`) if the text is not a formula in the known names.
  explicit Expression(std::string const& text, Names const& names = {});
  /// A value that a function of the program gives instead of a formula; it depends on time. Copies share the function,
  /// which may be called from any thread. `text` describes it in messages.
  using Function = std::function<double(std::array<double, 3> const& X, double t)>;
  Expression(std::string text, Function function);
  /// The value that `outer` gives for the value of another expression: a table over t, say. `outer` may be called from
  /// any thread. `text` describes it in messages.
  Expression(std::string text, std::function<double(double)> outer, Expression argument);
  Expression(Expression const&);
  Expression& operator=(Expression const&);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  /// Value at reference position X [m] and time t [s]; may be inf or nan, the caller checks.
  double operator()(std::array<double, 3> const& X, double t = 0) const;
  /// As above, with the values of `Names::variables` in their order; formulas that use none of them need no values.
  double operator()(std::array<double, 3> const& X, double t, std::span<double const> variables) const;
  std::string const& text() const;
  bool depends_on_time() const { return uses("t"); }
  /// Whether X, Y, Z or t occurs in it, or in a definition that it uses. A Function may use all of them.
  bool uses(std::string_view variable) const;
  /// Whether it may be evaluated at any place and time. A Function may know its own places and times alone.
  bool holds_anywhere() const;
  /// Whether it is a formula or a number, which its text gives, and no function of the program.
  bool is_formula() const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

struct ExpressionError {
  std::string text;  ///< what is wrong
  int column = 0;    ///< from 1, in the expression; 0 unknown
};

/// The names that a formula uses, in order of appearance (variables, constants, definitions, functions).
std::vector<std::string> expression_words(std::string const& text);

/// Whether a name is reserved in all formulas (X, Y, Z, t, pi and the functions), so that no constant may use it.
bool is_reserved_name(std::string_view name);

}  // namespace piola
