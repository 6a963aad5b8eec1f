// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/packing_file.hpp"
#include "piola/base/read_file.hpp"
#include "piola/math/digest.hpp"
#include "piola/output/files.hpp"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <type_traits>

namespace piola {
namespace {

constexpr std::string_view finished_mark = "piola packing 1\n", unfinished_mark = "piola unfinished packing 1\n";

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

std::string begun(std::string_view mark, std::string const& key) {
  std::string content(mark);
  append(content, static_cast<std::uint64_t>(key.size()));
  return content + key;
}

void write_sealed(std::filesystem::path const& path, std::string content) {
  append(content, digest_of(content));
  write_whole_file(path, content);
}

/// All bytes of a file; empty if there is no such file or it cannot be read.
std::string content_of(std::filesystem::path const& path) {
  FileToRead file(path);
  std::string content(static_cast<std::size_t>(file.size()), '\0');
  return file.read(content) == content.size() ? content : std::string();
}

/// What follows mark and key in the content of a file; nothing if these are others or the content is damaged.
std::optional<Bytes> opened(std::string const& content, std::string_view mark, std::string const& key) {
  std::uint64_t seal = 0, length = 0;
  if (content.size() < sizeof(seal)) return {};
  std::string_view const body(content.data(), content.size() - sizeof(seal));
  std::memcpy(&seal, content.data() + body.size(), sizeof(seal));
  Bytes bytes(body);
  if (digest_of(body) != seal || !bytes.skip(mark) || !bytes.take(length) || length != key.size() || !bytes.skip(key))
    return {};
  return bytes;
}

bool is_finite(double x) { return std::isfinite(x); }
bool is_finite(std::array<double, 3> const& x) { return std::isfinite(x[0] + x[1] + x[2]); }

/// `count` values, all finite.
template <class T>
bool take_all(Bytes& bytes, std::uint64_t count, std::vector<T>& values) {
  if (count > bytes.left() / sizeof(T)) return false;
  values.resize(static_cast<std::size_t>(count));
  return std::all_of(values.begin(), values.end(), [&](T& value) { return bytes.take(value) && is_finite(value); });
}

}  // namespace

std::uint64_t digest_of(std::string_view text) {
  Digest digest(text.size());
  digest.add(text);
  return digest.value();
}

std::string packing_name(std::string const& key) { return fmt::format("packed-{:016x}.cloud", digest_of(key)); }

void write_packing(std::filesystem::path const& path, std::string const& key, geometry::Packing const& packing) {
  std::string content = begun(finished_mark, key);
  append(content, static_cast<std::uint64_t>(packing.X.size()));
  append(content, packing.volume);
  append(content, packing.spacing);
  append(content, static_cast<std::int64_t>(packing.sweeps));
  for (auto const& X : packing.X) append(content, X);
  write_sealed(path, std::move(content));
}

std::optional<geometry::Packing> read_packing(std::filesystem::path const& path, std::string const& key) {
  std::string const content = content_of(path);
  std::uint64_t count = 0;
  std::int64_t sweeps = 0;
  geometry::Packing packing;
  auto bytes = opened(content, finished_mark, key);
  if (!bytes || !bytes->take(count) || !bytes->take(packing.volume) || !bytes->take(packing.spacing) ||
      !bytes->take(sweeps) || !take_all(*bytes, count, packing.X))
    return {};
  packing.sweeps = static_cast<int>(sweeps);
  return packing;
}

void write_unfinished(std::filesystem::path const& path, std::string const& key,
                      geometry::UnfinishedPacking const& packing) {
  std::string content = begun(unfinished_mark, key);
  append(content, static_cast<std::uint64_t>(packing.X.size()));
  append(content, static_cast<std::int64_t>(packing.sweeps));
  for (auto const* places : {&packing.X, &packing.listed, &packing.known_at})
    for (auto const& X : *places) append(content, X);
  for (double const away : packing.away) append(content, away);
  write_sealed(path, std::move(content));
}

std::optional<geometry::UnfinishedPacking> read_unfinished(std::filesystem::path const& path, std::string const& key) {
  std::string const content = content_of(path);
  std::uint64_t count = 0;
  std::int64_t sweeps = 0;
  geometry::UnfinishedPacking packing;
  auto bytes = opened(content, unfinished_mark, key);
  if (!bytes || !bytes->take(count) || !bytes->take(sweeps) || count == 0 || !take_all(*bytes, count, packing.X) ||
      !take_all(*bytes, count, packing.listed) || !take_all(*bytes, count, packing.known_at) ||
      !take_all(*bytes, count, packing.away))
    return {};
  packing.sweeps = static_cast<int>(sweeps);
  return packing;
}

}  // namespace piola
