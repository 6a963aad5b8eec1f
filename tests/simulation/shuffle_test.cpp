// SPDX-License-Identifier: Apache-2.0
// No result depends on where particles stand in memory: every case takes its first steps with the tiles of its bodies
// dealt out to one to seven owners at random, and has the same bits as in the order of the bodies.
#include "piola/base/errors.hpp"
#include "piola/input/read_case.hpp"
#include "piola/particles/ordering.hpp"
#include "piola/simulation/build.hpp"
#include "exec/thread_count.hpp"
#include "formulations/small_bodies.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>

namespace piola {
namespace {

namespace fs = std::filesystem;

constexpr int first_steps = 20;

/// Whatever a run tells, by name.
using Told = std::map<std::string, std::vector<double>>;

void tell_diagnostics(Diagnostics const& d, Told& told) {
  auto& sums = told["diagnostics"];
  sums = {d.kinetic_energy, d.strain_energy, d.stabilisation_loss,  d.projection_loss,
          d.external_work,  d.damping_loss,  d.jacobian_min,        d.jacobian_max,
          d.pressure_min,   d.pressure_max,  d.pressure_oscillation};
  sums.insert(sums.end(), d.linear_momentum.begin(), d.linear_momentum.end());
  sums.insert(sums.end(), d.angular_momentum.begin(), d.angular_momentum.end());
  for (auto const& [name, value] : d.more) told["column " + name] = {value};
  for (Action const& a : d.actions) {
    auto& action = told["action " + a.name];
    action.insert(action.end(), a.force.begin(), a.force.end());
    action.insert(action.end(), a.moment.begin(), a.moment.end());
  }
}

/// A case as it was read, with its particles, which some cases take long to make.
struct ReadCase {
  explicit ReadCase(fs::path const& file, std::vector<std::string> const& overrides = {})
      : spec(read_case(file, overrides, {}, &particles)) {}
  ParticleSet particles;
  CaseSpec spec;
};

/// Nothing where the shuffle finds no tile that it could move.
Told first_steps_of(ReadCase const& read, Shuffle shuffle) {
  std::int64_t moved = 0;
  shuffle.moved = &moved;
  Shuffle const before = set_shuffle(shuffle);
  Simulation s = build(read.spec, read.particles);
  set_shuffle(before);
  Told told;
  if (shuffle.owners > 0 && moved == 0) return told;
  double time = 0;
  for (int k = 0; k < first_steps && !s.formulation->failure(); ++k) {
    double const dt = s.formulation->stable_time_step();
    s.formulation->step(time, dt);
    told["steps"].push_back(dt);
    time += dt;
  }
  tell_diagnostics(s.formulation->diagnose(), told);
  for (FieldInfo const& field : s.formulation->fields()) {
    auto& values = told["field " + field.name];
    values.resize(s.particles.X.size() * static_cast<std::size_t>(field.components));
    s.formulation->sample(field.name, values);
  }
  for (auto const& [name, values] : testing::saved(*s.formulation).values) told["checkpoint " + name] = values;
  return told;
}

bool same_bits(std::vector<double> const& a, std::vector<double> const& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

std::vector<std::string> differences(Told const& a, Told const& b) {
  std::vector<std::string> names;
  for (auto const& [name, values] : a)
    if (!b.contains(name) || !same_bits(values, b.at(name))) names.push_back(name);
  return names;
}

/// Those with a body of a formulation that takes a dealt order: all of them.
std::vector<std::string> shuffled_cases() {
  std::vector<std::string> cases;
  fs::path const root = fs::path(testing::source_folder()) / "cases";
  for (auto const& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().filename() != "case.toml") continue;
    std::string const text = testing::text_of(entry.path());
    auto const has = [&](char const* name) { return text.find(name) != std::string::npos; };
    if (has("\"jst_sph\"") || has("\"taylor_sph\"") || has("\"nodal\"") || has("\"adaptle\""))
      cases.push_back(entry.path().parent_path().lexically_relative(root));
  }
  std::sort(cases.begin(), cases.end());
  return cases;
}

TEST(ShuffledCases, AreThere) { EXPECT_GE(shuffled_cases().size(), 74U); }

/// Three of the numbers of owners from 1 to 7, on one to three threads; many particles, whose set-up takes long, once.
/// What was told in the order of the bodies; nothing where no tile could be moved. Bodies of nodal that fill lattices
/// take lists in all these runs: their own loops compute where neighbours stand.
Told expect_same_steps(ReadCase const& read, int number) {
  Told reference;
  constexpr std::size_t many = 3000;
  std::vector<int> const dealings = read.particles.X.size() > many ? std::vector{2} : std::vector{0, 2, 4};
  for (int const more : dealings) {
    int const owners = 1 + (number + more) % 7;
    testing::Threads const threads(1 + more / 2);
    Told const told = first_steps_of(read, {owners, static_cast<std::uint64_t>(owners), nullptr, true});
    if (told.empty()) continue;
    if (reference.empty()) reference = first_steps_of(read, {0, 1, nullptr, true});
    EXPECT_FALSE(reference.at("steps").empty());
    auto const names = differences(reference, told);
    EXPECT_TRUE(names.empty()) << owners << " owners: " << ::testing::PrintToString(names);
  }
  return reference;
}

class ShuffledCase : public ::testing::TestWithParam<std::string> {};

/// All numbers of owners over the cases.
TEST_P(ShuffledCase, TakesTheSameStepsWhoeverOwnsTheParticles) {
  ReadCase const read(fs::path(testing::source_folder()) / "cases" / GetParam() / "case.toml");
  if (expect_same_steps(read, static_cast<int>(std::hash<std::string>{}(GetParam()) % 7)).empty())
    GTEST_SKIP() << "its bodies are smaller than two tiles";
}

/// What no first steps of a case show, with bodies of several tiles: what acts between bodies, and what happens to
/// particles of AdapTLE.
struct Acting {
  char const* name;
  char const* folder;
  char const* acts;  ///< a column that is above 0 after the first steps
  std::vector<std::string> overrides;
};
void PrintTo(Acting const& value, std::ostream* to) { *to << value.name; }

constexpr char const* jst = ".formulation={ name = \"jst_sph\" }";

std::vector<Acting> between_bodies() {
  auto const body = [](std::string const& name, std::string const& rest) { return "body." + name + rest; };
  return {{"rubbing",
           "contact/braked_block",
           "column contact_points",
           {body("block", ".shape.spacing=13.3 mm"), body("track", ".shape.spacing=20 mm"),
            body("block", R"(.initial_velocity=["3 m/s", "-9 m/s"])")}},
          {"colliding",
           "contact/colliding_blocks",
           "column contact_points",
           {body("left", jst), body("right", jst), "constants.v=900 m/s"}},
          {"glued", "tie/peel", "column tie_energy", {body("lower", jst), body("upper", jst)}},
          {"bonded", "tie/bonded_stack", "column tie_energy", {}},
          {"stacked", "tie/dropped_stack", "column tie_energy", {}},
          {"bolted", "contact/press_fit", "column contact_points", {}}};
}

/// Particles that convert at a small strain, because the guard wants it, by a formula, or are deleted; patches of both
/// descriptions in both interfaces; all sums over neighbours in space; jittered lattices, which have lists; shapes.
std::vector<Acting> of_adaptle() {
  auto const disc = [](std::string const& rest) { return "body.disc." + rest; };
  auto const plate = [](std::string const& rest) { return "body.plate." + rest; };
  auto const sheet = [](std::string const& rest) { return "body.sheet.formulation." + rest; };
  // Coarser than the case, and nearer.
  std::string const near = disc(
      R"(shape={ sphere = { centre = ["-5.2 mm", 0], radius = "5 mm", arrangement = "rings" }, spacing = "0.25 mm" })");
  std::string const coarse =
      plate(R"(shape={ box = { min = [0, "-9 mm"], max = ["2 mm", "9 mm"] }, spacing = "0.25 mm" })");
  char const* const touching = "column contact_overlap";
  std::string const eulerian = sheet("description=eulerian"), patch = sheet("description=patch"),
                    upper = sheet("eulerian_where=Y > 0.5");
  return {
      {"torn",
       "adaptle/impact_2d",
       "column converted_particles",
       {near, coarse, plate("formulation.convert_strain=0.05")}},
      {"guarded",
       "adaptle/impact_2d",
       "column guard_conversions",
       {near, coarse, plate("formulation.jacobian_min=0.98")}},
      {"by_formula",
       "adaptle/impact_2d",
       "column converted_particles",
       {near, coarse, plate("formulation.convert_when=plastic_strain > 0.02")}},
      {"deleted",
       "adaptle/expanding_ring",
       "column deleted_particles",
       {"body.ring.formulation.description=total_lagrangian", "body.ring.formulation.failed=delete",
        "body.ring.material.d1=0.00001"}},
      {"released", "adaptle/expanding_ring", "column failed_particles", {"body.ring.material.d1=0.00001"}},
      {"touching", "adaptle/impact_2d", touching, {near, coarse}},
      {"jittered", "adaptle/tensile_patch", "column eulerian_particles", {patch, upper, "body.sheet.shape.jitter=0.2"}},
      {"blended", "adaptle/tensile_patch", "column eulerian_particles", {patch, upper, sheet("blend=4")}},
      {"printed",
       "adaptle/tensile_patch",
       "column eulerian_particles",
       {patch, upper, sheet("interface=published"), sheet("correction=material")}},
      {"corrected", "adaptle/tensile_patch", "column eulerian_particles", {eulerian}},
      {"fluxes",
       "adaptle/colliding_halves",
       "column eulerian_particles",
       {"body.bar.formulation.description=eulerian", "body.bar.formulation.viscosity=riemann"}},
      {"on_a_wall", "adaptle/taylor_bar", touching, {"body.bar.shape.spacing=0.8 mm", "contact={law='kernel'}"}}};
}

class ShuffledContact : public ::testing::TestWithParam<Acting> {};

TEST_P(ShuffledContact, IsTheSameWhoeverOwnsTheParticles) {
  Acting const& c = GetParam();
  ReadCase const read(fs::path(testing::source_folder()) / "cases" / c.folder / "case.toml", c.overrides);
  Told const told = expect_same_steps(read, static_cast<int>(std::strlen(c.name)));
  ASSERT_FALSE(told.empty());
  EXPECT_GT(told.at(c.acts).front(), 0);
}

std::string name_of(::testing::TestParamInfo<Acting> const& value) { return value.param.name; }

INSTANTIATE_TEST_SUITE_P(ForceMoment, ShuffledContact, ::testing::ValuesIn(between_bodies()), name_of);
INSTANTIATE_TEST_SUITE_P(AdapTLE, ShuffledContact, ::testing::ValuesIn(of_adaptle()), name_of);

INSTANTIATE_TEST_SUITE_P(Cases, ShuffledCase, ::testing::ValuesIn(shuffled_cases()), [](auto const& value) {
  std::string name = value.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
});

}  // namespace
}  // namespace piola
