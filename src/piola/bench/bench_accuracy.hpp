// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

struct AccuracyOptions {
  std::filesystem::path cases;  ///< folder with nodal/twisting_column and nodal/bending_column
  std::vector<int> across{3, 4, 5, 6, 7, 8, 9, 10, 11, 12};  ///< particles across the column
  double longest = 60;  ///< processor time from which on a scheme is not run with more particles [s]
  std::string backend = "auto";
};

/// One run: a column of Lee et al. (2016) to just after its first peak, one thread, without output.
struct AccuracyRow {
  std::string problem;  ///< "twist" or "bend"
  double poissons_ratio = 0;
  std::string formulation;  ///< formulation and scheme
  int across = 0;
  std::int64_t particles = 0, steps = 0;
  double value = 0;            ///< first peak: twist of the top [degree], displacement of the tip [m]; nan: none
  double error = 0;            ///< relative to the converged finite elements
  double set_up = 0, cpu = 0;  ///< processor time: of the set-up, and of everything [s]
  std::string failure;         ///< why there is no value
};

/// Errors against processor time: `nodal` and `jst_sph` (its default and the published scheme), twisting and bending
/// column at nu = 0.45 and 0.499. The references are those of bench/finite_elements.
std::vector<AccuracyRow> measure_accuracy(AccuracyOptions const& options);

std::string to_json(std::vector<AccuracyRow> const& rows);
std::string to_text(std::vector<AccuracyRow> const& rows);

}  // namespace piola
