// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>

namespace piola {

/// Zeroed doubles for one field: aligned to cache lines, in huge pages where the system has them.
///
/// Successive arrays start at different offsets within a page: arrays that are equal modulo 4 KiB evict each other from
/// the first-level cache when a loop reads many of them (measured: three times slower).
class Memory {
 public:
  Memory() = default;
  explicit Memory(std::size_t doubles);  ///< throws std::bad_alloc
  Memory(Memory&& other) noexcept;
  Memory& operator=(Memory&& other) noexcept;
  Memory(Memory const&) = delete;
  Memory& operator=(Memory const&) = delete;
  ~Memory();

  double* data() { return data_; }
  double const* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }  ///< taken, but for the rest of the last page

 private:
  void* base_ = nullptr;
  double* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace piola
