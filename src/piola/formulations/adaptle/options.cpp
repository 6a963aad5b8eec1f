// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/options.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/kernels/list.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace piola::adaptle {
namespace {

constexpr std::array<std::string_view, 4> description_words{"adaptive", "total_lagrangian", "eulerian", "patch"};
constexpr std::array<std::string_view, 2> interface_words{"owner", "published"};
constexpr std::array<std::string_view, 3> correction_words{"material", "none", "mixed"};
constexpr std::array<std::string_view, 5> viscosity_words{"compression", "monaghan", "balsara", "morris_monaghan",
                                                          "riemann"};
constexpr std::array<std::string_view, 3> form_words{"auto", "published", "central"};
constexpr std::array<std::string_view, 3> mixed_words{"both", "eulerian_only", "none"};
constexpr std::array<std::string_view, 2> speed_words{"bulk", "p_wave"};
constexpr std::array<std::string_view, 2> assumption_words{"plane_strain", "plane_stress"};
constexpr std::array<std::string_view, 3> failed_words{"release", "keep", "delete"};
constexpr std::array<std::string_view, 2> lasting_words{"always", "one_step"};

constexpr std::array choices{
    Choice{"description",
           "adaptive: total-Lagrangian particles turn Eulerian where a criterion says so; patch: those that "
           "eulerian_where selects are Eulerian from the start",
           description_words},
    Choice{"interface",
           "forces between total-Lagrangian and Eulerian particles; owner: each through its own gradients with the "
           "reaction on the other, conserves momentum and energy; published: as in the paper, conserves "
           "neither",
           interface_words},
    Choice{"correction",
           "of kernel and gradient, eqs. 3 to 5, by which linear fields are exact; material: of total-Lagrangian sums; "
           "mixed: "
           "of spatial sums, too",
           correction_words},
    Choice{"kernel", "smoothing kernel of sums over neighbours, support 2h; that of contact is the cubic spline",
           LaneKernels::names},
    Choice{"viscosity",
           "switch of the artificial viscosity; compression: acts where the material is compressed, not in shear, so "
           "that alpha and beta need no choice by case; monaghan: none, as published; riemann: a flux from Riemann "
           "problems in place of it (all Eulerian, no correction)",
           viscosity_words},
    Choice{"viscosity_speed", "speed of sound in the viscosity", speed_words},
    Choice{"viscosity_form",
           "force of viscosity between total-Lagrangian particles; auto: central where no body yields, else published; "
           "published: set (2), which correction = \"mixed\" and interface = \"published\" always have; central: along "
           "the line between them, keeps angular momentum, twice as fast, can have a hourglass_stiffness",
           form_words},
    Choice{"artificial_stress_interface", "on which side of a mixed pair artificial stress acts", mixed_words},
    Choice{"assumption", "about the direction that a two-dimensional body does not have", assumption_words},
    Choice{
        "failed",
        "what failed particles carry; release: they lose shear and tension while a shear wave crosses their support; "
        "keep: all their stress, as published; delete (total_lagrangian only): nothing, and they leave the sums of "
        "their neighbours",
        failed_words},
    Choice{"initial_pressure_duration", "how long initial_pressure acts: a residual stress, or an impulse",
           lasting_words}};

constexpr std::array parameters{
    Parameter{"smoothing_length", "1", "h in spacings, of sums over present neighbours", Interval{0.6, 3, false, false},
              no_default, "2D 1.4, 3D 1.2"},
    Parameter{"material_smoothing_length", "1", "h in spacings, of sums over the neighbours of the start",
              Interval{0.6, 3, false, false}, no_default,
              "2D 1.2, 3D 1; with correction = \"none\", where so few neighbours err, smoothing_length"},
    Parameter{"alpha", "1", "linear part of the viscosity, eq. 6", not_negative, 1},
    Parameter{"beta", "1", "quadratic part of the viscosity, eq. 6", not_negative, 2},
    Parameter{
        "hourglass", "1",
        "damping of relative velocities of total-Lagrangian neighbours that their velocity gradients do not explain; "
        "0: none",
        Interval{0, 2, false, false}, no_default,
        "0.7; 0.1 with a hourglass_stiffness by default, and where a total_lagrangian body yields; with correction = "
        "\"none\", where gradients miss even linear motion at free surfaces, 0"},
    Parameter{"hourglass_stiffness", "1",
              "springs against displacements of total-Lagrangian neighbours that their deformation gradients do not "
              "explain, over the shear modulus; with viscosity_form = \"central\"",
              Interval{0, 10, false, false}, no_default,
              "1 where the material does not yield (a held load would else find motions that only damping resists), "
              "else 0"},
    Parameter{"artificial_stress", "1", "epsilon of eq. 10, acts on Eulerian particles in tension; 0: none",
              Interval{0, 1, false, false}, 0.3},
    Parameter{"artificial_stress_exponent", "1", "n of eq. 10, a whole number", Interval{1, 12, false, false}, 4},
    Parameter{"correction_limit", "1", "C_f: a particle drops its correction where it changes a gradient by more",
              Interval{1, unbounded, true, true}, 7.5},
    Parameter{"convert_strain", "1", "equivalent strain (18) at which a particle converts", positive, unbounded,
              "never"},
    Parameter{"convert_damage", "1", "damage at which a particle converts or fails", Interval{0, 1, true, false}, 1},
    Parameter{"jacobian_min", "1", "smallest volume ratio of a total-Lagrangian particle", Interval{0, 1, true, true},
              0.3},
    Parameter{"jacobian_max", "1", "largest volume ratio of a total-Lagrangian particle",
              Interval{1, unbounded, true, true}, 3},
    Parameter{"conversion_separation", "1",
              "a particle converts when an Eulerian reference neighbour has moved away by this many material smoothing "
              "lengths from where its deformation gradient would put it; 0: never",
              not_negative, 1},
    Parameter{"conversion_radius", "1", "reference neighbours within this many material smoothing lengths convert, too",
              Interval{0, 2, false, false}, 2},
    Parameter{"blend", "1", "spacings over which descriptions change gradually at a patch; 0: at once", not_negative,
              4}};

constexpr std::array<std::string_view, 8> variables{"damage",    "plastic_strain", "jacobian",          "pressure",
                                                    "von_mises", "temperature",    "equivalent_strain", "density"};

constexpr std::array formulas{
    FormulaInfo{"eulerian_where", "patch: particles that are Eulerian from the start", {}},
    FormulaInfo{"convert_when",
                "adaptive: a further condition under which a particle and its neighbours convert (pressure is positive "
                "in tension)",
                variables},
    FormulaInfo{"initial_pressure", "pressure added to that of the equation of state, positive in tension, in Pa", {}},
    FormulaInfo{
        "ignition", "time at which an explosive (eos = \"jwl\") is lit, in s; without it: at once everywhere", {}}};

/// Solids in rate form.
std::span<std::string_view const> usable_laws() {
  static auto const usable = laws_that([](LawInfo const& law) { return law.hypoelastic; });
  return usable;
}

constexpr std::array diagnostics{DiagnosticInfo{"internal_energy", "J"},
                                 DiagnosticInfo{"contact_energy", "J"},
                                 DiagnosticInfo{"hourglass_energy", "J"},
                                 DiagnosticInfo{"plastic_work", "J"},
                                 DiagnosticInfo{"viscous_loss", "J"},
                                 DiagnosticInfo{"artificial_stress_work", "J"},
                                 DiagnosticInfo{"eulerian_particles", "1"},
                                 DiagnosticInfo{"converted_particles", "1"},
                                 DiagnosticInfo{"guard_conversions", "1"},
                                 DiagnosticInfo{"converted_mass", "kg"},
                                 DiagnosticInfo{"conversion_energy_change", "J"},
                                 DiagnosticInfo{"conversion_momentum_change", "kg m/s"},
                                 DiagnosticInfo{"failed_particles", "1"},
                                 DiagnosticInfo{"deleted_particles", "1"},
                                 DiagnosticInfo{"contact_overlap", "1"},
                                 DiagnosticInfo{"axis_crossings", "1"},
                                 DiagnosticInfo{"temperature_max", "K"}};

std::string_view word(FormulationSpec const& spec, std::string_view name) { return word_of(spec, choices, name); }

/// Largest Courant number of lengths that shear has compressed, unless run.cfl is larger.
constexpr double longest_sheared = 0.6;

double number(FormulationSpec const& spec, std::string_view name) {
  for (Parameter const& p : parameters)
    if (p.name == name) return number_of(spec, name, p.default_value);
  return 0;
}

/// Whether a material can flow.
bool yields(MaterialParameters const& material) {
  bool can = false;
  with_solid(material, [&](auto const& law) { can = law.yield_stress({}, 0) < unbounded; });
  return can;
}

/// Default of zeta. Bodies that may become Eulerian are damped more, because noise would tear failing material apart
/// (record 13).
double default_hourglass(BodyOptions const& o, bool springs, bool yielding) {
  return springs || (yielding && o.description == Description::total_lagrangian) ? 0.1 : 0.7;
}

/// Whether lengths that shear has compressed may have a Courant number of up to `longest_sheared`. Bodies that stay
/// total-Lagrangian are stable at it (shear_waves_test) with damping and springs up to these values. The limit falls in
/// inverse proportion to stronger ones, and with Poisson's ratios below zero (record 30).
bool allows_longer_steps(BodyOptions const& o, Settings const& s, MaterialParameters const& material) {
  constexpr double most_alpha = 1, most_hourglass = 0.3, most_stiffness = 1;
  if (o.description != Description::total_lagrangian || !s.equations.has_correction() || s.plane_stress) return false;
  if (o.alpha > most_alpha || o.hourglass > most_hourglass || o.hourglass_stiffness > most_stiffness) return false;
  bool positive = true;
  with_solid(material, [&](auto const& law) { positive = 3 * law.kappa >= 2 * law.mu; });
  return positive;
}

/// springs: material sums have a hourglass stiffness, which materials without yield need.
BodyOptions read_body(FormulationSpec const& spec, int dimension, bool springs, bool yielding) {
  springs = springs && !yielding;
  BodyOptions o;
  o.description = choice_of<Description>(spec, choices, "description");
  o.smoothing_length = number_of(spec, "smoothing_length", dimension == 2 ? 1.4 : 1.2);
  bool const plain = word(spec, "correction") == "none";
  o.material_smoothing_length =
      number_of(spec, "material_smoothing_length", plain ? o.smoothing_length : (dimension == 2 ? 1.2 : 1));
  o.alpha = number(spec, "alpha");
  o.beta = number(spec, "beta");
  o.bulk_speed = word(spec, "viscosity_speed") == "bulk";
  o.artificial_stress = number(spec, "artificial_stress");
  o.hourglass = number_of(spec, "hourglass", plain ? 0 : default_hourglass(o, springs, yielding));
  o.hourglass_stiffness = number_of(spec, "hourglass_stiffness", springs ? 1 : 0);
  o.convert_strain = number(spec, "convert_strain");
  o.convert_damage = number(spec, "convert_damage");
  o.jacobian_min = number(spec, "jacobian_min");
  o.jacobian_max = number(spec, "jacobian_max");
  o.tether = number(spec, "conversion_separation");
  o.conversion_radius = number(spec, "conversion_radius");
  o.blend = number(spec, "blend");
  o.deletes = word(spec, "failed") == "delete";
  o.releases = word(spec, "failed") == "release";
  auto const formula = [&](std::string_view name) -> std::optional<Expression> {
    auto const found = spec.formulas.find(name);
    if (found == spec.formulas.end()) return std::nullopt;
    return found->second;
  };
  o.eulerian_where = formula("eulerian_where");
  o.convert_when = formula("convert_when");
  o.initial_pressure = formula("initial_pressure");
  o.ignition = formula("ignition");
  o.initial_pressure_lasts = word(spec, "initial_pressure_duration") == "always";
  return o;
}

/// yielding: some body can flow.
EquationSet read_equations(FormulationSpec const& spec, bool yielding) {
  EquationSet e;
  e.interface_form = choice_of<Interface>(spec, choices, "interface");
  std::string_view const viscosity = word(spec, "viscosity_form"), correction = word(spec, "correction");
  bool const published = e.interface_form == Interface::as_published || correction == "mixed" ||
                         viscosity == "published" || (viscosity == "auto" && yielding);
  if (correction == "none")
    e.form = published ? MaterialForm::published_plain : MaterialForm::plain;
  else
    e.form = published ? MaterialForm::published : MaterialForm::corrected;
  return e;
}

Settings read_settings(FormulationSpec const& spec, bool yielding, bool axisymmetric) {
  Settings s;
  s.axisymmetric = axisymmetric;
  s.viscosity = choice_of<Viscosity>(spec, choices, "viscosity");
  s.equations = read_equations(spec, yielding);
  s.kernel = find_kernel(word(spec, "kernel"));
  s.mixed_stress = choice_of<MixedStress>(spec, choices, "artificial_stress_interface");
  s.corrected = word(spec, "correction") == "mixed";
  s.plane_stress = word(spec, "assumption") == "plane_stress";
  s.exponent = static_cast<int>(number(spec, "artificial_stress_exponent"));
  s.artificial_stress = number(spec, "artificial_stress") > 0 && s.viscosity != Viscosity::riemann;
  s.fallback = number(spec, "correction_limit");
  return s;
}

/// Checks words and numbers that all bodies must have in common.
void check_alike(Assembly const& assembly, Problems& problems) {
  constexpr std::array<std::string_view, 7> shared{
      "interface", "correction", "kernel", "viscosity", "viscosity_form", "artificial_stress_interface", "assumption"};
  auto const& first = assembly.formulations.front();
  for (std::size_t b = 1; b < assembly.formulations.size(); ++b) {
    auto const& other = assembly.formulations[b];
    for (auto const name : shared)
      if (word(first, name) != word(other, name))
        problems.add({},
                     fmt::format("body.formulation.{} is \"{}\" for body \"{}\" and \"{}\" for body \"{}\" (allowed: "
                                 "the same for all bodies) - make them equal",
                                 name, word(first, name), assembly.particles.bodies[0].name, word(other, name),
                                 assembly.particles.bodies[b].name));
    for (std::string_view const name : {"artificial_stress", "artificial_stress_exponent", "correction_limit"})
      if (number_of(first, name, -1) != number_of(other, name, -1))
        problems.add({},
                     fmt::format("body.formulation.{} differs between the bodies \"{}\" and \"{}\" (allowed: the same "
                                 "for all bodies) - make them equal",
                                 name, assembly.particles.bodies[0].name, assembly.particles.bodies[b].name));
  }
}

/// Bodies that are seen as one need one kernel and one viscosity: the forces of a pair would else not be opposite.
void check_one_kernel(Assembly const& assembly, std::vector<BodyOptions> const& bodies, Problems& problems) {
  if (assembly.contact.law != ContactRule::Law::none) return;
  auto const& set = assembly.particles.bodies;
  auto const width = [&](std::size_t b) {
    auto const& s = set[b].spacing;
    return bodies[b].smoothing_length * std::max({s[0], s[1], assembly.particles.dimension == 3 ? s[2] : 0.0});
  };
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    bool const is_same = std::abs(width(b) - width(0)) < 1e-6 * width(0) && bodies[b].alpha == bodies[0].alpha &&
                         bodies[b].beta == bodies[0].beta;
    if (is_same) continue;
    problems.add({},
                 fmt::format("contact.law = \"none\" makes one of the bodies \"{}\" and \"{}\", but their smoothing "
                             "length in m, alpha or beta differ (allowed: equal ones) - make them equal or choose "
                             "another law of contact",
                             set[0].name, set[b].name));
  }
}

