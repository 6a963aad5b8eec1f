// SPDX-License-Identifier: Apache-2.0
// Messages about an invalid case file, word for word.
#include "support/sample_case.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

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
      "case.toml:1:1: \"titel\" is not a key of a case (allowed: title, constants, run, region, body, support, load, "
      "mirror, crack, rigid, contact, tie, probe, quantity, output) - did you mean \"title\"?\n"
      "case.toml:3:7: run.end cannot be read: \"0.5 m\" is not a time (expected a unit such as s)\n"
      "case.toml:4:7: run.cfl is -1 (allowed: above 0, at most 2)\n"
      "case.toml:7:42: body.shape.box.max[1] is -6 m (allowed: above min, which is 0 m)\n"
      "case.toml:7:68: body.shape.particles is a list of 2 (allowed: a list of 3)\n"
      "case.toml:8:12: body.material needs \"density\" (mass density in the reference configuration, in kg/m^3, above "
      "0) - add density = \"... kg/m^3\"\n"
      "case.toml:8:35: \"densty\" is not a key of body.material (allowed: law, name, density, youngs_modulus, "
      "poissons_ratio) - did you mean \"density\"?\n"
      "case.toml:8:67: body.material.youngs_modulus cannot be read: \"17 m\" is not a pressure or modulus (expected a "
      "unit such as Pa)\n"
      "case.toml:8:92: body.material.poissons_ratio is 0.5 (allowed: between -1 and 0.5, ends excluded)\n"
      "case.toml:9:47: body.formulation.variables is \"pf\" (allowed: pF, pFJ, pFHJ, displacement) - did you mean "
      "\"pF\"?\n"
      "case.toml:10:22: body.initial_velocity[0], formula \"w*Z\": \"w\" is not known (known: X, Y, Z, t, pi, NX, "
      "NY, NZ, depth, sin, cos, "
      "tan, asin, acos, atan, atan2, exp, log, sqrt, abs, pow, min, max) - use one of these or add it to define or "
      "constants\n"
      "case.toml:10:39: body.initial_velocity[2], formula \"sin(X\": a closing bracket is missing\n"
      "case.toml:12:8: support.body is \"colunm\" (allowed: column) - did you mean \"column\"?\n"
      "case.toml:14:7: support.fix is \"xyw\" (allowed: one or more of the letters xyz)");
}

TEST(CaseMessages, UnknownLawsAndFormulationsListWhatThereIs) {
  EXPECT_EQ(message_of(sample_with("neo_hookean", "neo_hooke")),
            "case.toml:10:20: body.material.law is \"neo_hooke\" (allowed: linear_elastic, neo_hookean, mooney_rivlin, "
            "saint_venant_kirchhoff, compressible_neo_hookean, elastic, perfectly_plastic, isotropic_hardening, "
            "johnson_cook, zerilli_armstrong, johnson_holmquist, steinberg_guinan) - did you mean \"neo_hookean\"?");
  EXPECT_EQ(message_of(sample_with("jst_sph", "mpm")),
            "case.toml:11:24: body.formulation.name is \"mpm\" (allowed: jst_sph, taylor_sph, adaptle, nodal) "
            "- choose "
            "one of these");
}

TEST(CaseMessages, SettingsOfEarlierVersionsSayWhatToDoInstead) {
  EXPECT_EQ(message_of(sample_with("variables = \"pF\"", "scheme = \"robust\", local_bulk = 2")),
            "case.toml:11:44: body.formulation.scheme = \"robust\" was removed - take scheme = \"filtered\", or the "
            "formulation nodal\n"
            "case.toml:11:67: body.formulation.local_bulk was removed - leave it out, the scheme sets it");
}

TEST(CaseMessages, RegionsThatSelectNothingSayWhereTheBodyIs) {
  EXPECT_EQ(message_of(sample_with("Y <= 0", "Y < 0")),
            "case.toml:16:9: support.where, formula \"Y < 0\" selects no particle of body \"column\" (its particles "
            "reach from "
            "(-0.5, 0, -0.5) m to (0.5, 6, 0.5) m) - change the condition");
  EXPECT_EQ(message_of(sample_with("[0.5, 6, 0.5]", "[0.5, 7, 0.5]")),
            "case.toml:21:6: probe.at of \"tip\" is (0.5, 7, 0.5) m, outside body \"column\" (its particles reach from "
            "(-0.5, 0, -0.5) m to (0.5, 6, 0.5) m) - move the point");
}

