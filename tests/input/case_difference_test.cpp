// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_difference.hpp"
#include "piola/base/errors.hpp"
#include "support/sample_case.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::replaced;
using test::sample_case;

/// "key: before -> after" for each difference between the sample and a changed one.
std::string differences(std::string_view from, std::string_view to) {
  std::string text;
  for (CaseDifference const& d : case_differences(sample_case(), replaced(sample_case(), from, to)))
    text += fmt::format("{}: {} -> {}\n", d.key, d.before, d.after);
  return text;
}

TEST(CaseDifference, NamesKeysByThePathsOfSettings) {
  EXPECT_EQ(differences("end = \"0.5 s\"", "end = 0.75"), "run.end: \"0.5 s\" -> 0.75\n");
  EXPECT_EQ(differences("poissons_ratio = 0.45", "poissons_ratio = 0.3"),
            "body.column.material.poissons_ratio: 0.45 -> 0.3\n");
  EXPECT_EQ(differences("fix = \"xyz\"", "fix = \"x\""), "support.0.fix: \"xyz\" -> \"x\"\n");
  EXPECT_EQ(differences("particles = [5, 25, 5]", "particles = [5, 25, 6]"),
            "body.column.shape.particles: [5, 25, 5] -> [5, 25, 6]\n");
}

TEST(CaseDifference, SeesWhatComesAndGoes) {
  EXPECT_EQ(differences("L = 6\n", ""), "constants.L: 6 -> nothing\n");
  EXPECT_EQ(differences("L = 6\n", "L = 6\nM = 1\n"), "constants.M: nothing -> 1\n");
  EXPECT_EQ(differences("[[support]]", "[contact]\n[[support]]"), "contact: nothing -> {}\n");
  EXPECT_EQ(differences("[[probe]]", "[[quantity]]\nname = \"q\"\n[[probe]]"),
            "quantity: nothing -> [q]\nquantity.q.name: nothing -> \"q\"\n");
}

TEST(CaseDifference, OrderOfTablesInAListCounts) {
  std::string const a = "[[body]]\nname = \"a\"\n", b = "[[body]]\nname = \"b\"\n";
  auto const found = case_differences(a + b, b + a);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].key, "body");
  EXPECT_EQ(found[0].before, "[a, b]");
  EXPECT_EQ(found[0].after, "[b, a]");
}

TEST(CaseDifference, CommentsAndLayoutDoNotCount) {
  EXPECT_EQ(differences("L = 6\n", "# the length\n  L   =   6 # m\n"), "");
  EXPECT_EQ(differences("fix = \"xyz\"", "'fix' = 'xyz'"), "");
}

TEST(CaseDifference, OnlyWhatLeavesTheStateAsItIsMayChange) {
  for (char const* key : {"run.end", "run.threads", "run.instruction_set", "run.guards.energy", "run.repartition",
                          "output.frames.every", "output.pictures", "quantity", "quantity.q.take"})
    EXPECT_TRUE(may_change_on_resume(key)) << key;
  for (char const* key : {"run", "run.cfl", "run.max_step", "run.ending", "title", "constants.L", "body.b.name",
                          "outputs", "probe.tip.at", "support", "contact.scale"})
    EXPECT_FALSE(may_change_on_resume(key)) << key;
}

}  // namespace
}  // namespace piola
