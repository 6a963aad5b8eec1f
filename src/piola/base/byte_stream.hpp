// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace piola {

/// Arrays one after the other, each behind its length.
class ByteWriter {
 public:
  template <class T>
  void put(std::vector<T> const& values) {
    std::size_t const size = values.size() * sizeof(T), at = bytes_.size();
    bytes_.resize(at + sizeof size + size);
    std::memcpy(bytes_.data() + at, &size, sizeof size);
    if (size > 0) std::memcpy(bytes_.data() + at + sizeof size, values.data(), size);
  }
  void put(std::vector<std::string> const& texts) {
    std::vector<char> all;
    for (std::string const& text : texts) {
      all.insert(all.end(), text.begin(), text.end());
      all.push_back('\0');
    }
    put(all);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Unpacks the values; returns false if the bytes do not have the expected content.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}
  template <class T>
  bool take(std::vector<T>& values) {
    std::size_t size = 0;
    if (left_.size() < sizeof size) return false;
    std::memcpy(&size, left_.data(), sizeof size);
    left_.remove_prefix(sizeof size);
    if (left_.size() < size || size % sizeof(T) != 0) return false;
    values.resize(size / sizeof(T));
    if (size > 0) std::memcpy(values.data(), left_.data(), size);
    left_.remove_prefix(size);
    return true;
  }
  bool take(std::vector<std::string>& texts) {
    std::vector<char> all;
    if (!take(all) || (!all.empty() && all.back() != '\0')) return false;
    for (std::size_t at = 0; at < all.size(); at += texts.back().size() + 1) texts.emplace_back(all.data() + at);
    return true;
  }

 private:
  std::string_view left_;
};

}  // namespace piola
