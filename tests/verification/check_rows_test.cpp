// SPDX-License-Identifier: Apache-2.0
// What the rows of every cases/*/*/checks.toml promise, whatever their numbers are.
#include "piola/base/text.hpp"
#include "piola/verification/verify.hpp"
#include "support/places.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace piola {
namespace {

struct CaseRows {
  std::string name;
  std::vector<Check> checks;
};

std::vector<CaseRows> const& all_rows() {
  static std::vector<CaseRows> const list = [] {
    std::vector<CaseRows> rows;
    std::filesystem::path const cases = std::filesystem::path(testing::source_folder()) / "cases";
    for (auto const& folder : find_cases(cases, {}))
      rows.push_back({folder.lexically_relative(cases).generic_string(), read_checks(folder / "checks.toml").checks});
    return rows;
  }();
  return list;
}

bool holds(std::string const& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// A number that cannot be negative and ought to be zero has its lower bound by nature.
bool ought_to_vanish(Check const& c) {
  std::string const& q = c.quantity;
  // An error may be as small a part of another one as it likes.
  if (c.as == Check::Comparison::ratio) return holds(q, "error");
  if (c.as == Check::Comparison::order) return false;
  return c.as == Check::Comparison::field_error || holds(q, "error") || holds(q, "drift") || holds(q, "change") ||
         holds(q, "max_increase") || holds(q, "max_decrease") || holds(q, "kinetic_energy");
}

bool bounds(Check const& c, Check::Kind side) {
  return c.kind == side || c.kind == Check::Kind::within || c.kind == Check::Kind::between;
}

TEST(CheckRows, AreMany) {
  std::size_t rows = 0;
  for (CaseRows const& c : all_rows()) rows += c.checks.size();
  EXPECT_GT(rows, 500U);
}

// A scheme that loses all its energy must not pass.
TEST(CheckRows, BoundEnergyFromBelowWhereTheyDoFromAbove) {
  for (CaseRows const& in : all_rows()) {
    for (Check const& c : in.checks) {
      bool const grows = c.kind == Check::Kind::above || (c.kind == Check::Kind::between && std::stod(c.reference) > 0);
      if (c.quantity != "energy.max_increase" || grows) continue;
      bool const found = std::any_of(in.checks.begin(), in.checks.end(), [&](Check const& other) {
        if (other.variant != c.variant || other.as != Check::Comparison::value) return false;
        if (other.quantity == "energy.max_decrease") return bounds(other, Check::Kind::below);
        return holds(other.quantity, "energy") && other.quantity != c.quantity && bounds(other, Check::Kind::above);
      });
      EXPECT_TRUE(found) << in.name << ", " << c.variant << ": nothing bounds its loss of energy";
    }
  }
}

TEST(CheckRows, BoundOnBothSides) {
  for (CaseRows const& in : all_rows()) {
    for (Check const& c : in.checks) {
      if (c.kind != Check::Kind::below && c.kind != Check::Kind::above) continue;
      if (c.kind == Check::Kind::below && ought_to_vanish(c)) continue;
      auto const missing = c.kind == Check::Kind::below ? Check::Kind::above : Check::Kind::below;
      bool const found = std::any_of(in.checks.begin(), in.checks.end(), [&](Check const& other) {
        return other.variant == c.variant && other.quantity == c.quantity && other.as == c.as && bounds(other, missing);
      });
      EXPECT_TRUE(found) << in.name << ", " << c.variant << ": " << c.quantity << " is bounded on one side";
    }
  }
}

// The truth is not smooth at the scale of coarse particles; its difference from a refined run is what counts.
TEST(CheckRows, AskNoRunToBeSmootherThanTheTruth) {
  for (CaseRows const& in : all_rows()) {
    for (Check const& c : in.checks) {
      EXPECT_FALSE(holds(c.quantity, "oscillation") && c.kind == Check::Kind::below)
          << in.name << ", " << c.variant << ": " << c.quantity;
    }
  }
}

// What holds by construction is no evidence: particles that are held, sums of opposite forces, projected momenta.
TEST(CheckRows, CountNothingThatHoldsByConstruction) {
  for (CaseRows const& in : all_rows()) {
    for (Check const& c : in.checks) {
      bool const round_off = c.kind == Check::Kind::below && std::stod(c.reference) <= 1e-9;
      if (!holds(c.quantity, "drift") || !round_off || c.expected_to_fall_short) continue;
      EXPECT_EQ(evidence_word(c.evidence), "code") << in.name << ", " << c.variant << ": " << c.quantity;
    }
  }
}

}  // namespace
}  // namespace piola
