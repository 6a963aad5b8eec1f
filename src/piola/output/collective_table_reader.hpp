// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/redistribution_plan.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/output/atomic_file.hpp"
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
std::unique_ptr<SharedFile> open_on_all(std::filesystem::path const& of_first, SharedFile::To to);

/// Reads tables written by CollectiveTableWriter. Each rank reads a contiguous range of rows, which are then
/// redistributed to their owners.
class CollectiveTableReader {
 public:
  /// Reads a table; all tables must be in one file. place: used on rank 0 only. values: receives the rows of this rank.
  /// Returns false on all ranks if some rank cannot read the file. Collective.
  bool read(std::optional<FileExtent> const& place, DistributedRows const& rows, std::span<double> values);

 private:
  std::unique_ptr<SharedFile> file_;
  bool begun_ = false;
  std::map<std::int64_t, RedistributionPlan> plans_;  ///< by set
};

}  // namespace piola
