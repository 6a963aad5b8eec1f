// SPDX-License-Identifier: Apache-2.0
#include "piola/guards/warnings.hpp"
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::expect_words;

std::vector<std::string> warnings(std::string const& text) { return build(read_case_text(text, "case.toml")).warnings; }

/// The only warning that speaks of `word`; "" if there is none.
std::string about(std::string const& word, std::vector<std::string> const& all) {
  std::string found;
  for (std::string const& text : all) {
    if (text.find(word) == std::string::npos) continue;
    EXPECT_EQ(found, "") << "twice";
    found = text;
  }
  return found;
}

/// A block of 8 x 8 particles that moves, in a formulation with these settings and laws; 2D, spacing 0.1 m.
std::string block(std::string const& formulation, std::string const& material, std::string const& more = "") {
  return "title = \"Block\"\n[run]\nend = \"1 s\"\n[[body]]\nname = \"block\"\n"
         "shape = { box = { min = [0, 0], max = [0.8, 0.8] }, particles = [8, 8], placement = \"cell_centred\" }\n"
         "material = { density = 1000, youngs_modulus = 1e7, " +
         material + " }\nformulation = { " + formulation + " }\ninitial_velocity = [\"Y\", \"0\"]\n" + more;
}

std::string rubber(std::string const& settings, std::string const& more = "", double ratio = 0.3) {
  return block("name = \"jst_sph\"" + settings, "law = \"neo_hookean\", poissons_ratio = " + std::to_string(ratio),
               more);
}
std::string taylor(std::string const& settings, std::string const& more = "") {
  return block("name = \"taylor_sph\"" + settings, "law = \"linear_elastic\", poissons_ratio = 0.3", more);
}
std::string const perfect = "law = \"perfectly_plastic\", poissons_ratio = 0.3, yield_stress = 1e6";
std::string adaptle(std::string const& settings, std::string const& more = "", std::string const& material = perfect) {
  return block("name = \"adaptle\"" + settings, material, more);
}

std::string const support = "[[support]]\nbody = \"block\"\nwhere = \"Y < 0.1\"\nfix = \"xy\"\n";
std::string const failing =
    "law = \"johnson_cook\", poissons_ratio = 0.3, yield_stress = 1e6, hardening_coefficient = 1e6, "
    "hardening_exponent = 0.3, melting_temperature = 900, damage = \"johnson_cook\", d1 = 0.1";

TEST(Warnings, GoodCasesHaveNone) {
  EXPECT_TRUE(warnings(rubber("")).empty());
  EXPECT_TRUE(warnings(rubber("", "", 0.499)).empty());
  EXPECT_TRUE(warnings(rubber(", scheme = \"paper\"")).empty());
  EXPECT_TRUE(warnings(taylor(", configuration = \"fixed\"", support)).empty());
  EXPECT_TRUE(
      warnings(adaptle(", description = \"total_lagrangian\", correction = \"mixed\", correction_limit = 5")).empty());
  std::string const tears = perfect + ", spall_pressure = 1e6";
  EXPECT_TRUE(warnings(adaptle(", convert_strain = 0.5, conversion_radius = 1", "", tears)).empty());
}

TEST(Warnings, TellWhereJstSphIsKnownToBeInaccurate) {
  auto const with_shape = [](std::string text, std::string const& shape) {
    std::size_t const from = text.find("shape = "), to = text.find('\n', from);
    return text.replace(from, to - from, "shape = { " + shape + " }");
  };
  std::string const jittered = "box = { min = [0, 0], max = [0.8, 0.8] }, particles = [8, 8], jitter = 0.2";
  std::string const disc = "sphere = { centre = [0, 0], radius = 0.4 }, spacing = 0.1";
  EXPECT_NE(about("irregular particles", warnings(with_shape(rubber(""), jittered))), "");
  EXPECT_NE(about("staircases", warnings(with_shape(rubber(""), disc))), "");
  std::string const nodal = block("name = \"nodal\"", "law = \"neo_hookean\", poissons_ratio = 0.3");
  EXPECT_TRUE(warnings(with_shape(nodal, jittered)).empty());
  EXPECT_TRUE(warnings(with_shape(nodal, disc)).empty());
}