void check_body(BodyOptions const& o, Settings const& s, std::string const& name, Problems& problems) {
  auto const refuse = [&](std::string const& what) { problems.add({}, "body \"" + name + "\": " + what); };
  if (o.description == Description::patch && !o.eulerian_where)
    refuse("description = \"patch\" needs eulerian_where, a formula that selects the Eulerian particles - add it");
  if (o.description != Description::patch && o.eulerian_where)
    refuse("eulerian_where belongs to description = \"patch\" - remove it or change the description");
  if (o.convert_when && o.description != Description::adaptive)
    refuse("convert_when belongs to description = \"adaptive\" - remove it or change the description");
  if (o.deletes && o.description != Description::total_lagrangian)
    refuse("failed = \"delete\" belongs to description = \"total_lagrangian\" - remove it or change the description");
  if (s.viscosity == Viscosity::riemann && (o.description != Description::eulerian || s.corrected))
    refuse("viscosity = \"riemann\" needs description = \"eulerian\" and no correction = \"mixed\" - change them");
}

/// Refuses a material whose cracks have a toughness, which only nodal knows.
void check_fracture(MaterialParameters const& material, std::string const& name, Problems& problems) {
  with_solid(material, [&](auto const& law) {
    if (law.fracture.strength < unbounded || law.fracture.energy > 0 || law.fracture.displacement > 0)
      problems.add({}, "body \"" + name +
                           "\": material.tensile_strength, fracture_energy and fracture_displacement have no effect in "
                           "adaptle (allowed here: damage, spall) - leave them out, or take the formulation nodal");
  });
}

