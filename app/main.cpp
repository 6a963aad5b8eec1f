// SPDX-License-Identifier: Apache-2.0
#include "piola/base/problems.hpp"
#include "piola/base/version.hpp"
#include "commands.hpp"
#include <cstdio>
#include <exception>
#include <fmt/format.h>

namespace {

using namespace piola;

int report(char const* kind, std::exception const& error, int code) {
  fmt::print(stderr, "piola: {}{}\n", kind, error.what());
  return code;
}

/// Runs the chosen command; every error becomes one message and the exit code that scripts rely on.
int perform(app::Action const& action) {
  try {
    return action();
  } catch (InputError const& error) {
    return report("", error, app::bad_input);
  } catch (PhysicsError const& error) {
    return report("", error, app::physics_failed);
  } catch (FileError const& error) {
    return report("", error, app::internal_error);
  } catch (std::bad_alloc const& error) {
    return report("not enough memory for this many particles - choose fewer ('piola check' tells how much is needed): ",
                  error, app::internal_error);
  } catch (std::exception const& error) {
    return report("internal error, please report it: ", error, app::internal_error);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Piola: smoothed particle hydrodynamics for solids at large strain");
  program.set_version_flag("--version", std::string(piola::version()));
  program.require_subcommand(1);
  app::Action action;
  app::add_run(program, action);
  app::add_check(program, action);
  app::add_resume(program, action);
  app::add_render(program, action);
  app::add_verify(program, action);
  app::add_describe(program, action);
  app::add_bench(program, action);
  try {
    program.parse(argc, argv);
  } catch (CLI::ParseError const& error) {
    return program.exit(error) == 0 ? app::completed : app::bad_input;
  }
  return perform(action);
}
