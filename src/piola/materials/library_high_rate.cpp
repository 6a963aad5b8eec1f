// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library_sets.hpp"

/// Metals with the law of Steinberg, Cochran and Guinan, and those of Zerilli and Armstrong 1987.
namespace piola::library {
namespace {

// rho0 c0^2
constexpr double copper_bulk = 8930.0 * 3940 * 3940, aluminium_bulk = 2703.0 * 5240 * 5240,
                 aluminium_2024_bulk = 2785.0 * 5328 * 5328, tungsten_bulk = 18167.0 * 4030 * 4030,
                 hard_tantalum_bulk = 16690.0 * 3410 * 3410;

constexpr std::array copper_half_hard_numbers{
    LibraryNumber{"density", 8930, "steinberg_1996", quoted},
    youngs_of(47.7e9, copper_bulk, "steinberg_1996", quoted),
    poissons_of(47.7e9, copper_bulk, "steinberg_1996", quoted),
    LibraryNumber{"yield_stress", 0.12e9, "steinberg_1996", quoted},
    LibraryNumber{"strain_factor", 36, "steinberg_1996", quoted},
    LibraryNumber{"hardening_exponent", 0.45, "steinberg_1996", quoted},
    LibraryNumber{"largest_yield_stress", 0.64e9, "steinberg_1996", quoted},
    LibraryNumber{"pressure_coefficient", 2.83e-11, "steinberg_1996", quoted},
    LibraryNumber{"temperature_coefficient", 3.77e-4, "steinberg_1996", quoted},
    LibraryNumber{"melting_at_rest", 1790, "steinberg_1996", quoted},
    LibraryNumber{"melting_slope", 1.5, "steinberg_1996", quoted},
    LibraryNumber{"melting_gamma", 2.02, "steinberg_1996", quoted},
    LibraryNumber{"specific_heat", 383, "handbook", quoted},
    LibraryNumber{"reference_temperature", 300, "steinberg_1996", unread},
    LibraryNumber{"bulk_sound_speed", 3940, "steinberg_1996", quoted},
    LibraryNumber{"hugoniot_s1", 1.489, "steinberg_1996", quoted},
    LibraryNumber{"grueneisen_gamma", 2.02, "steinberg_1996", quoted},
    LibraryNumber{"grueneisen_slope", 0.47, "steinberg_1996", quoted}};

constexpr std::array aluminium_6061_numbers{LibraryNumber{"density", 2703, "steinberg_1996", quoted},
                                            youngs_of(27.6e9, aluminium_bulk, "steinberg_1996", quoted),
                                            poissons_of(27.6e9, aluminium_bulk, "steinberg_1996", quoted),
                                            LibraryNumber{"yield_stress", 0.29e9, "steinberg_1996", quoted},
                                            LibraryNumber{"strain_factor", 125, "steinberg_1996", quoted},
                                            LibraryNumber{"hardening_exponent", 0.1, "steinberg_1996", quoted},
                                            LibraryNumber{"largest_yield_stress", 0.68e9, "steinberg_1996", quoted},
                                            LibraryNumber{"pressure_coefficient", 6.52e-11, "steinberg_1996", quoted},
                                            LibraryNumber{"temperature_coefficient", 6.16e-4, "steinberg_1996", quoted},
                                            LibraryNumber{"melting_at_rest", 1220, "steinberg_1996", quoted},
                                            LibraryNumber{"melting_slope", 1.5, "steinberg_1996", quoted},
                                            LibraryNumber{"melting_gamma", 1.97, "steinberg_1996", quoted},
                                            LibraryNumber{"specific_heat", 885, "handbook", quoted},
                                            LibraryNumber{"reference_temperature", 300, "steinberg_1996", unread},
                                            LibraryNumber{"bulk_sound_speed", 5240, "steinberg_1996", quoted},
                                            LibraryNumber{"hugoniot_s1", 1.40, "steinberg_1996", quoted},
                                            LibraryNumber{"grueneisen_gamma", 1.97, "steinberg_1996", quoted},
                                            LibraryNumber{"grueneisen_slope", 0.48, "steinberg_1996", quoted}};

constexpr std::array aluminium_2024_numbers{LibraryNumber{"density", 2785, "steinberg_1996", quoted},
                                            youngs_of(28.6e9, aluminium_2024_bulk, "steinberg_1996", quoted),
                                            poissons_of(28.6e9, aluminium_2024_bulk, "steinberg_1996", quoted),
                                            LibraryNumber{"yield_stress", 0.26e9, "steinberg_1996", quoted},
                                            LibraryNumber{"strain_factor", 310, "steinberg_1996", quoted},
                                            LibraryNumber{"hardening_exponent", 0.185, "steinberg_1996", quoted},
                                            LibraryNumber{"largest_yield_stress", 0.76e9, "steinberg_1996", quoted},
                                            LibraryNumber{"pressure_coefficient", 6.52e-11, "steinberg_1996", quoted},
                                            LibraryNumber{"temperature_coefficient", 6.16e-4, "steinberg_1996", quoted},
                                            LibraryNumber{"melting_at_rest", 1220, "steinberg_1996", quoted},
                                            LibraryNumber{"melting_slope", 1.5, "steinberg_1996", quoted},
                                            LibraryNumber{"melting_gamma", 2.00, "steinberg_1996", quoted},
                                            LibraryNumber{"specific_heat", 863, "steinberg_1996", quoted},
                                            LibraryNumber{"reference_temperature", 300, "steinberg_1996", unread},
                                            LibraryNumber{"bulk_sound_speed", 5328, "steinberg_1996", quoted},
                                            LibraryNumber{"hugoniot_s1", 1.338, "steinberg_1996", quoted},
                                            LibraryNumber{"grueneisen_gamma", 2.00, "steinberg_1996", quoted},
                                            LibraryNumber{"grueneisen_slope", 0.48, "steinberg_1996", quoted}};

constexpr std::array tungsten_95_numbers{LibraryNumber{"density", 18167, "steinberg_1996", quoted},
                                         youngs_of(145e9, tungsten_bulk, "steinberg_1996", quoted),
                                         poissons_of(145e9, tungsten_bulk, "steinberg_1996", quoted),
                                         LibraryNumber{"yield_stress", 1.87e9, "steinberg_1996", quoted},
                                         LibraryNumber{"strain_factor", 7.7, "steinberg_1996", quoted},
                                         LibraryNumber{"hardening_exponent", 0.13, "steinberg_1996", quoted},
                                         LibraryNumber{"largest_yield_stress", 4e9, "steinberg_1996", quoted},
                                         LibraryNumber{"pressure_coefficient", 1.03e-11, "steinberg_1996", quoted},
                                         LibraryNumber{"temperature_coefficient", 1.52e-4, "steinberg_1996", quoted},
                                         LibraryNumber{"melting_at_rest", 2263, "steinberg_1996", quoted},
                                         LibraryNumber{"melting_slope", 1.3, "steinberg_1996", quoted},
                                         LibraryNumber{"melting_gamma", 1.67, "steinberg_1996", quoted},
                                         LibraryNumber{"specific_heat", 143, "handbook", quoted},
                                         LibraryNumber{"reference_temperature", 300, "steinberg_1996", unread},
                                         LibraryNumber{"bulk_sound_speed", 4030, "steinberg_1996", quoted},
                                         LibraryNumber{"hugoniot_s1", 1.237, "steinberg_1996", quoted},
                                         LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
                                         LibraryNumber{"grueneisen_slope", 0.38, "steinberg_1996", quoted}};

constexpr std::array tantalum_hardening_numbers{
    LibraryNumber{"density", 16690, "steinberg_1996", quoted},
    youngs_of(69e9, hard_tantalum_bulk, "steinberg_1996", quoted),
    poissons_of(69e9, hard_tantalum_bulk, "steinberg_1996", quoted),
    LibraryNumber{"yield_stress", 0.77e9, "steinberg_1996", quoted},
    LibraryNumber{"strain_factor", 10, "steinberg_1996", unread},
    LibraryNumber{"hardening_exponent", 0.1, "steinberg_1996", unread},
    LibraryNumber{"largest_yield_stress", 1.1e9, "steinberg_1996", unread},
    LibraryNumber{"pressure_coefficient", 1.45e-11, "steinberg_1996", unread},
    LibraryNumber{"temperature_coefficient", 1.30e-4, "steinberg_1996", unread},
    LibraryNumber{"melting_at_rest", 4340, "steinberg_1996", unread},
    LibraryNumber{"melting_slope", 1.3, "steinberg_1996", unread},
    LibraryNumber{"melting_gamma", 1.67, "steinberg_1996", quoted},
    LibraryNumber{"specific_heat", 140, "handbook", unread},
    LibraryNumber{"reference_temperature", 300, "steinberg_1996", unread},
    LibraryNumber{"bulk_sound_speed", 3410, "steinberg_1996", quoted},
    LibraryNumber{"hugoniot_s1", 1.20, "steinberg_1996", quoted},
    LibraryNumber{"grueneisen_gamma", 1.67, "steinberg_1996", quoted},
    LibraryNumber{"grueneisen_slope", 0.42, "steinberg_1996", quoted}};

constexpr std::array copper_dislocations_numbers{LibraryNumber{"density", 8930, "steinberg_1996", quoted},
                                                 youngs_of(47.7e9, copper_bulk, "steinberg_1996", quoted),
                                                 poissons_of(47.7e9, copper_bulk, "steinberg_1996", quoted),
                                                 LibraryNumber{"athermal_stress", 65e6, "zerilli_1987", unread},
                                                 LibraryNumber{"thermal_hardening", 890e6, "zerilli_1987", unread},
                                                 LibraryNumber{"thermal_softening", 0.0028, "zerilli_1987", unread},
                                                 LibraryNumber{"thermal_rate", 0.000115, "zerilli_1987", unread},
                                                 LibraryNumber{"specific_heat", 383, "handbook", quoted},
                                                 LibraryNumber{"reference_temperature", 293, "assumed", chosen},
                                                 LibraryNumber{"bulk_sound_speed", 3940, "steinberg_1996", quoted},
                                                 LibraryNumber{"hugoniot_s1", 1.489, "steinberg_1996", quoted},
                                                 LibraryNumber{"grueneisen_gamma", 2.02, "steinberg_1996", quoted},
                                                 LibraryNumber{"grueneisen_slope", 0.47, "steinberg_1996", quoted}};

constexpr std::string_view never_fails =
    "no rate, no damage: does not fail; give spall_pressure where shocks meet free faces";
constexpr std::string_view fast = "rates above 1e5 1/s, where the flow stress is that of the rate-independent limit";

constexpr std::array high_rate_sets{
    LibraryMaterial{"copper_ofhc_half_hard", "oxygen-free copper, half hard, with shock", fast, never_fails,
                    "steinberg_guinan", with_shock, copper_half_hard_numbers},
    LibraryMaterial{"aluminium_6061_t6_shock", "aluminium 6061-T6 in strong shocks", fast, never_fails,
                    "steinberg_guinan", with_shock, aluminium_6061_numbers},
    LibraryMaterial{"aluminium_2024_t4_shock", "aluminium 2024-T4 in strong shocks", fast, never_fails,
                    "steinberg_guinan", with_shock, aluminium_2024_numbers},
    LibraryMaterial{"tungsten_alloy_95", "tungsten with 3.5 % nickel and 1.5 % iron, with shock", fast, never_fails,
                    "steinberg_guinan", with_shock, tungsten_95_numbers},
    LibraryMaterial{"tantalum_hardening", "tantalum that hardens, with shock", fast, never_fails, "steinberg_guinan",
                    with_shock, tantalum_hardening_numbers},
    LibraryMaterial{"copper_ofhc_dislocations", "oxygen-free copper, annealed, flow stress by dislocations, with shock",
                    "Taylor cylinders and tension at rates up to about 1e4 1/s",
                    "no damage: does not fail; give spall_pressure where shocks meet free faces", "zerilli_armstrong",
                    with_shock, copper_dislocations_numbers}};

}  // namespace

std::span<LibraryMaterial const> high_rate_metals() { return high_rate_sets; }

}  // namespace piola::library