TEST(Warnings, TellOfMetalsWhoseTensionNothingLimits) {
  for (std::string const settings : {", convert_strain = 0.5", ", description = \"eulerian\""})
    EXPECT_NE(about("nothing limits the tension", warnings(adaptle(settings))), "") << settings;
  for (std::string const settings : {"", ", description = \"total_lagrangian\""})
    EXPECT_EQ(about("nothing limits the tension", warnings(adaptle(settings))), "") << settings;
  EXPECT_EQ(about("nothing limits the tension", warnings(adaptle(", convert_strain = 0.5", "", failing))), "");
}

TEST(Warnings, TellWhereAdaptleIsKnownToBeInaccurateInBending) {
  std::string const elastic = "law = \"elastic\", poissons_ratio = 0.3";
  auto const bar = [&](std::string const& material, std::string const& held) {
    return test::replaced(test::replaced(adaptle(", description = \"total_lagrangian\"", held, material),
                                         "max = [0.8, 0.8]", "max = [0.5, 2.5]"),
                          "particles = [8, 8]", "particles = [5, 25]");
  };
  EXPECT_NE(about("5 particles across may bend", warnings(bar(elastic, support))), "");
  EXPECT_EQ(about("across may bend", warnings(bar(elastic, ""))), "");
  EXPECT_EQ(about("across may bend", warnings(bar(perfect, support))), "");
  EXPECT_EQ(about("across may bend", warnings(adaptle(", description = \"total_lagrangian\"", support, elastic))), "");
}

TEST(Warnings, NameTheLineAndWhatToDo) {
  EXPECT_EQ(warnings(rubber(", supports = \"multipliers\"")),
            std::vector<std::string>{"case.toml:8:46: body \"block\": supports has no effect here (the body has no "
                                     "support) - remove it, or change what it depends on"});
}

TEST(Warnings, StandInTheOrderOfTheFile) {
  auto const all = warnings(test::replaced(rubber(", supports = \"multipliers\""), "density = 1000", "density = 1"));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(all[0].starts_with("case.toml:7:")) << all[0];
  EXPECT_TRUE(all[1].starts_with("case.toml:8:")) << all[1];
}

/// A setting with the value given is noted in the first case, not in the second.
struct Setting {
  std::string word, ignored, heeded;
};

void expect_ignored(std::vector<Setting> const& settings) {
  for (Setting const& s : settings) {
    EXPECT_NE(about(s.word + " has no effect here", warnings(s.ignored)), "") << s.ignored;
    EXPECT_EQ(about(s.word + " has no effect here", warnings(s.heeded)), "") << s.heeded;
  }
}

TEST(Warnings, SettingsThatJstSphIgnores) {
  std::string const baseline = ", variables = \"displacement\"";
  expect_ignored({
      {"eps4_momentum", rubber(baseline + ", eps4_momentum = 0.1"), rubber(", eps4_momentum = 0.1")},
      {"eps2_momentum", rubber(baseline + ", eps2_momentum = 0.1"), rubber(baseline + ", eps2_momentum = 0")},
      {"angular_momentum_projection", rubber(baseline + ", angular_momentum_projection = \"on\""),
       rubber(", angular_momentum_projection = \"on\"")},
      {"scheme", rubber(baseline + ", scheme = \"filtered\""), rubber(baseline + ", scheme = \"paper\"")},
      {"laplacian_support", rubber(baseline + ", laplacian_support = 1.3"), rubber(", laplacian_support = 1.3")},
      {"supports", rubber(", supports = \"multipliers\""), rubber(", supports = \"multipliers\"", support)},
  });
  std::string const gradient = "initial_deformation_gradient = [[\"1.01\", 0], [0, 1]]\n";
  EXPECT_NE(about("initial_deformation_gradient has no effect", warnings(rubber(baseline, gradient))), "");
  EXPECT_EQ(about("initial_deformation_gradient has no effect", warnings(rubber("", gradient))), "");
}

