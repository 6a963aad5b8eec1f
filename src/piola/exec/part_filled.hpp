// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

namespace piola {

/// Zeros that take memory where somebody writes, page by page, if there are many of them (as fill_arrays_in_parts()
/// has it for fields).
template <class T>
struct ZeroPages {
  using value_type = T;
  ZeroPages() = default;
  template <class U>
  ZeroPages(ZeroPages<U> const&) {}

  T* allocate(std::size_t n) {
    void* const zeros = std::calloc(n, sizeof(T));
    if (zeros == nullptr) throw std::bad_alloc{};
    return static_cast<T*>(zeros);
  }
  void deallocate(T* p, std::size_t) { std::free(p); }
  /// They are zero already.
  template <class U>
  void construct(U*) {}
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
  bool operator==(ZeroPages const&) const = default;
};

/// For arrays as long as a body of which a rank fills its part: PartFilled<double> x(n) is zero all over, whatever T
/// says of itself. One that is made smaller must not grow again. Copies are full.
template <class T>
using PartFilled = std::vector<T, ZeroPages<T>>;

}  // namespace piola
