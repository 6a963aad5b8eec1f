// SPDX-License-Identifier: Apache-2.0
// Messages about an invalid case file: place, key, value, advice.
#include "support/key_words.hpp"
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

using test::expect_words;
using test::mentions;
using test::mentions_each;
using test::message_of;
using test::sample_case;
using test::sample_with;

TEST(CaseMessages, AllProblemsOfAFileAreReportedInItsOrder) {
  std::string const text = R"toml(titel = "Twisting column"
[run]
end = "0.5 m"
cfl = -1
[[body]]
name = "column"
shape = { box = { min = [0, 0, 0], max = [1, -6, 1] }, particles = [5, 25] }
material = { law = "neo_hookean", densty = 1100, youngs_modulus = "17 m", poissons_ratio = 0.5 }
formulation = { name = "jst_sph", variables = "pf" }
initial_velocity = ["w*Z", "0", "sin(X"]
[[support]]
body = "colunm"
where = "Y <= 0"
fix = "xyw"
)toml";
  EXPECT_EQ(
      message_of(text),
      "case.toml: the case needs \"title\" (what the case is called in files and pictures) - add title = \"A title\"\n"
      "case.toml:1:1: \"titel\" is not a key of a case (allowed: title, geometry, constants, library, run, region, "
      "body, "
      "support, load, mirror, crack, rigid, spring, contact, tie, probe, quantity, output) - did you mean \"title\"?\n"
      "case.toml:3:7: run.end cannot be read: \"0.5 m\" is not a time (expected a unit such as s)\n"
      "case.toml:4:7: run.cfl is -1 (allowed: above 0, at most 2)\n"
      "case.toml:7:42: body.shape.box.max[1] is -6 m (allowed: above min, which is 0 m)\n"
      "case.toml:7:68: body.shape.particles is a list of 2 (allowed: a list of 3)\n"
      "case.toml:8:12: body.material needs \"density\" (mass density in the reference configuration, in kg/m^3, above "
      "0) - add density = \"... kg/m^3\"\n"
      "case.toml:8:35: \"densty\" is not a key of body.material (allowed: law, name, library, density, youngs_modulus, "
      "poissons_ratio) - did you mean \"density\"?\n"
      "case.toml:8:67: body.material.youngs_modulus cannot be read: \"17 m\" is not a pressure or modulus (expected a "
      "unit such as Pa)\n"
      "case.toml:8:92: body.material.poissons_ratio is 0.5 (allowed: between -1 and 0.5, ends excluded)\n"
      "case.toml:9:47: body.formulation.variables is \"pf\" (allowed: pF, pFJ, pFHJ, displacement) - did you mean "
      "\"pF\"?\n"
      "case.toml:10:22: body.initial_velocity[0], formula \"w*Z\": \"w\" is not known (known: X, Y, Z, t, pi, NX, NY, "
      "NZ, depth, sin, cos, tan, asin, acos, atan, atan2, exp, log, sqrt, abs, pow, min, max) - use one of these or "
      "add it to define or constants\n"
      "case.toml:10:39: body.initial_velocity[2], formula \"sin(X\": a closing bracket is missing\n"
      "case.toml:12:8: support.body is \"colunm\" (allowed: column) - did you mean \"column\"?\n"
      "case.toml:14:7: support.fix is \"xyw\" (allowed: one or more of the letters xyz)");
}

TEST(CaseMessages, UnknownLawsAndFormulationsListWhatThereIs) {
  EXPECT_TRUE(mentions(message_of(sample_with("neo_hookean", "neo_hooke")),
                       {"case.toml:10:20: body.material.law", "neo_hooke", "linear_elastic", "steinberg_guinan",
                        "did you mean \"neo_hookean\""}));
  EXPECT_TRUE(mentions(message_of(sample_with("jst_sph", "mpm")), {"case.toml:11:24: body.formulation.name", "mpm",
                                                                   "jst_sph, taylor_sph, adaptle, nodal", "choose"}));
}

