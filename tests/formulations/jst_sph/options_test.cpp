// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/base/errors.hpp"
#include <gtest/gtest.h>

namespace piola::jst_sph {
namespace {

MaterialParameters rubber(double poissons_ratio, std::string_view law = "neo_hookean") {
  MaterialParameters material;
  material.law = find_law(law)->index;
  material.value[0] = 1100;
  material.value[1] = 17e6;
  material.value[2] = poissons_ratio;
  return material;
}

Options options(std::map<std::string, std::string, std::less<>> words = {},
                std::map<std::string, double, std::less<>> numbers = {}) {
  return read_options({"jst_sph", std::move(numbers), std::move(words)}, rubber(0.3), std::nan(""));
}

TEST(JstOptions, AreTheFilteredSchemeByDefault) {
  Options const o = options();
  EXPECT_EQ(o.integrator, Integrator::verlet);
  EXPECT_EQ(o.variables, Variables::pF);
  EXPECT_EQ(o.eps2, 0);
  EXPECT_EQ(o.eps4, 0.125);
  EXPECT_EQ(o.biharmonic, Biharmonic::adjoint);
  EXPECT_EQ(o.gradient_support, 0.8);
  EXPECT_EQ(o.laplacian_support, 1.2);
  EXPECT_TRUE(o.project);
  EXPECT_EQ(o.cfl, 0) << "the step comes from the stability limit";
  ASSERT_NE(o.kernel, nullptr);
  EXPECT_EQ(o.kernel->name, "cubic_spline");
}

TEST(JstOptions, OfThePaperAreTheOperatorsAsPrinted) {
  Options const o = options({{"scheme", "paper"}});
  EXPECT_EQ(o.integrator, Integrator::tvd_rk2);
  EXPECT_FALSE(o.filter);
  EXPECT_EQ(o.eps4, 0.125);
  EXPECT_EQ(o.biharmonic, Biharmonic::literal);
  EXPECT_EQ(o.gradient_support, 1.2);
  EXPECT_EQ(o.laplacian_support, 1.2);
  EXPECT_EQ(o.cfl, 0.3);
  EXPECT_TRUE(o.project);
}

TEST(JstOptions, FilterTheVolumeOfNearlyIncompressibleMaterialsOnly) {
  auto const filter = [](double poissons_ratio, std::map<std::string, std::string, std::less<>> words = {}) {
    return read_options({"jst_sph", {}, std::move(words)}, rubber(poissons_ratio), std::nan("")).filter;
  };
  EXPECT_FALSE(filter(0.3));
  EXPECT_FALSE(filter(0.44));
  EXPECT_TRUE(filter(0.45));
  EXPECT_TRUE(filter(0.499));
  EXPECT_FALSE(filter(0.499, {{"scheme", "paper"}}));
  EXPECT_FALSE(filter(0.499, {{"variables", "displacement"}}));
}

TEST(JstOptions, FollowTheLaw) {
  for (LawInfo const& law : laws()) {
    if (law.hypoelastic || law.block != nullptr) {
      EXPECT_THROW((void)read_options({"jst_sph", {}, {}}, rubber(0.3, law.name), std::nan("")), InputError)
          << law.name;
      continue;
    }
    Options const o = read_options({"jst_sph", {}, {}}, rubber(0.49, law.name), std::nan(""));
    EXPECT_EQ(o.filter, law.volumetric_split) << law.name;
    EXPECT_EQ(o.exact_speed, !law.volumetric_split) << law.name << ": it stiffens in tension";
  }
}

TEST(JstOptions, RefuseEvolvedVolumesOutsideThePaper) {
  for (auto const* evolved : {"pFJ", "pFHJ"}) {
    EXPECT_THROW((void)options({{"variables", evolved}}), InputError) << evolved;
    EXPECT_NO_THROW((void)options({{"variables", evolved}, {"scheme", "paper"}}, {{"eps4_volume", 0.1}})) << evolved;
  }
  EXPECT_THROW((void)options({{"scheme", "paper"}}, {{"eps4_volume", 0.1}}), InputError) << "J is not an unknown";
}

TEST(JstOptions, GivenOneByOneOverrideTheScheme) {
  Options const o = options({{"scheme", "paper"}, {"angular_momentum_projection", "off"}},
                            {{"gradient_support", 0.75}, {"eps2_momentum", 0.5}});
  EXPECT_EQ(o.gradient_support, 0.75);
  EXPECT_EQ(o.eps2, 0.5);
  EXPECT_FALSE(o.project);
}

TEST(JstOptions, OfDisplacementVariablesHaveNoStabilisationAndNoProjection) {
  Options const o = options({{"variables", "displacement"}}, {{"eps2_momentum", 0.5}});
  EXPECT_EQ(o.variables, Variables::displacement);
  EXPECT_EQ(o.integrator, Integrator::tvd_rk2);
  EXPECT_EQ(o.biharmonic, Biharmonic::none);
  EXPECT_EQ(o.eps2, 0);
  EXPECT_EQ(o.eps4, 0);
  EXPECT_FALSE(o.project);
}

TEST(JstOptions, TakeTheCourantNumberThatIsGiven) {
  EXPECT_EQ(read_options({"jst_sph", {}, {}}, rubber(0.3), 0.1).cfl, 0.1);
}

TEST(JstOptions, RefuseALaplacianThatReachesLessFarThanTheGradient) {
  try {
    (void)options({}, {{"gradient_support", 1.5}});
    FAIL() << "accepted";
  } catch (InputError const& e) {
    std::string const text = e.what();
    EXPECT_NE(text.find("laplacian_support = 1.2"), std::string::npos) << text;
    EXPECT_NE(text.find("gradient_support = 1.5"), std::string::npos) << text;
  }
  EXPECT_NO_THROW((void)options({{"variables", "displacement"}}, {{"gradient_support", 1.5}}));
}

}  // namespace
}  // namespace piola::jst_sph