TEST(CaseMessages, FormulasMustBeFiniteAtEveryParticle) {
  EXPECT_EQ(
      message_of(sample_with("\"w*Z\"", "\"1/Y\"")),
      "case.toml:13:20: body.initial_velocity[0], formula \"1/Y\" is inf at X = (-0.5, 0, -0.5) m of body \"column\" "
      "(allowed: a finite number at every particle)");
  EXPECT_EQ(message_of(sample_with("initial_velocity",
                                   "initial_deformation_gradient = [[1, 0, 0], [0, \"1 - Y\", 0], [0, 0, "
                                   "1]]\ninitial_velocity")),
            "case.toml:13:32: body.initial_deformation_gradient has the determinant 0 at X = (-0.5, 1, -0.5) m of body "
            "\"column\" (allowed: above 0) - a body cannot be turned inside out");
}

TEST(CaseMessages, FormulasCannotAssignOrUseThemselves) {
  EXPECT_EQ(message_of(sample_with("Y <= 0", "Y = 0")),
            "case.toml:16:12: support.where, formula \"Y = 0\": \"=\" assigns, which a formula cannot do - write == to "
            "compare");
  EXPECT_EQ(message_of(sample_with("pi*Y/(2*L)", "w")),
            "case.toml:12:16: body.define.w uses itself, directly or through others - write it without \"w\"");
  EXPECT_EQ(message_of(sample_with("L = 6", "L = 6\nsin = 3")),
            "case.toml:5:1: \"sin\" already has a meaning in formulas (allowed: letters, digits and _) - choose "
            "another name");
}

TEST(CaseMessages, WrongTypesSayWhatIsThereAndWhatIsAllowed) {
  EXPECT_EQ(message_of(sample_with("end = \"0.5 s\"", "end = true")),
            "case.toml:6:7: run.end is true (allowed: a number in s or a text such as \"2 s\")");
  EXPECT_EQ(message_of(sample_with("end = \"0.5 s\"", "end = nan")),
            "case.toml:6:7: run.end is not a number (allowed: a finite number)");
  EXPECT_EQ(message_of(sample_with("[5, 25, 5]", "[5, 25.5, 5]")),
            "case.toml:9:93: body.shape.particles[1] is 25.5 (allowed: a whole number from 1 to 2147483647)");
  EXPECT_EQ(message_of(sample_with("title = \"Twisting column\"", "title = 3")),
            "case.toml:1:9: title is 3 (allowed: a text in quotes)");
  EXPECT_EQ(
      message_of(sample_with("\"w*Z\"", "\"5 MPa\"")),
      "case.toml:13:21: body.initial_velocity[0] cannot be read: \"5 MPa\" is not a velocity (expected a unit such as "
      "m/s)");
}

TEST(CaseMessages, ShapesNeedOneKindAndOneFineness) {
  EXPECT_EQ(
      message_of(sample_with(", particles = [5, 25, 5]", "")),
      "case.toml:9:9: body.shape needs \"particles\" or \"spacing\" (how fine the body is) - add particles = [...]");
  EXPECT_EQ(message_of(sample_with("particles = [5, 25, 5]", "particles = [5, 25, 5], spacing = 1")),
            "case.toml:9:111: body.shape has both \"particles\" and \"spacing\" (allowed: one of them) - remove one");
  EXPECT_EQ(message_of(sample_with("box = {", "sphere = { centre = [0, 0, 0], radius = 1 }, box = {")),
            "case.toml:9:9: body.shape has 2 of box, sphere, cylinder or another shape (allowed: one) - keep one");
}

TEST(CaseMessages, AnEmptyBodyIsReported) {
  std::string const shape =
      R"(box = { min = ["-0.5 m", 0, "-50 cm"], max = [0.5, "6 m", 0.5] }, particles = [5, 25, 5])";
  std::string const text = sample_with(shape, "sphere = { centre = [0, 0, 0], radius = 0.8 }, spacing = 1");
  EXPECT_EQ(message_of(text),
            "case.toml:9:9: body \"column\" has no particles - make the spacing smaller or the body larger");
}

TEST(CaseMessages, ProbesAndQuantitiesMustFitTogether) {
  EXPECT_EQ(message_of(sample_with("\"pressure\"]", "\"presure\"]")),
            "case.toml:22:33: probe.quantities[1] is \"presure\" (allowed: pressure, damage, temperature, "
            "density, cell_pressure, slip, momentum_x, momentum_y and 56 more) - did you mean \"pressure\"?");
  EXPECT_EQ(
      message_of(sample_case() + "[[quantity]]\nname = \"q\"\ncolumn = \"tip.presure\"\n"),
      "case.toml:25:10: quantity.column is \"tip.presure\" (allowed: tip.pressure, time, total_energy, pressure_min, "
      "pressure_max, step, strain_energy, dt and 23 more) - did you mean \"tip.pressure\"?");
  EXPECT_EQ(message_of(sample_case() +
                       "[[quantity]]\nname = \"q\"\ncolumn = \"tip.pressure\"\nunit = \"m\"\nthreshold = 3\n"),
            "case.toml:26:8: quantity.unit is \"m\" (allowed: a unit of a pressure or modulus such as Pa)\n"
            "case.toml:27:13: quantity.threshold is not used by this \"take\" - remove it");
  EXPECT_EQ(
      message_of(sample_case() + "[[probe]]\nname = \"tip\"\nbody = \"column\"\nkind = \"maximum\"\n"),
      "case.toml:23:1: probe needs \"quantities\" (what to record, for example velocity_x or pressure) - add "
      "quantities = [\"pressure\"]\n"
      "case.toml:24:8: the name \"tip\" is taken by another probe (allowed: one probe per name) - choose another name");
}

