// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace piola::app {

/// What is wrong with the names of the command and of the long options that a user typed, one line each with what they
/// may have meant; empty if all names are known.
std::string name_hints(CLI::App const& program, std::span<char const* const> arguments);

}  // namespace piola::app
