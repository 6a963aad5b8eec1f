// SPDX-License-Identifier: Apache-2.0
#include "piola/base/child_process.hpp"
#include "piola/math/hash.hpp"
#include "geometry/mesh_shapes.hpp"
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <optional>

namespace piola::testing {
namespace {

using geometry::MeshOptions;

/// Numbers that look random, the same on every computer.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(uniform(seed_, ++drawn_) * static_cast<double>(n));
  }

 private:
  std::uint64_t seed_, drawn_ = 0;
};

/// What is often behind mistakes of readers.
std::string odd_word(Dice& dice) {
  static std::vector<std::string> const words{"-1",         "0",          "1e39",  "nan",
                                              "4294967295", "2147483648", "\n",    " ",
                                              "/",          "//",         "solid", "endsolid",
                                              "f 1 2 3\n",  "v 0 0 0\n",  "g \n",  "element face 9\n",
                                              "\\\n",       "facet",      "\xff",  std::string(1, '\0')};
  return words[dice.below(words.size())];
}

void change_once(std::string& bytes, Dice& dice) {
  if (bytes.empty()) return;
  std::size_t const at = dice.below(bytes.size()), some = 1 + dice.below(12);
  switch (dice.below(7)) {
    case 0: bytes[at] = static_cast<char>(dice.below(256)); break;
    case 1: bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8))); break;
    case 2: bytes.erase(at, some); break;
    case 3: bytes.insert(at, bytes.substr(dice.below(bytes.size()), 4 * some)); break;
    case 4: bytes.insert(at, odd_word(dice)); break;
    case 5: bytes.replace(at, some, odd_word(dice)); break;
    default: bytes.resize(dice.below(8) == 0 ? at : bytes.size()); break;
  }
}

struct Mutant {
  std::string name, bytes;
  MeshOptions options;
};

Mutant mutant(std::uint64_t number) {
  Dice dice(number);
  Shape const shapes[]{corner_tetrahedron(), unit_cube(), pillar(7), round_ball(1)};
  Shape const& shape = shapes[dice.below(std::size(shapes))];
  Mutant m;
  switch (dice.below(4)) {
    case 0: m = {"a.stl", stl_text(shape), {}}; break;
    case 1: m = {"b.stl", stl_binary(shape), {}}; break;
    case 2: m = {"c.obj", obj_text(shape), {}}; break;
    default: m = {"d.ply", ply_text(shape), {}}; break;
  }
  constexpr MeshOptions::Repair repairs[]{MeshOptions::Repair::none, MeshOptions::Repair::orient,
                                          MeshOptions::Repair::holes};
  m.options.repair = repairs[dice.below(3)];
  m.options.largest_hole = 10;
  m.options.spacing = 0.1;
  for (std::size_t changes = 1 + dice.below(6); changes > 0; --changes) change_once(m.bytes, dice);
  return m;
}

/// "read" or "refused"; what is read can be asked and cut. Anything else ends the process.
std::string outcome(Mutant const& m) {
  geometry::MeshReport report;
  geometry::SolidPtr const solid = geometry::mesh_from_bytes(m.bytes, m.name, m.options, report);
  if ((solid == nullptr) == report.problems.empty()) std::abort();
  if (solid == nullptr) return "refused";
  static_cast<void>(solid->at({{0.1, 0.2, -0.3}}));
  std::vector<geometry::SurfacePiece> pieces;
  geometry::Bounds const box = solid->bounds();
  solid->cut_surface(0.2 * (box.max[0] - box.min[0] + box.max[1] - box.min[1] + box.max[2] - box.min[2]), pieces);
  for (auto const& p : pieces)
    if (p.patch < 0 || p.patch >= static_cast<int>(solid->patches().size())) std::abort();
  return "read";
}

struct Count {
  std::uint64_t read = 0, refused = 0;
  void add(std::string const& what) { ++(what == "read" ? read : refused); }
};

/// Many files in one child, where the reader has no child of its own; empty if it did not survive them.
std::optional<Count> outcomes(std::uint64_t first, std::uint64_t end) {
  ChildAnswer const answer = run_in_child_process(
      [&] {
        std::string letters;
        for (std::uint64_t k = first; k < end; ++k) {
          Mutant m = mutant(k);
          m.options.time_limit = 0;
          letters += outcome(m) == "read" ? 'r' : '-';
        }
        return letters;
      },
      {20, std::size_t{2'000'000'000}});
  if (!answer.trouble.empty()) return {};
  Count count;
  for (char const letter : answer.bytes) count.add(letter == 'r' ? "read" : "refused");
  return count;
}

/// 1,000 files, or as many as PIOLA_MUTATIONS says: 1e5 take some minutes. Where the reader itself crashes or hangs its
/// file is read again as users read it, with a child that takes the blow.
TEST(MeshMutations, AreReadOrRefusedWhateverHappenedToThem) {
  char const* const wanted = std::getenv("PIOLA_MUTATIONS");
  std::uint64_t const all = wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 1000;
  constexpr std::uint64_t at_once = 100;
  Count count;
  std::uint64_t alone = 0;
  for (std::uint64_t first = 0; first < all; first += at_once) {
    std::uint64_t const end = std::min(first + at_once, all);
    if (auto const some = outcomes(first, end)) {
      count.read += some->read;
      count.refused += some->refused;
      continue;
    }
    for (std::uint64_t k = first; k < end; ++k, ++alone) count.add(outcome(mutant(k)));
  }
  EXPECT_EQ(count.read + count.refused, all);
  EXPECT_GT(count.read, all / 50);
  EXPECT_GT(count.refused, all / 50);
  RecordProperty("alone", static_cast<int>(alone));
  std::cout << count.read << " read, " << count.refused << " refused, " << alone << " one by one\n";
}

}  // namespace
}  // namespace piola::testing
