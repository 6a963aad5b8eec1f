// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/options.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace piola::nodal {
namespace {

/// Hyperelastic laws and solids in rate form without failure.
std::span<std::string_view const> usable_laws() {
  static auto const usable = laws_that([](LawInfo const& law) { return !law.brittle; });
  return usable;
}

constexpr std::array parameters{
    Parameter{"min_mass_ratio", "1",
              "smallest mass of a particle over that of its cell: more allows longer steps and makes the inertia of "
              "edges less exact",
              Interval{0.05, 1}, 0.3},
    Parameter{"fluctuation_viscosity", "1",
              "viscosity against strain rates that differ within a cell, in units of density times spacing times wave "
              "speed; damps waves of a few spacings; try 0.05",
              Interval{0, 1}, 0},
    Parameter{"shock_viscosity", "1",
              "viscous pressure in compression, in units of density times the square of spacing times rate of volume; "
              "smears shocks over a few spacings, and its work is heat",
              Interval{0, 20}, no_default, "2 if heat raises the pressure of the material, else 0"},
    Parameter{"chatter_damping", "1",
              "largest fraction of a step's friction heat that chatter damping may dissipate; 0: no damping",
              Interval{0, 1}, 0.05},
    Parameter{"energy_tolerance", "1",
              "share of the largest energy by which total energy may rise and fall with the accelerations, as it does "
              "in Verlet steps: steps are shortened to it; 0: steps are limited by stability alone",
              Interval{0, 1}, no_default, "0.001; pressure = \"implicit\" 0"},
    Parameter{
        "convert_strain", "1",
        "with conversion = \"eulerian\": equivalent strain, eq. 18 of AdapTLE, at which a cell converts that has not "
        "failed",
        Interval{0, 1e300}, no_default, "none"}};

constexpr std::array<std::string_view, 5> assumption_words{"as_dimension", "plane_strain", "plane_stress",
                                                           "uniaxial_strain", "uniaxial_stress"};
constexpr std::array<std::string_view, 2> pressure_words{"explicit", "implicit"};
constexpr std::array<std::string_view, 2> conversion_words{"never", "eulerian"};
constexpr std::array choices{
    Choice{"assumption",
           "about the directions that a body does not have; as_dimension: 1D uniaxial_strain, 2D plane_strain",
           assumption_words},
    Choice{
        "pressure",
        "implicit: steps are not limited by pressure waves, which is faster for slender bodies above a Poisson's ratio "
        "of 0.49 in slow motion; waves shorter than a step are lost",
        pressure_words},
    Choice{
        "conversion",
        "of cells that have failed, or are too deformed for gradients in the reference configuration; eulerian: "
        "their material flows on as Eulerian particles, AdapTLE's idea; never: particles of failed cells press, then "
        "come off",
        conversion_words}};

/// Columns of Diagnostics::more (observe.cpp).
constexpr std::array diagnostics{
    DiagnosticInfo{"cell_jacobian_min", "1"},         DiagnosticInfo{"repeated_steps", "1"},
    DiagnosticInfo{"cell_pressure_oscillation", "1"}, DiagnosticInfo{"plastic_work", "J"},
    DiagnosticInfo{"internal_energy", "J"},           DiagnosticInfo{"failed_particles", "1"},
    DiagnosticInfo{"fracture_energy", "J"},           DiagnosticInfo{"crack_area", "m2"},
    DiagnosticInfo{"eulerian_particles", "1"},        DiagnosticInfo{"radiated_energy", "J"}};

}  // namespace

FormulationInfo info() {
  FormulationInfo info{
      "nodal",
      "conservative total-Lagrangian particles for solids: quadratic fits, cells integrated at "
      "four points, exact masses; nothing but plastic flow dissipates, on lattices and irregular clouds alike",
      parameters,
      choices,
      usable_laws(),
      diagnostics};
  info.can_be_coupled = true;
  info.parts = true;
  info.surface_supports = true;
  info.minimises = true;
  info.conducts = true;
  info.axisymmetric = true;
  info.block_laws = true;
  info.absorbs = true;
  info.outline = true;  // cells end at the surface, and mirror planes are there
  return info;
}

