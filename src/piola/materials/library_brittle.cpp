// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library_sets.hpp"

namespace piola::library {
namespace {

constexpr std::array soda_lime_glass_numbers{LibraryNumber{"density", 2530, "holmquist_1995", quoted},
                                             youngs_of(30.4e9, 45.4e9, "holmquist_1995", quoted),
                                             poissons_of(30.4e9, 45.4e9, "holmquist_1995", quoted),
                                             LibraryNumber{"c1", 45.4e9, "holmquist_1995", quoted},
                                             LibraryNumber{"c2", -138e9, "holmquist_1995", quoted},
                                             LibraryNumber{"c3", 290e9, "holmquist_1995", quoted},
                                             LibraryNumber{"hugoniot_elastic_limit", 5.95e9, "holmquist_1995", quoted},
                                             LibraryNumber{"pressure_at_limit", 2.92e9, "holmquist_1995", quoted},
                                             LibraryNumber{"tensile_strength", 0.15e9, "holmquist_1995", quoted},
                                             LibraryNumber{"intact_strength", 0.93, "holmquist_1995", quoted},
                                             LibraryNumber{"intact_exponent", 0.77, "holmquist_1995", quoted},
                                             LibraryNumber{"fractured_strength", 0.088, "holmquist_1995", quoted},
                                             LibraryNumber{"fractured_exponent", 0.35, "holmquist_1995", quoted},
                                             LibraryNumber{"largest_fractured_strength", 0.5, "holmquist_1995", quoted},
                                             LibraryNumber{"rate_coefficient", 0.003, "holmquist_1995", quoted},
                                             LibraryNumber{"fracture_coefficient", 0.053, "holmquist_1995", quoted},
                                             LibraryNumber{"fracture_exponent", 0.85, "holmquist_1995", quoted},
                                             LibraryNumber{"bulking", 1, "holmquist_1995", quoted}};

constexpr std::array boron_carbide_numbers{
    LibraryNumber{"density", 2510, "johnson_holmquist_1999", quoted},
    youngs_of(197e9, 233e9, "johnson_holmquist_1999", quoted),
    poissons_of(197e9, 233e9, "johnson_holmquist_1999", quoted),
    LibraryNumber{"c1", 233e9, "johnson_holmquist_1999", quoted},
    LibraryNumber{"c2", -593e9, "johnson_holmquist_1999", quoted},
    LibraryNumber{"c3", 2800e9, "johnson_holmquist_1999", quoted},
    LibraryNumber{"hugoniot_elastic_limit", 19e9, "johnson_holmquist_1999", quoted},
    LibraryNumber{"pressure_at_limit", 8.71e9, "johnson_holmquist_1999", quoted},
    LibraryNumber{"tensile_strength", 0.26e9, "johnson_holmquist_1999", quoted},
    LibraryNumber{"intact_strength", 0.927, "johnson_holmquist_1999", quoted},
    LibraryNumber{"intact_exponent", 0.67, "johnson_holmquist_1999", quoted},
    LibraryNumber{"fractured_strength", 0.7, "johnson_holmquist_1999", quoted},
    LibraryNumber{"fractured_exponent", 0.85, "johnson_holmquist_1999", quoted},
    LibraryNumber{"largest_fractured_strength", 0.2, "johnson_holmquist_1999", quoted},
    LibraryNumber{"rate_coefficient", 0.005, "johnson_holmquist_1999", quoted},
    LibraryNumber{"fracture_coefficient", 0.001, "johnson_holmquist_1999", quoted},
    LibraryNumber{"fracture_exponent", 0.5, "johnson_holmquist_1999", quoted},
    LibraryNumber{"bulking", 1, "johnson_holmquist_1999", quoted}};

constexpr std::array alumina_numbers{LibraryNumber{"density", 3700, "cronin_2003", unread},
                                     youngs_of(90.16e9, 130.95e9, "cronin_2003", quoted),
                                     poissons_of(90.16e9, 130.95e9, "cronin_2003", quoted),
                                     LibraryNumber{"c1", 130.95e9, "cronin_2003", quoted},
                                     LibraryNumber{"hugoniot_elastic_limit", 2.79e9, "cronin_2003", quoted},
                                     LibraryNumber{"pressure_at_limit", 1.46e9, "cronin_2003", quoted},
                                     LibraryNumber{"tensile_strength", 0.2e9, "cronin_2003", quoted},
                                     LibraryNumber{"intact_strength", 0.93, "cronin_2003", quoted},
                                     LibraryNumber{"intact_exponent", 0.6, "cronin_2003", quoted},
                                     LibraryNumber{"fractured_strength", 0.31, "cronin_2003", quoted},
                                     LibraryNumber{"fractured_exponent", 0.6, "cronin_2003", quoted},
                                     LibraryNumber{"largest_fractured_strength", 0.2, "cronin_2003", quoted},
                                     LibraryNumber{"fracture_coefficient", 0.005, "cronin_2003", quoted},
                                     LibraryNumber{"fracture_exponent", 1, "cronin_2003", quoted},
                                     LibraryNumber{"bulking", 1, "cronin_2003", quoted}};

constexpr std::string_view brittle_lacks =
    "no crack of its own width: what is broken is grains; strength falls in a plastic strain, not in an energy of "
    "fracture, so "
    "that finer particles break a little sooner";

constexpr std::array brittle_sets{
    LibraryMaterial{"soda_lime_glass", "soda-lime (float) glass, with failure and bulking",
                    "plate impact to 14 GPa, penetration at some km/s", brittle_lacks, "johnson_holmquist",
                    with_polynomial, soda_lime_glass_numbers},
    LibraryMaterial{"boron_carbide", "boron carbide, with failure and bulking",
                    "plate impact to 50 GPa, penetration at some km/s", brittle_lacks, "johnson_holmquist",
                    with_polynomial, boron_carbide_numbers},
    LibraryMaterial{"alumina", "alumina (99.5 %), with failure and bulking",
                    "as fitted in its source: softer than other alumina, whose elastic limit is 6 GPa and more",
                    brittle_lacks, "johnson_holmquist", with_polynomial, alumina_numbers}};

}  // namespace

std::span<LibraryMaterial const> brittle() { return brittle_sets; }

}  // namespace piola::library
