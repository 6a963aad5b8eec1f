// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "commands.hpp"
#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <unistd.h>

namespace piola::app {
namespace {

struct ImportArguments {
  std::string file;
  std::string units, out, particles, spacing, formulation, material;
  bool force = false;
};

/// The program in Python that converts: beside the program in a build folder, below share where it is installed.
std::filesystem::path converter() {
  std::array<char, PATH_MAX> program{};
  ::ssize_t const length = ::readlink("/proc/self/exe", program.data(), program.size() - 1);
  std::filesystem::path const folder = std::filesystem::path(length > 0 ? program.data() : "").parent_path();
  std::error_code ignored;
  for (char const* const place : {"python", "../share/piola/python"}) {
    auto found = folder / place / "piola_import" / "__main__.py";
    if (std::filesystem::exists(found, ignored)) return found;
  }
  throw InputError("the converter piola_import is neither in " + (folder / "python").string() + " nor in " +
                   (folder / "../share/piola/python").lexically_normal().string() + " - install Piola again");
}

/// The Python for which the distribution installs its packages, unless the variable PIOLA_PYTHON names another one.
std::string interpreter() {
  char const* const named = std::getenv("PIOLA_PYTHON");
  if (named != nullptr && *named != '\0') return named;
  return ::access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
}

/// Continues as the converter; returns only if there is no Python.
int convert(ImportArguments const& options) {
  std::vector<std::string> words{interpreter(), "-B", converter().string()};
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
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  throw InputError("piola import needs Python, and " + words[0] + " cannot be started (" + std::strerror(errno) +
                   ") - install the packages python3 and python3-numpy, for Gmsh and VTK also python3-meshio");
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
