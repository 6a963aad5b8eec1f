// SPDX-License-Identifier: Apache-2.0
// Messages about tables in place of formulas: place, key, value, advice.
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::mentions;
using test::mentions_each;
using test::message_of;
using test::sample_case;

// The sample has 22 lines, so that the pressure is in line 26.
std::string loaded(std::string const& pressure) {
  return sample_case() + "[[load]]\nbody = \"column\"\nface = \"+y\"\npressure = " + pressure + "\n";
}
std::string with(std::string const& pressure) { return message_of(loaded(pressure)); }

/// Message about a case in a folder with the file force.csv.
std::string with_file(std::string const& content, std::string const& more = "", std::string const& key = "file") {
  testing::TemporaryFolder const folder;
  std::ofstream(folder / "force.csv") << content;
  std::string const name = (folder / "case.toml").string();
  try {
    read_case_text(loaded("{ " + key + " = \"force.csv\"" + more + " }"), name);
  } catch (InputError const& error) {
    return error.what();
  }
  return "";
}

TEST(TableMessages, RowsAreAccepted) {
  EXPECT_EQ(with("{ table = [[0, 0], [\"1 ms\", \"5 kPa\"], [0.002, 5e3]] }"), "");
  EXPECT_EQ(with("{ table = [[0, 0], [1, 2]], over = \"X\", before = \"zero\", after = \"hold\", scale = -2 }"), "");
  EXPECT_EQ(with("{ table = [[0, 0], [\"1 mm^2\", 2]], over = \"X^2 + Z^2\", interpolation = \"smooth\" }"), "");
}

TEST(TableMessages, RowsThatCannotBeUsedAreListedTogether) {
  EXPECT_TRUE(
      mentions_each(with("{ table = [[0, 0], [\"1 ms\", \"5 kN\"], [\"1 m\", 2], [1, 2, 3], [0.5, nan], [0.2, 1], "
                         "[0.2, 1]] }"),
                    {{"case.toml:26:40: table.table[1][1]", "5 kN", "Pa"},
                     {"case.toml:26:50: table.table[2][0]", "1 m", "s"},
                     {"case.toml:26:61: table.table[3]", "list of 3", "list of 2"},
                     {"case.toml:26:78: table.table[4][1]", "not a number", "finite"},
                     {"case.toml:26:94: table.table[6]", "200 ms", "not above the one before", "sort"}}));
  EXPECT_TRUE(mentions(with("{ table = [[0, 0]] }"), {"case.toml:26:22: table.table", "list of 1", "2 or more"}));
  EXPECT_TRUE(mentions(with("{ table = [[0, 1], [0, 2]] }"), {"begins with 0 s", "not above", "jump"}));
}

TEST(TableMessages, TablesHaveRowsOrAFile) {
  EXPECT_TRUE(mentions(with("{ }"), {"case.toml:26:12:", "load.pressure needs one of table, file", "add one"}));
  EXPECT_TRUE(mentions(with("{ table = [[0, 0], [1, 1]], file = \"a.csv\" }"), {"load.pressure has 2 of table, file"}));
  EXPECT_TRUE(mentions_each(with("{ table = [[0, 0], [1, 1]], column = \"a\", end = 1, after = \"stop\" }"),
                            {{"table.column", "only with file", "remove"},
                             {"\"end\" is not a key of table"},
                             {"table.after", "\"stop\"", "hold, zero, error"}}));
}

TEST(TableMessages, TablesStandForValuesOnly) {
  EXPECT_TRUE(mentions(message_of(test::sample_with("where = \"Y <= 0\"", "where = { table = [[0, 0], [1, 1]] }")),
                       {"case.toml:16:9: support.where", "is a table", "a formula in quotes"}));
  EXPECT_TRUE(mentions(message_of(test::sample_with("[\"w*Z\",", "[{ table = [[0, 0], [1, 1]] },")),
                       {"body.initial_velocity", "table over t", "value at the start", "over = \"X\""}));
  EXPECT_TRUE(mentions(with("{ table = [[0, 0], [1, 1]], derivative = true }"),
                       {"table.derivative", "\"Pa\"", "velocities", "remove"}));
  EXPECT_TRUE(
      mentions(message_of(sample_case() + "[[rigid]]\nname = \"die\"\nsphere = { centre = [20, 0, 0], radius = 1 }\n"
                                          "velocity = [{ table = [[0, 0], [1, 1]], over = \"X\" }, 0, 0]\n"),
               {"rigid.velocity[0]", "table over X", "uses X", "moves as one"}));
}

