// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/bound_keys.hpp"
#include "piola/math/table_function.hpp"
#include <span>
#include <string>

namespace piola {

/// A table in place of a formula, without its rows.
struct TableSpec {
  std::string file;    ///< empty: the rows are in the case
  std::string column;  ///< of the file; empty: the second one
  TableFunction::Options options;
  double scale = 1;  ///< factor of all values
  bool derivative = false;
};

std::span<BoundKey<TableSpec> const> table_keys();

}  // namespace piola
