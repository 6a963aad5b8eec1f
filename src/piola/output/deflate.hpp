// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace piola {

/// Cuts `bytes` into chunks of `chunk` bytes (the last one is filled up with zeros), groups the bytes of equal
/// significance of each `width`-byte number (HDF5's shuffle filter) and deflates each chunk, in threads.
/// The result is what HDF5's own shuffle + deflate filters would read; it does not depend on the number of threads.
std::vector<std::vector<std::byte>> deflate_chunks(std::span<std::byte const> bytes, std::size_t chunk,
                                                   std::size_t width);

}  // namespace piola
