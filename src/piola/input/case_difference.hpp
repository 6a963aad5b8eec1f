// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// One key that two texts of a case give differently.
struct CaseDifference {
  std::string key;            ///< dotted path; the tables of a list by their names, or numbers from 0
  std::string before, after;  ///< TOML; "nothing" where the key is not given
};

/// Returns the differences between two cases, in the order of the second. Comments and layout are ignored. Throws
/// InputError if one of them is not TOML.
std::vector<CaseDifference> case_differences(std::string_view before, std::string_view after);

/// Whether a run may be resumed with another value there: where it ends, when it breaks off, what it writes, how it
/// uses the machine. The state at a given time does not depend on any of these.
bool may_change_on_resume(std::string_view key);

/// These keys, for messages.
std::string keys_that_may_change();

}  // namespace piola
