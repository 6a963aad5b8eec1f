// SPDX-License-Identifier: Apache-2.0
#include "piola/input/document.hpp"
#include "support/key_words.hpp"
#include <cmath>
#include <ctime>
#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace piola {
namespace {

using test::mentions;

std::string problems_of(std::string const& text) {
  Problems problems;
  auto const document = parse_document(text, "f", problems);
  EXPECT_EQ(document.has_value(), problems.empty());
  return problems.empty() ? "" : problems.lines().front();
}

Document parsed(std::string const& text) {
  Problems problems;
  auto document = parse_document(text, "f", problems);
  EXPECT_TRUE(document) << text;
  return document.value_or(Document{});
}

TEST(Document, ValuesKnowWhereTheyStand) {
  Document const document = parsed("a = 1\n[b]\n  c = \"text\"  # comment\n  d = [1.5, true]\n");
  Node const* const b = document.root.find("b");
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(document.root.find("a")->integer, 1);
  EXPECT_EQ(b->find("c")->place.line, 3);
  EXPECT_EQ(b->find("c")->place.column, 7);
  EXPECT_EQ(b->find("c")->text_offset, 1);
  EXPECT_EQ(b->entries[0].place.column, 3);
  EXPECT_DOUBLE_EQ(b->find("d")->items[0].real, 1.5);
  EXPECT_TRUE(b->find("d")->items[1].flag);
  EXPECT_EQ(b->find("nothing"), nullptr);
}

TEST(Document, EntriesKeepTheOrderOfTheFile) {
  Document const document = parsed("z = 1\na = 2\nm = 3\n");
  EXPECT_EQ(document.root.entries[0].key, "z");
  EXPECT_EQ(document.root.entries[2].key, "m");
}

TEST(Document, PlacesInsideTextsAreKnownOnlyForPlainTexts) {
  EXPECT_EQ(parsed("a = 'X+'\n").root.find("a")->text_offset, 1);
  EXPECT_EQ(parsed("a = \"X\\u002B\"\n").root.find("a")->text_offset, 0);
  EXPECT_EQ(parsed("a = \"\"\"\nX+\"\"\"\n").root.find("a")->text_offset, 0);
}

TEST(Document, SyntaxErrorsHaveAPlace) {
  EXPECT_EQ(problems_of("a = 1\nb = = 2\n").substr(0, 10), "f:2:5: thi");
  EXPECT_EQ(problems_of("a = 1\n[~run]\nend = 1\n"),
            "f:2: this is not TOML: a stray character in a key or a [header] - see docs/user/case-file.md");
  EXPECT_NE(problems_of("a = 1\na = 2\n"), "");
  EXPECT_NE(problems_of("a = \"\xff\"\n"), "");
}

TEST(Document, QuantitiesWithoutQuotesAreNamed) {
  auto const advice = [](std::string const& quantity) {
    return "this is not TOML: a quantity with a unit stands in quotes - write \"" + quantity + "\"";
  };
  EXPECT_EQ(problems_of("[run]\nend = 5 ms\n").substr(7), advice("5 ms"));
  EXPECT_EQ(problems_of("[run]\nend = 5 ms\n").substr(0, 4), "f:2:");
  for (auto const& [line, quantity] :
       std::initializer_list<std::pair<std::string, std::string>>{{"a = 5ms", "5ms"},
                                                                  {"a = -2.5e3 kg/m^3  # dense", "-2.5e3 kg/m^3"},
                                                                  {"a = [0, 1 m, 2]", "1 m"},
                                                                  {"a = { b = \"x = 3 s\", c = 17 MPa }", "17 MPa"}})
    EXPECT_NE(problems_of(line + "\n").find(advice(quantity)), std::string::npos) << problems_of(line + "\n");
  for (char const* const line : {"a = 5 bananas", "a = = 5", "a = \"5 ms\" b", "a = 5 6", "a = b # 5 ms"})
    EXPECT_EQ(problems_of(std::string(line) + "\n").find("stands in quotes"), std::string::npos) << line;
}

TEST(Document, DangerousTextsAreRefusedBeforeParsing) {
  EXPECT_TRUE(mentions(problems_of(std::string("a = 1\n b\0", 9)), {"f:2:3:", "NUL byte", "case file"}));
  EXPECT_TRUE(mentions(problems_of(std::string(5'000'000, '#')), {"f:", "4 MB", "case file"}));
  std::string key = "a";
  for (int i = 0; i < 100; ++i) key += ".a";
  EXPECT_TRUE(mentions(problems_of(key + " = 1"), {"f:1:130:", "64 dots", "case file"}));
  EXPECT_EQ(problems_of("a = \"" + std::string(100, '.') + "\" # " + std::string(100, '.')), "");
  EXPECT_EQ(problems_of("a = '''\n" + std::string(100, '.') + "'''"), "");
  EXPECT_NE(problems_of("a = " + std::string(5000, '[') + std::string(5000, ']')), "");
}

TEST(Document, NestedBracketsAreRefusedInLinearTime) {
  EXPECT_EQ(problems_of("a = " + std::string(64, '[') + std::string(64, ']')), "");
  EXPECT_TRUE(mentions(problems_of("a = 1\nb = " + std::string(65, '[') + std::string(65, ']')),
                       {"f:2:69:", "brackets", "64", "case file"}));
  // In quadratic time each of these takes minutes.
  for (char const* piece : {"[", "[[", "{", "=", ",", "[ 1,", "{a=", "\"", "'", "[1 m", "=1"}) {
    std::string text = "a = ";
    while (text.size() < 500'000) text += piece;
    auto const start = std::clock();
    EXPECT_NE(problems_of(text), "") << piece;
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 5) << piece;
  }
}

TEST(Document, QuotesThatDoNotCloseAreNamedWhereTheyOpen) {
  std::string const says = "this is not TOML: the quoted text that begins here does not end";
  for (auto const& [text, place] : std::initializer_list<std::pair<std::string, std::string>>{
           {"[run]\nend = \"1 ms\n[output]\n", "f:2:7: "},
           {"a = 'one\nb = 2\n", "f:1:5: "},
           {"a = [\"x\", \"y, 3]\n", "f:1:11: "},
           {"# it's fine\na = \"it's fine\"\nb = \"\"\"\nand so on\n", "f:3:5: "},
           {"a = 1 mm\"\n", "f:1:9: "}}) {
    EXPECT_EQ(problems_of(text).substr(0, place.size()), place) << text;
    EXPECT_NE(problems_of(text).find(says), std::string::npos) << problems_of(text);
  }
  EXPECT_EQ(problems_of("a = \"\"\"\"quoted\"\"\"\"\"\nb = ''\nc = \"\\\"\"\n"), "") << "closed in other ways";
  EXPECT_EQ(problems_of("a = b\nc = \"open\n").substr(0, 6), "f:1:5:") << "the first mistake is named";
}

TEST(Document, ControlCharactersAreRefused) {
  for (char const* text :
       {"a = \"\\u001B[31m\"", "a = \"x\\u009b\"", "a = \"\\r\"", "a = [\"\\b\"]", "\"\\u0007\" = 1"})
    EXPECT_NE(problems_of(text).find("control character"), std::string::npos) << text;
  EXPECT_NE(problems_of("t.a = \"\\u001B\"").find("\\x1b"), std::string::npos);
  EXPECT_EQ(problems_of("a = \"\\t two\\nlines \\u00e9\"\nb = \"\"\"\r\ntwo\r\nlines\"\"\""), "");
  Document document = parsed("a = 1\n");
  Problems problems;
  apply_overrides(document, std::vector<std::string>{"a=x\x1b[31m"}, problems);
  EXPECT_EQ(problems.count(), 1U);
}

TEST(Document, LongTextsAndKeysAreRefusedWithoutBeingShown) {
  EXPECT_EQ(problems_of("a = \"" + std::string(10'000, 'x') + "\""), "");
  EXPECT_TRUE(mentions(problems_of("[t]\na = [1, \"" + std::string(10'001, 'x') + "\"]"),
                       {"f:2:9:", "10,001 characters", "at most 10,000", "shorten", "define"}));
  EXPECT_TRUE(mentions(problems_of(std::string(201, 'k') + " = 1"),
                       {"f:1:1:", "key", "201 characters", "at most 200", "shorten"}));
}

TEST(Document, WrittenTomlReadsBackTheSame) {
  std::string const text =
      "s = \"a \\\"quote\\\" \\\\ and\\nline\"\ni = -3\nx = 0.1\ny = 1e300\nn = nan\nf = false\n"
      "when = 1979-05-27\n\"odd key\" = 1\nempty = []\ntable = {}\n[t]\nu = { v = [1, [2, 3]] }\n"
      "[[l]]\na = 1\n[[l]]\na = 2\n[l.sub]\nb = 3\n";
  std::string const once = toml_text(parsed(text).root);
  EXPECT_EQ(toml_text(parsed(once).root), once);
  Document const again = parsed(once);
  EXPECT_EQ(again.root.find("s")->text, "a \"quote\" \\ and\nline");
  EXPECT_EQ(again.root.find("x")->real, 0.1);
  EXPECT_TRUE(std::isnan(again.root.find("n")->real));
  EXPECT_EQ(again.root.find("when")->kind, Node::Kind::date);
  EXPECT_EQ(again.root.find("l")->items[1].find("sub")->find("b")->integer, 3);
}

TEST(Document, EveryTextAndNumberSurvivesWriting) {
  EXPECT_TRUE(rc::check("texts and numbers", [](double number, std::int64_t integer) {
    auto const text = *rc::gen::container<std::string>(rc::gen::inRange<char>(32, 127));
    RC_PRE(!std::isnan(number));
    Node root;
    Node t, x, i;
    t.kind = Node::Kind::text;
    t.text = text;
    x.kind = Node::Kind::real;
    x.real = number;
    i.kind = Node::Kind::integer;
    i.integer = integer;
    root.entries = {{"t", {}, t}, {"x", {}, x}, {"i", {}, i}};
    Problems problems;
    auto const document = parse_document(toml_text(root), "f", problems);
    RC_ASSERT(document.has_value());
    RC_ASSERT(document->root.find("t")->text == text);
    RC_ASSERT(document->root.find("x")->number() == number);
    RC_ASSERT(document->root.find("i")->integer == integer);
  }));
}

TEST(Document, OverridesFindTheirWay) {
  Document document = parsed("[run]\nend = 1\n[[body]]\nname = \"a\"\nlist = [1, 2]\n[[body]]\nname = \"b\"\n");
  Problems problems;
  apply_overrides(document,
                  std::vector<std::string>{"run.end = 2", "body.b.new.deep = some words", "body.0.list.1=7",
                                           "run.text='1'", "run.t={a = 1}", "run.q=\"a=b\""},
                  problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(document.root.find("run")->find("end")->integer, 2);
  EXPECT_EQ(document.root.find("run")->find("text")->text, "1");
  EXPECT_EQ(document.root.find("run")->find("q")->text, "a=b");
  EXPECT_EQ(document.root.find("run")->find("end")->place.file, "--set run.end = 2");
  EXPECT_EQ(document.root.find("body")->items[1].find("new")->find("deep")->text, "some words");
  EXPECT_EQ(document.root.find("body")->items[0].find("list")->items[1].integer, 7);
}

}  // namespace
}  // namespace piola