TEST(CaseMessages, ErrorsNeedAFieldAndAFormulaPerComponent) {
  std::string const probe = sample_case() + "[[probe]]\nname = \"e\"\nbody = \"column\"\n";
  EXPECT_EQ(message_of(probe + "kind = \"error\"\n"),
            "case.toml:23:1: probe needs \"field\" (the field to compare) - add field = \"CauchyStress\"\n"
            "case.toml:23:1: probe needs \"reference\" (one formula per component of the field) - add reference = "
            "[\"0\", ...]");
  EXPECT_EQ(message_of(probe + "kind = \"error\"\nfield = \"CauchyStress\"\nreference = [0, 0]\n"),
            "case.toml:28:13: probe.reference is a list of 2 (allowed: a list of 6)");
  EXPECT_EQ(
      message_of(probe + "kind = \"error\"\nfield = \"Presure\"\nreference = [0]\n"),
      "case.toml:27:9: probe.field is \"Presure\" (allowed: Pressure, CellPressure, Density, Damage, Temperature, "
      "Slip, Momentum, KernelType and 19 more) - did you mean \"Pressure\"?");
  EXPECT_EQ(
      message_of(probe + "kind = \"error\"\nfield = \"Pressure\"\nreference = [\"1/t\"]\nwhere = \"Y > 5\"\n"),
      "case.toml:28:13: probe.reference[0], formula \"1/t\" is inf at X = (-0.5, 5.25, -0.5) m of body \"column\" "
      "(allowed: a finite number at every particle)");
  EXPECT_EQ(message_of(probe + "kind = \"extent\"\nfield = \"Pressure\"\n"),
            "case.toml:27:9: probe.field is used only by the kind \"error\" - remove it");
}

TEST(CaseMessages, BodiesMustFitTogether) {
  std::string const second = R"toml([[body]]
name = "column"
shape = { box = { min = [0, 0], max = [1, 1] }, particles = [5, 5] }
material = { law = "linear_elastic", density = 1, youngs_modulus = 1, poissons_ratio = 0 }
formulation = { name = "jst_sph" }
)toml";
  EXPECT_EQ(message_of(sample_case() + second),
            "case.toml:24:8: the name \"column\" is taken by another body (allowed: one body per name) - choose "
            "another name");
  EXPECT_EQ(
      message_of(sample_case() + test::replaced(second, "\"column\"", "\"plate\"")),
      "case.toml:25:9: body \"plate\" is in 2D, body \"column\" in 3D (allowed: one dimension for all) - give all "
      "shapes as many components");
}

TEST(CaseMessages, SettingsOfTheCommandLineAreNamed) {
  EXPECT_EQ(
      message_of(sample_case(), {"run.ens=1"}),
      "--set run.ens=1: \"ens\" is not a key of run (allowed: end, cfl, damping, relax, relax_tolerance, max_step, "
      "min_step, threads, instruction_set, repartition, guards) - did you mean \"end\"?");
  EXPECT_EQ(message_of(sample_case(), {"body.colum.name=a"}),
            "--set body.colum.name=a: no body has the name \"colum\" (known: column) - did you mean \"column\"?");
  EXPECT_EQ(
      message_of(sample_case(), {"body.1.name=a", "run.end=[1"}),
      "--set body.1.name=a: \"body\" has 1 item (they count from 0) - use a smaller number than 1\n"
      "--set run.end=[1: the value \"[1\" is not TOML (allowed: a number, a text, [..], {..}, true, false) - mind the "
      "quotes of the shell");
  EXPECT_EQ(message_of(sample_case(), {"body.column.material.poissons_ratio=0.6"}),
            "--set body.column.material.poissons_ratio=0.6: body.material.poissons_ratio is 0.6 (allowed: between -1 "
            "and 0.5, "
            "ends excluded)");
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
  for (char const* const part :
       {"output.pictures.view is \"top\" (allowed: x, y, z, -x, -y, -z, iso, iso2)",
        "output.pictures.azimuth is given by the name of the view - remove it", "output.pictures.zoom is 0",
        "output.pictures.follow is \"colunm\" (allowed: column) - did you mean \"column\"?",
        "output.pictures.map is \"jet\" (allowed: auto, viridis, cividis, magma, grey, blue_red, blue_brown, "
        "heat_on_grey)"})
    EXPECT_NE(reported.find(part), std::string::npos) << part << "\n" << reported;
}

}  // namespace
}  // namespace piola