namespace {

/// Rejects options that solids in rate form do not support.
void check_solid(MaterialParameters const& material, bool stress_free, Problems& problems) {
  if (is_explosive(material))
    problems.add({},
                 "material: eos = \"jwl\" is an explosive (allowed here: the other words of eos) - take the "
                 "formulation adaptle");
  if (stress_free)
    problems.add({},
                 fmt::format("formulation: assumption is for hyperelastic laws here, and {} is a solid in rate form "
                             "(allowed: as_dimension, plane_strain, uniaxial_strain) - leave it out, or take the "
                             "formulation adaptle",
                             law_of(material).name));
}

/// Rejects what laws on blocks of points do not support.
void check_block_law(MaterialParameters const& material, bool stress_free, bool solids, Problems& problems) {
  LawInfo const& law = law_of(material);
  if (stress_free)
    problems.add({}, fmt::format("formulation: assumption does not go with {}, a law on blocks of points "
                                 "(allowed: as_dimension, plane_strain, uniaxial_strain) - leave it out",
                                 law.name));
  if (solids)
    problems.add(
        {}, fmt::format(
                "material: {}, a law on blocks of points, and a solid in rate form cannot be one body (allowed: parts "
                "with hyperelastic laws or laws of libraries) - make the parts bodies and tie them",
                law.name));
}

/// Rejects materials that cannot be in one body.
void check_parts(std::vector<MaterialParameters> const& materials, bool stress_free, bool solids, bool hyperelastic,
                 Problems& problems) {
  for (MaterialParameters const& material : materials)
    if (is_block_law(material)) check_block_law(material, stress_free, solids, problems);
  if (hyperelastic && std::any_of(materials.begin(), materials.end(), &fails))
    problems.add({},
                 "material: a part that fails and a hyperelastic one cannot be one body (allowed: solids in rate form, "
                 "such as elastic) - take elastic for the hyperelastic part, or make the parts bodies and tie them");
}

/// Most history values of a point by laws on blocks of points; -1: none has a history.
int most_block_history(std::vector<MaterialParameters> const& materials) {
  int most = -1;
  for (MaterialParameters const& material : materials)
    with_block_law(material, [&](BlockLaw const& law) {
      if (!law.elastic()) most = std::max(most, law.history_count());
    });
  return most;
}

/// Rejects numbers of a failure that do not belong together.
void check_failure(FormulationSpec const& spec, MaterialParameters const& material, Problems& problems) {
  with_solid(material, [&](auto const& law) {
    Fracture const& of = law.fracture;
    if ((of.strength < unbounded) != (of.energy > 0))
      problems.add({},
                   "material: a crack needs both tensile_strength, the stress at which it opens, and fracture_energy, "
                   "what it takes per area - give both or neither");
    if (of.displacement > 0 && !law.damages)
      problems.add({},
                   "material: fracture_displacement is that of material of damage 1, and nothing here damages it - "
                   "give damage or spall too, or leave it out");
    if (fails(material) && number_of(spec, "fluctuation_viscosity", 0) > 0)
      problems.add({},
                   "formulation: fluctuation_viscosity would hold the pieces of a body that fails together (allowed: 0 "
                   "with damage, spall or tensile_strength) - leave it out");
  });
}

/// Rejects what Eulerian cells do not support.
void check_conversion(FormulationSpec const& spec, bool hyperelastic, Problems& problems) {
  if (hyperelastic)
    problems.add(
        {},
        "formulation: conversion = \"eulerian\" is for solids in rate form, whose stress does not follow from F "
        "(allowed: such as elastic, johnson_cook) - take one of them, or leave conversion out");
  if (number_of(spec, "fluctuation_viscosity", 0) > 0)
    problems.add({},
                 "formulation: fluctuation_viscosity would hold particles that convert (allowed: 0 with conversion = "
                 "\"eulerian\") - leave it out");
}

/// Rejects what an implicit pressure does not support.
void check_implicit(FormulationSpec const& spec, std::vector<MaterialParameters> const& materials, int dimension,
                    bool stress_free, Problems& problems) {
  bool split = true;
  for (MaterialParameters const& material : materials) {
    auto const& law = law_of(material);
    split = split && !is_hypoelastic(material) && law.volumetric_split &&
            law.small_strain == law_of(materials[0]).small_strain;
  }
  bool const viscous = number_of(spec, "fluctuation_viscosity", 0) > 0 || number_of(spec, "shock_viscosity", 0) > 0;
  if (split && !stress_free && !viscous && dimension > 1) return;
  problems.add({},
               "formulation: pressure = \"implicit\" needs two or three dimensions without a direction that is free of "
               "stress, no viscosity, and a law whose energy splits into shape and volume (allowed: neo_hookean, "
               "mooney_rivlin; linear_elastic for all materials) - take pressure = \"explicit\"");
}

/// A number of the settings; empty: not given.
std::optional<double> given_number(FormulationSpec const& spec, std::string const& name) {
  double const value = number_of(spec, name, std::numeric_limits<double>::quiet_NaN());
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

}  // namespace

Options read_options(FormulationSpec const& spec, std::vector<MaterialParameters> const& materials, int dimension,
                     double cfl) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  Problems problems;
  bool const stress_free = is_stress_free(word_of(spec, choices, "assumption"), dimension, false, problems);
  bool solids = false, hyperelastic = false, elastic = false;
  for (MaterialParameters const& material : materials) {
    (is_hypoelastic(material) ? solids : hyperelastic) = true;
    elastic = elastic || !stores_internal_energy(material);
    if (is_hypoelastic(material)) check_solid(material, stress_free, problems);
    check_failure(spec, material, problems);
  }
  int const block_history = most_block_history(materials);
  check_parts(materials, stress_free, solids, hyperelastic, problems);
  bool const converts = word_of(spec, choices, "conversion") == "eulerian";
  double const convert_strain = number_of(spec, "convert_strain", unbounded);
  if (convert_strain < unbounded && !converts)
    problems.add({}, "formulation: convert_strain is for conversion = \"eulerian\" - add that, or leave it out");
  if (converts) check_conversion(spec, hyperelastic, problems);
  bool const implicit_pressure = word_of(spec, choices, "pressure") == "implicit";
  if (implicit_pressure) check_implicit(spec, materials, dimension, stress_free, problems);
  problems.raise_if_any();
  Options o;
  o.implicit_pressure = implicit_pressure;
  o.least_mass = number_of(spec, "min_mass_ratio", 0.3);
  o.fluctuation_viscosity = number_of(spec, "fluctuation_viscosity", 0);
  o.shock_viscosity = given_number(spec, "shock_viscosity");
  o.viscous = o.fluctuation_viscosity > 0 || (elastic && o.shock_viscosity.value_or(0) > 0);
  o.energy_tolerance = number_of(spec, "energy_tolerance", implicit_pressure ? 0 : 1e-3);
  o.stress_free = stress_free;
  o.cfl = std::isnan(cfl) ? 0 : cfl;
  o.solids = solids;
  o.block_history = block_history;
  o.converts = converts;
  o.convert_strain = convert_strain;
  o.conducts =
      std::any_of(materials.begin(), materials.end(), [](auto const& m) { return heat_of(m).conductivity > 0; });
  o.failure = converts || std::any_of(materials.begin(), materials.end(), &fails);
  return o;
}

}  // namespace piola::nodal