TEST(Warnings, SettingsThatTaylorSphIgnores) {
  std::string const estimates = ", exchange = \"kernel_sums\"", on = estimates + ", momentum_projection = \"on\"",
                    boxes = ", virtual_particles = \"lattice_cells\"";
  expect_ignored({
      {"momentum_projection", taylor(", momentum_projection = \"on\""), taylor(on)},
      {"gradient", taylor(", gradient = \"published\""), taylor(estimates + ", gradient = \"published\"")},
      {"kernel", taylor(", kernel = \"wendland_c2\""), taylor(estimates + ", kernel = \"wendland_c2\"")},
      {"smoothing_length", taylor(", smoothing_length = 1"), taylor(estimates + ", smoothing_length = 1")},
      {"hourglass_filter", taylor(", hourglass_filter = 0.2"), taylor(estimates + ", hourglass_filter = 0.2")},
      {"stress_retention", taylor(estimates + ", stress_retention = 0.1"), taylor(", stress_retention = 0.1")},
      {"stress_retention", taylor(", configuration = \"fixed\", stress_retention = 0.1"),
       taylor(", stress_retention = 0.1")},
      {"hourglass_stiffness", taylor(", hourglass_stiffness = 0.1"), taylor(boxes + ", hourglass_stiffness = 0.1")},
      {"momentum_projection", taylor(on, support), taylor(on)},
      {"momentum_projection", taylor(on + ", configuration = \"fixed\""), taylor(on)},
  });
  EXPECT_NE(about("without any stress", warnings(taylor("", "initial_displacement = [\"0.01*X\", 0]\n"))), "");
  std::string const bar =
      "title = \"Bar\"\n[run]\nend = 1\n[[body]]\nname = \"bar\"\nshape = { box = { min = [0], max = [1] }, particles "
      "= "
      "[20] }\nmaterial = { law = \"linear_elastic\", density = 1000, youngs_modulus = 1e6, poissons_ratio = 0 }\n"
      "formulation = { name = \"taylor_sph\", hourglass_filter = 0.3, virtual_particles = \"lattice_cells\" }\n"
      "initial_velocity = [\"X\"]\n";
  EXPECT_NE(about("hourglass_filter has no effect here", warnings(bar)), "");
  EXPECT_NE(about("virtual_particles has no effect here", warnings(bar)), "");
}

TEST(Warnings, SettingsThatAdaptleIgnores) {
  std::string const lagrangian = ", description = \"total_lagrangian\"", eulerian = ", description = \"eulerian\"";
  std::string const patch = ", description = \"patch\", eulerian_where = \"X < 0.4\"";
  expect_ignored({
      {"convert_strain", adaptle(lagrangian + ", convert_strain = 1"), adaptle(", convert_strain = 1")},
      {"convert_damage", adaptle(eulerian + ", convert_damage = 0.5"), adaptle(", convert_damage = 0.5", "", failing)},
      {"conversion_separation", adaptle(patch + ", conversion_separation = 2"), adaptle(", conversion_separation = 2")},
      {"conversion_radius", adaptle(lagrangian + ", conversion_radius = 1"), adaptle(", conversion_radius = 1")},
      {"jacobian_max", adaptle(lagrangian + ", jacobian_max = 2"), adaptle(patch + ", jacobian_max = 2")},
      {"blend", adaptle(", blend = 2"), adaptle(patch + ", blend = 2")},
      {"blend", adaptle(patch + ", blend = 2, interface = \"published\""), adaptle(patch + ", blend = 2")},
      {"hourglass", adaptle(eulerian + ", hourglass = 0.1"), adaptle(", hourglass = 0.1")},
      {"interface", adaptle(eulerian + ", interface = \"published\""), adaptle(", interface = \"published\"")},
      {"artificial_stress", adaptle(lagrangian + ", artificial_stress = 0.2"), adaptle(", artificial_stress = 0.2")},
      {"artificial_stress_exponent", adaptle(", artificial_stress = 0, artificial_stress_exponent = 3"),
       adaptle(", artificial_stress_exponent = 3")},
      {"correction", adaptle(eulerian + ", correction = \"material\""), adaptle(", correction = \"material\"")},
      {"correction_limit", adaptle(", correction_limit = 9"),
       adaptle(", correction = \"mixed\", correction_limit = 9")},
      {"viscosity", adaptle(", alpha = 0, beta = 0, viscosity = \"balsara\""), adaptle(", viscosity = \"balsara\"")},
      {"alpha", adaptle(eulerian + ", correction = \"none\", viscosity = \"riemann\", alpha = 2"),
       adaptle(eulerian + ", alpha = 2")},
      {"initial_pressure_duration", adaptle(", initial_pressure_duration = \"one_step\""),
       adaptle(", initial_pressure_duration = \"one_step\", initial_pressure = \"1\"")},
  });
}

