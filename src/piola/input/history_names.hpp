// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// A column that every history.csv has.
struct HistoryName {
  std::string_view name;
  std::string_view unit;  ///< SI, UDUNITS notation
};
std::span<HistoryName const> history_names();

/// A field that formulations can write, as frames and pictures name it. Not every one has all of them.
struct FieldName {
  std::string_view name;
  std::string_view unit;
  int components;  ///< 1 scalar, 3 vector, 6 symmetric tensor, 9 tensor (row by row)
};
std::span<FieldName const> field_names();

}  // namespace piola
