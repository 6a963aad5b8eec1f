// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/files.hpp"
#include "piola/output/hdf5.hpp"
#include <cstdint>
#include <filesystem>
#include <utility>

/// How HDF5 reaches the disk. Included by output/hdf5*.cpp only.
namespace piola::hdf5 {

/// A file that HDF5 writes as it likes, never told of a failure, which NewFile keeps.
struct GrowingFile {
  explicit GrowingFile(std::filesystem::path path) : on_disk(std::move(path)) {}
  NewFile on_disk;
  bool reserving = false;      ///< values of data sets are not written, but where they would be is kept
  std::uint64_t reserved = 0;  ///< that place
  std::uint64_t bytes = 0;     ///< that HDF5 has made use of: the length of the file once HDF5 has closed it
};

/// A new file of HDF5. `file` must live longer than the handle, and stay where it is.
Handle create_on(GrowingFile& file);

}  // namespace piola::hdf5
