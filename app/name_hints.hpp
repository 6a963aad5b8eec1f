// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <CLI/CLI.hpp>
#include <span>
#include <string>

namespace piola::app {

/// Reports unknown command and option names with the most similar known ones, one line each; empty if all names are
/// known.
std::string name_hints(CLI::App const& program, std::span<char const* const> arguments);

}  // namespace piola::app
