// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library_sets.hpp"

namespace piola::library {
namespace {

constexpr std::array with_jwl{LibraryWord{"eos", "jwl"}};

constexpr std::array tnt_numbers{LibraryNumber{"density", 1630, "dobratz_1981", quoted},
                                 LibraryNumber{"youngs_modulus", 1e6, "assumed", chosen},
                                 LibraryNumber{"poissons_ratio", 0.2, "assumed", chosen},
                                 LibraryNumber{"jwl_a", 371.2e9, "dobratz_1981", quoted},
                                 LibraryNumber{"jwl_b", 3.231e9, "dobratz_1981", quoted},
                                 LibraryNumber{"jwl_r1", 4.15, "dobratz_1981", quoted},
                                 LibraryNumber{"jwl_r2", 0.95, "dobratz_1981", quoted},
                                 LibraryNumber{"jwl_omega", 0.3, "dobratz_1981", quoted},
                                 LibraryNumber{"detonation_energy", 7e9, "dobratz_1981", quoted},
                                 LibraryNumber{"detonation_speed", 6930, "dobratz_1981", quoted}};

constexpr std::array composition_b_numbers{LibraryNumber{"density", 1717, "dobratz_1981", quoted},
                                           LibraryNumber{"youngs_modulus", 1e6, "assumed", chosen},
                                           LibraryNumber{"poissons_ratio", 0.2, "assumed", chosen},
                                           LibraryNumber{"jwl_a", 524.2e9, "dobratz_1981", quoted},
                                           LibraryNumber{"jwl_b", 7.678e9, "dobratz_1981", unread},
                                           LibraryNumber{"jwl_r1", 4.2, "dobratz_1981", quoted},
                                           LibraryNumber{"jwl_r2", 1.1, "dobratz_1981", quoted},
                                           LibraryNumber{"jwl_omega", 0.34, "dobratz_1981", quoted},
                                           LibraryNumber{"detonation_energy", 8.5e9, "dobratz_1981", unread},
                                           LibraryNumber{"detonation_speed", 7980, "dobratz_1981", quoted}};

constexpr std::array c4_numbers{LibraryNumber{"density", 1601, "dobratz_1981", quoted},
                                LibraryNumber{"youngs_modulus", 1e6, "assumed", chosen},
                                LibraryNumber{"poissons_ratio", 0.2, "assumed", chosen},
                                LibraryNumber{"jwl_a", 609.77e9, "dobratz_1981", quoted},
                                LibraryNumber{"jwl_b", 12.95e9, "dobratz_1981", quoted},
                                LibraryNumber{"jwl_r1", 4.5, "dobratz_1981", quoted},
                                LibraryNumber{"jwl_r2", 1.4, "dobratz_1981", quoted},
                                LibraryNumber{"jwl_omega", 0.25, "dobratz_1981", quoted},
                                LibraryNumber{"detonation_energy", 9e9, "dobratz_1981", quoted},
                                LibraryNumber{"detonation_speed", 8193, "dobratz_1981", unread}};

constexpr std::array pbx_9404_numbers{LibraryNumber{"density", 1840, "dobratz_1981", quoted},
                                      LibraryNumber{"youngs_modulus", 1e6, "assumed", chosen},
                                      LibraryNumber{"poissons_ratio", 0.2, "assumed", chosen},
                                      LibraryNumber{"jwl_a", 852.4e9, "dobratz_1981", quoted},
                                      LibraryNumber{"jwl_b", 18.02e9, "dobratz_1981", quoted},
                                      LibraryNumber{"jwl_r1", 4.6, "dobratz_1981", unread},
                                      LibraryNumber{"jwl_r2", 1.3, "dobratz_1981", unread},
                                      LibraryNumber{"jwl_omega", 0.38, "dobratz_1981", quoted},
                                      LibraryNumber{"detonation_energy", 10.2e9, "dobratz_1981", unread},
                                      LibraryNumber{"detonation_speed", 8800, "dobratz_1981", quoted}};

constexpr std::string_view explosive_range =
    "gases to about seven times the volume; charges well above the diameter below which the explosive fails; the "
    "numbers fulfil the "
    "conditions of Chapman and Jouguet within 1 % (tested)";
constexpr std::string_view explosive_lacks =
    "no initiation: it burns when `ignition` says so; no strength, does not fail; no burning with air";

constexpr std::array explosive_sets{
    LibraryMaterial{"tnt", "TNT, pressed, whose gases expand by Jones, Wilkins and Lee", explosive_range,
                    explosive_lacks, "elastic", with_jwl, tnt_numbers},
    LibraryMaterial{"composition_b", "Composition B, grade A, whose gases expand by Jones, Wilkins and Lee",
                    explosive_range, explosive_lacks, "elastic", with_jwl, composition_b_numbers},
    LibraryMaterial{"c4", "C-4, whose gases expand by Jones, Wilkins and Lee", explosive_range, explosive_lacks,
                    "elastic", with_jwl, c4_numbers},
    LibraryMaterial{"pbx_9404", "PBX-9404, whose gases expand by Jones, Wilkins and Lee", explosive_range,
                    explosive_lacks, "elastic", with_jwl, pbx_9404_numbers}};

}  // namespace

std::span<LibraryMaterial const> explosives() { return explosive_sets; }

}  // namespace piola::library