TEST(CaseMessages, SettingsOfEarlierVersionsSayWhatToDoInstead) {
  EXPECT_TRUE(mentions_each(
      message_of(sample_with("variables = \"pF\"", "scheme = \"robust\", local_bulk = 2")),
      {{"case.toml:11:44: body.formulation.scheme", "robust", "removed", "scheme = \"filtered\"", "nodal"},
       {"case.toml:11:67: body.formulation.local_bulk", "removed", "leave it out"}}));
}

TEST(CaseMessages, RegionsThatSelectNothingSayWhereTheBodyIs) {
  EXPECT_TRUE(mentions(message_of(sample_with("Y <= 0", "Y < 0")),
                       {"case.toml:16:9: support.where", "Y < 0", "no particle", "column",
                        "(-0.5, 0, -0.5) m to (0.5, 6, 0.5) m", "condition"}));
  EXPECT_EQ(message_of(sample_with("[0.5, 6, 0.5]", "[0.5, 7, 0.5]")),
            "case.toml:21:6: probe.at of \"tip\" is (0.5, 7, 0.5) m, outside body \"column\" (its particles reach from "
            "(-0.5, 0, -0.5) m to (0.5, 6, 0.5) m) - move the point");
}

TEST(CaseMessages, FormulasMustBeFiniteAtEveryParticle) {
  EXPECT_TRUE(
      mentions(message_of(sample_with("\"w*Z\"", "\"1/Y\"")),
               {"case.toml:13:20: body.initial_velocity[0]", "1/Y", "inf", "(-0.5, 0, -0.5) m", "column", "finite"}));
  EXPECT_TRUE(mentions(message_of(sample_with("initial_velocity",
                                              "initial_deformation_gradient = [[1, 0, 0], [0, \"1 - Y\", 0], [0, 0, "
                                              "1]]\ninitial_velocity")),
                       {"case.toml:13:32: body.initial_deformation_gradient", "determinant 0", "(-0.5, 1, -0.5) m",
                        "column", "above 0", "inside out"}));
}

TEST(CaseMessages, FormulasCannotAssignOrUseThemselves) {
  EXPECT_TRUE(mentions(message_of(sample_with("Y <= 0", "Y = 0")),
                       {"case.toml:16:12: support.where", "Y = 0", "\"=\" assigns", "write =="}));
  EXPECT_EQ(message_of(sample_with("pi*Y/(2*L)", "w")),
            "case.toml:12:16: body.define.w uses itself, directly or through others - write it without \"w\"");
  EXPECT_TRUE(mentions(message_of(sample_with("L = 6", "L = 6\nsin = 3")),
                       {"case.toml:5:1:", "sin", "has a meaning", "letters, digits and _", "another name"}));
}

TEST(CaseMessages, WrongTypesSayWhatIsThereAndWhatIsAllowed) {
  EXPECT_TRUE(mentions(message_of(sample_with("end = \"0.5 s\"", "end = true")),
                       {"case.toml:6:7: run.end", "true", "number in s", "2 s"}));
  EXPECT_EQ(message_of(sample_with("end = \"0.5 s\"", "end = nan")),
            "case.toml:6:7: run.end is not a number (allowed: a finite number)");
  EXPECT_TRUE(mentions(message_of(sample_with("[5, 25, 5]", "[5, 25.5, 5]")),
                       {"case.toml:9:93: body.shape.particles[1]", "25.5", "whole number from 1 to 2147483647"}));
  EXPECT_EQ(message_of(sample_with("title = \"Twisting column\"", "title = 3")),
            "case.toml:1:9: title is 3 (allowed: a text in quotes)");
  EXPECT_TRUE(mentions(message_of(sample_with("\"w*Z\"", "\"5 MPa\"")),
                       {"case.toml:13:21: body.initial_velocity[0]", "5 MPa", "not a velocity", "m/s"}));
}

