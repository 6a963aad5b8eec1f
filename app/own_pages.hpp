// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace piola::app {

/// The manual page piola(1), from the commands and options that the program has.
std::string man_page(CLI::App const& program);

/// A script for bash that completes commands, options and files, likewise.
std::string bash_completion(CLI::App const& program);

}  // namespace piola::app