TEST(Warnings, SettingsOfAdaptleConcernItsOwnBodiesAlone) {
  std::string const other =
      "[[body]]\nname = \"other\"\nshape = { box = { min = [2, 0], max = [2.8, 0.8] }, particles = [8, 8], placement = "
      "\"cell_centred\" }\nmaterial = { density = 1000, youngs_modulus = 1e7, " +
      perfect + " }\nformulation = { name = \"nodal\" }\n";
  std::string const ignored = about("correction_limit", warnings(adaptle(", correction_limit = 5", other)));
  EXPECT_NE(ignored, "");
  EXPECT_EQ(about("correction", warnings(adaptle(", correction = \"mixed\"", other))), "");
  EXPECT_EQ(about("kernel", warnings(adaptle(", kernel = \"wendland_c2\"", other))), "");
}

TEST(Warnings, MaterialsThatCannotFail) {
  EXPECT_NE(about("convert_damage has no effect", warnings(adaptle(", convert_damage = 0.5"))), "");
  EXPECT_NE(about("failed has no effect", warnings(adaptle(", failed = \"release\""))), "");
  EXPECT_EQ(about("failed has no effect", warnings(adaptle(", failed = \"release\"", "", failing))), "");
  EXPECT_NE(about("asks for damage", warnings(adaptle(", convert_when = \"damage > 0.5\""))), "");
  EXPECT_EQ(about("asks for damage", warnings(adaptle(", convert_when = \"jacobian > 1.5\""))), "");
  std::string const kept = ", description = \"total_lagrangian\"";
  EXPECT_EQ(about("nothing follows from it", warnings(adaptle(kept, "", failing))), "") << "stress is released";
  EXPECT_NE(about("nothing follows from it", warnings(adaptle(kept + ", failed = \"keep\"", "", failing))), "");
  EXPECT_NE(about("too coarse for tensile_strength",
                  warnings(block("name = \"nodal\"",
                                 "law = \"elastic\", poissons_ratio = 0.3, tensile_strength = \"500 MPa\", "
                                 "fracture_energy = \"1 J/m^2\""))),
            "");
  EXPECT_EQ(about("too coarse for tensile_strength",
                  warnings(block("name = \"nodal\"",
                                 "law = \"elastic\", poissons_ratio = 0.3, tensile_strength = \"0.1 MPa\", "
                                 "fracture_energy = \"1 kJ/m^2\""))),
            "");
}

TEST(Warnings, PoissonsRatiosThatLock) {
  std::string const paper = ", scheme = \"paper\"";
  EXPECT_NE(about("locks", warnings(rubber(paper, "", 0.48))), "");
  EXPECT_EQ(about("locks", warnings(rubber(paper, "", 0.45))), "");
  EXPECT_NE(about("nothing damps", warnings(rubber(", variables = \"displacement\"", "", 0.48))), "");
  std::string const unsplit = "law = \"saint_venant_kirchhoff\", poissons_ratio = 0.48";
  EXPECT_NE(about("pressure rings", warnings(block("name = \"jst_sph\"", unsplit))), "");
}

