// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh.hpp"
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "support/places.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace piola {
namespace {

std::string body(std::string const& shape, std::string const& formulation) {
  return "title = \"Patch\"\n[run]\nend = \"1 ms\"\n[[body]]\nname = \"body\"\nshape = " + shape +
         "\nmaterial = { law = \"neo_hookean\", density = \"1100 kg/m^3\", youngs_modulus = \"17 MPa\", "
         "poissons_ratio = 0.3 }\nformulation = { name = \"" +
         formulation + "\" }\n";
}

/// Row by row.
constexpr std::array<double, 9> gradient{0.15, -0.1, 0.05, 0.125, -0.075, 0.025, -0.05, 0.1, 0.2};

std::string with_linear_displacement(std::string text) {
  text += "initial_displacement = [";
  for (std::size_t i = 0; i < 9; i += 3)
    text += fmt::format("\"{}*X + {}*Y + {}*Z + 0.01\",", gradient[i], gradient[i + 1], gradient[i + 2]);
  return text + "]\n";
}

/// The displacement u = G X + c is differentiated exactly on packed particles, too: F = I + G to round-off.
void expect_exact(std::string const& shape, std::string const& formulation) {
  SCOPED_TRACE(formulation);
  Simulation const s = build(read_case_text(with_linear_displacement(body(shape, formulation)), "patch.toml"));
  std::vector<double> F(9 * s.particles.X.size());
  s.formulation->observables().sample("DeformationGradient", F);
  double largest = 0;
  for (std::size_t k = 0; k < F.size(); ++k)
    largest = std::max(largest, std::abs(F[k] - gradient[k % 9] - (k % 9 % 4 == 0 ? 1 : 0)));
  EXPECT_GT(s.particles.X.size(), 1000U);
  EXPECT_LT(largest, 1e-12);
}

TEST(PackedPatch, BracketFromAMeshHasTheExactGradient) {
  auto const file = std::filesystem::path(testing::source_folder()) / "cases/geometry/meshes/bracket.stl";
  geometry::MeshReport report;
  if (!geometry::read_mesh(file.string(), {.scale = 1e-3}, report)) {
    ASSERT_NE(report.problems.at(0).find("built without meshes"), std::string::npos) << report.problems[0];
    GTEST_SKIP() << report.problems[0];
  }
  std::string const shape = "{ spacing = \"2.5 mm\", mesh = { file = \"" + file.string() + "\", unit = \"mm\" } }";
  for (char const* formulation : {"nodal", "jst_sph"}) expect_exact(shape, formulation);
}

TEST(PackedPatch, BallHasTheExactGradient) {
  std::string const shape =
      "{ spacing = 0.15, arrangement = \"packed\", sphere = { centre = [0.3, 0, 0], radius = 1 } }";
  for (char const* formulation : {"nodal", "jst_sph"}) expect_exact(shape, formulation);
}

}  // namespace
}  // namespace piola
