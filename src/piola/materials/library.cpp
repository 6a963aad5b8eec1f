// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/library.hpp"
#include <array>

namespace piola {
namespace {

constexpr std::array gas{LibraryWord{"eos", "stiffened_gas"}};
constexpr std::array grueneisen{LibraryWord{"eos", "mie_grueneisen"}};
constexpr std::array fracture{LibraryWord{"damage", "johnson_cook"}};
constexpr std::array grueneisen_fracture{LibraryWord{"eos", "mie_grueneisen"}, LibraryWord{"damage", "johnson_cook"}};

/// E and nu of a shear modulus and a bulk modulus [Pa].
constexpr LibraryNumber youngs(double shear, double bulk) {
  return {"youngs_modulus", 9 * bulk * shear / (3 * bulk + shear)};
}
constexpr LibraryNumber poissons(double shear, double bulk) {
  return {"poissons_ratio", (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear)};
}

constexpr double disc_shear = 27.6e9, disc_bulk = 2785.0 * 5328 * 5328;
constexpr std::array<LibraryNumber, 6> aluminium_disc{{{"density", 2785},
                                                       youngs(disc_shear, disc_bulk),
                                                       poissons(disc_shear, disc_bulk),
                                                       {"yield_stress", 0.3e9},
                                                       {"bulk_sound_speed", 5328},
                                                       {"adiabatic_exponent", 2}}};

constexpr std::array<LibraryNumber, 5> steel_sphere{{{"density", 7870},
                                                     {"youngs_modulus", 200e9},
                                                     {"poissons_ratio", 0.30},
                                                     {"yield_stress", 315e6},
                                                     {"hardening_modulus", 16.2e9}}};

constexpr std::array<LibraryNumber, 19> aluminium_plate{{{"density", 2870},
                                                         {"youngs_modulus", 70e9},
                                                         {"poissons_ratio", 0.33},
                                                         {"yield_stress", 479e6},
                                                         {"hardening_coefficient", 323e6},
                                                         {"hardening_exponent", 0.41},
                                                         {"rate_coefficient", 0.101},
                                                         {"thermal_exponent", 1.8},
                                                         {"specific_heat", 875},
                                                         {"reference_temperature", 300},
                                                         {"melting_temperature", 850},
                                                         {"reference_rate", 1},
                                                         {"bulk_sound_speed", 5328},
                                                         {"grueneisen_gamma", 2},
                                                         {"grueneisen_slope", 0.48},
                                                         {"hugoniot_s1", 1.338},
                                                         {"d1", 0.45},
                                                         {"d4", 0.0138},
                                                         {"spall_pressure", 800e6}}};

constexpr std::array<LibraryNumber, 5> copper_bar{{{"density", 8930},
                                                   {"youngs_modulus", 117e9},
                                                   {"poissons_ratio", 0.35},
                                                   {"yield_stress", 400e6},
                                                   {"hardening_modulus", 100e6}}};

constexpr std::array<LibraryNumber, 20> copper_ofhc{{{"density", 8960},
                                                     {"youngs_modulus", 124e9},
                                                     {"poissons_ratio", 0.34},
                                                     {"yield_stress", 90e6},
                                                     {"hardening_coefficient", 292e6},
                                                     {"hardening_exponent", 0.31},
                                                     {"rate_coefficient", 0.025},
                                                     {"thermal_exponent", 1.09},
                                                     {"specific_heat", 383},
                                                     {"reference_temperature", 293},
                                                     {"melting_temperature", 1356},
                                                     {"bulk_sound_speed", 3940},
                                                     {"grueneisen_gamma", 2.02},
                                                     {"grueneisen_slope", 0.47},
                                                     {"hugoniot_s1", 1.489},
                                                     {"d1", 0.54},
                                                     {"d2", 4.89},
                                                     {"d3", -3.03},
                                                     {"d4", 0.014},
                                                     {"d5", 1.12}}};

constexpr std::array<LibraryNumber, 16> iron_armco{{{"density", 7890},
                                                    {"youngs_modulus", 207e9},
                                                    {"poissons_ratio", 0.29},
                                                    {"yield_stress", 175e6},
                                                    {"hardening_coefficient", 380e6},
                                                    {"hardening_exponent", 0.32},
                                                    {"rate_coefficient", 0.060},
                                                    {"thermal_exponent", 0.55},
                                                    {"specific_heat", 452},
                                                    {"reference_temperature", 293},
                                                    {"melting_temperature", 1811},
                                                    {"d1", -2.20},
                                                    {"d2", 5.43},
                                                    {"d3", -0.47},
                                                    {"d4", 0.016},
                                                    {"d5", 0.63}}};

constexpr std::array<LibraryNumber, 16> steel_4340{{{"density", 7830},
                                                    {"youngs_modulus", 200e9},
                                                    {"poissons_ratio", 0.29},
                                                    {"yield_stress", 792e6},
                                                    {"hardening_coefficient", 510e6},
                                                    {"hardening_exponent", 0.26},
                                                    {"rate_coefficient", 0.014},
                                                    {"thermal_exponent", 1.03},
                                                    {"specific_heat", 477},
                                                    {"reference_temperature", 293},
                                                    {"melting_temperature", 1793},
                                                    {"d1", 0.05},
                                                    {"d2", 3.44},
                                                    {"d3", -2.12},
                                                    {"d4", 0.002},
                                                    {"d5", 0.61}}};

constexpr std::array<LibraryNumber, 15> aluminium_2024{{{"density", 2770},
                                                        {"youngs_modulus", 73e9},
                                                        {"poissons_ratio", 0.33},
                                                        {"yield_stress", 265e6},
                                                        {"hardening_coefficient", 426e6},
                                                        {"hardening_exponent", 0.34},
                                                        {"rate_coefficient", 0.015},
                                                        {"thermal_exponent", 1.00},
                                                        {"specific_heat", 875},
                                                        {"reference_temperature", 293},
                                                        {"melting_temperature", 775},
                                                        {"bulk_sound_speed", 5328},
                                                        {"grueneisen_gamma", 2},
                                                        {"grueneisen_slope", 0.48},
                                                        {"hugoniot_s1", 1.338}}};

constexpr std::array<LibraryNumber, 15> aluminium_6061{{{"density", 2703},
                                                        {"youngs_modulus", 69e9},
                                                        {"poissons_ratio", 0.33},
                                                        {"yield_stress", 324e6},
                                                        {"hardening_coefficient", 114e6},
                                                        {"hardening_exponent", 0.42},
                                                        {"rate_coefficient", 0.002},
                                                        {"thermal_exponent", 1.34},
                                                        {"specific_heat", 896},
                                                        {"reference_temperature", 293},
                                                        {"melting_temperature", 925},
                                                        {"bulk_sound_speed", 5240},
                                                        {"grueneisen_gamma", 1.97},
                                                        {"grueneisen_slope", 0.48},
                                                        {"hugoniot_s1", 1.40}}};

constexpr std::array<LibraryNumber, 11> tungsten{{{"density", 17000},
                                                  {"youngs_modulus", 340e9},
                                                  {"poissons_ratio", 0.28},
                                                  {"yield_stress", 1506e6},
                                                  {"hardening_coefficient", 177e6},
                                                  {"hardening_exponent", 0.12},
                                                  {"rate_coefficient", 0.016},
                                                  {"thermal_exponent", 1.00},
                                                  {"specific_heat", 134},
                                                  {"reference_temperature", 293},
                                                  {"melting_temperature", 1723}}};

constexpr double be_shear = 151e9, be_bulk = 114.5e9;
constexpr std::array<LibraryNumber, 4> beryllium{
    {{"density", 1845}, youngs(be_shear, be_bulk), poissons(be_shear, be_bulk), {"yield_stress", 330e6}}};

constexpr std::string_view iron_source =
    "flow stress, density, heat capacity, melting: G. R. Johnson, W. H. Cook, Proc. 7th Int. Symp. Ballistics, The "
    "Hague "
    "1983, pp. 541-547, table 1; fracture: the same, Eng. Fract. Mech. 21 (1985) 31-48; E and nu: handbook values; "
    "room "
    "temperature taken as 293 K";
constexpr std::string_view copper_source =
    "flow stress, density, heat capacity, melting: G. R. Johnson, W. H. Cook, Proc. 7th Int. Symp. Ballistics, The "
    "Hague "
    "1983, pp. 541-547, table 1; fracture: the same, Eng. Fract. Mech. 21 (1985) 31-48; E and nu: handbook values; "
    "shock: "
    "D. J. Steinberg, Equation of state and strength properties of selected materials, UCRL-MA-106439, LLNL 1996; room "
    "temperature taken as 293 K";
constexpr std::string_view aluminium_2024_source =
    "flow stress, density, heat capacity, melting: G. R. Johnson, W. H. Cook, Proc. 7th Int. Symp. Ballistics, The "
    "Hague "
    "1983, pp. 541-547, table 1; E and nu: handbook values; shock (2024-T4): D. J. Steinberg, Equation of state and "
    "strength properties of selected materials, UCRL-MA-106439, LLNL 1996; room temperature taken as 293 K";
constexpr std::string_view tungsten_source =
    "flow stress, density, heat capacity, melting: G. R. Johnson, W. H. Cook, Proc. 7th Int. Symp. Ballistics, The "
    "Hague "
    "1983, pp. 541-547, table 1 (0.07 Ni, 0.03 Fe); E and nu: usual for alloys with 90 % tungsten; room temperature "
    "taken "
    "as 293 K";

constexpr std::array materials{
    LibraryMaterial{
        "aluminium_adaptle_3_2", "aluminium of the disc on a plate at 3100 m/s, perfectly plastic",
        "J. Young, F. Teixeira-Dias, A. Azevedo, F. Mill, Int. J. Mech. Sci. 192 (2021) 106108, section 3.2; "
        "E and nu from G = 27.6 GPa and rho0 c0^2",
        "perfectly_plastic", gas, aluminium_disc},
    LibraryMaterial{
        "steel_adaptle_3_3",
        "steel of the sphere at 500 m/s, linear hardening",
        "J. Young, F. Teixeira-Dias, A. Azevedo, F. Mill, Int. J. Mech. Sci. 192 (2021) 106108, section 3.3",
        "isotropic_hardening",
        {},
        steel_sphere},
    LibraryMaterial{
        "aluminium_adaptle_3_3", "aluminium of the plate hit at 500 m/s, with damage and spall",
        "J. Young, F. Teixeira-Dias, A. Azevedo, F. Mill, Int. J. Mech. Sci. 192 (2021) 106108, section 3.3",
        "johnson_cook", grueneisen_fracture, aluminium_plate},
    LibraryMaterial{
        "copper_taylor_bar",
        "copper of the usual Taylor bar (32.4 mm long, 3.2 mm radius, 227 m/s)",
        "G. T. Camacho, M. Ortiz, Comput. Methods Appl. Mech. Eng. 142 (1997) 269-301; Y. Y. Zhu, S. Cescotto, "
        "Int. J. Numer. Methods Eng. 38 (1995) 987-1019",
        "isotropic_hardening",
        {},
        copper_bar},
    LibraryMaterial{"copper_ofhc", "oxygen-free copper, with damage", copper_source, "johnson_cook",
                    grueneisen_fracture, copper_ofhc},
    LibraryMaterial{"iron_armco", "Armco iron, with damage", iron_source, "johnson_cook", fracture, iron_armco},
    LibraryMaterial{"steel_4340", "4340 steel (hardness Rockwell C 30), with damage", iron_source, "johnson_cook",
                    fracture, steel_4340},
    LibraryMaterial{"aluminium_2024_t351", "aluminium 2024-T351", aluminium_2024_source, "johnson_cook", grueneisen,
                    aluminium_2024},
    LibraryMaterial{
        "aluminium_6061_t6", "aluminium 6061-T6",
        "flow stress: D. R. Lesuer, G. J. Kay, M. M. LeBlanc, Modeling large-strain, high-rate deformation in "
        "metals, UCRL-JC-134118, LLNL 2001; density and shock: D. J. Steinberg, Equation of state and strength "
        "properties of selected materials, UCRL-MA-106439, LLNL 1996; E, nu, heat capacity: handbook values; "
        "room temperature taken as 293 K",
        "johnson_cook", grueneisen, aluminium_6061},
    LibraryMaterial{
        "tungsten_alloy", "tungsten with 7 % nickel and 3 % iron", tungsten_source, "johnson_cook", {}, tungsten},
    LibraryMaterial{
        "beryllium",
        "beryllium of the collapsing shells of Verney, perfectly plastic",
        "density, G = 151 GPa, yield stress: B. P. Howell, G. J. Ball, J. Comput. Phys. 175 (2002) 128-167, "
        "after D. J. Steinberg, S. G. Cochran, M. W. Guinan, J. Appl. Phys. 51 (1980) 1498-1504; bulk modulus "
        "114.5 GPa: Voigt mean of the single crystal, J. F. Smith, C. L. Arbogast, J. Appl. Phys. 31 (1960) "
        "99-102",
        "perfectly_plastic",
        {},
        beryllium}};

}  // namespace

std::optional<std::string_view> LibraryMaterial::word(std::string_view choice) const {
  for (LibraryWord const& given : words)
    if (given.choice == choice) return given.word;
  return std::nullopt;
}

std::optional<double> LibraryMaterial::number(std::string_view parameter) const {
  for (LibraryNumber const& given : numbers)
    if (given.parameter == parameter) return given.value;
  return std::nullopt;
}

std::span<LibraryMaterial const> material_library() { return materials; }

std::optional<LibraryMaterial> find_material(std::string_view name) {
  for (LibraryMaterial const& material : materials)
    if (material.name == name) return material;
  return std::nullopt;
}

MaterialParameters parameters_of(LibraryMaterial const& material) {
  LawInfo const law = *find_law(material.law);
  MaterialParameters values;
  values.law = law.index;
  for (std::size_t c = 0; c < law.choices.size(); ++c) {
    if (auto const word = material.word(law.choices[c].name)) values.word[c] = index_of(law.choices[c], *word);
  }
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    Parameter const& parameter = law.parameters[i];
    double const otherwise = parameter.required() ? 0 : parameter.default_value;
    values.value[i] = material.number(parameter.name).value_or(otherwise);
  }
  return values;
}

}  // namespace piola