std::string two_cubes(std::string const& formulation, double gap, std::string const& more = "") {
  auto const cube = [&](std::string const& name, double x, std::string const& velocity) {
    return "[[body]]\nname = \"" + name + "\"\nshape = { box = { min = [" + std::to_string(x) + ", 0], max = [" +
           std::to_string(x + 1) +
           ", 1] }, particles = [10, 10], placement = \"cell_centred\" }\nmaterial = { law = \"elastic\", density = "
           "1000, "
           "youngs_modulus = 1e7, poissons_ratio = 0.3 }\nformulation = { name = \"" +
           formulation + "\" }\ninitial_velocity = [\"" + velocity + "\", \"0\"]\n";
  };
  return "title = \"Two\"\n[run]\nend = 1\n" + cube("left", 0, "1") + cube("right", 1 + gap, "-1") + more;
}

TEST(Warnings, BodiesThatCannotMeet) {
  EXPECT_TRUE(warnings(two_cubes("adaptle", 1)).empty());
  EXPECT_TRUE(warnings(two_cubes("nodal", 1)).empty()) << "they have surfaces";
  EXPECT_TRUE(warnings(two_cubes("nodal", 1, "[contact]\nlaw = \"none\"\n")).empty()) << "as was asked for";
  std::string mixed = two_cubes("nodal", 1);
  mixed.replace(mixed.rfind("nodal"), 5, "adaptle");
  EXPECT_TRUE(warnings(mixed).empty()) << "contact by the colour function";
}

TEST(Warnings, SettingsOfBodiesInSurfaceContactNeedNotBeEqual) {
  std::string text = two_cubes("adaptle\", description = \"total_lagrangian", 1, "[contact]\nlaw = \"surface\"\n");
  text.insert(text.rfind("\" }\ninitial_velocity") + 1, ", correction = \"none\"");
  EXPECT_TRUE(warnings(text).empty());
}

// Particles may stand before the plane while the surface of their body is behind it.
TEST(Warnings, SurfacesThatOverlapAtTheStart) {
  auto const plane = [](double x) {
    return "[[rigid]]\nname = \"wall\"\nplane = { point = [" + std::to_string(x) + ", 0], normal = [1, 0] }\n";
  };
  EXPECT_TRUE(warnings(two_cubes("nodal", 1, plane(0))).empty()) << "touching";
  std::string const text = about("overlap at the start", warnings(two_cubes("nodal", 1, plane(0.03))));
  EXPECT_NE(text.find("by 0.3 spacings; contact holds "), std::string::npos) << text;
}

// The spacing is 0.1.
TEST(Warnings, RigidShapesNarrowerThanASpacing) {
  auto const box = [](std::string const& min, std::string const& max) {
    return "[[rigid]]\nname = \"tool\"\nbox = { min = " + min + ", max = " + max + " }\n";
  };
  std::string const needle = box("[0.5, -2]", "[0.54, -0.5]"), sheet = box("[-5, -2]", "[5, -1.96]");
  std::string const text = about("contact takes it for one spacing wide", warnings(two_cubes("nodal", 1, needle)));
  expect_words(text, {"\"tool\" is 40 mm wide", "spacing of body \"left\", 100 mm"});
  EXPECT_NE(text.find("take a spacing of 20 mm or less"), std::string::npos) << text;
  EXPECT_TRUE(warnings(two_cubes("nodal", 1, sheet)).empty()) << "its face is wide";
  EXPECT_TRUE(warnings(two_cubes("nodal", 1, box("[0.5, -2]", "[0.61, -0.5]"))).empty());
  std::string const shot = "[[rigid]]\nname = \"shot\"\nsphere = { centre = [0.5, -2], radius = 0.03 }\n";
  EXPECT_NE(
      about("\"shot\" is 60 mm wide, less than the spacing of body \"right\"", warnings(two_cubes("nodal", 1, shot))),
      "");
  EXPECT_NE(about("is 40 mm thick, less than the spacing of body \"left\"", warnings(two_cubes("adaptle", 1, sheet))),
            "");
}

