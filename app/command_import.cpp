// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"
#include "python_module.hpp"
#include <memory>

namespace piola::app {
namespace {

struct ImportArguments {
  std::string file;
  std::string units, out, particles, spacing, formulation, material;
  bool force = false;
};

int convert(ImportArguments const& options) {
  std::vector<std::string> words;
  auto const pass_on = [&](char const* name, std::string const& value) {
    if (!value.empty()) words.push_back(name + ("=" + value));
  };
  pass_on("--units", options.units);
  pass_on("--out", options.out);
  pass_on("--particles", options.particles);
  pass_on("--spacing", options.spacing);
  pass_on("--formulation", options.formulation);
  pass_on("--material", options.material);
  if (options.force) words.emplace_back("--force");
  words.emplace_back("--");
  words.push_back(options.file);
  return continue_in_python("piola_import", words, "python3 and python3-numpy, for Gmsh and VTK also python3-meshio");
}

}  // namespace

void add_import(CLI::App& program, Action& action) {
  auto const options = std::make_shared<ImportArguments>();
  CLI::App* command = program.add_subcommand(
      "import", "Turn a mesh, cards or points of another program (LS-DYNA, Abaqus, Gmsh, VTK, CSV) into a case");
  command
      ->add_option(
          "file", options->file,
          "The file: .k, .key (LS-DYNA), .inp (Abaqus), .msh, .vtu and others (meshio), .step (gmsh), .csv, .xyz")
      ->required();
  command->add_option("--units", options->units,
                      "The units of the file: SI, or length, time and mass as in mm,ms,kg; of a mesh the length alone");
  command->add_option("--out,-o", options->out, "The folder to write (default: the name of the file)");
  command
      ->add_option("--particles", options->particles,
                   "packed: particles of equal volume within the surface of the mesh (default); elements: one particle "
                   "for each element, at its centroid with its volume")
      ->check(CLI::IsMember({"packed", "elements"}));
  command->add_option("--spacing", options->spacing,
                      "Distance of particles, such as 2mm (default: as fine as the mesh)");
  command
      ->add_option("--formulation", options->formulation,
                   "Default: nodal; for particles of elements and tables the one that takes them")
      ->check(CLI::IsMember({"nodal", "jst_sph", "adaptle"}));
  command->add_option("--material", options->material,
                      "Material of the library for parts without one (default: a placeholder, steel_4340)");
  command->add_flag("--force", options->force, "Replace a case.toml that is there");
  command->callback([options, &action] { action = [options] { return convert(*options); }; });
}

}  // namespace piola::app
