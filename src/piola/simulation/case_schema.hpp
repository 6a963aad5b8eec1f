// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace piola {

/// JSON Schema (draft 7) of a case file, for editors and scripts. Made from the tables of keys, laws and formulations
/// that the reader and the manual use. It is no stricter than the reader: texts with units and formulas are texts here.
std::string case_schema();

}  // namespace piola
