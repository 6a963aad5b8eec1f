// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/memory.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/heap_tuning.hpp"
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace piola {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t huge_page = std::size_t{1} << 21;
constexpr std::size_t page = std::size_t{1} << 12, many_pages = 16;
constexpr std::size_t colours = 64;
constexpr std::size_t many_huge_pages = 32;
std::size_t parts_of_arrays = 1;
constexpr std::size_t lines_per_colour = 33;  // odd, so that 64 colours visit all sets of a 4 KiB page

std::size_t next_offset() {
  static std::atomic<std::size_t> colour{0};
  return (colour.fetch_add(1, std::memory_order_relaxed) % colours) * lines_per_colour * cache_line;
}

}  // namespace

void exec_host::set_lazy_allocation(int parts) {
  PIOLA_EXPECTS(parts >= 1);
  parts_of_arrays = static_cast<std::size_t>(std::max(1, parts));
}

Memory::Memory(std::size_t doubles) {
  std::size_t const payload = doubles * sizeof(double);
  // Small arrays stay in small pages: a huge page each would waste memory on cases of a thousand particles.
  bool const large = payload >= huge_page;
  std::size_t const offset = next_offset();
  bool const by_parts = parts_of_arrays > 1 && payload >= many_pages * page;
  std::size_t const alignment = large ? huge_page : by_parts ? page : cache_line;
  std::size_t const size = (payload + offset + alignment - 1) / alignment * alignment;
  // Nothing touches the pages before the data, so that they take no memory; nor what is left of the last page, which is
  // a huge one at most.
  bytes_ = payload;
  base_ = std::aligned_alloc(alignment, size == 0 ? alignment : size);
  if (base_ == nullptr) throw std::bad_alloc{};
#if defined(__linux__)
  // Huge pages at the edges of a part waste memory unless the part is far larger than a huge page.
  bool const huge = parts_of_arrays == 1 || payload / parts_of_arrays >= many_huge_pages * huge_page;
  if (large) (void)madvise(base_, size, huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
  // Pages released by MADV_DONTNEED read as zero on the next access.
  bool const zero = by_parts && madvise(base_, size, MADV_DONTNEED) == 0;
#else
  bool const zero = false;
#endif
  data_ = reinterpret_cast<double*>(static_cast<char*>(base_) + offset);
  if (zero) return;
  // Threads zero the parts that they will work on.
  constexpr std::size_t part = std::size_t{1} << 20;
  auto const parts = static_cast<std::ptrdiff_t>((payload + part - 1) / part);
  auto* const bytes = reinterpret_cast<char*>(data_);
#pragma omp parallel for schedule(static) if (parts > 8)
  for (std::ptrdiff_t k = 0; k < parts; ++k) {
    std::size_t const first = static_cast<std::size_t>(k) * part;
    std::memset(bytes + first, 0, std::min(part, payload - first));
  }
}

Memory::Memory(Memory&& other) noexcept
    : base_(std::exchange(other.base_, nullptr)),
      data_(std::exchange(other.data_, nullptr)),
      bytes_(std::exchange(other.bytes_, 0)) {}

Memory& Memory::operator=(Memory&& other) noexcept {
  std::swap(base_, other.base_);
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

Memory::~Memory() { std::free(base_); }

}  // namespace piola
