// SPDX-License-Identifier: Apache-2.0
#include "piola/study/refinement.hpp"
#include "piola/input/read_case.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::TemporaryFolder;

/// A case with bodies of these shapes.
std::filesystem::path case_of(TemporaryFolder const& folder, std::vector<std::string> const& shapes) {
  std::string text = "title = 'c'\ncontact = 'none'\n[run]\nend = '1 us'\n";
  for (std::size_t b = 0; b < shapes.size(); ++b)
    text += "[[body]]\nname = 'b" + std::to_string(b) + "'\nshape = " + shapes[b] +
            "\nmaterial = { law = 'neo_hookean', density = 1100, youngs_modulus = 5e6, poissons_ratio = 0.4 }\n"
            "formulation = { name = 'jst_sph' }\n";
  text += "[[quantity]]\nname = 'e'\ncolumn = 'kinetic_energy'\ntake = 'maximum'\n";
  write_whole_file(folder / "c.toml", text);
  return folder / "c.toml";
}

CaseSpec refined(std::filesystem::path const& file, double factor) {
  return read_case(file, spacing_settings(file, {}, read_case(file), factor));
}

TEST(Refinement, ScalesEveryKindOfBody) {
  TemporaryFolder folder;
  auto const file =
      case_of(folder, {"{ box = { min = [0, 0], max = ['10 mm', '5.2 mm'] }, spacing = '1 mm' }",
                       "{ box = { min = [1, 0], max = [1.02, 0.01] }, particles = [5, 3] }",
                       "{ box = { min = [2, 0], max = [2.02, 0.01] }, particles = [4, 2], placement = 'cell_centred' }",
                       "{ sphere = { centre = [3, 0], radius = '5 mm' }, spacing = '1 mm' }",
                       "{ box = { min = [4, 0], max = [4.02, 0.01] }, spacing = '1 mm', arrangement = 'lattice' }"});
  CaseSpec const whole = read_case(file), half = refined(file, 0.5);
  EXPECT_TRUE(spacing_settings(file, {}, whole, 1).empty());
  using Counts = std::array<int, 3>;
  EXPECT_EQ(whole.bodies[0].shape.particles, (Counts{11, 6, 1}));
  EXPECT_EQ(half.bodies[0].shape.particles, (Counts{21, 11, 1}));
  EXPECT_EQ(half.bodies[1].shape.particles, (Counts{9, 5, 1}));
  EXPECT_EQ(half.bodies[2].shape.particles, (Counts{8, 4, 1}));
  EXPECT_DOUBLE_EQ(half.bodies[3].shape.spacing, 0.5e-3);
  EXPECT_DOUBLE_EQ(half.bodies[4].shape.spacing, 0.5e-3);
  SpacingRatio const ratio = spacing_ratio(half, whole);
  EXPECT_NEAR(ratio.mean, 0.5, 1e-12);
  EXPECT_NEAR(ratio.least, 0.5, 1e-12);
  EXPECT_NEAR(ratio.most, 0.5, 1e-12);
  EXPECT_NEAR(finest_spacing(whole), 1e-3, 1e-12);
  CaseSpec const coarse = refined(file, 1.5);
  EXPECT_EQ(coarse.bodies[0].shape.particles, (Counts{8, 4, 1}));  // 6.7 and 3.3 intervals
  EXPECT_GT(spacing_ratio(coarse, whole).most, 1.05 * spacing_ratio(coarse, whole).least);
}

TEST(Refinement, LeavesADirectionWithOneParticle) {
  TemporaryFolder folder;
  auto const file =
      case_of(folder, {"{ box = { min = [0, 0, 0], max = [0.01, 0.01, 0.001] }, particles = [6, 6, 1] }"});
  CaseSpec const whole = read_case(file), half = refined(file, 0.5);
  EXPECT_EQ(half.bodies[0].shape.particles, (std::array<int, 3>{11, 11, 1}));
  EXPECT_NEAR(spacing_ratio(half, whole).most, 0.5, 1e-12);
  EXPECT_NEAR(finest_spacing(whole), 2e-3, 1e-12);
}

TEST(Refinement, RefusesParticlesOfAFile) {
  TemporaryFolder folder;
  write_whole_file(folder / "c.csv", "x,y,volume\n0,0,1\n1,0,1\n0,1,1\n1,1,1\n2,0,1\n2,1,1\n0,2,1\n1,2,1\n2,2,1\n");
  auto const file = case_of(folder, {"{ points = { file = 'c.csv' } }"});
  EXPECT_THROW(spacing_settings(file, {}, read_case(file), 0.5), InputError);
}

TEST(Refinement, AddsColumnsToTheQuantities) {
  TemporaryFolder folder;
  auto const file = case_of(folder, {"{ box = { min = [0, 0], max = [1, 1] }, spacing = 0.1 }"});
  CaseSpec const spec = read_case(file, {quantity_setting(file, {}, {"strain_energy", "total_energy:minimum"})});
  ASSERT_EQ(spec.quantities.size(), 3u);
  EXPECT_EQ(spec.quantities[0].name, "e");
  EXPECT_EQ(spec.quantities[1].name, "strain_energy_final_value");
  EXPECT_EQ(spec.quantities[2].name, "total_energy_minimum");
  EXPECT_EQ(spec.quantities[2].take, QuantitySpec::Statistic::minimum);
  EXPECT_THROW(read_case(file, {quantity_setting(file, {}, {"strain_energie"})}), InputError);
  EXPECT_NE(quantity_setting(file, {}, {"tie_heat"}).find("\"tie_dissipation_final_value\""), std::string::npos);
}

}  // namespace
}  // namespace piola
