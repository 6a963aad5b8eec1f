// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// Advice for a word that textbooks or other programs use for a key of case files: "write \"acceleration\"" if that key
/// is one of `known`, else its section, "that is \"acceleration\" of [[load]]"; "" for other words.
std::string advice_for_synonym(std::string_view word, std::span<std::string const> known);

}  // namespace piola
