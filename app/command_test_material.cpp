// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/input/law_settings.hpp"
#include "piola/materials/block_law.hpp"
#include "piola/materials/law_library.hpp"
#include "piola/verification/block_law_battery.hpp"
#include "commands.hpp"
#include "streams.hpp"
#include <fmt/format.h>
#include <memory>

namespace piola::app {
namespace {

struct TestMaterialArguments {
  std::string library, law;
  std::vector<std::string> set;
};

std::string table_of(piola_material const& law) {
  std::string text = fmt::format("law {}: {}\n", law.name, law.about != nullptr ? law.about : "");
  for (int k = 0; k < law.parameter_count; ++k) {
    auto const& p = law.parameters[k];
    text += fmt::format("  parameter {} [{}], {}\n", p.name, p.unit, p.meaning);
  }
  for (int k = 0; k < law.history_count; ++k)
    text += fmt::format("  history {} [{}]\n", law.history[k].name, law.history[k].unit);
  return text;
}

int test_material(TestMaterialArguments const& options) {
  auto const material = read_library_material(options.library, options.law, options.set);
  BlockLaw const law(material);
  std::string text = table_of(law.description());
  text += fmt::format("  at rest: bulk modulus {:.4g} Pa, shear modulus {:.4g} Pa, pressure waves {:.4g} m/s\n",
                      law.kappa, law.mu, law.p_wave_speed());
  bool good = true;
  for (LawCheck const& check : check_block_law(material)) {
    good = good && check.passed();
    text += fmt::format("{}  {}: {:.3g} (at most {:.3g})\n", check.passed() ? "pass" : "FAIL", check.what, check.value,
                        check.bound);
  }
  text += fmt::format("time of a point and step: {:.3g} ns\n", 1e9 * seconds_per_point(material));
  write_out(text);
  return with_output(good ? completed : physics_failed);
}

}  // namespace

void add_test_material(CLI::App& program, Action& action) {
  auto const options = std::make_shared<TestMaterialArguments>();
  CLI::App* const command =
      program.add_subcommand("test-material", "Check a material law of your own in a shared library");
  command->add_option("library", options->library, "the library, e.g. ./my_law.so")->required();
  command->add_option("--law", options->law, "which of its laws, if it has several");
  command->add_option("parameters", options->set, "its parameters: density=\"1100 kg/m^3\" mu=\"6 MPa\"");
  command->callback([options, &action] { action = [options] { return test_material(*options); }; });
}

}  // namespace piola::app