/// Refuses what axisymmetric bodies cannot have.
void check_axisymmetric(Assembly const& assembly, Options const& o, Problems& problems) {
  if (!assembly.particles.axisymmetric) return;
  auto const refuse = [&](std::string const& what) {
    problems.add({}, "adaptle: geometry is \"axisymmetric\", and " + what);
  };
  if (o.settings.viscosity == Viscosity::riemann)
    refuse(
        "body.formulation.viscosity is \"riemann\" (allowed: compression, monaghan, balsara, morris_monaghan) - "
        "choose another one");
  if (o.settings.corrected)
    refuse("body.formulation.correction is \"mixed\" (allowed: material, none) - choose another one");
  if (!o.settings.equations.has_reactions())
    refuse("body.formulation.interface is \"published\" (allowed: owner) - leave it out");
  if (o.settings.plane_stress)
    refuse(
        "body.formulation.assumption is \"plane_stress\" (the third direction is that of the circle) - leave it out");
  if (assembly.contact.law == ContactRule::Law::as_published)
    refuse("contact.law is \"published\" (allowed: kernel, linear, surface, none) - choose another law");
  for (BodyOptions const& body : o.bodies)
    if (body.description == Description::patch)
      return refuse(
          "body.formulation.description is \"patch\" (allowed: adaptive, total_lagrangian, eulerian) - choose "
          "another one");
}

}  // namespace

