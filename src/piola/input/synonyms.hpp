// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// What a case file calls the thing that users of other programs, or of textbooks, call `word`; "" if the word is
/// nobody's. "write \"acceleration\"" where that is one of the keys in `known`, else where it stands:
/// "that is acceleration of [[load]]".
std::string advice_for_synonym(std::string_view word, std::span<std::string const> known);

}  // namespace piola
