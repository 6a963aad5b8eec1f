// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/redistribution_plan.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/dataset_storage.hpp"
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

/// Collective writer of tables in one HDF5 file. Rank 0 reserves the file space; rows are redistributed to page-aligned
/// ranges that the ranks compress and write concurrently. The bytes of the file do not depend on the number of ranks.
/// If not all ranks see the file, rank 0 writes everything.
class CollectiveTableWriter {
 public:
  /// file: the open file on rank 0, which must outlive this object; null on other ranks.
  explicit CollectiveTableWriter(hdf5::Writer* file) : file_(file) {}
  /// Writes a data set; `path` is used on rank 0 only. Collective. Does not throw if it cannot be written: end() does.
  template <class T>
  void put(std::string const& path, DistributedRows const& rows, std::span<T const> values,
           hdf5::Storage storage = hdf5::Storage::contiguous);
  /// Calls f() on rank 0, unless an error has been recorded there. Records an error of f(), too: end() throws it.
  template <class F>
  void try_on_root(F const& f) {
    if (file_ == nullptr || trouble_) return;
    try {
      f();
    } catch (...) {
      trouble_ = std::current_exception();
    }
  }
  /// Completes all writes to the disk. Collective; a second call does nothing. Throws on all ranks if a rank could not
  /// write its part: comm::CollectiveError, or on one rank FileError.
  void end();

 private:
  void join();
  RedistributionPlan const& plan(DistributedRows const& rows, Index block);
  /// Calls f() on rank 0 and broadcasts its result; nothing if it threw.
  template <class F>
  std::optional<std::vector<std::uint64_t>> by_first(std::size_t count, F const& f);
  template <class T>
  void put_contiguous(std::string const& path, DistributedRows const& rows, std::span<T const> values, bool columns);
  template <class T>
  void put_chunks(std::string const& path, DistributedRows const& rows, std::span<T const> values);
  void write_at(std::uint64_t at, std::span<std::byte const> bytes);

  hdf5::Writer* file_;
  std::unique_ptr<SharedFile> joined_;  ///< on other ranks
  bool begun_ = false, ended_ = false, all_see_ = false;
  std::map<std::pair<std::int64_t, Index>, RedistributionPlan> plans_;  ///< by set and block
  std::vector<hdf5::WrittenPart> written_;                              ///< on other ranks
  std::exception_ptr trouble_;
};

}  // namespace piola
