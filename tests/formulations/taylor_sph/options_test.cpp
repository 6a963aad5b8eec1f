// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/options.hpp"
#include "piola/base/errors.hpp"
#include "formulations/taylor_sph/taylor_bodies.hpp"
#include "support/key_words.hpp"

namespace piola::taylor_sph {
namespace {

using test::mentions;

using Words = std::map<std::string, std::string, std::less<>>;
using Numbers = std::map<std::string, double, std::less<>>;

/// Of estimates, unless the words say otherwise.
Options options(int dimension, Words words = {}, Numbers numbers = {}, double cfl = std::nan(""),
                bool whole_lattice = true) {
  words.emplace("exchange", "kernel_sums");
  return read_options({"taylor_sph", std::move(numbers), std::move(words)}, dimension, cfl, whole_lattice);
}

std::string message(int dimension, Words words, double cfl = std::nan("")) {
  try {
    (void)options(dimension, std::move(words), {}, cfl);
  } catch (InputError const& error) {
    return error.what();
  }
  return "";
}

TEST(TaylorOptions, AreAMovingBodyOfSimplicesWithTheAdjointExchangeByDefault) {
  for (int D = 1; D <= 3; ++D) {
    Options const o = read_options({"taylor_sph", {}, {}}, D, std::nan(""), true);
    EXPECT_TRUE(o.moving);
    EXPECT_TRUE(o.adjoint);
    EXPECT_FALSE(o.lattice_cells);
    EXPECT_FALSE(o.conserve) << "momenta are kept anyway";
    EXPECT_EQ(o.memory, 0.2);
    EXPECT_EQ(o.hourglass, 0);
    EXPECT_EQ(o.cfl, 0.9);
    Options const fixed = read_options({"taylor_sph", {}, {{"configuration", "fixed"}}}, D, std::nan(""), true);
    EXPECT_FALSE(fixed.adjoint) << "exact waves at Courant number 1 need the estimates";
  }
  Options const boxes = read_options(
      {"taylor_sph", {{"stress_retention", 0.5}}, {{"virtual_particles", "lattice_cells"}}}, 2, std::nan(""), true);
  EXPECT_EQ(boxes.hourglass_stiffness, 0.05);
  EXPECT_EQ(boxes.memory, 0.5);
}

TEST(TaylorOptions, OfEstimatesAreAMovingBodyOfLatticeBoxesByDefault) {
  for (int D = 1; D <= 3; ++D) {
    Options const o = options(D);
    EXPECT_TRUE(o.moving);
    EXPECT_EQ(o.form, GradientForm::linear_exact);
    EXPECT_EQ(o.kernel, find_kernel("cubic_spline"));
    EXPECT_EQ(o.lattice_cells, D > 1);
    EXPECT_EQ(o.stress_free, D == 1) << "a bar is free across, a plate held";
    EXPECT_EQ(o.smoothing_length, D == 1 ? 0.6 : 0.9);
    EXPECT_EQ(o.hourglass, D == 1 ? 0 : 0.3);
    EXPECT_TRUE(o.conserve);
    EXPECT_EQ(o.cfl, 0.9);
  }
}

TEST(TaylorOptions, TakeSimplicesWhereTheLatticeIsNotWholeOrDoesNotMove) {
  for (int D = 2; D <= 3; ++D) {
    Options const part = options(D, {}, {}, std::nan(""), false), fixed = options(D, {{"configuration", "fixed"}});
    EXPECT_FALSE(part.lattice_cells);
    EXPECT_EQ(part.smoothing_length, D == 2 ? 1.1 : 0.9);
    EXPECT_FALSE(fixed.lattice_cells);
    EXPECT_EQ(fixed.smoothing_length, 0.9);
    EXPECT_FALSE(options(D, {{"virtual_particles", "delaunay"}}).lattice_cells);
  }
}

TEST(TaylorOptions, OfAFixedBodyTakeTheLargestStepThatIsExact) {
  EXPECT_EQ(options(1, {{"configuration", "fixed"}}).cfl, 1);
  EXPECT_EQ(options(2, {{"configuration", "fixed"}, {"virtual_particles", "lattice_cells"}}).cfl, 1);
  EXPECT_EQ(options(2, {{"configuration", "fixed"}}).cfl, 0.9) << "triangles";
  for (int D = 1; D <= 3; ++D) {
    Options const o = options(D, {{"configuration", "fixed"}});
    EXPECT_FALSE(o.moving);
    EXPECT_EQ(o.smoothing_length, D == 1 ? 0.6 : 0.9);
    EXPECT_EQ(o.hourglass, 0);
  }
}

TEST(TaylorOptions, FollowTheWordsThatAreGiven) {
  EXPECT_EQ(options(2, {{"gradient", "published"}}).form, GradientForm::as_published);
  EXPECT_EQ(options(2, {{"gradient", "linear_exact"}}).form, GradientForm::linear_exact);
  EXPECT_EQ(options(2, {{"kernel", "wendland_c2"}}).kernel, find_kernel("wendland_c2"));
  EXPECT_EQ(options(2, {{"kernel", "cubic_spline"}}).kernel, find_kernel("cubic_spline"));
  EXPECT_TRUE(options(2, {{"configuration", "updated"}}).moving);
  EXPECT_FALSE(options(2, {{"momentum_projection", "off"}}).conserve);
  Options const boxes = options(3, {{"virtual_particles", "lattice_cells"}, {"configuration", "fixed"}});
  EXPECT_TRUE(boxes.lattice_cells);
  EXPECT_EQ(boxes.smoothing_length, 0.6);
  EXPECT_FALSE(options(1, {{"virtual_particles", "lattice_cells"}}).lattice_cells) << "the same thing in 1D";
}

TEST(TaylorOptions, KnowWhatHappensInTheDirectionsThatAreMissing) {
  EXPECT_TRUE(options(1, {{"assumption", "as_dimension"}}).stress_free);
  EXPECT_TRUE(options(1, {{"assumption", "uniaxial_stress"}}).stress_free);
  EXPECT_FALSE(options(1, {{"assumption", "uniaxial_strain"}}).stress_free);
  EXPECT_TRUE(options(2, {{"assumption", "plane_stress"}}).stress_free);
  EXPECT_FALSE(options(2, {{"assumption", "plane_strain"}}).stress_free);
  EXPECT_FALSE(options(3, {{"assumption", "as_dimension"}}).stress_free);
}

TEST(TaylorOptions, FollowTheNumbersThatAreGiven) {
  Options const o = options(2, {}, {{"smoothing_length", 1.1}, {"hourglass_filter", 0.2}}, 0.5);
  EXPECT_EQ(o.smoothing_length, 1.1);
  EXPECT_EQ(o.hourglass, 0.2);
  EXPECT_EQ(o.cfl, 0.5);
  EXPECT_EQ(options(2, {{"configuration", "fixed"}}, {{"hourglass_filter", 0.3}}).hourglass, 0.3);
}

TEST(TaylorOptions, RefuseACourantNumberAboveOne) {
  EXPECT_EQ(message(1, {}, 1), "");
  EXPECT_EQ(
      message(1, {}, 1.05),
      "run.cfl = 1.05 is above 1: two-step Taylor amplifies short waves then and blows up within some hundred "
      "steps (allowed: up to 1, where waves along a lattice travel exactly one spacing per step) - set run.cfl to "
      "1 or less");
}

TEST(TaylorOptions, RefuseAnAssumptionForAnotherDimension) {
  EXPECT_TRUE(mentions(message(3, {{"assumption", "plane_stress"}}),
                       {"formulation", "plane_stress", "2D", "3D", "leave it out"}));
  for (auto const* word : {"plane_stress", "plane_strain"})
    for (int D = 1; D <= 3; ++D) EXPECT_EQ(message(D, {{"assumption", word}}).empty(), D == 2) << word << D;
  for (auto const* word : {"uniaxial_stress", "uniaxial_strain"})
    for (int D = 1; D <= 3; ++D) EXPECT_EQ(message(D, {{"assumption", word}}).empty(), D == 1) << word << D;
}

TEST(TaylorOptions, AreRefusedTogether) {
  std::string const text = message(3, {{"assumption", "plane_strain"}}, 2);
  EXPECT_NE(text.find("plane_strain"), std::string::npos) << text;
  EXPECT_NE(text.find("run.cfl = 2"), std::string::npos) << text;
}

TEST(TaylorOptions, AreAllDeclared) {
  FormulationInfo const i = info();
  EXPECT_EQ(i.name, "taylor_sph");
  EXPECT_TRUE(i.cracks);
  EXPECT_FALSE(i.mirrors);
  for (auto const& choice : i.choices)
    for (auto const word : choice.allowed) {
      int const D = word.starts_with("uniaxial") ? 1 : 2;
      EXPECT_EQ(message(D, {{std::string(choice.name), std::string(word)}}), "") << choice.name << " " << word;
    }
  EXPECT_EQ(i.laws.size(), 1u);
  EXPECT_EQ(i.laws.front(), "linear_elastic");
}

TEST(TaylorSolver, RefusesMirrorsAndAnInitialDeformationGradient) {
  using namespace testing;
  Assembly a = assemble_taylor(unit_box(2, 5));
  a.mirrors.push_back({});
  EXPECT_EQ(refusal(a), piola::refusal(info(), "mirrors"));
  a.mirrors.clear();
  a.initial_deformation_gradient.assign(a.particles.X.size(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_TRUE(mentions(refusal(a), {"taylor_sph", "initial deformation gradient", "remove"}));
}

TEST(TaylorSolver, RefusesAMachineThatItDoesNotHaveAndNamesThoseItHas) {
  using namespace testing;
  Assembly a = assemble_taylor(unit_box(2, 5));
  a.backend = "abacus";
  std::string usable = "usable: auto";
  for (auto names = backend_names(); *names != nullptr; ++names) usable += std::string(", ") + *names;
  EXPECT_TRUE(mentions(refusal(a), {"instruction set", "'abacus'", usable + ")"}));
}

}  // namespace
}  // namespace piola::taylor_sph
