// SPDX-License-Identifier: Apache-2.0
#include "man_page.hpp"
#include "piola/base/version.hpp"
#include "commands.hpp"
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace piola::app {
namespace {

std::vector<CLI::App const*> commands_of(CLI::App const& program) {
  return program.get_subcommands([](CLI::App const*) { return true; });
}

/// Text for troff: hyphens that can be searched for, backslashes as such, and no line that begins a request.
std::string troff(std::string_view text) {
  std::string out;
  bool at_start = true;
  for (char const c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    at_start = c == '\n';
    if (c == '-')
      out += "\\-";
    else if (c == '\\')
      out += "\\e";
    else
      out += c;
  }
  return out;
}

/// "--out, -o TEXT"; a positional as its name.
std::string names_of(CLI::Option const& option) {
  std::string names = option.get_positional() ? option.get_name(true) : option.get_name(false, true);
  for (std::size_t comma = 0; (comma = names.find(',', comma)) != std::string::npos; comma += 2)
    names.insert(comma + 1, " ");
  std::string const type = option.get_positional() || option.get_items_expected_max() == 0 ? "" : "VALUE";
  return type.empty() ? names : names + " " + type;
}

std::string entries(CLI::App const& command) {
  std::string text;
  for (CLI::Option const* option : command.get_options(is_shown))
    text += fmt::format(".TP\n.B {}\n{}\n", troff(names_of(*option)), troff(option->get_description()));
  return text;
}

std::string synopsis(CLI::App const& command) {
  std::string text = command.get_name() + " [OPTION...]";
  for (CLI::Option const* option : command.get_options([](CLI::Option const* o) { return o->get_positional(); }))
    text += option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
  return text;
}

/// Words that start with "--" or "-", separated by spaces.
std::string flags_of(CLI::App const& command) {
  std::string words;
  for (CLI::Option const* option : command.get_options(is_shown)) {
    for (std::string const& name : option->get_lnames()) words += "--" + name + " ";
    for (std::string const& name : option->get_snames()) words += "-" + name + " ";
  }
  if (!words.empty()) words.pop_back();
  return words;
}

constexpr std::string_view man_end = R"(.SH EXIT STATUS
.TP
.B 0
The run was completed, or what was asked for was done.
.TP
.B 1
A file cannot be written, or a check of \fBverify\fR fell short unexpectedly.
.TP
.B 2
The case, a file or the command line is wrong: every problem is listed with its place.
.TP
.B 3
The physics left its admissible range; the last state is in the results.
.TP
.B 4
The run was stopped by a signal or by \-\-wall\-time, with a checkpoint.
.SH SIGNALS
SIGINT, SIGTERM, SIGHUP and SIGUSR2 stop a run between two steps with a checkpoint; SIGUSR1 writes one and goes on.
.SH ENVIRONMENT
.TP
.B OMP_NUM_THREADS, SLURM_CPUS_PER_TASK
Number of threads if neither the case nor \-\-threads says it.
.SH SEE ALSO
The manual and the theory in /usr/share/doc/piola/, examples in /usr/share/piola/cases/.
)";

constexpr char const* completion = R"(# bash completion of piola
_piola() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words=
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    mapfile -t COMPREPLY < <(compgen -W "{} --help --version" -- "$word")
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  elif [[ ${{COMP_WORDS[1]}} == describe && $COMP_CWORD -eq 2 ]]; then
    mapfile -t COMPREPLY < <(compgen -W "case material library kernel formulation" -- "$word")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -F _piola piola
)";

}  // namespace

std::string man_page(CLI::App const& program) {
  std::string text = fmt::format(
      ".TH PIOLA 1 \"\" \"Piola {}\" \"User Commands\"\n.SH NAME\npiola \\- {}\n.SH SYNOPSIS\n.B piola\n.I COMMAND\n"
      "[OPTION...]\n.SH DESCRIPTION\nPiola computes the fast motion of solids at large strain. A case is described in "
      "a text file; Piola checks it, runs it, and writes frames for ParaView, histories, pictures and checkpoints.\n"
      ".SH COMMANDS\n",
      version(), "smoothed particle hydrodynamics for solids at large strain");
  for (CLI::App const* command : commands_of(program))
    text += fmt::format(".SS piola {}\n{}.\n{}", troff(synopsis(*command)), troff(command->get_description()),
                        entries(*command));
  return text + std::string(man_end);
}

std::string bash_completion(CLI::App const& program) {
  std::string commands, cases;
  for (CLI::App const* command : commands_of(program)) {
    commands += (commands.empty() ? "" : " ") + command->get_name();
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), flags_of(*command));
  }
  return fmt::format(fmt::runtime(completion), commands, cases);
}

}  // namespace piola::app
