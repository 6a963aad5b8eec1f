// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace piola {

/// JSON Schema (draft 7) of a case file, for editors and scripts. Generated from the tables of keys, laws and
/// formulations of the reader and the manual. It is no stricter than the reader: texts with units and formulas are
/// strings.
std::string case_schema();

}  // namespace piola
