// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library_sets.hpp"

namespace piola::library {
namespace {

constexpr double disc_shear = 27.6e9, disc_bulk = 2785.0 * 5328 * 5328;

constexpr std::array aluminium_perfectly_plastic_numbers{LibraryNumber{"density", 2785, "young_2021", read},
                                                         youngs_of(disc_shear, disc_bulk, "young_2021", read),
                                                         poissons_of(disc_shear, disc_bulk, "young_2021", read),
                                                         LibraryNumber{"yield_stress", 0.3e9, "young_2021", read},
                                                         LibraryNumber{"bulk_sound_speed", 5328, "young_2021", read},
                                                         LibraryNumber{"adiabatic_exponent", 2, "young_2021", read}};

constexpr std::array aluminium_spall_numbers{LibraryNumber{"density", 2870, "young_2021", read},
                                             LibraryNumber{"youngs_modulus", 70e9, "young_2021", read},
                                             LibraryNumber{"poissons_ratio", 0.33, "young_2021", read},
                                             LibraryNumber{"yield_stress", 479e6, "young_2021", read},
                                             LibraryNumber{"hardening_coefficient", 323e6, "young_2021", read},
                                             LibraryNumber{"hardening_exponent", 0.41, "young_2021", read},
                                             LibraryNumber{"rate_coefficient", 0.101, "young_2021", read},
                                             LibraryNumber{"thermal_exponent", 1.8, "young_2021", read},
                                             LibraryNumber{"specific_heat", 875, "young_2021", read},
                                             LibraryNumber{"reference_temperature", 300, "young_2021", read},
                                             LibraryNumber{"melting_temperature", 850, "young_2021", read},
                                             LibraryNumber{"reference_rate", 1, "young_2021", read},
                                             LibraryNumber{"bulk_sound_speed", 5328, "young_2021", read},
                                             LibraryNumber{"grueneisen_gamma", 2, "young_2021", read},
                                             LibraryNumber{"grueneisen_slope", 0.48, "young_2021", read},
                                             LibraryNumber{"hugoniot_s1", 1.338, "young_2021", read},
                                             LibraryNumber{"d1", 0.45, "young_2021", read},
                                             LibraryNumber{"d4", 0.0138, "young_2021", read},
                                             LibraryNumber{"spall_pressure", 800e6, "young_2021", read}};

constexpr std::array aluminium_2024_t3_numbers{LibraryNumber{"density", 2780, "handbook", quoted},
                                               LibraryNumber{"youngs_modulus", 73e9, "handbook", quoted},
                                               LibraryNumber{"poissons_ratio", 0.33, "handbook", quoted},
                                               LibraryNumber{"yield_stress", 369e6, "lesuer_2000", quoted},
                                               LibraryNumber{"hardening_coefficient", 684e6, "lesuer_2000", quoted},
                                               LibraryNumber{"hardening_exponent", 0.73, "lesuer_2000", quoted},
                                               LibraryNumber{"rate_coefficient", 0.0083, "lesuer_2000", quoted},
                                               LibraryNumber{"thermal_exponent", 1.7, "lesuer_2000", quoted},
                                               LibraryNumber{"specific_heat", 875, "johnson_cook_1983", quoted},
                                               LibraryNumber{"melting_temperature", 775, "johnson_cook_1983", quoted},
                                               LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                               LibraryNumber{"bulk_sound_speed", 5328, "steinberg_1996", quoted},
                                               LibraryNumber{"hugoniot_s1", 1.338, "steinberg_1996", quoted},
                                               LibraryNumber{"grueneisen_gamma", 2.00, "steinberg_1996", quoted},
                                               LibraryNumber{"grueneisen_slope", 0.48, "steinberg_1996", quoted},
                                               LibraryNumber{"d1", 0.13, "teng_2006", quoted},
                                               LibraryNumber{"d2", 0.13, "teng_2006", quoted},
                                               LibraryNumber{"d3", -1.5, "teng_2006", quoted},
                                               LibraryNumber{"d4", 0.011, "teng_2006", quoted},
                                               LibraryNumber{"d5", 0, "teng_2006", quoted}};

constexpr std::array aluminium_2024_t351_numbers{
    LibraryNumber{"density", 2770, "johnson_cook_1983", unread},
    LibraryNumber{"youngs_modulus", 73e9, "handbook", quoted},
    LibraryNumber{"poissons_ratio", 0.33, "handbook", quoted},
    LibraryNumber{"yield_stress", 265e6, "johnson_cook_1983", quoted},
    LibraryNumber{"hardening_coefficient", 426e6, "johnson_cook_1983", quoted},
    LibraryNumber{"hardening_exponent", 0.34, "johnson_cook_1983", quoted},
    LibraryNumber{"rate_coefficient", 0.015, "johnson_cook_1983", quoted},
    LibraryNumber{"thermal_exponent", 1.00, "johnson_cook_1983", quoted},
    LibraryNumber{"specific_heat", 875, "johnson_cook_1983", quoted},
    LibraryNumber{"melting_temperature", 775, "johnson_cook_1983", quoted},
    LibraryNumber{"reference_temperature", 293, "assumed", chosen},
    LibraryNumber{"bulk_sound_speed", 5328, "steinberg_1996", quoted},
    LibraryNumber{"hugoniot_s1", 1.338, "steinberg_1996", quoted},
    LibraryNumber{"grueneisen_gamma", 2.00, "steinberg_1996", quoted},
    LibraryNumber{"grueneisen_slope", 0.48, "steinberg_1996", quoted},
    LibraryNumber{"d1", 0.112, "johnson_holmquist_1989", quoted},
    LibraryNumber{"d2", 0.123, "johnson_holmquist_1989", quoted},
    LibraryNumber{"d3", -1.5, "johnson_holmquist_1989", unread},
    LibraryNumber{"d4", 0.007, "johnson_holmquist_1989", quoted},
    LibraryNumber{"d5", 0, "johnson_holmquist_1989", quoted}};

constexpr std::array aluminium_6061_t6_numbers{LibraryNumber{"density", 2703, "steinberg_1996", quoted},
                                               LibraryNumber{"youngs_modulus", 69e9, "handbook", quoted},
                                               LibraryNumber{"poissons_ratio", 0.33, "handbook", quoted},
                                               LibraryNumber{"yield_stress", 324e6, "lesuer_2001", quoted},
                                               LibraryNumber{"hardening_coefficient", 114e6, "lesuer_2001", quoted},
                                               LibraryNumber{"hardening_exponent", 0.42, "lesuer_2001", quoted},
                                               LibraryNumber{"rate_coefficient", 0.002, "lesuer_2001", quoted},
                                               LibraryNumber{"thermal_exponent", 1.34, "lesuer_2001", quoted},
                                               LibraryNumber{"specific_heat", 896, "handbook", quoted},
                                               LibraryNumber{"melting_temperature", 925, "handbook", quoted},
                                               LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                               LibraryNumber{"bulk_sound_speed", 5240, "steinberg_1996", quoted},
                                               LibraryNumber{"hugoniot_s1", 1.40, "steinberg_1996", quoted},
                                               LibraryNumber{"grueneisen_gamma", 1.97, "steinberg_1996", quoted},
                                               LibraryNumber{"grueneisen_slope", 0.48, "steinberg_1996", quoted},
                                               LibraryNumber{"d1", -0.77, "johnson_holmquist_1989", quoted},
                                               LibraryNumber{"d2", 1.45, "johnson_holmquist_1989", quoted},
                                               LibraryNumber{"d3", -0.47, "johnson_holmquist_1989", quoted},
                                               LibraryNumber{"d4", 0, "johnson_holmquist_1989", quoted},
                                               LibraryNumber{"d5", 1.60, "johnson_holmquist_1989", quoted}};

constexpr std::array aluminium_7075_t651_numbers{LibraryNumber{"density", 2810, "handbook", quoted},
                                                 LibraryNumber{"youngs_modulus", 71.7e9, "handbook", quoted},
                                                 LibraryNumber{"poissons_ratio", 0.33, "handbook", quoted},
                                                 LibraryNumber{"yield_stress", 546e6, "brar_2009", quoted},
                                                 LibraryNumber{"hardening_coefficient", 678e6, "brar_2009", quoted},
                                                 LibraryNumber{"hardening_exponent", 0.71, "brar_2009", quoted},
                                                 LibraryNumber{"rate_coefficient", 0.024, "brar_2009", unread},
                                                 LibraryNumber{"thermal_exponent", 1.56, "brar_2009", quoted},
                                                 LibraryNumber{"specific_heat", 960, "handbook", quoted},
                                                 LibraryNumber{"melting_temperature", 893, "handbook", quoted},
                                                 LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                                 LibraryNumber{"bulk_sound_speed", 5200, "steinberg_1996", quoted},
                                                 LibraryNumber{"hugoniot_s1", 1.36, "steinberg_1996", quoted},
                                                 LibraryNumber{"grueneisen_gamma", 2.20, "steinberg_1996", quoted},
                                                 LibraryNumber{"grueneisen_slope", 0.48, "steinberg_1996", quoted},
                                                 LibraryNumber{"d1", -0.068, "brar_2009", quoted},
                                                 LibraryNumber{"d2", 0.451, "brar_2009", quoted},
                                                 LibraryNumber{"d3", -0.952, "brar_2009", quoted},
                                                 LibraryNumber{"d4", 0.036, "brar_2009", quoted},
                                                 LibraryNumber{"d5", 0.697, "brar_2009", quoted}};

constexpr std::array aluminium_alloys_sets{
    LibraryMaterial{"aluminium_perfectly_plastic", "aluminium of the disc on a plate at 3100 m/s, perfectly plastic",
                    "hypervelocity, where strength matters little",
                    "no hardening, no rate, no heat, no damage: does not fail", "perfectly_plastic", with_gas,
                    aluminium_perfectly_plastic_numbers},
    LibraryMaterial{
        "aluminium_spall", "aluminium of the plate hit at 500 m/s, with shock, damage and spall",
        "the impact of its paper; c0 of the shock is 9 % above that of E and nu: the density may have two digits "
        "swapped",
        "", "johnson_cook", with_shock_and_damage, aluminium_spall_numbers},
    LibraryMaterial{
        "aluminium_2024_t3", "aluminium 2024-T3 and 2024-T351, with shock and damage",
        "flow stress: Hopkinson bars at 4000 to 8000 1/s; damage: tension and notches, not above a triaxiality "
        "of 1; shock: of 2024-T4",
        "no tension limit: give spall_pressure where shocks meet free faces", "johnson_cook", with_shock_and_damage,
        aluminium_2024_t3_numbers},
    LibraryMaterial{
        "aluminium_2024_t351", "aluminium 2024-T351, with shock and damage",
        "flow stress: torsion up to about 400 1/s and Hopkinson bars at raised temperature, checked with Taylor "
        "cylinders; shock: of 2024-T4",
        "no tension limit: give spall_pressure where shocks meet free faces", "johnson_cook", with_shock_and_damage,
        aluminium_2024_t351_numbers},
    LibraryMaterial{
        "aluminium_6061_t6", "aluminium 6061-T6, with shock and damage",
        "flow stress: compression up to 8000 1/s; damage: the fracture strain is zero above a triaxiality of 1.35",
        "no tension limit: give spall_pressure where shocks meet free faces", "johnson_cook", with_shock_and_damage,
        aluminium_6061_t6_numbers},
    LibraryMaterial{
        "aluminium_7075_t651", "aluminium 7075-T651, with shock and damage",
        "slow tests and Hopkinson bars, room and raised temperature; damage: the fracture strain is zero above a "
        "triaxiality of 2; shock: of 7075-T6",
        "no tension limit: give spall_pressure where shocks meet free faces", "johnson_cook", with_shock_and_damage,
        aluminium_7075_t651_numbers}};

}  // namespace

std::span<LibraryMaterial const> aluminium_alloys() { return aluminium_alloys_sets; }

}  // namespace piola::library