TEST(TableMessages, FilesAreReadInTheirUnits) {
  EXPECT_EQ(with_file("time [ms],force [kPa]\n0,0\n1,5\n"), "");
  EXPECT_EQ(with_file("\xef\xbb\xbf# measured\n\"time [ms]\" ; p [MPa]\r\n\r\n0;0\r\n1.5;-5e-3\r\n"), "");
  EXPECT_EQ(with_file("0\t0\n0.001\t5000\n"), "") << "no header: SI";
  EXPECT_EQ(with_file("t,a,b\n0,-,1\n1,-,2\n", ", column = \"b\""), "") << "other columns are not read";
}

TEST(TableMessages, FilesThatCannotBeUsedAreExplainedLineByLine) {
  EXPECT_TRUE(mentions(with("{ file = \"none.csv\" }"), {"case.toml:26:21: none.csv", "cannot be read"}));
  EXPECT_TRUE(mentions(with("{ file = 3 }"), {"case.toml:26:21: table.file", "a text in quotes"}));
  EXPECT_TRUE(mentions(with("{ file = \"\" }"), {"case.toml:26:21:", "cannot be read"}));
  EXPECT_TRUE(mentions(with_file(""), {"force.csv: is empty", "header"}));
  EXPECT_TRUE(mentions(with_file("# nothing\n"), {"is empty"}));
  EXPECT_TRUE(mentions(with_file("time,force\n1,2\n"), {"has one row", "two or more"}));
  EXPECT_TRUE(mentions(with_file("time,force\n"), {"has no row"}));
  EXPECT_TRUE(
      mentions_each(with_file("time [ms],p [kN]\n0,0\n1,2\n"), {{"force.csv:1:11", "the unit of \"p\"", "kN"}}));
  EXPECT_TRUE(
      mentions_each(with_file("time [mm],p [kPa\n0,0\n1,2\n"),
                    {{"force.csv:1:1:", "the unit of \"time\"", "mm"}, {"force.csv:1:11:", "p [kPa", "brackets"}}));
  EXPECT_TRUE(mentions_each(with_file("time,p\n0,0\n1\n2,nan\n3,x\n0,1\n5,6,7\n"),
                            {{"force.csv:3:1:", "1 fields", "expected 2"},
                             {"force.csv:4:3:", "nan", "not finite"},
                             {"force.csv:5:3:", "\"x\" is not a number"},
                             {"force.csv:6:1:", "\"0\" is not above the one before"},
                             {"force.csv:7:1:", "3 fields", "expected 2"}}));
  EXPECT_TRUE(mentions(with_file("p\n1\n2\n"), {"force.csv:1:1:", "one column", "two or more"}));
  EXPECT_TRUE(mentions(with_file("t,a,b\n0,0,1\n1,0,2\n"), {"2 columns of values (a, b)", "column = \"a\""}));
  EXPECT_TRUE(mentions(with_file("t,force,b\n0,0,1\n1,0,2\n", ", column = \"forze\""),
                       {"no column \"forze\"", "force, b", "did you mean \"force\"?"}));
  EXPECT_TRUE(mentions(with_file("0,0\n1,0\n", ", column = \"p\""), {"no column \"p\"", "add a header"}));
  EXPECT_TRUE(mentions(with_file(std::string("t,p\n0,\0\n", 8)), {"NUL byte", "give a CSV file"}));
  std::string many = "t,p\n";
  for (int k = 0; k < 20; ++k) many += "0,a\n";
  EXPECT_NE(with_file(many).find("force.csv: 15 more such problems"), std::string::npos);
}

}  // namespace
}  // namespace piola