TEST(CaseMessages, ShapesNeedOneKindAndOneFineness) {
  EXPECT_EQ(
      message_of(sample_with(", particles = [5, 25, 5]", "")),
      "case.toml:9:9: body.shape needs \"particles\" or \"spacing\" (how fine the body is) - add particles = [...]");
  EXPECT_TRUE(mentions(message_of(sample_with("particles = [5, 25, 5]", "particles = [5, 25, 5], spacing = 1")),
                       {"case.toml:9:111: body.shape", "particles", "spacing", "one of them", "remove one"}));
  EXPECT_TRUE(mentions(message_of(sample_with("box = {", "sphere = { centre = [0, 0, 0], radius = 1 }, box = {")),
                       {"case.toml:9:9: body.shape", "2 of box, sphere, cylinder", "one", "keep one"}));
}

TEST(CaseMessages, AnEmptyBodyIsReported) {
  std::string const shape =
      R"(box = { min = ["-0.5 m", 0, "-50 cm"], max = [0.5, "6 m", 0.5] }, particles = [5, 25, 5])";
  std::string const text = sample_with(shape, "sphere = { centre = [0, 0, 0], radius = 0.8 }, spacing = 1");
  EXPECT_EQ(message_of(text),
            "case.toml:9:9: body \"column\" has no particles - make the spacing smaller or the body larger");
}

TEST(CaseMessages, ProbesAndQuantitiesMustFitTogether) {
  EXPECT_TRUE(mentions(
      message_of(sample_with("\"pressure\"]", "\"presure\"]")),
      {"case.toml:22:33: probe.quantities[1]", "presure", "pressure, damage", "more", "did you mean \"pressure\""}));
  EXPECT_EQ(
      message_of(sample_case() + "[[quantity]]\nname = \"q\"\ncolumn = \"tip.presure\"\n"),
      "case.toml:25:10: quantity.column is \"tip.presure\" (allowed: tip.pressure, time, total_energy, pressure_min, "
      "pressure_max, step, strain_energy, dt and 23 more) - did you mean \"tip.pressure\"?");
  EXPECT_TRUE(
      mentions_each(message_of(sample_case() +
                               "[[quantity]]\nname = \"q\"\ncolumn = \"tip.pressure\"\nunit = \"m\"\nthreshold = 3\n"),
                    {{"case.toml:26:8: quantity.unit", "\"m\"", "unit of a pressure", "Pa"},
                     {"case.toml:27:13: quantity.threshold", "not used", "take", "remove"}}));
  EXPECT_TRUE(
      mentions_each(message_of(sample_case() + "[[probe]]\nname = \"tip\"\nbody = \"column\"\nkind = \"maximum\"\n"),
                    {{"case.toml:23:1: probe", "quantities", "velocity_x or pressure", "add quantities"},
                     {"case.toml:24:8:", "tip", "taken by another probe", "another name"}}));
}

TEST(CaseMessages, ErrorsNeedAFieldAndAFormulaPerComponent) {
  std::string const probe = sample_case() + "[[probe]]\nname = \"e\"\nbody = \"column\"\n";
  EXPECT_TRUE(mentions_each(message_of(probe + "kind = \"error\"\n"),
                            {{"case.toml:23:1: probe", "field", "add field = \"CauchyStress\""},
                             {"case.toml:23:1: probe", "reference", "formula per component", "add reference"}}));
  EXPECT_TRUE(mentions(message_of(probe + "kind = \"error\"\nfield = \"CauchyStress\"\nreference = [0, 0]\n"),
                       {"case.toml:28:13: probe.reference", "list of 2", "list of 6"}));
  EXPECT_TRUE(mentions(
      message_of(probe + "kind = \"error\"\nfield = \"Presure\"\nreference = [0]\n"),
      {"case.toml:27:9: probe.field", "Presure", "Pressure, CellPressure", "more", "did you mean \"Pressure\""}));
  EXPECT_TRUE(
      mentions(message_of(probe + "kind = \"error\"\nfield = \"Pressure\"\nreference = [\"1/t\"]\nwhere = \"Y > 5\"\n"),
               {"case.toml:28:13: probe.reference[0]", "1/t", "inf", "(-0.5, 5.25, -0.5) m", "column", "finite"}));
  EXPECT_TRUE(mentions(message_of(probe + "kind = \"extent\"\nfield = \"Pressure\"\n"),
                       {"case.toml:27:9: probe.field", "only by the kind \"error\"", "remove"}));
}

