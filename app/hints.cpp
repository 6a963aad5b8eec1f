// SPDX-License-Identifier: Apache-2.0
#include "hints.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola::app {
namespace {

std::vector<std::string> long_options(CLI::App const& command) {
  std::vector<std::string> names;
  for (CLI::Option const* option : command.get_options()) {
    for (std::string const& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string hint(std::string_view where, std::string_view kind, std::string const& name,
                 std::vector<std::string> const& known) {
  return fmt::format("{}: there is no {} {} (known: {}) - {}\n", where, kind, in_quotes(name), joined(known),
                     advice_for_name(name, known));
}

}  // namespace

std::string name_hints(CLI::App const& program, std::span<char const* const> arguments) {
  CLI::App const* command = nullptr;
  std::vector<std::string> commands;
  for (CLI::App const* each : program.get_subcommands([](CLI::App const*) { return true; }))
    commands.push_back(each->get_name());
  std::string text;
  for (std::string const argument : arguments) {
    if (argument == "--") break;
    bool const is_option = argument.starts_with("-");
    if (!is_option && command == nullptr) {
      if (std::find(commands.begin(), commands.end(), argument) == commands.end())
        return text + hint("piola", "command", argument, commands);
      command = program.get_subcommand(argument);
    }
    if (!argument.starts_with("--")) continue;
    CLI::App const& owner = command != nullptr ? *command : program;
    std::vector<std::string> const known = long_options(owner);
    std::string const name = argument.substr(0, argument.find('='));
    if (std::find(known.begin(), known.end(), name) == known.end())
      text += hint(command != nullptr ? "piola " + command->get_name() : "piola", "option", name, known);
  }
  return text;
}

}  // namespace piola::app
