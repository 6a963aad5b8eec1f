// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace piola {

/// Copy-on-write vector. Copies share memory; any non-const access detaches. Before a parallel loop that writes, call
/// own() once.
template <class T>
class CopyOnWriteVector {
 public:
  using value_type = T;
  using size_type = std::size_t;
  using const_iterator = typename std::vector<T>::const_iterator;
  using iterator = typename std::vector<T>::iterator;
  using const_reference = T const&;
  using reference = T&;

  CopyOnWriteVector() = default;
  CopyOnWriteVector(std::vector<T> values) : values_(std::make_shared<std::vector<T>>(std::move(values))) {}
  CopyOnWriteVector(std::initializer_list<T> values) : CopyOnWriteVector(std::vector<T>(values)) {}

  template <class Iterator>
  CopyOnWriteVector(Iterator first, Iterator last) : CopyOnWriteVector(std::vector<T>(first, last)) {}

  /// The vector for reading, which does not detach.
  std::vector<T> const& seen() const { return values_ ? *values_ : nothing(); }
  operator std::vector<T> const&() const { return seen(); }
  /// The vector of this object alone.
  std::vector<T>& own() {
    if (!values_)
      values_ = std::make_shared<std::vector<T>>();
    else if (values_.use_count() > 1)
      values_ = std::make_shared<std::vector<T>>(*values_);
    return *values_;
  }
  bool shared() const { return values_.use_count() > 1; }  ///< another copy uses the same memory

  std::size_t size() const { return seen().size(); }
  bool empty() const { return seen().empty(); }
  T const* data() const { return seen().data(); }
  T const& operator[](std::size_t k) const { return (*values_)[k]; }
  T const& front() const { return seen().front(); }
  T const& back() const { return seen().back(); }
  const_iterator begin() const { return seen().begin(); }
  const_iterator end() const { return seen().end(); }

  T& operator[](std::size_t k) { return own()[k]; }
  void push_back(T const& value) { own().push_back(value); }
  void resize(std::size_t size) { own().resize(size); }
  void resize(std::size_t size, T const& value) { own().resize(size, value); }
  void assign(std::size_t size, T const& value) { own().assign(size, value); }
  void clear() { values_.reset(); }

  friend bool operator==(CopyOnWriteVector const& a, CopyOnWriteVector const& b) { return a.seen() == b.seen(); }

 private:
  static std::vector<T> const& nothing() {
    static std::vector<T> const empty;
    return empty;
  }
  std::shared_ptr<std::vector<T>> values_;
};

}  // namespace piola
