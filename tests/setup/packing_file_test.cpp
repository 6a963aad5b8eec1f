// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/packing_file.hpp"
#include "piola/base/stopped.hpp"
#include "piola/model/read_case.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

namespace fs = std::filesystem;

TEST(PackingFile, OfAStoppedPackingComesBackAsItWas) {
  testing::TemporaryFolder const folder;
  fs::path const path = folder.path() / packing_name("key");
  geometry::UnfinishedPacking const packing{{{1, 2, 3}}, {{4, 5, 6}}, {{7, 8, 9}}, {0.5}, 11};
  write_unfinished(path, "key", packing);
  auto const back = read_unfinished(path, "key");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->X, packing.X);
  EXPECT_EQ(back->listed, packing.listed);
  EXPECT_EQ(back->known_at, packing.known_at);
  EXPECT_EQ(back->away, packing.away);
  EXPECT_EQ(back->sweeps, 11);
  EXPECT_FALSE(read_unfinished(path, "other"));
  EXPECT_FALSE(read_packing(path, "key")) << "an unfinished packing must not be taken for a finished one";
  std::string const whole = read_text_file(path);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string bad = whole;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    write_whole_file(path, bad);
    EXPECT_FALSE(read_unfinished(path, "key")) << i;
    write_whole_file(path, whole.substr(0, i));
    EXPECT_FALSE(read_unfinished(path, "key")) << i;
  }
}

TEST(PackingFile, KeepsItsLayout) {
  testing::TemporaryFolder const folder;
  fs::path const path = folder.path() / "p";
  // Mark of 16 and 27 characters, length of the key, key, values of 8 bytes each, check sum.
  write_packing(path, "key", {{{1, 2, 3}, {4, 5, 6}}, 0.5, 0.25, 7});
  EXPECT_EQ(fs::file_size(path), 16U + 8 + 3 + 8 * (4 + 2 * 3) + 8);
  write_unfinished(path, "key", {{{1, 2, 3}}, {{4, 5, 6}}, {{7, 8, 9}}, {0.5}, 11});
  EXPECT_EQ(fs::file_size(path), 27U + 8 + 3 + 8 * (2 + 3 * 3 + 1) + 8);
}

TEST(PackingFile, WithValuesThatAreNotFiniteIsNotTaken) {
  testing::TemporaryFolder const folder;
  fs::path const path = folder.path() / "p";
  double const nan = std::numeric_limits<double>::quiet_NaN();
  write_packing(path, "key", {{{1, nan, 3}, {4, 5, 6}}, 0.5, 0.25, 7});
  EXPECT_FALSE(read_packing(path, "key"));
  write_unfinished(path, "key", {{{1, 2, 3}}, {{4, 5, 6}}, {{7, 8, 9}}, {nan}, 11});
  EXPECT_FALSE(read_unfinished(path, "key"));
  write_unfinished(path, "key", {{}, {}, {}, {}, 11});
  EXPECT_FALSE(read_unfinished(path, "key")) << "it has no particle to continue from";
}

/// Two bodies, of which the second is stopped while it is packed.
std::string const two_tori = R"(title = "Two"
[run]
end = 1
[[body]]
name = "a"
shape = { spacing = 0.3, torus = { centre = [0, 0, 0], radius = 1, tube_radius = 0.4 } }
material = { law = "neo_hookean", density = 1, youngs_modulus = 1, poissons_ratio = 0.3 }
formulation = { name = "nodal" }
[[body]]
name = "b"
shape = { spacing = 0.25, torus = { centre = [5, 0, 0], radius = 1, tube_radius = 0.4 } }
material = { law = "neo_hookean", density = 1, youngs_modulus = 1, poissons_ratio = 0.3 }
formulation = { name = "nodal" }
[contact]
law = "none"
)";

TEST(PackingFile, SetUpContinuesWhereItWasStopped) {
  testing::TemporaryFolder const folder;
  fs::path const file = folder.path() / "case.toml", unfinished = folder.path() / "results" / unfinished_set_up;
  write_whole_file(file, two_tori);
  ParticleSet whole, continued;
  read_case(file, {}, {}, &whole);
  int sweeps_of_b = 0;
  ReadLimits limits;
  limits.unfinished = unfinished;
  limits.packing = [&](std::string const& body, double) {
    if (body != "b") return AfterSweep::go_on;
    return ++sweeps_of_b == 4 ? AfterSweep::keep : AfterSweep::go_on;
  };
  EXPECT_THROW(read_case(file, {}, limits), SetUpStopped);
  EXPECT_TRUE(fs::exists(unfinished));
  read_case(file, {}, limits, &continued);
  EXPECT_EQ(continued.X.seen(), whole.X.seen());
  int const continued_sweeps = sweeps_of_b;
  sweeps_of_b = 5;
  limits.unfinished.clear();
  read_case(file, {}, limits);
  EXPECT_EQ(continued_sweeps, sweeps_of_b - 5) << "sweeps before and after the stop add up to those of one packing";
}

TEST(PackingFile, ALookTakesAPackingAsItIs) {
  testing::TemporaryFolder const folder;
  fs::path const file = folder.path() / "case.toml";
  write_whole_file(file, two_tori);
  ReadLimits limits;
  limits.packing = [](std::string const&, double) { return AfterSweep::take; };
  ParticleSet rough, whole;
  CaseSpec const spec = read_case(file, {}, limits, &rough);
  read_case(file, {}, {}, &whole);
  EXPECT_EQ(rough.size(), whole.size());
  EXPECT_NE(rough.X.seen(), whole.X.seen());
  EXPECT_TRUE(spec.bodies[0].shape.solid_particles->rough);
}

}  // namespace
}  // namespace piola