TEST(Warnings, SettingsOfTheOtherContact) {
  EXPECT_NE(about("contact.law has no effect", warnings(two_cubes("nodal", 1, "[contact]\nlaw = \"linear\"\n"))), "");
  EXPECT_NE(about("contact.friction has no effect",
                  warnings(two_cubes("adaptle\", description = \"total_lagrangian", 1, "[contact]\nfriction = 0.1\n"))),
            "");
  EXPECT_TRUE(warnings(two_cubes("nodal", 1, "[contact]\nfriction = 0.1\n")).empty());
  auto const rubber = [](std::string const& settings) {
    std::string text = two_cubes("nodal\"" + settings + ", name_end = \"", 1, "[contact]\nfriction = 0.1\n");
    for (std::size_t at = 0; (at = text.find(", name_end = \"\"")) != std::string::npos;) text.erase(at, 15);
    for (std::size_t at = 0; (at = text.find("\"elastic\"")) != std::string::npos;)
      text.replace(at, 9, "\"neo_hookean\"");
    return warnings(text);
  };
  std::string const undamped = ", chatter_damping = 0";
  EXPECT_EQ(rubber(undamped).size(), 2U) << "one for each body";
  EXPECT_NE(rubber(undamped).front().find("chatter"), std::string::npos);
  EXPECT_TRUE(rubber("").empty());
  EXPECT_TRUE(rubber(undamped + ", fluctuation_viscosity = 0.3").empty());
}

// The energy of the law "linear" by hand: of each of ten particles of a face with the one across, 0.06 m away, and with
// those beside it, of which none is nearer than a spacing: 10 * 1/2 K 0.1 m (1 - 0.6)^2, K = E / (3 (1 - 2 nu)).
TEST(Warnings, EnergyOfBodiesThatTouch) {
  std::string const text = two_cubes("adaptle", -0.04, "[contact]\nlaw = \"linear\"\n");
  Simulation const simulation = build(read_case_text(text, "case.toml"));
  double const K = 1e7 / 1.2, energy = 10 * 0.5 * K * 0.01 * 0.16;
  Diagnostics const start = simulation.formulation->diagnose();
  double held = 0;
  for (auto const& [name, value] : start.more) held += name == "contact_energy" ? value : 0;
  EXPECT_NEAR(held, energy, 1e-9 * energy);
  EXPECT_EQ(simulation.warnings,
            std::vector<std::string>{
                "case.toml:12:9: the bodies \"left\" and \"right\" start close to each other: their nearest particles "
                "are 60 mm apart, 0.60 spacings; contact holds 66.7 kJ at the start, 99 % of all energy, which nothing "
                "has paid for - leave two smoothing lengths between their particles"});
  // A spring without tension or compression holds nothing.
  EXPECT_TRUE(warnings(two_cubes("adaptle", 0.001, "[contact]\nlaw = \"linear\"\n")).empty());
  EXPECT_NE(about("close to each other", warnings(two_cubes("adaptle", 0, "[contact]\nlaw = \"kernel\"\n"))), "");
  EXPECT_TRUE(warnings(two_cubes("adaptle", 0.2)).empty());
}

TEST(Warnings, ContactWithNothing) {
  EXPECT_NE(about("contact has no effect", warnings(adaptle("", "[contact]\nscale = 2\n"))), "");
  std::string const wall = "[[rigid]]\nname = \"wall\"\nplane = { point = [-1, 0], normal = [1, 0] }\n";
  EXPECT_TRUE(warnings(adaptle("", wall + "[contact]\nscale = 2\n")).empty());
  EXPECT_NE(
      about("contact.closing_speed has no effect", warnings(adaptle("", wall + "[contact]\nclosing_speed = 2\n"))), "");
  std::string const near = "[[rigid]]\nname = \"wall\"\nplane = { point = [0.02, 0], normal = [1, 0] }\n";
  EXPECT_NE(about("rigid shape \"wall\" starts 30 mm from a particle",
                  warnings(adaptle("", near + "[contact]\nlaw = \"kernel\"\n"))),
            "");
}

