// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/identity.hpp"

namespace piola {

struct CaseSpec;

/// The identity of a run of this case by this program: digests of its text with all settings, of the content of every
/// file that it names, of version and build of the program, and of the instruction set. Reads the files. Threads, ranks
/// and what else changes no result do not count; neither do comments and layout of the text. `run` stays empty if a
/// file cannot be read, or if the program has no build id.
Identity identity_of(CaseSpec const& spec);

}  // namespace piola
