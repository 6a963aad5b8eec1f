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

/// Rows per block of whole pages, so that no two ranks access the same page of a file.
inline constexpr Index rows_of_pages = 4096;

/// Opens a file on all ranks; `of_first` is used on rank 0 only. Returns null on all ranks unless all see the file.
/// Collective.
std::unique_ptr<JoinedFile> open_on_all(std::filesystem::path const& of_first, JoinedFile::To to);

/// Reads tables written by RowWriter. Each rank reads a contiguous range of rows, which are then redistributed to their
/// owners.
class RowReader {
 public:
  /// Reads a table; all tables must be in one file. place: used on rank 0 only. values: receives the rows of this rank.
  /// Returns false on all ranks if some rank cannot read the file. Collective.
  bool read(std::optional<PlaceInFile> const& place, RowsOfRanks const& rows, std::span<double> values);

 private:
  std::unique_ptr<JoinedFile> file_;
  bool begun_ = false;
  std::map<std::int64_t, RowPlan> plans_;  ///< by set
};

}  // namespace piola
