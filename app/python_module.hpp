// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace piola::app {

/// Continues as a module in Python that belongs to the program, with these arguments; `packages` names what it needs,
/// for the message. Does not return. Throws InputError if there is no Python or no such module.
int continue_in_python(std::string const& module, std::vector<std::string> const& arguments,
                       std::string const& packages);

}  // namespace piola::app
