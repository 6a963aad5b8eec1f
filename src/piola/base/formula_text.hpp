// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"

namespace piola {

/// Throws ExpressionError, with the column and advice, for a text that cannot be a formula in the known names: unknown
/// names, units, assignments, operators of other languages. The parser of Expression finds what is left.
void check_formula_text(std::string const& text, Names const& names);

}  // namespace piola
