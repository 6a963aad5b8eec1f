// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/packing_file.hpp"
#include "piola/math/digest.hpp"
#include "piola/output/files.hpp"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <type_traits>

namespace piola {
namespace {

constexpr std::string_view mark = "piola packing 1\n";

template <class T>
void append(std::string& to, T const& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  to.append(bytes.data(), bytes.size());
}

/// Takes values from the front of a text; false once there is not enough left.
class Bytes {
 public:
  explicit Bytes(std::string_view text) : text_(text) {}
  template <class T>
  bool take(T& value) {
    if (text_.size() < sizeof(T)) return false;
    std::memcpy(&value, text_.data(), sizeof(T));
    text_.remove_prefix(sizeof(T));
    return true;
  }
  bool skip(std::string_view expected) {
    if (!text_.starts_with(expected)) return false;
    text_.remove_prefix(expected.size());
    return true;
  }
  std::size_t left() const { return text_.size(); }

 private:
  std::string_view text_;
};

}  // namespace

std::uint64_t digest_of(std::string_view text) {
  Digest digest(text.size());
  digest.add(text);
  return digest.value();
}

std::string packing_name(std::string const& key) { return fmt::format("packed-{:016x}.cloud", digest_of(key)); }

void write_packing(std::filesystem::path const& path, std::string const& key, geometry::Packing const& packing) {
  std::string content(mark);
  append(content, static_cast<std::uint64_t>(key.size()));
  content += key;
  append(content, static_cast<std::uint64_t>(packing.X.size()));
  append(content, packing.volume);
  append(content, packing.spacing);
  append(content, static_cast<std::int64_t>(packing.sweeps));
  for (auto const& X : packing.X) append(content, X);
  append(content, digest_of(content));
  write_whole_file(path, content);
}

std::optional<geometry::Packing> read_packing(std::filesystem::path const& path, std::string const& key) {
  FileToRead file(path);
  std::string content(static_cast<std::size_t>(file.size()), '\0');
  if (file.read(content) < content.size()) return {};
  std::uint64_t seal = 0, length = 0, count = 0;
  std::int64_t sweeps = 0;
  if (content.size() < sizeof(seal)) return {};
  std::string_view const body(content.data(), content.size() - sizeof(seal));
  std::memcpy(&seal, content.data() + body.size(), sizeof(seal));
  Bytes bytes(body);
  geometry::Packing packing;
  if (digest_of(body) != seal || !bytes.skip(mark) || !bytes.take(length) || length != key.size() || !bytes.skip(key) ||
      !bytes.take(count) || !bytes.take(packing.volume) || !bytes.take(packing.spacing) || !bytes.take(sweeps))
    return {};
  if (count != bytes.left() / sizeof(packing.X[0])) return {};
  packing.sweeps = static_cast<int>(sweeps);
  packing.X.resize(static_cast<std::size_t>(count));
  for (auto& X : packing.X)
    if (!bytes.take(X) || !std::isfinite(X[0] + X[1] + X[2])) return {};
  return packing;
}

}  // namespace piola
