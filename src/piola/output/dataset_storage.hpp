// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace piola::hdf5 {

class Writer;

/// How the numbers of a data set lie on the disk.
enum class Storage {
  contiguous,
  sequence,  ///< as contiguous, without columns
  compressed
};

/// Bytes of a file, and their check sum as it was when they were written.
struct WrittenPart {
  std::uint64_t at, bytes;
  std::uint32_t check_sum;
};

}  // namespace piola::hdf5
