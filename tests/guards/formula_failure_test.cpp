// SPDX-License-Identifier: Apache-2.0
// A run that ends because a formula is no number says so, and not that its step was too large.
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/run_case.hpp"
#include "support/key_words.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::expect_words;

std::string failure_of(std::string const& formulation, std::string const& more) {
  std::string const text =
      "title = \"Bar\"\n[run]\nend = \"10 ms\"\n[[body]]\nname = \"bar\"\n"
      "shape = { box = { min = [0, 0], max = [0.8, 0.4] }, particles = [8, 4], placement = \"cell_centred\" }\n"
      "material = { law = \"linear_elastic\", density = 1000, youngs_modulus = 1e7, poissons_ratio = 0.3 }\n"
      "formulation = { name = \"" +
      formulation + "\" }\n" + more;
  Simulation s = build(read_case_text(text, "case.toml"));
  Listener listener;
  std::atomic<int> const none{0};
  testing::TemporaryFolder const folder;
  return run_case(s, {.folder = folder / "r"}, listener, none).failure;
}

std::string const support = "[[support]]\nbody = \"bar\"\nwhere = \"X < 0.1\"\nfix = \"xy\"\n";

TEST(FormulaFailure, NamesTheLoadItsFormulaTimeAndPlace) {
  std::string const load =
      support + "[[load]]\nbody = \"bar\"\nface = \"+x\"\ntraction = [\"1e3*sqrt(1 - t/2e-3)\", 0]\n";
  for (char const* formulation : {"jst_sph", "nodal"}) {
    std::string const failure = failure_of(formulation, load);
    expect_words(failure, {"the load on body \"bar\": traction = \"1e3*sqrt(1 - t/2e-3)\" is not a number at t = 0.00",
                           "X = (0.75, ", "finite number at all times", "up to its until"});
    EXPECT_EQ(failure.find("the step is too large"), std::string::npos) << failure;
  }
}

TEST(FormulaFailure, NamesSupportsToo) {
  std::string const drive =
      "[[support]]\nbody = \"bar\"\nwhere = \"X < 0.1\"\nfix = \"xy\"\nvelocity = [\"log(2e-3 - t)*0.01\", 0]\n";
  expect_words(failure_of("jst_sph", drive), {"the support of body \"bar\": velocity = \"log(2e-3 - t)*0.01\" is "});
}

// What is gone before it fails, and what fails for other reasons.
TEST(FormulaFailure, BlamesNoFormulaThatIsFine) {
  std::string const load = support +
                           "[[load]]\nbody = \"bar\"\nface = \"+x\"\nuntil = \"1 ms\"\ntraction = "
                           "[\"1e3*sqrt(1 - t/2e-3)\", 0]\n";
  EXPECT_EQ(failure_of("jst_sph", load), "");
  std::string const wild = support + "[[load]]\nbody = \"bar\"\nface = \"+x\"\ntraction = [-1e10, 0]\n";
  std::string const failure = failure_of("jst_sph", wild);
  EXPECT_NE(failure, "");
  EXPECT_EQ(failure.find("load on body"), std::string::npos) << failure;
}

}  // namespace
}  // namespace piola
