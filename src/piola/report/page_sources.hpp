// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

/// The page's own sources, compiled into the program (web/, cmake/PiolaEmbeddedFiles.cmake).
namespace piola::report::web {

extern std::string_view const style, body, script;

}  // namespace piola::report::web
