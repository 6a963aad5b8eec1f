// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/count_coupled_communication.hpp"
#include "piola/estimates/scaling.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/input/read_case.hpp"
#include "piola/simulation/build.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace piola {
namespace {

struct BodyText {
  char const* name;
  double low, high;  ///< mm, along y
  double spacing;    ///< mm
  char const* formulation;
};

std::string case_of(std::vector<BodyText> const& bodies, std::string const& more = "") {
  std::string text = "title = \"Blocks\"\n[run]\nend = \"1 us\"\n" + more;
  for (BodyText const& body : bodies)
    text += fmt::format(
        "[[body]]\nname = \"{}\"\nshape.box = {{ min = [\"0 mm\", \"{} mm\"], max = [\"8 mm\", \"{} mm\"] }}\n"
        "shape.spacing = \"{} mm\"\nshape.placement = \"cell_centred\"\n"
        "material = {{ name = \"aluminium_perfectly_plastic\" }}\nformulation = {{ name = {} }}\n",
        body.name, body.low, body.high, body.spacing, body.formulation);
  return text;
}

/// What is counted without building the bodies is what they say when they are built.
void expect_same_talk(std::string const& text) {
  CaseSpec const spec = read_case_text(text, "case.toml");
  Assembly const assembly = assemble(spec);
  Estimate const whole = estimate(spec, assembly.particles, *make_formulation(assembly), 1);
  Estimate counted = estimate_from_parts(spec, assembly.particles, 1);
  count_talk_between(assembly, counted);
  ASSERT_EQ(counted.talk.size(), whole.talk.size());
  for (std::size_t b = 0; b < whole.talk.size(); ++b) {
    SCOPED_TRACE(spec.bodies[b].name);
    ASSERT_TRUE(counted.talk[b] && whole.talk[b]);
    EXPECT_DOUBLE_EQ(counted.talk[b]->collectives, whole.talk[b]->collectives);
    EXPECT_DOUBLE_EQ(counted.talk[b]->replicated_values, whole.talk[b]->replicated_values);
    EXPECT_DOUBLE_EQ(counted.talk[b]->stages, whole.talk[b]->stages);
    ASSERT_EQ(counted.talk[b]->near.has_value(), whole.talk[b]->near.has_value());
    if (whole.talk[b]->near) {
      EXPECT_EQ(counted.talk[b]->near->group, whole.talk[b]->near->group);
      EXPECT_EQ(counted.talk[b]->near->touching, whole.talk[b]->near->touching);
      EXPECT_EQ(counted.talk[b]->near->is_eulerian, whole.talk[b]->near->is_eulerian);
      EXPECT_DOUBLE_EQ(counted.talk[b]->near->cell, whole.talk[b]->near->cell);
    }
    ASSERT_EQ(counted.talk[b]->messages.size(), whole.talk[b]->messages.size());
    for (std::size_t m = 0; m < whole.talk[b]->messages.size(); ++m)
      for (std::size_t k = 0; k < whole.talk[b]->messages[m].size(); ++k) {
        EXPECT_EQ(counted.talk[b]->messages[m][k].numbers, whole.talk[b]->messages[m][k].numbers);
        EXPECT_DOUBLE_EQ(counted.talk[b]->messages[m][k].reach, whole.talk[b]->messages[m][k].reach);
      }
  }
}

constexpr char const* lagrangian = "\"adaptle\", description = \"total_lagrangian\"";
constexpr char const* flowing = "\"adaptle\", description = \"eulerian\"";

TEST(TalkBetween, IsThatOfBodiesThatAreBuilt) {
  expect_same_talk(case_of({{"low", 0, 4, 0.2, lagrangian}, {"high", 4.2, 8, 0.2, lagrangian}}));
  expect_same_talk(case_of({{"low", 0, 4, 0.2, lagrangian}, {"high", 9, 12, 0.2, lagrangian}}));
  expect_same_talk(case_of({{"low", 0, 4, 0.2, lagrangian}, {"high", 4.2, 8, 0.2, flowing}}));
  expect_same_talk(
      case_of({{"low", 0, 4, 0.2, flowing}, {"high", 4.2, 8, 0.2, flowing}}, "[contact]\nlaw = \"none\"\n"));
  expect_same_talk(case_of({{"low", 0, 4, 0.2, lagrangian}, {"high", 4.2, 8, 0.2, "\"nodal\""}}));
  expect_same_talk(case_of({{"low", 0, 4, 0.2, flowing}, {"high", 5, 8, 0.4, "\"nodal\""}}));
}

// Where bodies stand decides, not how many particles they have: at the same distance in space that is more spacings.
TEST(TalkBetween, OfBodiesThatAreApartHasNoContact) {
  auto const messages = [](double spacing, std::string const& contact) {
    CaseSpec const spec = read_case_text(
        case_of({{"low", 0, 4, spacing, lagrangian}, {"high", 4.5, 7.5, spacing, lagrangian}}, contact), "case.toml");
    Assembly const assembly = assemble(spec);
    Estimate cost = estimate_from_parts(spec, assembly.particles, 1);
    count_talk_between(assembly, cost);
    return scale(assembly.particles, cost, 2).shares[0].messages;
  };
  std::string const none = "[contact]\nlaw = \"none\"\n";
  EXPECT_EQ(messages(0.5, "") - messages(0.5, none), 3) << "how many, where, and what contact reads";
  EXPECT_EQ(messages(0.1, ""), messages(0.1, none));
}

// A body of nodal that has to follow shorter steps looks at its own in each of them.
TEST(TalkBetween, KnowsWhoSetsTheStep) {
  auto const more = [](double spacing, std::string const& run = "") {
    std::string text = case_of({{"low", 0, 4, 0.2, lagrangian}, {"high", 6, 10, spacing, "\"nodal\""}});
    text.replace(text.find("end ="), 0, run);
    CaseSpec const spec = read_case_text(text, "case.toml");
    Assembly const assembly = assemble(spec);
    return estimate(spec, assembly.particles, *make_formulation(assembly), 1).talk[1]->collectives;
  };
  double const own = more(0.1);  // whose steps are the shortest
  EXPECT_NEAR(more(1.0) - own, 0.3, 1e-12);
  EXPECT_NEAR(more(0.1, "max_step = \"0.1 ns\"\n") - own, 0.3, 1e-12);
}

}  // namespace
}  // namespace piola