// A key counts as given wherever it comes from; one of a similar name does not count for it.
TEST(Warnings, OfIdleContactKeysFromTheCaseAndFromSettings) {
  std::string const apart = two_cubes("nodal", 1), text = "contact.law has no effect";
  auto const with = [&](std::string const& more, std::vector<std::string> const& settings) {
    return build(read_case_text(apart + more, "case.toml", settings)).warnings;
  };
  EXPECT_NE(about(text, with("[contact]\nlaw = \"linear\"\n", {})), "");
  EXPECT_NE(about(text, with("[[contact]]\nscale = 2\nlaw = \"linear\"\n", {})), "");
  EXPECT_NE(about(text, warnings("contact = { law = \"linear\" }\n" + apart)), "");
  EXPECT_NE(about(text, with("", {"contact.law=linear"})), "");
  EXPECT_NE(about(text, with("", {"contact={ scale = 2, law = \"linear\" }"})), "");
  EXPECT_NE(about(text, with("", {"contact.scale=2", "contact.law=linear"})), "");
  EXPECT_NE(about(text, with("[contact]\nscale = 2\n", {"contact.law=linear"})), "");
  EXPECT_NE(about(text, with("[contact]\nlaw = \"linear\"\n", {"contact.scale=2"})), "");
  // A setting of more than 200 characters, of which a place keeps the first 200 only.
  std::string const long_setting = "contact={ " + std::string(200, ' ') + "law = \"linear\" }";
  EXPECT_NE(about(text, with("", {long_setting})), "");
  EXPECT_EQ(about(text, with("", {"contact.scale=2"})), "");
  EXPECT_EQ(about(text, with("[contact]\nscale = 2\n", {"contact.scale=3"})), "");
}

TEST(Warnings, LeaveOutContactThatTheCaseSwitchesOff) {
  std::string const wall = "[[rigid]]\nname = \"wall\"\nplane = { point = [-1, 0], normal = [1, 0] }\n";
  std::string const off = "contact = \"none\"\n";
  EXPECT_EQ(about("contact.stiffness has no effect", warnings(off + adaptle("", wall))), "");
  EXPECT_EQ(about("contact.exponent has no effect", warnings(off + adaptle("", wall))), "");
}

TEST(Warnings, ASlipOfUnitsThatMakesOneStepOfARun) {
  auto const all = warnings(test::sample_with("17 MPa", "17"));
  EXPECT_NE(about("softer than any jelly", all), "");
  EXPECT_NE(about("so that the run is a single step", all), "");
  EXPECT_NE(about("times the speed of pressure waves", all), "");
}

std::string solid(std::string const& shape, std::string const& spacing) {
  return "title = \"Solid\"\n[run]\nend = \"1 us\"\n[[body]]\nname = \"part\"\nshape = { spacing = " + spacing + ", " +
         shape +
         " }\nmaterial = { law = \"neo_hookean\", density = 1000, youngs_modulus = 1e7, poissons_ratio = 0.3 }\n"
         "formulation = { name = \"jst_sph\" }\ninitial_velocity = [\"0.1*Y\", \"0\", \"0\"]\n";
}

TEST(Warnings, PartsOfSolidsThatAreThin) {
  // A plate of 0.22 and a needle of 0.2 across.
  std::string const plate =
                        "difference = [ { box = { min = [0, 0, 0], max = [1, 1, 0.22] } }, "
                        "{ cylinder = { centre = [0.5, 0.5, -1], radius = 0.2, length = 3 } } ]",
                    needle = "capsule = { from = [0, 0, 0], to = [2, 0, 0], radius = 0.1 }";
  std::string const of_plate = about("spacings thick", warnings(solid(plate, "0.1")));
  EXPECT_NE(of_plate.find("case.toml:6:"), std::string::npos) << of_plate;
  EXPECT_NE(of_plate.find("body \"part\" is 2.2 spacings thick around ("), std::string::npos) << of_plate;
  EXPECT_NE(about("is 2 spacings thick", warnings(solid(needle, "0.1"))), "");
  EXPECT_EQ(about("spacings thick", warnings(solid(plate, "0.07"))), "");
  EXPECT_EQ(about("spacings thick", warnings(solid(needle, "0.05"))), "");
}

}  // namespace
}  // namespace piola