TEST(CaseMessages, BodiesMustFitTogether) {
  std::string const second = R"toml([[body]]
name = "column"
shape = { box = { min = [0, 0], max = [1, 1] }, particles = [5, 5] }
material = { law = "linear_elastic", density = 1, youngs_modulus = 1, poissons_ratio = 0 }
formulation = { name = "jst_sph" }
)toml";
  EXPECT_TRUE(mentions(message_of(sample_case() + second),
                       {"case.toml:24:8:", "column", "taken by another body", "another name"}));
  EXPECT_TRUE(mentions(message_of(sample_case() + test::replaced(second, "\"column\"", "\"plate\"")),
                       {"case.toml:25:9:", "plate", "2D", "column", "3D", "one dimension for all", "components"}));
}

TEST(CaseMessages, SettingsOfTheCommandLineAreNamed) {
  EXPECT_EQ(
      message_of(sample_case(), {"run.ens=1"}),
      "--set run.ens=1: \"ens\" is not a key of run (allowed: end, cfl, damping, relax, relax_method, relax_tolerance, "
      "max_step, min_step, threads, instruction_set, repartition, guards) - did you mean \"end\"?");
  EXPECT_TRUE(mentions(message_of(sample_case(), {"body.colum.name=a"}),
                       {"--set body.colum.name=a:", "colum", "known: column", "did you mean \"column\""}));
  EXPECT_EQ(
      message_of(sample_case(), {"body.1.name=a", "run.end=[1"}),
      "--set body.1.name=a: \"body\" has 1 item (they count from 0) - use a smaller number than 1\n"
      "--set run.end=[1: the value \"[1\" is not TOML (allowed: a number, a text, [..], {..}, true, false) - mind the "
      "quotes of the shell");
  EXPECT_TRUE(mentions(
      message_of(sample_case(), {"body.column.material.poissons_ratio=0.6"}),
      {"--set body.column.material.poissons_ratio=0.6:", "body.material.poissons_ratio", "0.6", "between -1 and 0.5"}));
}

TEST(CaseMessages, ConjugateGradientsNeedOnePotentialEnergy) {
  std::string const all = message_of(
      sample_case() +
          "[[support]]\nbody = \"column\"\nwhere = \"Y > 1\"\nfix = \"y\"\nvelocity = [\"0\", \"1\", \"0\"]\n" +
          "[[rigid]]\nname = \"floor\"\nplane = { point = [0, -9, 0], normal = [0, 1, 0] }\n",
      {"run.relax=true", "run.relax_method=conjugate_gradients"});
  expect_words(all, {"one body without contact, ties and rigid", "does not have (allowed: nodal)",
                     "support.velocity drives the body"});
  EXPECT_TRUE(mentions(message_of(sample_case(), {"run.relax_method=conjugate_gradients"}),
                       {"run.relax_method", "only with relax = true"}));
  expect_words(message_of(sample_case(), {"run.relax=true", "run.relax_method=conjugate_gradients", "run.damping=5"}),
               {"run.damping", "has no effect"});
}

TEST(CaseMessages, TheLookOfPicturesHasNamesAndBounds) {
  std::string const reported = message_of(sample_case() + R"([output.pictures]
every = 1
view = "top"
azimuth = 3
zoom = 0
follow = "colunm"
map = "jet"
)");
  expect_words(reported,
               {"output.pictures.view", "\"top\"", "x, y, z, -x, -y, -z, iso, iso2", "output.pictures.azimuth",
                "name of the view", "output.pictures.zoom is 0", "output.pictures.follow", "\"colunm\"",
                "did you mean \"column\"?", "output.pictures.map", "\"jet\"", "auto, viridis"});
}

}  // namespace
}  // namespace piola
