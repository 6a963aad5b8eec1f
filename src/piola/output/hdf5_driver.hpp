// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/atomic_file.hpp"
#include "piola/output/hdf5.hpp"
#include <cstdint>
#include <filesystem>
#include <utility>

/// HDF5 file driver. Included by output/hdf5*.cpp only.
namespace piola::hdf5 {

/// File behind the HDF5 driver. Write errors are stored in AtomicFile and not reported to HDF5; callers check
/// AtomicFile.
struct AppendOnlyFile {
  explicit AppendOnlyFile(std::filesystem::path path) : on_disk(std::move(path)) {}
  AtomicFile on_disk;
  bool reserving = false;      ///< values of data sets are not written; their offset is recorded in `reserved`
  std::uint64_t reserved = 0;  ///< offset of the last values not written
  std::uint64_t bytes = 0;     ///< used by HDF5: the length of the file after HDF5 has closed it
};

/// Creates a new HDF5 file. `file` must outlive the handle and must not be moved.
Handle create_on(AppendOnlyFile& file);

}  // namespace piola::hdf5
