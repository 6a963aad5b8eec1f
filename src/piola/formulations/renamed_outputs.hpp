// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// A column of history.csv or a field of frames that had another name in the previous minor release.
struct RenamedOutput {
  std::string_view before, now;  ///< a column of a named part without its first word: "turn_x" of "stone.turn_x"
  bool of_parts = false;         ///< only as NAME.before
};

/// All of them. The next minor release empties this table.
std::span<RenamedOutput const> renamed_outputs();

/// Returns the present name of a column, quantity of a probe or field; any other name as it is.
/// "tie_heat" becomes "tie_dissipation", "stone.turn_x" becomes "stone.rotation_x".
std::string current_output_name(std::string_view name);

/// Returns the name under which a file with the fields `in_file` holds a field: the present or the previous one.
std::string stored_output_name(std::string const& name, std::span<std::string const> in_file);

}  // namespace piola
