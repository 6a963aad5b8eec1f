// SPDX-License-Identifier: Apache-2.0
#include "piola/base/expression.hpp"
#include "piola/base/text.hpp"
#include "support/key_words.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck.h>

namespace piola {
namespace {

using test::mentions;

double value_of(std::string const& text, std::array<double, 3> const& X = {}, double t = 0) {
  return Expression(text)(X, t);
}

ExpressionError error_of(std::string const& text, Names const& names = {}) {
  try {
    Expression const expression(text, names);
  } catch (ExpressionError const& error) {
    return error;
  }
  return {"no error", -1};
}

TEST(Expression, TheDefaultIsZero) {
  EXPECT_EQ(Expression()({1, 2, 3}, 4), 0);
  EXPECT_EQ(Expression().text(), "0");
}

TEST(Expression, PositionAndTimeAreVariables) {
  EXPECT_DOUBLE_EQ(value_of("X + 10*Y + 100*Z + 1000*t", {1, 2, 3}, 4), 4321);
  EXPECT_DOUBLE_EQ(value_of("105*sin(pi*Y/12)", {0, 6, 0}), 105);
}

TEST(Expression, AllFunctionsOfTheManualExist) {
  EXPECT_DOUBLE_EQ(value_of("sin(1)+cos(1)+tan(1)"), std::sin(1) + std::cos(1) + std::tan(1));
  EXPECT_DOUBLE_EQ(value_of("asin(0.5)+acos(0.5)+atan(0.5)+atan2(1,-1)"),
                   std::asin(0.5) + std::acos(0.5) + std::atan(0.5) + std::atan2(1, -1));
  EXPECT_DOUBLE_EQ(value_of("exp(1)*log(10)*sqrt(2)*abs(-3)*pow(2,3)"),
                   std::numbers::e * std::log(10) * std::numbers::sqrt2 * 24);
  EXPECT_DOUBLE_EQ(value_of("min(3,1,2)+10*max(3,1,2)"), 31);
}

TEST(Expression, MayBeAFunctionOfAnother) {
  Names names;
  names.definitions = {{"w", "X + 2*t"}};
  Expression const inner("w", names),
      outer(
          "twice", [](double x) { return 2 * x; }, inner),
      copy(outer);
  EXPECT_DOUBLE_EQ(copy({3, 0, 0}, 4), 22);
  EXPECT_EQ(copy.text(), "twice");
  EXPECT_TRUE(copy.depends_on_time() && copy.uses("X") && !copy.uses("Y"));
  EXPECT_TRUE(copy.holds_anywhere() && !copy.is_formula() && inner.is_formula());
  Expression const called("called", [](std::array<double, 3> const&, double) { return 1; });
  EXPECT_TRUE(called.uses("Y") && called.depends_on_time());
  EXPECT_FALSE(called.holds_anywhere() || called.is_formula());
  EXPECT_FALSE(Expression(
                   "twice", [](double x) { return 2 * x; }, called)
                   .holds_anywhere());
}

TEST(Expression, OperatorsFollowTheUsualOrder) {
  EXPECT_DOUBLE_EQ(value_of("2^3^2"), 512);
  EXPECT_DOUBLE_EQ(value_of("-2^2"), -4);
  EXPECT_DOUBLE_EQ(value_of("1+2*3-4/2"), 5);
  EXPECT_DOUBLE_EQ(value_of("1e-5*1E5 + .5 + 1.e1"), 11.5);
}

TEST(Expression, ConditionsAreNumbers) {
  EXPECT_EQ(value_of("Y <= 0", {0, 0, 0}), 1);
  EXPECT_EQ(value_of("Y <= 0", {0, 1, 0}), 0);
  EXPECT_EQ(value_of("X > 0 && Y > 0 || Z == 3", {1, 0, 3}), 1);
  EXPECT_EQ(value_of("!(X > 0)", {1, 0, 0}), 0);
  EXPECT_EQ(value_of("X != 1", {1, 0, 0}), 0);
  EXPECT_EQ(value_of("X > 0 ? 5 : 7", {1, 0, 0}), 5);
  EXPECT_EQ(value_of("X > 0 ? 5 : X < -1 ? 6 : 7", {-2, 0, 0}), 6);
}

TEST(Expression, ConstantsAndDefinitionsMayBeUsedInOrder) {
  Names const names{{{"Omega", 105}, {"L", 6}},
                    {{"phase", "pi*Y/(2*L)"}, {"w", "Omega*sin(phase)"}, {"unused", "1/0"}}};
  Expression const e("w*Z", names);
  EXPECT_DOUBLE_EQ(e({0, 6, 2}), 210);
  EXPECT_DOUBLE_EQ(e({0, 2, 1}), 105 * std::sin(std::numbers::pi / 6));
}

TEST(Expression, CopiesAreIndependent) {
  Names const names{{}, {{"w", "X+1"}}};
  Expression const a("w*t", names);
  Expression b = a;
  EXPECT_DOUBLE_EQ(a({1, 0, 0}, 1), 2);
  EXPECT_DOUBLE_EQ(b({2, 0, 0}, 2), 6);
  EXPECT_DOUBLE_EQ(a({1, 0, 0}, 1), 2);
  b = Expression("7");
  EXPECT_EQ(b({}), 7);
  Expression const moved = std::move(b);
  EXPECT_EQ(moved.text(), "7");
}

TEST(Expression, FurtherVariablesTakeTheValuesOfEachEvaluation) {
  Names const names{{{"limit", 0.5}}, {{"far", "X > 10"}, {"both", "far && damage > limit"}}, {"damage", "jacobian"}};
  Expression const e("damage + 10*jacobian + 100*X + 1000*t", names);
  Expression const copy = e;
  EXPECT_EQ(e({2, 0, 0}, 3, std::array{0.5, 0.25}), 0.5 + 2.5 + 200 + 3000);
  EXPECT_EQ(copy({0, 0, 0}, 0, std::array{1.0, 0.0}), 1);
  EXPECT_EQ(e({0, 0, 0}, 0, std::array{0.0, 1.0}), 10);
  Expression const through_definition("both", names);
  EXPECT_EQ(through_definition({11, 0, 0}, 0, std::array{0.6, 1.0}), 1);
  EXPECT_EQ(through_definition({11, 0, 0}, 0, std::array{0.4, 1.0}), 0);
  EXPECT_EQ(through_definition({9, 0, 0}, 0, std::array{0.6, 1.0}), 0);
}

TEST(Expression, AFormulaWithoutFurtherVariablesNeedsNoValues) {
  Names const names{{}, {}, {"damage"}};
  EXPECT_EQ(Expression("2*X", names)({3, 0, 0}, 0), 6);
  EXPECT_EQ(Expression("7", names)({3, 0, 0}, 0), 7);
}

TEST(Expression, FurtherVariablesAreSuggestedAndHaveOneMeaning) {
  EXPECT_NE(error_of("damge > 1", {{}, {}, {"damage"}}).text.find("did you mean \"damage\"?"), std::string::npos);
  ExpressionError const error = error_of("1 + damage", {{{"damage", 1}}, {}, {"damage"}});
  EXPECT_TRUE(mentions(error.text, {"damage", "variable", "define or constants", "another name"}));
  EXPECT_EQ(error.column, 5);
  EXPECT_NE(error_of("damage", {{}, {{"damage", "X"}}, {"damage"}}).column, -1);
  EXPECT_EQ(error_of("X", {{{"damage", 1}}, {}, {"damage"}}).text, "no error");
}

TEST(Expression, InfiniteAndUndefinedValuesAreReturned) {
  EXPECT_TRUE(std::isinf(value_of("1/X")));
  EXPECT_TRUE(std::isnan(value_of("sqrt(X-1)")));
}

TEST(Expression, AssignmentsAreRefused) {
  ExpressionError const error = error_of("Y = 3");
  EXPECT_EQ(error.text, "\"=\" assigns, which a formula cannot do - write == to compare");
  EXPECT_EQ(error.column, 3);
  EXPECT_NE(error_of("X+=1").column, -1);
  EXPECT_NE(error_of("X==(Y=1)").column, -1);
}

TEST(Expression, AnUnknownNameGetsASuggestionAndAColumn) {
  Names const names{{{"Omega", 105}}, {}};
  ExpressionError const error = error_of("2*Omegaa*X", names);
  EXPECT_EQ(error.column, 3);
  EXPECT_NE(error.text.find("\"Omegaa\" is not known (known: X, Y, Z, t, pi, Omega, sin"), std::string::npos);
  EXPECT_NE(error.text.find("did you mean \"Omega\"?"), std::string::npos);
  EXPECT_NE(error_of("if(X>0,1,2)").text.find("condition ? value : other_value"), std::string::npos);
}

TEST(Expression, BrokenFormulasSayWhere) {
  EXPECT_EQ(error_of("").text, "the formula is empty");
  EXPECT_EQ(error_of("2 3").text, "an operator is missing before \"3\"");
  EXPECT_EQ(error_of("2 X").column, 3);
  EXPECT_EQ(error_of("sin(X").text, "a closing bracket is missing");
  EXPECT_EQ(error_of("X,Y").text, "a comma is not expected here: a formula has one value");
  EXPECT_EQ(error_of("sin(1,2)").text, "the function \"sin\" has too many arguments");
  EXPECT_EQ(error_of("pow(1)").text, "the function \"pow\" has too few arguments");
  EXPECT_EQ(error_of("X > 0 ? 1").text, "\"?\" has no \":\" with the other value");
  EXPECT_EQ(error_of("X $ Y").column, 3);
  for (char const* const text : {"X+", "*X", "()", "sin", "sin()", "X)", "(X", "1 ? : 2", ": 1", "X==", "\"X\"", "{1}",
                                 "X;Y", "min()", "1..2", "2e", "X Y", "\xc3\xa9", "0x12"}) {
    EXPECT_NE(error_of(text).column, -1) << text;
  }
}

// The manual: what is not zero is true; the value is 1 or 0. For constants, named constants and variables alike.
TEST(Expression, LogicHasTheDocumentedValueForConstantsAndVariables) {
  for (double const a : {0.0, 0.5, -0.25, 1.0, 3.0})
    for (double const b : {0.0, 0.75, -1.0, 1e-300}) {
      Names const names{{{"a", a}, {"b", b}}, {{"d", "X"}}};
      std::string const A = exact_text(a), B = exact_text(b);
      double const both = a != 0 && b != 0 ? 1 : 0, either = a != 0 || b != 0 ? 1 : 0, neither = a == 0 ? 1 : 0;
      for (auto const& [left, right] : {std::pair{A, B}, {"a", "b"}, {"X", "Y"}, {"X", B}, {A, "Y"}, {"d", "b"}}) {
        auto const value = [&, l = left, r = right](std::string const& middle) {
          return Expression("(" + l + ")" + middle + "(" + r + ")", names)({a, b, 0});
        };
        EXPECT_EQ(value("&&"), both) << left << right;
        EXPECT_EQ(value(" || "), either) << left << right;
        EXPECT_EQ(Expression("!(" + left + ")", names)({a, b, 0}), neither);
        EXPECT_EQ(Expression("(" + left + ") ? 2 : 3", names)({a, b, 0}), a != 0 ? 2 : 3);
      }
    }
}

TEST(Expression, LogicBindsAsInC) {
  EXPECT_EQ(value_of("1 || 0 && 0"), 1);
  EXPECT_EQ(value_of("0.5&&0.5||0"), 1);
  EXPECT_EQ(value_of("X>0&&X<1||X==7"), value_of("((X>0)&&(X<1))||(X==7)"));
  EXPECT_EQ(value_of("1+1&&0"), 0);
  EXPECT_EQ(value_of("1 && !0 && -0.5"), 1);
  EXPECT_EQ(value_of("0.2 && 0.2 ? 5 : 6"), 5);
  EXPECT_EQ(error_of("1 &&").text, "the formula ends too early");
  EXPECT_EQ(error_of("&& 1").text, "the operator \"&&\" has nothing to work on");
  EXPECT_EQ(error_of("X && $").column, 6);
}

TEST(Expression, OtherTonguesAreTranslated) {
  EXPECT_TRUE(mentions(error_of("5*y").text, {"y", "not known", "X, Y, Z", "did you mean \"Y\""}));
  EXPECT_EQ(error_of("5*y").column, 3);
  EXPECT_NE(error_of("2*T").text.find("did you mean \"t\"?"), std::string::npos);
  EXPECT_EQ(error_of("X > 0 and X < 1").text, "\"and\" is not an operator - write &&");
  EXPECT_EQ(error_of("X > 0 or X < 1").text, "\"or\" is not an operator - write ||");
  EXPECT_EQ(error_of("not X").text, "\"not\" is not an operator - write !");
  EXPECT_EQ(error_of("X**2").text, "\"**\" is not an operator - write ^ for powers");
  EXPECT_EQ(error_of("X**2").column, 2);
  EXPECT_EQ(error_of("X > 0 & X < 1").text, "\"&\" is not an operator - write &&");
  EXPECT_EQ(error_of("X|1").text, "\"|\" is not an operator - write ||");
  EXPECT_EQ(error_of("X*T", {{{"T", 1}}, {}}).text, "no error") << "a name of the case means what the case says";
  EXPECT_EQ(error_of("y", {{}, {{"y", "Y-1"}}}).text, "no error");
}

TEST(Expression, UnitsInAFormulaAreNamed) {
  std::string const advice =
      "which cannot stand in a formula (numbers are in SI) - write the number in SI, or name the quantity in "
      "constants, e.g. a = \"5 mm\"";
  for (char const* const text : {"X <= 5 mm", "X <= 5mm", "X <= 5*mm", "X/mm", "(X + 2) mm", "2.5e3mm"}) {
    EXPECT_EQ(error_of(text).text, "\"mm\" is a unit, " + advice) << text;
  }
  EXPECT_EQ(error_of("X <= 5 mm").column, 8);
  EXPECT_EQ(error_of("X <= 5mm").column, 7);
  EXPECT_NE(error_of("3 m/s").text.find("\"m\" is a unit"), std::string::npos);
  EXPECT_EQ(error_of("m*X").text.find("is a unit"), std::string::npos) << "a single letter is more often a name";
  EXPECT_EQ(error_of("2*mm", {{{"mm", 1e-3}}, {}}).text, "no error");
}

TEST(Expression, NestingAndLengthAreBounded) {
  EXPECT_EQ(value_of(std::string(500, '(') + "1" + std::string(500, ')')), 1);
  EXPECT_NE(error_of(std::string(5000, '1')).column, -1);
}

TEST(Expression, WordsOfAFormulaAreFound) {
  std::vector<std::string> const expected{"a", "sin", "X", "b2"};
  EXPECT_EQ(expression_words("a*1e5*sin(X)+b2-1e-3"), expected);
  EXPECT_TRUE(is_reserved_name("pi"));
  EXPECT_TRUE(is_reserved_name("sin"));
  EXPECT_FALSE(is_reserved_name("Omega"));
}

TEST(Expression, ArithmeticAgreesWithCpp) {
  EXPECT_TRUE(rc::check("a polynomial", [](int a, int b, int c) {
    Names const names{{{"a", a}, {"b", b}, {"c", c}}, {{"square", "X*X"}}};
    double const x = 0.5 * a + 1;
    RC_ASSERT(Expression("a*square + b*X + c", names)({x, 0, 0}) == a * (x * x) + b * x + c);
  }));
}

TEST(Expression, AnyTextIsAFormulaOrAnExpressionError) {
  EXPECT_TRUE(rc::check("random formulas", [] {
    auto const pieces = *rc::gen::container<std::vector<std::string>>(
        rc::gen::element<std::string>("X", "t", "sin", "(", ")", "+", "-", "*", "/", "^", ",", "?", ":", "1", "2.5",
                                      "<", "==", "&&", "!", "min", " ", "w", "=", "e"));
    std::string text;
    for (std::string const& piece : pieces) text += piece;
    try {
      Expression(text, Names{{}, {{"w", "X+1"}}})({1, 2, 3}, 4);
    } catch (ExpressionError const&) {
    }
  }));
}

}  // namespace
}  // namespace piola
