// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library_sets.hpp"

namespace piola::library {
namespace {

// rho0 c0^2; of rubber: wood_1964 [Pa].
constexpr double pmma_bulk = 1182.0 * 2180 * 2180, lexan_bulk = 1196.0 * 1933 * 1933, rubber_bulk = 1.95e9;
// E / (2 (1 + nu)) of dowling_2013 [Pa].
constexpr double lexan_shear = 2.4e9 / (2 * 1.38);
constexpr LibraryNumber poissons_of_gelatine{"poissons_ratio", 0.5 - 850e3 / (6 * 2.38e9), "wen_2013", unread};

constexpr std::array pmma_numbers{LibraryNumber{"density", 1182, "steinberg_1996", quoted},
                                  youngs_of(2.32e9, pmma_bulk, "steinberg_1996", quoted),
                                  poissons_of(2.32e9, pmma_bulk, "steinberg_1996", quoted),
                                  LibraryNumber{"yield_stress", 0.42e9, "steinberg_1996", quoted},
                                  LibraryNumber{"bulk_sound_speed", 2180, "steinberg_1996", quoted},
                                  LibraryNumber{"hugoniot_s1", 2.088, "steinberg_1996", quoted},
                                  LibraryNumber{"hugoniot_s2", -1.124, "steinberg_1996", quoted},
                                  LibraryNumber{"grueneisen_gamma", 0.85, "steinberg_1996", quoted}};

constexpr std::array polycarbonate_numbers{LibraryNumber{"density", 1196, "steinberg_1996", quoted},
                                           youngs_of(lexan_shear, lexan_bulk, "dowling_2013", read),
                                           poissons_of(lexan_shear, lexan_bulk, "steinberg_1996", quoted),
                                           LibraryNumber{"yield_stress", 80e6, "dwivedi_2012", unread},
                                           LibraryNumber{"hardening_coefficient", 75e6, "dwivedi_2012", unread},
                                           LibraryNumber{"hardening_exponent", 2, "dwivedi_2012", unread},
                                           LibraryNumber{"rate_coefficient", 0.052, "dwivedi_2012", unread},
                                           LibraryNumber{"thermal_exponent", 0.548, "dwivedi_2012", unread},
                                           LibraryNumber{"specific_heat", 1200, "handbook", unread},
                                           LibraryNumber{"melting_temperature", 562, "dwivedi_2012", unread},
                                           LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                           LibraryNumber{"bulk_sound_speed", 1933, "steinberg_1996", quoted},
                                           LibraryNumber{"hugoniot_s1", 3.49, "steinberg_1996", quoted},
                                           LibraryNumber{"hugoniot_s2", -8.2, "steinberg_1996", quoted},
                                           LibraryNumber{"hugoniot_s3", 9.6, "steinberg_1996", quoted},
                                           LibraryNumber{"grueneisen_gamma", 0.61, "steinberg_1996", quoted}};

constexpr std::array natural_rubber_numbers{LibraryNumber{"density", 920, "handbook", unread},
                                            youngs_of(0.39e6, rubber_bulk, "treloar_1944", unread),
                                            poissons_of(0.39e6, rubber_bulk, "wood_1964", unread)};

constexpr std::array ballistic_gelatine_numbers{LibraryNumber{"density", 1030, "wen_2013", quoted},
                                                LibraryNumber{"youngs_modulus", 850e3, "wen_2013", unread},
                                                poissons_of_gelatine,
                                                LibraryNumber{"yield_stress", 220e3, "wen_2013", quoted},
                                                LibraryNumber{"hardening_modulus", 10.12e3, "wen_2013", unread},
                                                LibraryNumber{"c1", 2.38e9, "wen_2013", quoted},
                                                LibraryNumber{"c2", 7.14e9, "wen_2013", quoted},
                                                LibraryNumber{"c3", 11.9e9, "wen_2013", quoted}};

constexpr std::array non_metals_sets{
    LibraryMaterial{"pmma", "PMMA (Lucite), perfectly plastic, with shock",
                    "shocks of 0.5 GPa and more; E and nu are those of ultrasound, twice those of a slow test",
                    "no rate, no softening, no damage: does not fail, while PMMA is brittle", "perfectly_plastic",
                    with_shock, pmma_numbers},
    LibraryMaterial{
        "polycarbonate", "polycarbonate (Lexan), with shock",
        "slow and Hopkinson bar compression; E and nu have the shear modulus of a slow test and the bulk modulus "
        "of the shock",
        "no softening after yield, no damage: does not fail", "johnson_cook", with_shock, polycarbonate_numbers},
    LibraryMaterial{"natural_rubber",
                    "natural rubber, vulcanised, unfilled, neo-Hookean",
                    "slow extension up to a stretch of 2, compression, shear; 293 K",
                    "no stiffening at a stretch of 3 and more, no viscosity, no damage: does not fail; nearly "
                    "incompressible: the time step is that of pressure waves of 1460 m/s",
                    "neo_hookean",
                    {},
                    natural_rubber_numbers},
    LibraryMaterial{"ballistic_gelatine",
                    "ballistic gelatine, 10 % by mass at 4 C, linear hardening, with the pressure of water",
                    "steel spheres of some millimetres at 600 to 950 m/s",
                    "no rate, no heat; no damage: does not fail, the paper removes what is strained by 0.9",
                    "isotropic_hardening", with_polynomial, ballistic_gelatine_numbers}};

}  // namespace

std::span<LibraryMaterial const> non_metals() { return non_metals_sets; }

}  // namespace piola::library
