// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/files.hpp"
#include "piola/output/storage.hpp"
#include "piola/parallel/row_plan.hpp"
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace piola {

/// Tables that all ranks write into one file: HDF5 on rank 0 says where each goes, their rows go to the ranks that
/// write them, a stretch of whole pages each, and these compress and write at the same time. So a file has the same
/// bytes for any number of ranks. Where not all see the file, because their machines share no disk, rank 0 writes all.
class RowWriter {
 public:
  /// The file, on rank 0; on others nothing.
  explicit RowWriter(hdf5::Writer* file) : file_(file) {}
  /// A data set with this path, which only rank 0 needs to know. Collective. Does not throw if it cannot be written:
  /// end() does.
  template <class T>
  void put(std::string const& path, RowsOfRanks const& rows, std::span<T const> values,
           hdf5::Storage storage = hdf5::Storage::contiguous);
  /// Whether rank 0 knows of no trouble so far.
  bool good() const { return !trouble_; }
  /// All is on the disk. Collective; nothing if it was called before. Throws FileError on rank 0 if some rank could not
  /// write its part.
  void end();

 private:
  void join();
  RowPlan const& plan(RowsOfRanks const& rows, Index block);
  /// What f() makes on rank 0, on all ranks; nothing if it threw.
  template <class F>
  std::optional<std::vector<std::uint64_t>> by_first(std::size_t count, F const& f);
  template <class T>
  void put_contiguous(std::string const& path, RowsOfRanks const& rows, std::span<T const> values, bool columns);
  template <class T>
  void put_chunks(std::string const& path, RowsOfRanks const& rows, std::span<T const> values);
  void write_at(std::uint64_t at, std::span<std::byte const> bytes);

  hdf5::Writer* file_;
  std::unique_ptr<JoinedFile> joined_;  ///< on other ranks
  bool begun_ = false, ended_ = false, all_see_ = false;
  std::map<std::pair<std::int64_t, Index>, RowPlan> plans_;  ///< by set and block
  std::vector<hdf5::WrittenPart> written_;                   ///< on other ranks
  std::exception_ptr trouble_;
};

}  // namespace piola
