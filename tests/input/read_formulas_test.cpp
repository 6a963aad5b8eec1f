// SPDX-License-Identifier: Apache-2.0
// Formulas that a formulation declares, with a table that no formulation has.
#include "piola/input/sections.hpp"
#include "support/key_words.hpp"
#include <array>
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;

constexpr std::array<std::string_view, 2> state{"damage", "jacobian"};
constexpr std::array table{FormulaInfo{"convert_when", "what turns a particle", state},
                           FormulaInfo{"eulerian_where", "what is turned from the start", {}}};

struct Outcome {
  FormulationSpec spec;
  std::string message;
};

Outcome read(std::string const& text) {
  Problems problems;
  Outcome outcome;
  auto const document = parse_document(text, "case.toml", problems);
  if (document) {
    Section const section(document->root, "body.formulation", problems);
    Names const names{{{"limit", 0.5}}, {{"far", "X > 10*limit"}}};
    read_formulation_formulas(section, table, names, outcome.spec);
  }
  try {
    problems.raise_if_any();
  } catch (InputError const& error) {
    outcome.message = error.what();
  }
  return outcome;
}

TEST(FormulasOfFormulations, UseTheirVariablesTheConstantsAndTheDefinitions) {
  Outcome const outcome = read("convert_when = \"damage > limit && far && jacobian < 1 && t >= 1\"\n");
  ASSERT_EQ(outcome.message, "");
  ASSERT_EQ(outcome.spec.formulas.size(), 1U);
  Expression const& when = outcome.spec.formulas.at("convert_when");
  EXPECT_EQ(when({6, 0, 0}, 1, std::array{0.6, 0.9}), 1);
  EXPECT_EQ(when({6, 0, 0}, 1, std::array{0.4, 0.9}), 0);
  EXPECT_EQ(when({6, 0, 0}, 1, std::array{0.6, 1.0}), 0);
  EXPECT_EQ(when({4, 0, 0}, 1, std::array{0.6, 0.9}), 0);
  EXPECT_EQ(when({6, 0, 0}, 0, std::array{0.6, 0.9}), 0);
}

TEST(FormulasOfFormulations, EachHasItsOwnVariables) {
  EXPECT_EQ(read("eulerian_where = \"X > 1\"\n").message, "");
  EXPECT_EQ(read("eulerian_where = 1\n").spec.formulas.at("eulerian_where")({}), 1);
  EXPECT_TRUE(mentions(read("eulerian_where = \"damage > 1\"\n").message,
                       {"case.toml:1:19: body.formulation.eulerian_where", "damage > 1", "\"damage\" is not known",
                        "limit", "add it to define or constants"}));
}

TEST(FormulasOfFormulations, UnknownNamesGetASuggestion) {
  EXPECT_TRUE(mentions(read("convert_when = \"damge > 1\"\n").message,
                       {"case.toml:1:17: body.formulation.convert_when", "damge > 1", "\"damge\" is not known",
                        "damage, jacobian", "limit", "did you mean \"damage\""}));
  EXPECT_EQ(read("convert_when = true\n").message,
            "case.toml:1:16: body.formulation.convert_when is true (allowed: a formula in quotes, or a number)");
}

}  // namespace
}  // namespace piola
