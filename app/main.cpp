// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/base/stopped.hpp"
#include "piola/base/version.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/heap_tuning.hpp"
#include "piola/simulation/driver_and_workers.hpp"
#include "commands.hpp"
#include "name_hints.hpp"
#include "signals.hpp"
#include "sleep.hpp"
#include "streams.hpp"
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

namespace {

using namespace piola;
using app::print_message;

/// One rank speaks for all of them.
int report(std::string const& message, int code) {
  auto const trouble = shut_down({code, message});
  if (trouble) {
    print_message("piola: {}\n", trouble->message);
    return trouble->code;
  }
  app::set_quiet(false);
  print_message("piola: {} (on rank {}, which ends all {})\n", message, comm::rank(), comm::size());
  comm::abort_all(code);
  return code;
}

/// Runs the chosen command; every error becomes one message and the exit code that scripts rely on.
int perform(app::Action const& action) {
  try {
    int const code = action();
    (void)shut_down({code, {}});
    return code;
  } catch (comm::CollectiveError const& error) {
    print_message("piola: {}\n", error.what());
    return error.code();
  } catch (SetUpStopped const& error) {
    print_message("piola: {}\n", error.what());
    if (comm::is_parallel()) comm::abort_all(app::stopped_by_signal);  // the other ranks are still in their set-up
    return app::stopped_by_signal;
  } catch (InputError const& error) {
    return report(error.what(), app::bad_input);
  } catch (PhysicsError const& error) {
    return report(error.what(), app::physics_failed);
  } catch (FileError const& error) {
    return report(error.what(), app::internal_error);
  } catch (std::filesystem::filesystem_error const& error) {
    return report(
        fmt::format("{}: cannot be used, {} - check the path", error.path1().string(), error.code().message()),
        app::internal_error);
  } catch (std::bad_alloc const&) {
    return report("not enough memory for this many particles - choose fewer ('piola check' reports how much is needed)",
                  app::internal_error);
  } catch (std::exception const& error) {
    return report(fmt::format("internal error, please report it: {}", error.what()), app::internal_error);
  }
}

/// Handles a help request or an error in the command line.
int explain(CLI::App const& program, CLI::ParseError const& error, std::span<char const* const> arguments) {
  std::ostringstream out, err;
  bool const asked = program.exit(error, out, err) == 0;
  std::string const hints = asked ? "" : app::name_hints(program, arguments);
  app::write_out(out.str());
  app::write_err(hints.empty() ? err.str() : hints + "Run with --help for more information.\n");
  return asked ? app::with_output(app::completed) : app::bad_input;
}

/// The given action; on several ranks, for commands other than run and resume, one that refuses.
app::Action action_on_ranks(CLI::App const& program, app::Action action) {
  if (!comm::is_parallel() || program.got_subcommand("run") || program.got_subcommand("resume")) return action;
  return []() -> int {
    print_message(
        "piola: several ranks (mpirun) are for 'piola run' and 'piola resume' - start this command without mpirun\n");
    return app::bad_input;
  };
}

/// Parses the command line: the subcommand that is given stores its action (app/command_NAME.cpp), which is then run.
int run_command(int argc, char** argv) {
  CLI::App program("Piola: smoothed particle hydrodynamics for solids at large strain");
  program.set_version_flag("--version", std::string(piola::version()));
  program.require_subcommand(1);
  app::Action action;
  app::add_run(program, action);
  app::add_check(program, action);
  app::add_resume(program, action);
  app::add_render(program, action);
  app::add_study(program, action);
  app::add_converge(program, action);
  app::add_plot(program, action);
  app::add_report(program, action);
  app::add_watch(program, action);
  app::add_verify(program, action);
  app::add_describe(program, action);
  app::add_bench(program, action);
  try {
    program.parse(argc, argv);
  } catch (CLI::ParseError const& error) {
    return explain(program, error, std::span<char const* const>(argv, static_cast<std::size_t>(argc)).subspan(1));
  }
  return perform(action_on_ranks(program, std::move(action)));
}

}  // namespace

int main(int argc, char** argv) {
  app::secure_streams();
  exec_host::set_mmap_threshold();
  app::sleep_while_waiting(argv);
  comm::start();
  if (comm::rank() != 0) {
    app::set_quiet(true);
    app::ignore_stop_signals();
  }
  int const code = run_command(argc, argv);
  comm::finish();
  return code;
}
