// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library_sets.hpp"

namespace piola::library {
namespace {

constexpr std::array steel_linear_hardening_numbers{
    LibraryNumber{"density", 7870, "young_2021", read}, LibraryNumber{"youngs_modulus", 200e9, "young_2021", read},
    LibraryNumber{"poissons_ratio", 0.30, "young_2021", read}, LibraryNumber{"yield_stress", 315e6, "young_2021", read},
    LibraryNumber{"hardening_modulus", 16.2e9, "young_2021", read}};

constexpr std::array iron_armco_numbers{LibraryNumber{"density", 7890, "johnson_cook_1983", unread},
                                        LibraryNumber{"youngs_modulus", 207e9, "handbook", unread},
                                        LibraryNumber{"poissons_ratio", 0.29, "handbook", unread},
                                        LibraryNumber{"yield_stress", 175e6, "johnson_cook_1983", quoted},
                                        LibraryNumber{"hardening_coefficient", 380e6, "johnson_cook_1983", quoted},
                                        LibraryNumber{"hardening_exponent", 0.32, "johnson_cook_1983", quoted},
                                        LibraryNumber{"rate_coefficient", 0.060, "johnson_cook_1983", quoted},
                                        LibraryNumber{"thermal_exponent", 0.55, "johnson_cook_1983", quoted},
                                        LibraryNumber{"specific_heat", 452, "johnson_cook_1983", unread},
                                        LibraryNumber{"melting_temperature", 1811, "johnson_cook_1983", quoted},
                                        LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                        LibraryNumber{"bulk_sound_speed", 4578, "steinberg_1996", quoted},
                                        LibraryNumber{"hugoniot_s1", 1.33, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_slope", 0.43, "steinberg_1996", quoted},
                                        LibraryNumber{"d1", -2.20, "johnson_cook_1985", unread},
                                        LibraryNumber{"d2", 5.43, "johnson_cook_1985", unread},
                                        LibraryNumber{"d3", -0.47, "johnson_cook_1985", unread},
                                        LibraryNumber{"d4", 0.016, "johnson_cook_1985", unread},
                                        LibraryNumber{"d5", 0.63, "johnson_cook_1985", unread}};

constexpr std::array steel_1006_numbers{LibraryNumber{"density", 7890, "johnson_cook_1983", unread},
                                        LibraryNumber{"youngs_modulus", 212e9, "dowling_2013", read},
                                        LibraryNumber{"poissons_ratio", 0.293, "dowling_2013", read},
                                        LibraryNumber{"yield_stress", 350e6, "johnson_cook_1983", quoted},
                                        LibraryNumber{"hardening_coefficient", 275e6, "johnson_cook_1983", quoted},
                                        LibraryNumber{"hardening_exponent", 0.36, "johnson_cook_1983", quoted},
                                        LibraryNumber{"rate_coefficient", 0.022, "johnson_cook_1983", quoted},
                                        LibraryNumber{"thermal_exponent", 1.00, "johnson_cook_1983", quoted},
                                        LibraryNumber{"specific_heat", 452, "johnson_cook_1983", unread},
                                        LibraryNumber{"melting_temperature", 1811, "johnson_cook_1983", quoted},
                                        LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                        LibraryNumber{"bulk_sound_speed", 4578, "steinberg_1996", quoted},
                                        LibraryNumber{"hugoniot_s1", 1.33, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_slope", 0.43, "steinberg_1996", quoted}};

constexpr std::array steel_mild_numbers{LibraryNumber{"density", 7850, "iqbal_2015", unread},
                                        LibraryNumber{"youngs_modulus", 203e9, "iqbal_2015", unread},
                                        LibraryNumber{"poissons_ratio", 0.293, "dowling_2013", read},
                                        LibraryNumber{"yield_stress", 304.33e6, "iqbal_2015", unread},
                                        LibraryNumber{"hardening_coefficient", 422.007e6, "iqbal_2015", unread},
                                        LibraryNumber{"hardening_exponent", 0.345, "iqbal_2015", unread},
                                        LibraryNumber{"rate_coefficient", 0.0156, "iqbal_2015", unread},
                                        LibraryNumber{"thermal_exponent", 0.87, "iqbal_2015", unread},
                                        LibraryNumber{"specific_heat", 452, "iqbal_2015", unread},
                                        LibraryNumber{"melting_temperature", 1800, "iqbal_2015", unread},
                                        LibraryNumber{"reference_rate", 1e-4, "iqbal_2015", unread},
                                        LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                        LibraryNumber{"bulk_sound_speed", 4578, "steinberg_1996", quoted},
                                        LibraryNumber{"hugoniot_s1", 1.33, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_slope", 0.43, "steinberg_1996", quoted},
                                        LibraryNumber{"d1", 0.1152, "iqbal_2015", unread},
                                        LibraryNumber{"d2", 1.0116, "iqbal_2015", unread},
                                        LibraryNumber{"d3", -1.7684, "iqbal_2015", unread},
                                        LibraryNumber{"d4", -0.05279, "iqbal_2015", unread},
                                        LibraryNumber{"d5", 0.5262, "iqbal_2015", unread}};

constexpr std::array steel_4340_numbers{LibraryNumber{"density", 7830, "johnson_cook_1983", quoted},
                                        LibraryNumber{"youngs_modulus", 200e9, "handbook", quoted},
                                        LibraryNumber{"poissons_ratio", 0.29, "handbook", quoted},
                                        LibraryNumber{"yield_stress", 792e6, "johnson_cook_1983", quoted},
                                        LibraryNumber{"hardening_coefficient", 510e6, "johnson_cook_1983", quoted},
                                        LibraryNumber{"hardening_exponent", 0.26, "johnson_cook_1983", quoted},
                                        LibraryNumber{"rate_coefficient", 0.014, "johnson_cook_1983", quoted},
                                        LibraryNumber{"thermal_exponent", 1.03, "johnson_cook_1983", quoted},
                                        LibraryNumber{"specific_heat", 477, "johnson_cook_1983", quoted},
                                        LibraryNumber{"melting_temperature", 1793, "johnson_cook_1983", quoted},
                                        LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                        LibraryNumber{"bulk_sound_speed", 4578, "steinberg_1996", quoted},
                                        LibraryNumber{"hugoniot_s1", 1.33, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_slope", 0.43, "steinberg_1996", quoted},
                                        LibraryNumber{"d1", 0.05, "johnson_cook_1985", quoted},
                                        LibraryNumber{"d2", 3.44, "johnson_cook_1985", quoted},
                                        LibraryNumber{"d3", -2.12, "johnson_cook_1985", quoted},
                                        LibraryNumber{"d4", 0.002, "johnson_cook_1985", quoted},
                                        LibraryNumber{"d5", 0.61, "johnson_cook_1985", quoted}};

constexpr std::array weldox_460_e_numbers{LibraryNumber{"density", 7850, "borvik_2002", quoted},
                                          LibraryNumber{"youngs_modulus", 200e9, "borvik_2002", quoted},
                                          LibraryNumber{"poissons_ratio", 0.293, "dowling_2013", read},
                                          LibraryNumber{"yield_stress", 490e6, "borvik_2002", quoted},
                                          LibraryNumber{"hardening_coefficient", 383e6, "borvik_2002", quoted},
                                          LibraryNumber{"hardening_exponent", 0.45, "borvik_2002", quoted},
                                          LibraryNumber{"rate_coefficient", 0.0114, "borvik_2002", quoted},
                                          LibraryNumber{"thermal_exponent", 0.94, "borvik_2002", quoted},
                                          LibraryNumber{"specific_heat", 452, "borvik_2002", unread},
                                          LibraryNumber{"melting_temperature", 1800, "borvik_2002", quoted},
                                          LibraryNumber{"reference_rate", 5e-4, "borvik_2002", quoted},
                                          LibraryNumber{"heat_fraction", 0.9, "borvik_2002", unread},
                                          LibraryNumber{"reference_temperature", 293, "borvik_2002", quoted},
                                          LibraryNumber{"bulk_sound_speed", 4578, "steinberg_1996", quoted},
                                          LibraryNumber{"hugoniot_s1", 1.33, "steinberg_1996", quoted},
                                          LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
                                          LibraryNumber{"grueneisen_slope", 0.43, "steinberg_1996", quoted},
                                          LibraryNumber{"d1", 0.0705, "borvik_2002", quoted},
                                          LibraryNumber{"d2", 1.732, "borvik_2002", quoted},
                                          LibraryNumber{"d3", -0.54, "borvik_2002", quoted},
                                          LibraryNumber{"d4", -0.015, "borvik_2002", quoted}};

constexpr std::array armox_500t_numbers{LibraryNumber{"density", 7850, "iqbal_2016", unread},
                                        LibraryNumber{"youngs_modulus", 201e9, "iqbal_2016", unread},
                                        LibraryNumber{"poissons_ratio", 0.293, "dowling_2013", read},
                                        LibraryNumber{"yield_stress", 1372.488e6, "iqbal_2016", unread},
                                        LibraryNumber{"hardening_coefficient", 835.022e6, "iqbal_2016", unread},
                                        LibraryNumber{"hardening_exponent", 0.2467, "iqbal_2016", unread},
                                        LibraryNumber{"rate_coefficient", 0.0617, "iqbal_2016", unread},
                                        LibraryNumber{"thermal_exponent", 0.84, "iqbal_2016", unread},
                                        LibraryNumber{"specific_heat", 455, "iqbal_2016", unread},
                                        LibraryNumber{"melting_temperature", 1800, "iqbal_2016", unread},
                                        LibraryNumber{"reference_rate", 1, "iqbal_2016", unread},
                                        LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                        LibraryNumber{"bulk_sound_speed", 4578, "steinberg_1996", quoted},
                                        LibraryNumber{"hugoniot_s1", 1.33, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
                                        LibraryNumber{"grueneisen_slope", 0.43, "steinberg_1996", quoted},
                                        LibraryNumber{"d1", 0.04289, "iqbal_2016", unread},
                                        LibraryNumber{"d2", 2.1521, "iqbal_2016", unread},
                                        LibraryNumber{"d3", -2.7575, "iqbal_2016", unread},
                                        LibraryNumber{"d4", -0.0066, "iqbal_2016", unread},
                                        LibraryNumber{"d5", 0.86, "iqbal_2016", unread}};

constexpr std::array steels_sets{
    LibraryMaterial{"steel_linear_hardening",
                    "steel of the sphere that hits a plate at 500 m/s, linear hardening",
                    "impacts of some 100 m/s that the sphere survives",
                    "no rate, no heat, no damage: does not fail; no shock: the bulk modulus is constant",
                    "isotropic_hardening",
                    {},
                    steel_linear_hardening_numbers},
    LibraryMaterial{
        "iron_armco", "Armco iron, with shock and damage",
        "flow stress: torsion up to about 400 1/s and Hopkinson bars at raised temperature, checked with Taylor "
        "cylinders; damage: notched tension bars and torsion; shock: of 4340 steel, below the change of phase of "
        "iron at 13 GPa",
        "no change of phase of iron at 13 GPa", "johnson_cook", with_shock_and_damage, iron_armco_numbers},
    LibraryMaterial{
        "steel_1006", "1006 steel, a mild steel, with shock",
        "flow stress: torsion up to about 400 1/s and Hopkinson bars at raised temperature, checked with Taylor "
        "cylinders; shock: of 4340 steel, below the change of phase of iron at 13 GPa",
        "no damage: does not fail; no change of phase of iron at 13 GPa", "johnson_cook", with_shock,
        steel_1006_numbers},
    LibraryMaterial{
        "steel_mild", "mild structural steel, hot rolled, with shock and damage",
        "tension at several rates and temperatures; plates against 7.62 mm projectiles; above 1.7e4 1/s the rate "
        "term makes the fracture strain zero: what yields breaks at once; shock: of 4340 steel, below the change "
        "of phase of iron at 13 GPa",
        "no change of phase of iron at 13 GPa", "johnson_cook", with_shock_and_damage, steel_mild_numbers},
    LibraryMaterial{
        "steel_4340", "4340 steel (hardness Rockwell C 30), with shock and damage",
        "flow stress: torsion up to about 400 1/s and Hopkinson bars at raised temperature, checked with Taylor "
        "cylinders; damage: notched tension bars and torsion; shock: of 4340 steel, below the change of phase of "
        "iron at 13 GPa",
        "no change of phase of iron at 13 GPa", "johnson_cook", with_shock_and_damage, steel_4340_numbers},
    LibraryMaterial{
        "weldox_460_e", "Weldox 460 E structural steel, with shock and damage",
        "plates of 6 to 30 mm against blunt, hemispherical and conical projectiles at 100 to 500 m/s; rate and "
        "damage are powers (1 + rate/rate0)^C in the paper, within 2 % of the logarithms here up to 1e4 1/s; nu "
        "of the paper is 0.33, which does not go with the shock; shock: of 4340 steel, below the change of phase "
        "of iron at 13 GPa",
        "no weakening by damage before it fails (a set of 2001 with 807 MPa and 0.73 for the hardening goes with one "
        "that "
        "takes 30 %, and is 40 % too strong at large strains without it); no change of phase of iron at 13 GPa",
        "johnson_cook", with_shock_and_damage, weldox_460_e_numbers},
    LibraryMaterial{
        "armox_500t", "Armox 500T armour steel, with shock and damage",
        "tension at several rates and temperatures; plates against 7.62 mm projectiles; shock: of 4340 steel, "
        "below the change of phase of iron at 13 GPa",
        "no change of phase of iron at 13 GPa", "johnson_cook", with_shock_and_damage, armox_500t_numbers}};

}  // namespace

std::span<LibraryMaterial const> steels() { return steels_sets; }

}  // namespace piola::library
