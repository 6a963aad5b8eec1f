// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace piola::app {

/// The manual page piola(1), generated from the commands and options of the program.
std::string man_page(CLI::App const& program);

/// A bash completion script for commands, options and files, generated likewise.
std::string bash_completion(CLI::App const& program);

}  // namespace piola::app
