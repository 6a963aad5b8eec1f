// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library_sets.hpp"

namespace piola::library {
namespace {

// rho0 c0^2; of the shells of Verney: the Voigt mean of the single crystal (smith_1960).
constexpr double tantalum_bulk = 16690.0 * 3410 * 3410, s200_bulk = 1850.0 * 8000 * 8000, verney_bulk = 114.5e9;

constexpr std::array copper_linear_hardening_numbers{LibraryNumber{"density", 8930, "camacho_1997", quoted},
                                                     LibraryNumber{"youngs_modulus", 117e9, "camacho_1997", quoted},
                                                     LibraryNumber{"poissons_ratio", 0.35, "camacho_1997", quoted},
                                                     LibraryNumber{"yield_stress", 400e6, "camacho_1997", quoted},
                                                     LibraryNumber{"hardening_modulus", 100e6, "camacho_1997", quoted}};

constexpr std::array copper_ofhc_numbers{LibraryNumber{"density", 8960, "johnson_cook_1983", quoted},
                                         LibraryNumber{"youngs_modulus", 124e9, "handbook", quoted},
                                         LibraryNumber{"poissons_ratio", 0.34, "handbook", quoted},
                                         LibraryNumber{"yield_stress", 90e6, "johnson_cook_1983", quoted},
                                         LibraryNumber{"hardening_coefficient", 292e6, "johnson_cook_1983", quoted},
                                         LibraryNumber{"hardening_exponent", 0.31, "johnson_cook_1983", quoted},
                                         LibraryNumber{"rate_coefficient", 0.025, "johnson_cook_1983", quoted},
                                         LibraryNumber{"thermal_exponent", 1.09, "johnson_cook_1983", quoted},
                                         LibraryNumber{"specific_heat", 383, "johnson_cook_1983", quoted},
                                         LibraryNumber{"melting_temperature", 1356, "johnson_cook_1983", quoted},
                                         LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                         LibraryNumber{"bulk_sound_speed", 3940, "steinberg_1996", quoted},
                                         LibraryNumber{"hugoniot_s1", 1.489, "steinberg_1996", quoted},
                                         LibraryNumber{"grueneisen_gamma", 2.02, "steinberg_1996", quoted},
                                         LibraryNumber{"grueneisen_slope", 0.47, "steinberg_1996", quoted},
                                         LibraryNumber{"d1", 0.54, "johnson_cook_1985", quoted},
                                         LibraryNumber{"d2", 4.89, "johnson_cook_1985", quoted},
                                         LibraryNumber{"d3", -3.03, "johnson_cook_1985", quoted},
                                         LibraryNumber{"d4", 0.014, "johnson_cook_1985", quoted},
                                         LibraryNumber{"d5", 1.12, "johnson_cook_1985", quoted}};

constexpr std::array tungsten_alloy_numbers{LibraryNumber{"density", 17000, "johnson_cook_1983", unread},
                                            LibraryNumber{"youngs_modulus", 340e9, "handbook", unread},
                                            LibraryNumber{"poissons_ratio", 0.28, "handbook", unread},
                                            LibraryNumber{"yield_stress", 1506e6, "johnson_cook_1983", quoted},
                                            LibraryNumber{"hardening_coefficient", 177e6, "johnson_cook_1983", quoted},
                                            LibraryNumber{"hardening_exponent", 0.12, "johnson_cook_1983", quoted},
                                            LibraryNumber{"rate_coefficient", 0.016, "johnson_cook_1983", quoted},
                                            LibraryNumber{"thermal_exponent", 1.00, "johnson_cook_1983", quoted},
                                            LibraryNumber{"specific_heat", 134, "johnson_cook_1983", quoted},
                                            LibraryNumber{"melting_temperature", 1723, "johnson_cook_1983", quoted},
                                            LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                            LibraryNumber{"bulk_sound_speed", 4030, "steinberg_1996", quoted},
                                            LibraryNumber{"hugoniot_s1", 1.237, "steinberg_1996", quoted},
                                            LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
                                            LibraryNumber{"grueneisen_slope", 0.38, "steinberg_1996", quoted},
                                            LibraryNumber{"d1", 0, "johnson_holmquist_1989", unread},
                                            LibraryNumber{"d2", 0.33, "johnson_holmquist_1989", unread},
                                            LibraryNumber{"d3", -1.5, "johnson_holmquist_1989", unread},
                                            LibraryNumber{"d4", 0, "johnson_holmquist_1989", unread},
                                            LibraryNumber{"d5", 0, "johnson_holmquist_1989", unread}};

constexpr std::array tantalum_numbers{LibraryNumber{"density", 16690, "steinberg_1996", quoted},
                                      youngs_of(69e9, tantalum_bulk, "steinberg_1996", quoted),
                                      poissons_of(69e9, tantalum_bulk, "steinberg_1996", quoted),
                                      LibraryNumber{"yield_stress", 0.77e9, "steinberg_1996", quoted},
                                      LibraryNumber{"bulk_sound_speed", 3410, "steinberg_1996", quoted},
                                      LibraryNumber{"hugoniot_s1", 1.20, "steinberg_1996", quoted},
                                      LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
                                      LibraryNumber{"grueneisen_slope", 0.42, "steinberg_1996", quoted}};

constexpr std::array lead_numbers{LibraryNumber{"density", 11340, "steinberg_1996", quoted},
                                  LibraryNumber{"youngs_modulus", 16.1e9, "dowling_2013", read},
                                  LibraryNumber{"poissons_ratio", 0.44, "dowling_2013", read},
                                  LibraryNumber{"yield_stress", 8e6, "steinberg_1996", unread},
                                  LibraryNumber{"bulk_sound_speed", 2006, "steinberg_1996", quoted},
                                  LibraryNumber{"hugoniot_s1", 1.429, "steinberg_1996", quoted},
                                  LibraryNumber{"hugoniot_s2", 0.8506, "steinberg_1996", quoted},
                                  LibraryNumber{"hugoniot_s3", -1.64, "steinberg_1996", quoted},
                                  LibraryNumber{"grueneisen_gamma", 2.74, "steinberg_1996", quoted},
                                  LibraryNumber{"grueneisen_slope", 0.54, "steinberg_1996", quoted}};

constexpr std::array titanium_6al_4v_numbers{LibraryNumber{"density", 4430, "handbook", quoted},
                                             LibraryNumber{"youngs_modulus", 113.8e9, "handbook", quoted},
                                             LibraryNumber{"poissons_ratio", 0.342, "handbook", quoted},
                                             LibraryNumber{"yield_stress", 862e6, "johnson_1985", unread},
                                             LibraryNumber{"hardening_coefficient", 331e6, "johnson_1985", unread},
                                             LibraryNumber{"hardening_exponent", 0.34, "johnson_1985", unread},
                                             LibraryNumber{"rate_coefficient", 0.012, "johnson_1985", unread},
                                             LibraryNumber{"thermal_exponent", 0.80, "johnson_1985", unread},
                                             LibraryNumber{"specific_heat", 526, "handbook", quoted},
                                             LibraryNumber{"melting_temperature", 1878, "handbook", quoted},
                                             LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                             LibraryNumber{"bulk_sound_speed", 5130, "steinberg_1996", quoted},
                                             LibraryNumber{"hugoniot_s1", 1.028, "steinberg_1996", quoted},
                                             LibraryNumber{"grueneisen_gamma", 1.23, "steinberg_1996", quoted},
                                             LibraryNumber{"grueneisen_slope", 0.17, "steinberg_1996", quoted},
                                             LibraryNumber{"d1", -0.09, "johnson_1985", quoted},
                                             LibraryNumber{"d2", 0.25, "johnson_1985", quoted},
                                             LibraryNumber{"d3", -0.5, "johnson_1985", quoted},
                                             LibraryNumber{"d4", 0.014, "johnson_1985", quoted},
                                             LibraryNumber{"d5", 3.87, "johnson_1985", quoted}};

constexpr std::array beryllium_numbers{
    LibraryNumber{"density", 1845, "howell_2002", quoted}, youngs_of(151e9, verney_bulk, "howell_2002", quoted),
    poissons_of(151e9, verney_bulk, "smith_1960", unread), LibraryNumber{"yield_stress", 330e6, "howell_2002", quoted}};

constexpr std::array beryllium_s200_numbers{LibraryNumber{"density", 1850, "steinberg_1996", quoted},
                                            youngs_of(151e9, s200_bulk, "howell_2002", quoted),
                                            poissons_of(151e9, s200_bulk, "steinberg_1996", quoted),
                                            LibraryNumber{"yield_stress", 330e6, "howell_2002", quoted},
                                            LibraryNumber{"bulk_sound_speed", 8000, "steinberg_1996", quoted},
                                            LibraryNumber{"hugoniot_s1", 1.124, "steinberg_1996", quoted},
                                            LibraryNumber{"grueneisen_gamma", 1.11, "steinberg_1996", quoted},
                                            LibraryNumber{"grueneisen_slope", 0.16, "steinberg_1996", quoted}};

constexpr std::array other_metals_sets{
    LibraryMaterial{"copper_linear_hardening",
                    "copper of the usual Taylor bar (32.4 mm long, 3.2 mm radius, 227 m/s)",
                    "the Taylor bar",
                    "no rate, no heat, no damage: does not fail; no shock: the bulk modulus is constant",
                    "isotropic_hardening",
                    {},
                    copper_linear_hardening_numbers},
    LibraryMaterial{
        "copper_ofhc", "oxygen-free copper, annealed, with shock and damage",
        "flow stress: torsion up to about 400 1/s and Hopkinson bars at raised temperature, checked with Taylor "
        "cylinders; damage: notched tension bars and torsion; the same numbers, with 89.6 MPa for the yield stress, "
        "are quoted for tough-pitch (ETP) copper",
        "", "johnson_cook", with_shock_and_damage, copper_ofhc_numbers},
    LibraryMaterial{
        "tungsten_alloy", "tungsten with 7 % nickel and 3 % iron, with shock and damage",
        "flow stress: torsion up to about 400 1/s and Hopkinson bars at raised temperature, checked with Taylor "
        "cylinders; shock: of tungsten with 3.5 % nickel and 1.5 % iron",
        "", "johnson_cook", with_shock_and_damage, tungsten_alloy_numbers},
    LibraryMaterial{
        "tantalum", "tantalum, perfectly plastic, with shock",
        "rates above 1e5 1/s, where its yield stress is that of the rate-independent limit; pressures up to some "
        "10 GPa",
        "no hardening, no rate, no softening, no damage: does not fail", "perfectly_plastic", with_shock,
        tantalum_numbers},
    LibraryMaterial{"lead", "lead, perfectly plastic, with shock", "rates above 1e5 1/s; pressures up to some 10 GPa",
                    "no hardening, no rate, no melting (it melts in strong shocks), no damage: does not fail",
                    "perfectly_plastic", with_shock, lead_numbers},
    LibraryMaterial{"titanium_6al_4v", "titanium with 6 % aluminium and 4 % vanadium, with shock and damage",
                    "flow stress and damage: torsion, tension and Hopkinson bars up to about 1e3 1/s",
                    "no adiabatic shear bands narrower than a particle", "johnson_cook", with_shock_and_damage,
                    titanium_6al_4v_numbers},
    LibraryMaterial{"beryllium",
                    "beryllium of the collapsing shells of Verney, perfectly plastic",
                    "the shells of Verney",
                    "no hardening, no damage: does not fail; no shock: the bulk modulus is constant",
                    "perfectly_plastic",
                    {},
                    beryllium_numbers},
    LibraryMaterial{"beryllium_s200", "beryllium S-200, perfectly plastic, with shock", "rates above 1e5 1/s",
                    "no hardening, no damage: does not fail, while beryllium is brittle", "perfectly_plastic",
                    with_shock, beryllium_s200_numbers}};

}  // namespace

std::span<LibraryMaterial const> other_metals() { return other_metals_sets; }

}  // namespace piola::library
