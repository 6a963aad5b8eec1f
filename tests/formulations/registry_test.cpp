// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/registry.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/units.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/materials/registry.hpp"
#include <gtest/gtest.h>
#include <set>

namespace piola {
namespace {

TEST(Formulations, AreFoundByTheirNames) {
  ASSERT_FALSE(formulations().empty());
  for (auto const& info : formulations()) {
    ASSERT_TRUE(find_formulation(info.name).has_value());
    EXPECT_EQ(find_formulation(info.name)->about, info.about);
    EXPECT_FALSE(info.about.empty());
  }
  EXPECT_FALSE(find_formulation("alchemy").has_value());
}

TEST(Formulations, DeclareKeysThatCanBeReadAndChecked) {
  for (auto const& info : formulations()) {
    std::set<std::string_view> keys;
    for (Parameter const& p : info.parameters) {
      EXPECT_TRUE(keys.insert(p.name).second) << p.name << " is declared twice";
      EXPECT_TRUE(same_dimension(p.unit, p.unit)) << p.name;
      EXPECT_FALSE(p.meaning.empty()) << p.name;
      if (!p.required()) {
        EXPECT_TRUE(p.allowed.contains(p.default_value) || p.default_value == unbounded) << p.name;
      }
    }
    for (FormulaInfo const& f : info.formulas) {
      EXPECT_TRUE(keys.insert(f.name).second) << f.name << " is declared twice";
      EXPECT_FALSE(f.meaning.empty()) << f.name;
      for (auto const variable : f.variables) EXPECT_FALSE(is_reserved_name(variable)) << variable;
    }
    for (Choice const& c : info.choices) {
      EXPECT_TRUE(keys.insert(c.name).second) << c.name << " is declared twice";
      EXPECT_FALSE(c.allowed.empty()) << c.name;
      EXPECT_EQ(std::set<std::string_view>(c.allowed.begin(), c.allowed.end()).size(), c.allowed.size()) << c.name;
    }
  }
}

TEST(Formulations, NameOnlyLawsThatExist) {
  for (auto const& info : formulations()) {
    EXPECT_FALSE(info.laws.empty());
    for (auto const law : info.laws) EXPECT_TRUE(find_law(law).has_value()) << law;
  }
}

// A formulation that ignored a crack would run a body that is whole there.
TEST(Formulations, RefuseWhatTheyDoNotKnow) {
  for (auto const& info : formulations()) {
    Assembly assembly;
    assembly.formulations.push_back({std::string(info.name), {}, {}});
    assembly.particles.cracks.resize(1);
    assembly.mirrors.resize(1);
    assembly.particles.bodies.resize(1);
    assembly.particles.bodies[0].off_lattice = true;
    assembly.rigid_shapes.resize(1);
    std::string message;
    if (info.cracks && info.mirrors && info.off_lattice && info.contact) continue;
    try {
      make_formulation(assembly);
    } catch (InputError const& error) {
      message = error.what();
    }
    EXPECT_EQ(message.find(refusal(info, "cracks")) != std::string::npos, !info.cracks) << message;
    EXPECT_EQ(message.find(refusal(info, "mirrors")) != std::string::npos, !info.mirrors) << message;
    EXPECT_EQ(message.find(refusal(info, "rings")) != std::string::npos, !info.off_lattice) << message;
    EXPECT_EQ(message.find(refusal(info, "rigid shapes")) != std::string::npos, !info.contact) << message;
  }
  EXPECT_FALSE(find_formulation("jst_sph")->cracks);
  EXPECT_TRUE(find_formulation("jst_sph")->mirrors);
  EXPECT_TRUE(find_formulation("jst_sph")->off_lattice);
  EXPECT_FALSE(find_formulation("taylor_sph")->off_lattice);
  EXPECT_FALSE(find_formulation("jst_sph")->contact);
}

TEST(Formulations, SayWhatToRemove) {
  FormulationInfo const info = *find_formulation("jst_sph");
  auto const ending = [&](std::string_view what) {
    std::string const text = refusal(info, what);
    return text.substr(text.find(") - "));
  };
  EXPECT_EQ(ending("contact"), ") - remove the contact or change body.formulation");
  EXPECT_EQ(ending("rigid shapes"), ") - remove the rigid shape or change body.formulation");
  EXPECT_EQ(ending("cracks"), ") - remove the crack or change body.formulation");
  EXPECT_EQ(refusal(info, "contact").find("the formulation \"jst_sph\" knows no contact (allowed: "), 0U);
}

}  // namespace
}  // namespace piola
