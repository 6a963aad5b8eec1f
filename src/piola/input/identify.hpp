// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/identity.hpp"
#include <filesystem>
#include <string>

namespace piola {

struct CaseSpec;

/// The identity of a run of this case by this program: digests of its text with all settings, of the content of every
/// file that it names, of version and build of the program, and of the instruction set. Reads the files. Threads, ranks
/// and what else changes no result do not count; neither do comments and layout of the text. `run` stays empty if a
/// file cannot be read, or if the program has no build id.
Identity identity_of(CaseSpec const& spec);

/// 16 hexadecimal digits that stand for the content of a file, whatever its name; empty if it is no ordinary file or
/// cannot be read. Reads 1 MiB at a time.
std::string digest_of_file(std::filesystem::path const& path);

}  // namespace piola
