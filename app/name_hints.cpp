// SPDX-License-Identifier: Apache-2.0
#include "name_hints.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "commands.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola::app {
namespace {

std::vector<std::string> long_names(std::vector<CLI::Option const*> const& options) {
  std::vector<std::string> names;
  for (CLI::Option const* option : options)
    for (std::string const& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string hint(std::string_view where, std::string_view kind, std::string const& name,
                 std::vector<std::string> const& known) {
  return fmt::format("{}: there is no {} {} (known: {}) - {}\n", where, kind, in_quotes(name), joined(known),
                     advice_for_name(name, known));
}

/// `--set run.end=1 us` without quotes: the shell makes two words of the value.
std::string quote_hint(std::string const& command, std::span<char const* const> arguments) {
  for (std::size_t i = 0; i + 2 < arguments.size(); ++i) {
    std::string const setting = arguments[i + 1], unit = arguments[i + 2];
    std::size_t const equals = setting.find('=');
    if (std::string_view(arguments[i]) != "--set" || equals == std::string::npos) continue;
    std::string const value = setting.substr(equals + 1);
    bool const number = !value.empty() && value.find_first_not_of("0123456789+-.eE") == std::string::npos;
    if (!number || unit.starts_with("-") || !is_unit(unit)) continue;
    return fmt::format(
        "piola {}: {} stands apart from its number (a value with a space needs quotes) - write --set "
        "\"{} {}\"\n",
        command, in_quotes(unit), setting, unit);
  }
  return "";
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
    std::vector<std::string> const known = long_names(owner.get_options());
    std::string const name = argument.substr(0, argument.find('='));
    if (std::find(known.begin(), known.end(), name) == known.end())
      text += hint(command != nullptr ? "piola " + command->get_name() : "piola", "option", name,
                   long_names(owner.get_options(is_shown)));
  }
  return command != nullptr ? text + quote_hint(command->get_name(), arguments) : text;
}

}  // namespace piola::app
