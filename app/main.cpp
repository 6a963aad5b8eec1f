// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/base/stopped.hpp"
#include "piola/base/version.hpp"
#include "piola/domain/error_agreement.hpp"
#include "piola/exec/heap_tuning.hpp"
#include "commands.hpp"
#include "name_hints.hpp"
#include "signals.hpp"
#include "sleep.hpp"
#include "streams.hpp"
#include <chrono>
#include <exception>
#include <fmt/format.h>
#include <sstream>
#include <thread>

namespace {

using namespace piola;
using app::print_message;

/// Prints an error of this rank and returns the exit code. On several ranks only one prints: if all ranks have an error
/// within the timeout, the lowest one; otherwise this rank, which then aborts the others, as they may wait for it.
int report(ErrorReport const& error) {
  constexpr double timeout = 5;  // s
  if (auto const first = comm::agree_within(timeout, error)) {
    print_message("piola: {}\n", first->message);
    return first->code;
  }
  // Lower ranks may have an error, too, and only one is to print.
  std::this_thread::sleep_for(std::chrono::milliseconds(300 * comm::rank()));
  app::set_quiet(false);
  print_message("piola: {} (on rank {}, which ends all {})\n", error.message, comm::rank(), comm::size());
  comm::abort_all(error.code);
  return error.code;
}

/// Runs the chosen command; every error becomes one message and the exit code that scripts rely on.
int perform(app::Action const& action) {
  try {
    return action();
  } catch (comm::CollectiveError const& error) {
    print_message("piola: {}\n", error.what());
    return error.code();
  } catch (SetUpStopped const& error) {
    print_message("piola: {}\n", error.what());
    if (comm::is_parallel()) comm::abort_all(stopped_by_signal);  // the other ranks are still in their set-up
    return stopped_by_signal;
  } catch (...) {
    return report(report_of(std::current_exception()));
  }
}

/// Handles a help request or an error in the command line.
int explain(CLI::App const& program, CLI::ParseError const& error, std::span<char const* const> arguments) {
  std::ostringstream out, err;
  bool const asked = program.exit(error, out, err) == 0;
  std::string const hints = asked ? "" : app::name_hints(program, arguments);
  app::write_out(out.str());
  app::write_err(hints.empty() ? err.str() : hints + "Run with --help for more information.\n");
  return asked ? app::with_output(completed) : bad_input;
}

/// The given action; on several ranks, for commands other than run and resume, one that refuses.
app::Action action_on_ranks(CLI::App const& program, app::Action action) {
  if (!comm::is_parallel() || program.got_subcommand("run") || program.got_subcommand("resume")) return action;
  return []() -> int {
    print_message(
        "piola: several ranks (mpirun) are for 'piola run' and 'piola resume' - start this command without mpirun\n");
    return bad_input;
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
  app::add_import(program, action);
  app::add_identify(program, action);
  app::add_test_material(program, action);
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
  app::tell_crashes_of_laws();
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
