// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

namespace piola {

/// Rows of the table of a law: plain data of fixed size, so that laws carry it to every device.
struct LawTable {
  static constexpr int most = 32;
  int count = 0;  ///< 0: none
  double x[most]{}, y[most]{};
};

/// A table that a law needs: values that do not fall over an argument from 0 on. Reading, checks, `piola describe` and
/// the manual come from this entry.
struct TableParameter {
  std::string_view name;      ///< key in the case file
  std::string_view argument;  ///< meaning of the first column
  std::string_view unit_of_argument;
  std::string_view value;  ///< meaning of the second column, which is positive
  std::string_view unit;
};

}  // namespace piola
