// SPDX-License-Identifier: Apache-2.0
// Words of textbooks and of other programs lead to the keys that mean the same.
#include "piola/input/synonyms.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::expect_words;

std::string with(std::string const& from, std::string const& to) {
  return test::message_of(test::sample_with(from, to));
}

TEST(Synonyms, LeadToKeysOfTheSameTable) {
  std::string const load = "[[load]]\nbody = \"column\"\n";
  expect_words(with("[[probe]]", load + "gravity = [0, -9.81, 0]\n[[probe]]"),
               {"\"gravity\" is not a key of load", "write \"acceleration\""});
  expect_words(with("density", "rho"), {"\"rho\" is not a key of body.material", "write \"density\""});
  expect_words(with("youngs_modulus", "E"), {"write \"youngs_modulus\""});
  expect_words(with("youngs_modulus", "elastic_modulus"), {"write \"youngs_modulus\""});
  expect_words(with("poissons_ratio", "nu"), {"write \"poissons_ratio\""});
  expect_words(with("end =", "t_end ="), {"write \"end\""});
  expect_words(with("end =", "dt = 1\nend ="), {"write \"max_step\""});
  expect_words(with("initial_velocity", "velocity"), {"write \"initial_velocity\""});
  expect_words(with("[[probe]]", "[[sensor]]\nname = \"a\"\n[[probe]]"), {"write \"probe\""});
}

TEST(Synonyms, LeadToOtherTables) {
  expect_words(with("[run]\n", "[run]\ngravity = 9.81\n"), {"that is \"acceleration\" of [[load]]"});
  expect_words(with("[run]\n", "[run]\nfriction_coefficient = 0.3\n"), {"that is \"friction\" of [contact]"});
}

TEST(Synonyms, LeadToLaws) {
  expect_words(with("neo_hookean", "fluid"),
               {"is \"fluid\" (allowed: ", "write \"elastic\" as law, with an equation of state (eos)"});
  expect_words(with("neo_hookean", "rubber"), {"write \"neo_hookean\""});
  expect_words(with("neo_hookean", "J2"), {"write \"perfectly_plastic\""});
}

// A slip of the pen is nearer than another meaning.
TEST(Synonyms, DoNotHideTypos) {
  expect_words(with("density", "densty"), {"did you mean \"density\"?"});
  expect_words(with("density", "Density"), {"did you mean \"density\"?"});
  EXPECT_EQ(advice_for_synonym("density", {}), "");
}

TEST(Messages, ATableWhereAListIsNeededIsReadAllTheSame) {
  std::string const message = with("[[body]]", "[body]");
  expect_words(message, {"body is a table", "list of tables", "write [[body]]"});
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
}

TEST(Messages, ASpacingLargerThanTheBodyIsNamed) {
  std::string const message = with("particles = [5, 25, 5]", "spacing = \"10 m\"");
  expect_words(message, {"body.shape.spacing is 10 m, larger than the body, 6 m", "a single particle"});
  EXPECT_EQ(message.find("support"), std::string::npos) << message;
  std::string const ball =
      "title = \"t\"\n[run]\nend = 1\n[[body]]\nname = \"b\"\nformulation = { name = \"jst_sph\" }\n"
      "shape = { sphere = { centre = [0, 0], radius = 0.01 }, spacing = 1 }\n"
      "material = { law = \"neo_hookean\", density = 1, youngs_modulus = 1, poissons_ratio = 0 }\n"
      "[[support]]\nbody = \"b\"\nwhere = \"X < 0\"\nfix = \"xy\"\n";
  expect_words(test::message_of(ball), {"body.shape.spacing is 1 m, larger than the body, 20 mm"});
}

}  // namespace
}  // namespace piola
