// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"

namespace piola::app {

/// "(0, -9.81, 0)": the texts of the first `dimension` formulas.
std::string vector_text(std::array<Expression, 3> const& formulas, int dimension);

/// Prints rigid shapes, their springs, and the pairs in contact.
void print_contact(CaseSpec const& spec, int dimension);

}  // namespace piola::app
