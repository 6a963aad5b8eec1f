// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

/// [[row]] of rows.toml: a case with settings.
struct BenchRowSpec {
  std::string name;
  std::vector<std::string> set;  ///< overrides, "key=value"
  bool scalar = false;           ///< also measured on the scalar path
  int warm_up = 1;               ///< steps before the measurement
  int steps = 0;                 ///< the mean of these steps counts; 0: the fastest of several measurements
};

/// Content of rows.toml.
struct BenchFile {
  std::string name;  ///< its folder, "nodal/rates"
  std::filesystem::path case_file;
  bool in_turn = false;  ///< measurements of all rows alternate, so that disturbances affect all of them
  std::vector<BenchRowSpec> rows;
};

/// Reads the benchmarks below `folder` that the names select: one of them, or all of a folder. Throws InputError.
std::vector<BenchFile> read_benchmarks(std::filesystem::path const& folder, std::vector<std::string> const& names);

}  // namespace piola
