// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

namespace piola {

/// Allocator of zeros. Large arrays (calloc) allocate pages on first write; for fields see set_lazy_allocation().
template <class T>
struct LazyZeroAllocator {
  using value_type = T;
  LazyZeroAllocator() = default;
  template <class U>
  LazyZeroAllocator(LazyZeroAllocator<U> const&) {}

  T* allocate(std::size_t n) {
    void* const zeros = std::calloc(n, sizeof(T));
    if (zeros == nullptr) throw std::bad_alloc{};
    return static_cast<T*>(zeros);
  }
  void deallocate(T* p, std::size_t) { std::free(p); }
  /// Does nothing: the memory is zero already.
  template <class U>
  void construct(U*) {}
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
  bool operator==(LazyZeroAllocator const&) const = default;
};

/// Zero-initialised array whose pages are allocated on first write, for arrays of the length of a body of which a rank
/// fills only its part. T's constructor is not run. Precondition: never grown after shrinking. A copy allocates all
/// pages.
template <class T>
using LazyZeroArray = std::vector<T, LazyZeroAllocator<T>>;

}  // namespace piola
