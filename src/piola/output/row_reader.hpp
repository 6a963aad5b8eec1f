// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/output/files.hpp"
#include "piola/parallel/row_plan.hpp"
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>

namespace piola {

/// Rows of pages that ranks read or write: no two of them have a page in common.
inline constexpr Index rows_of_pages = 4096;

/// The file of this path, which rank 0 alone needs to say, for this rank; nothing on all ranks unless all of them see
/// it. Collective.
std::unique_ptr<JoinedFile> open_on_all(std::filesystem::path const& of_first, JoinedFile::To to);

/// Reads what RowWriter has written: each rank a stretch of the whole, whose rows go to the ranks that want them then.
class RowReader {
 public:
  /// Of tables in one file; `place`: that of rank 0. `values`: those of the rows of this rank. Returns false, on all
  /// ranks, if not all of them can read the file. Collective.
  bool read(std::optional<PlaceInFile> const& place, RowsOfRanks const& rows, std::span<double> values);

 private:
  std::unique_ptr<JoinedFile> file_;
  bool begun_ = false;
  std::map<std::int64_t, RowPlan> plans_;  ///< by set
};

}  // namespace piola