FormulationInfo info() {
  FormulationInfo info{"adaptle",
                       "total-Lagrangian SPH whose particles turn Eulerian where the material is torn; plasticity, "
                       "damage, contact (Young, Teixeira-Dias, Azevedo, Mill 2021)",
                       parameters,
                       choices,
                       usable_laws(),
                       diagnostics};
  info.mirrors = false;
  info.axisymmetric = true;
  info.contact = true;
  info.can_be_coupled = true;
  info.formulas = formulas;
  return info;
}

Options read_options(Assembly const& assembly) {
  Problems problems;
  Options o;
  int const dimension = assembly.particles.dimension;
  if (dimension == 1) problems.add({}, "adaptle: the case is one-dimensional (allowed: 2 or 3 dimensions)");
  o.settings = read_settings(assembly.formulations.front(),
                             std::any_of(assembly.materials.begin(), assembly.materials.end(), yields),
                             assembly.particles.axisymmetric);
  if (o.settings.plane_stress && dimension != 2)
    problems.add({}, "formulation: assumption = \"plane_stress\" is for bodies in 2D - leave it out");
  EquationSet const& equations = o.settings.equations;
  bool const springs = equations.has_hourglass_stiffness() && equations.has_correction();
  o.settings.cfl = std::isnan(assembly.cfl) ? 0.3 : assembly.cfl;
  check_alike(assembly, problems);
  for (std::size_t b = 0; b < assembly.formulations.size(); ++b) {
    o.bodies.push_back(read_body(assembly.formulations[b], dimension, springs, yields(assembly.materials[b])));
    double& sheared_cfl = o.bodies.back().sheared_cfl = o.settings.cfl;
    if (allows_longer_steps(o.bodies.back(), o.settings, assembly.materials[b]))
      sheared_cfl = std::max(sheared_cfl, std::min(2 * sheared_cfl, longest_sheared));
    check_body(o.bodies.back(), o.settings, assembly.particles.bodies[b].name, problems);
    check_fracture(assembly.materials[b], assembly.particles.bodies[b].name, problems);
  }
  check_one_kernel(assembly, o.bodies, problems);
  check_axisymmetric(assembly, o, problems);
  problems.raise_if_any();
  return o;
}

}  // namespace piola::adaptle
