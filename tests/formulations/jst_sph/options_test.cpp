// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/base/errors.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola::jst_sph {
namespace {

MaterialParameters rubber(double poissons_ratio) {
  MaterialParameters material;
  material.law = find_law("neo_hookean")->index;
  material.value[0] = 1100;
  material.value[1] = 17e6;
  material.value[2] = poissons_ratio;
  return material;
}

Options options(std::map<std::string, std::string, std::less<>> words = {},
                std::map<std::string, double, std::less<>> numbers = {}) {
  return read_options({"jst_sph", std::move(numbers), std::move(words)}, rubber(0.3), std::nan(""));
}

TEST(JstOptions, OfTheConservativeSchemeHaveAnHourglassEnergy) {
  Options const o = options({{"scheme", "conservative"}});
  EXPECT_EQ(o.integrator, Integrator::verlet);
  EXPECT_EQ(o.biharmonic, Biharmonic::none);
  EXPECT_EQ(o.eps4, 0);
  EXPECT_EQ(o.hourglass_stiffness, 0.5);
  EXPECT_EQ(o.hourglass_stiffening, 3);
  EXPECT_EQ(o.hourglass_viscosity, 1);
  EXPECT_EQ(o.bulk_viscosity, 0.06);
  EXPECT_EQ(o.local_bulk, 1);
  EXPECT_TRUE(o.project);
  EXPECT_EQ(o.cfl, 0) << "the step comes from the stability limit";
}

TEST(JstOptions, RefuseHourglassSettingsWhereTheSchemeHasNone) {
  for (auto const* name : {"hourglass_stiffness", "hourglass_stiffening", "hourglass_viscosity", "bulk_viscosity"}) {
    EXPECT_NO_THROW((void)options({{"scheme", "conservative"}}, {{name, 0.1}})) << name;
    for (auto const* scheme : {"filtered", "robust", "paper"})
      EXPECT_THROW((void)options({{"scheme", scheme}}, {{name, 0.1}}), InputError) << name << scheme;
  }
  EXPECT_THROW((void)options({{"scheme", "conservative"}, {"integrator", "tvd_rk2"}}), InputError);
  EXPECT_THROW((void)options({{"scheme", "conservative"}}, {{"eps2_momentum", 0.1}}), InputError);
}

TEST(JstOptions, AreTheConservativeSchemeByDefault) {
  Options const o = options();
  EXPECT_TRUE(o.hourglass());
  EXPECT_EQ(o.biharmonic, Biharmonic::none);
  EXPECT_EQ(o.gradient_support, 0.8);
}

// Irregular clouds need a wider gradient, and more energy for what it does not see.
TEST(JstOptions, OfTheConservativeSchemeAreOthersOnIrregularClouds) {
  auto const off_lattice = [](std::map<std::string, std::string, std::less<>> words) {
    return read_options({"jst_sph", {}, std::move(words)}, rubber(0.3), std::nan(""), false);
  };
  EXPECT_EQ(off_lattice({}).gradient_support, 1);
  EXPECT_EQ(off_lattice({}).hourglass_stiffness, 10);
  EXPECT_EQ(off_lattice({{"scheme", "filtered"}}).gradient_support, 0.8);
  EXPECT_EQ(off_lattice({{"scheme", "paper"}}).gradient_support, 1.2);
  FormulationSpec const given{"jst_sph", {{"gradient_support", 0.9}, {"hourglass_stiffness", 2.0}}, {}};
  EXPECT_EQ(read_options(given, rubber(0.3), std::nan(""), false).gradient_support, 0.9);
  EXPECT_EQ(read_options(given, rubber(0.3), std::nan(""), false).hourglass_stiffness, 2);
}

TEST(JstOptions, OfTheFilteredSchemeHaveABiharmonicTerm) {
  Options const o = options({{"scheme", "filtered"}});
  EXPECT_EQ(o.integrator, Integrator::verlet);
  EXPECT_FALSE(o.hourglass());
  EXPECT_EQ(o.eps4, 0.125);
  EXPECT_EQ(o.biharmonic, Biharmonic::adjoint);
  EXPECT_TRUE(o.shear_speed);
  EXPECT_TRUE(o.project);
  EXPECT_EQ(o.cfl, 0) << "the step comes from the stability limit";
}

TEST(JstOptions, FilterTheVolumeOfNearlyIncompressibleMaterialsOnly) {
  auto const filter = [](double poissons_ratio) {
    return read_options({"jst_sph", {}, {}}, rubber(poissons_ratio), std::nan("")).filter;
  };
  EXPECT_FALSE(filter(0.3));
  EXPECT_FALSE(filter(0.44));
  EXPECT_TRUE(filter(0.45));
  EXPECT_TRUE(filter(0.499));
}

TEST(JstOptions, RefuseWhatTheSchemesDoNotHave) {
  using Words = std::map<std::string, std::string, std::less<>>;
  Words const filtered{{"scheme", "robust"}, {"volumetric_filter", "on"}};
  EXPECT_TRUE(options(filtered).filter);
  for (auto const* evolved : {"pFJ", "pFHJ"}) {
    Words words = filtered;
    words["variables"] = evolved;
    EXPECT_THROW((void)options(words), InputError) << evolved;
    EXPECT_THROW((void)options({{"variables", evolved}}, {{"eps4_volume", 0.1}}), InputError) << evolved;
    EXPECT_NO_THROW((void)options({{"variables", evolved}, {"scheme", "paper"}}, {{"eps4_volume", 0.1}})) << evolved;
  }
  EXPECT_THROW((void)options({{"scheme", "paper"}}, {{"eps4_volume", 0.1}}), InputError) << "J is not an unknown";
  EXPECT_THROW((void)options({{"gradient", "uncorrected"}}), InputError) << "not with Verlet";
  EXPECT_THROW((void)options({{"scheme", "robust"}, {"gradient", "corrected_kernel"}}), InputError) << "two supports";
}

MaterialParameters stiff_in_volume(std::string_view law) {
  MaterialParameters material = rubber(0.49);
  material.law = find_law(law)->index;
  return material;
}

TEST(JstOptions, FilterLawsWithAVolumetricPartAlone) {
  FormulationSpec const on{"jst_sph", {}, {{"volumetric_filter", "on"}}};
  for (LawInfo const& law : laws()) {
    if (law.rate_form) continue;
    MaterialParameters const material = stiff_in_volume(law.name);
    EXPECT_EQ(read_options({"jst_sph", {}, {}}, material, std::nan("")).filter, law.volumetric_split) << law.name;
    if (law.volumetric_split) {
      EXPECT_TRUE(read_options(on, material, std::nan("")).filter) << law.name;
    } else {
      EXPECT_THROW((void)read_options(on, material, std::nan("")), InputError) << law.name;
    }
  }
}

TEST(JstOptions, SayWhichLawsTheFilterCanWorkWith) {
  FormulationSpec const on{"jst_sph", {}, {{"volumetric_filter", "on"}}};
  try {
    (void)read_options(on, stiff_in_volume("saint_venant_kirchhoff"), std::nan(""));
    FAIL() << "was accepted";
  } catch (InputError const& error) {
    std::string const text = error.what();
    EXPECT_NE(text.find("volumetric_filter"), std::string::npos) << text;
    EXPECT_NE(text.find("saint_venant_kirchhoff is none"), std::string::npos) << text;
    EXPECT_NE(text.find("linear_elastic, neo_hookean, mooney_rivlin"), std::string::npos) << text;
  }
}

TEST(JstOptions, TakeTheExactWaveSpeedForLawsThatStiffenInTension) {
  for (LawInfo const& law : laws()) {
    if (law.rate_form) continue;
    EXPECT_EQ(read_options({"jst_sph", {}, {}}, stiff_in_volume(law.name), std::nan("")).exact_speed,
              !law.volumetric_split)
        << law.name;
  }
}

TEST(JstOptions, OfSolidsInRateFormKeepTheBiharmonicTerm) {
  MaterialParameters metal = rubber(0.3);
  metal.law = find_law("elastic")->index;
  Options const o = read_options({"jst_sph", {}, {{"scheme", "conservative"}}}, metal, std::nan(""));
  EXPECT_FALSE(o.hourglass());
  EXPECT_EQ(o.eps4, 0.125);
}

TEST(JstOptions, OfTheRobustSchemeAreTheCompactSet) {
  Options const o = options({{"scheme", "robust"}});
  EXPECT_EQ(o.integrator, Integrator::tvd_rk2);
  EXPECT_FALSE(o.shear_speed);
  EXPECT_FALSE(o.filter);
  EXPECT_EQ(o.variables, Variables::pF);
  EXPECT_EQ(o.biharmonic, Biharmonic::adjoint);
  EXPECT_EQ(o.gradient_support, 0.8);
  EXPECT_EQ(o.laplacian_support, 1.2);
  EXPECT_EQ(o.eps2, 0);
  EXPECT_EQ(o.eps4, 0.125);
  EXPECT_EQ(o.cfl, 0.3);
  EXPECT_TRUE(o.project);
  ASSERT_NE(o.kernel, nullptr);
  EXPECT_EQ(o.kernel->name, "cubic_spline");
}

TEST(JstOptions, OfThePaperAreTheOperatorsAsPrinted) {
  Options const o = options({{"scheme", "paper"}});
  EXPECT_EQ(o.biharmonic, Biharmonic::literal);
  EXPECT_EQ(o.gradient_support, 1.2);
  EXPECT_EQ(o.laplacian_support, 1.2);
}

TEST(JstOptions, GivenOneByOneOverrideTheScheme) {
  Options const o = options({{"scheme", "paper"}, {"biharmonic", "adjoint"}, {"angular_momentum_projection", "off"}},
                            {{"gradient_support", 0.75}, {"eps2_momentum", 0.5}});
  EXPECT_EQ(o.biharmonic, Biharmonic::adjoint);
  EXPECT_EQ(o.gradient_support, 0.75);
  EXPECT_EQ(o.eps2, 0.5);
  EXPECT_FALSE(o.project);
}

TEST(JstOptions, OfDisplacementVariablesHaveNoStabilisationAndNoProjection) {
  Options const o = options({{"variables", "displacement"}}, {{"eps2_momentum", 0.5}});
  EXPECT_EQ(o.variables, Variables::displacement);
  EXPECT_EQ(o.biharmonic, Biharmonic::none);
  EXPECT_EQ(o.eps2, 0);
  EXPECT_EQ(o.eps4, 0);
  EXPECT_FALSE(o.project);
}

TEST(JstOptions, WithoutStabilisationNeedNoLaplacian) {
  EXPECT_EQ(options({{"scheme", "filtered"}}, {{"eps4_momentum", 0}}).biharmonic, Biharmonic::none);
  EXPECT_EQ(options({{"scheme", "filtered"}}, {{"eps4_momentum", 0}, {"eps2_momentum", 0.1}}).biharmonic,
            Biharmonic::adjoint);
}

TEST(JstOptions, TakeTheCourantNumberThatIsGiven) {
  EXPECT_EQ(read_options({"jst_sph", {}, {}}, rubber(0.3), 0.1).cfl, 0.1);
}

TEST(JstOptions, RefuseALaplacianThatReachesLessFarThanTheGradient) {
  try {
    (void)options({{"scheme", "filtered"}}, {{"gradient_support", 1.5}});
    FAIL() << "accepted";
  } catch (InputError const& e) {
    std::string const text = e.what();
    EXPECT_NE(text.find("laplacian_support = 1.2"), std::string::npos) << text;
    EXPECT_NE(text.find("gradient_support = 1.5"), std::string::npos) << text;
  }
  EXPECT_NO_THROW((void)options({}, {{"gradient_support", 1.5}, {"eps4_momentum", 0}}));
}

}  // namespace
}  // namespace piola::jst_sph
