// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/packing_file.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/read_file.hpp"
#include "piola/math/digest.hpp"
#include "piola/output/atomic_file.hpp"
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <type_traits>
#include <utility>

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

bool is_finite(double x) { return std::isfinite(x); }
bool is_finite(std::array<double, 3> const& x) { return std::isfinite(x[0] + x[1] + x[2]); }

/// Appends the values of a packing to the content of a file. Inverse of PackingReader.
class PackingWriter {
 public:
  explicit PackingWriter(std::string& content) : content_(content) {}
  void number(double value) { append(content_, value); }
  void whole(int value) { append(content_, static_cast<std::int64_t>(value)); }
  template <class T>
  void count_of(std::vector<T> const& values) {
    append(content_, static_cast<std::uint64_t>(values.size()));
  }
  template <class T>
  void list(std::vector<T> const& values) {
    for (T const& value : values) append(content_, value);
  }

 private:
  std::string& content_;
};

/// Takes the values of a packing from the front of a text. Inverse of PackingWriter.
class PackingReader {
 public:
  explicit PackingReader(std::string_view text) : text_(text) {}
  /// False once there was not enough left, or a listed value was not finite.
  bool good() const { return good_; }
  template <class T>
  bool take(T& value) {
    good_ = good_ && text_.size() >= sizeof(T);
    if (!good_) return false;
    std::memcpy(&value, text_.data(), sizeof(T));
    text_.remove_prefix(sizeof(T));
    return true;
  }
  bool skip(std::string_view expected) {
    good_ = good_ && text_.starts_with(expected);
    if (good_) text_.remove_prefix(expected.size());
    return good_;
  }
  void number(double& value) { take(value); }
  void whole(int& value) {
    std::int64_t wide = 0;
    if (take(wide)) value = static_cast<int>(wide);
  }
  /// Length of all lists that follow.
  template <class T>
  void count_of(std::vector<T>&) {
    take(count_);
  }
  template <class T>
  void list(std::vector<T>& values) {
    good_ = good_ && count_ <= text_.size() / sizeof(T);
    if (!good_) return;
    values.resize(static_cast<std::size_t>(count_));
    for (T& value : values) good_ = take(value) && is_finite(value);
  }

 private:
  std::string_view text_;
  std::uint64_t count_ = 0;
  bool good_ = true;
};

/// Values of a packing in the order of the file. File: PackingWriter, with a const packing, or
/// PackingReader.
template <class File, class Packing>
  requires std::is_same_v<std::remove_const_t<Packing>, geometry::Packing>
void transfer(File& file, Packing& packing) {
  file.count_of(packing.X);
  file.number(packing.volume);
  file.number(packing.spacing);
  file.whole(packing.sweeps);
  file.list(packing.X);
}
template <class File, class Packing>
  requires std::is_same_v<std::remove_const_t<Packing>, geometry::UnfinishedPacking>
void transfer(File& file, Packing& packing) {
  file.count_of(packing.X);
  file.whole(packing.sweeps);
  file.list(packing.X);
  file.list(packing.listed);
  file.list(packing.known_at);
  file.list(packing.away);
}

/// Mark, length of the key, key, values, and a check sum of all of it.
template <class Packing>
void write_content(std::filesystem::path const& path, std::string_view mark, std::string const& key,
                   Packing const& packing) {
  std::string content(mark);
  append(content, static_cast<std::uint64_t>(key.size()));
  content += key;
  PackingWriter file(content);
  transfer(file, packing);
  append(content, digest_of(content));
  write_whole_file(path, content);
}

/// All bytes of a file; empty if there is no such file or it cannot be read.
std::string content_of(std::filesystem::path const& path) {
  FileToRead file(path);
  std::string content(static_cast<std::size_t>(file.size()), '\0');
  return file.read(content) == content.size() ? content : std::string();
}

/// Returns nothing if the file is missing, has another mark or key, or is damaged. Inverse of write_content().
template <class Packing>
std::optional<Packing> read_content(std::filesystem::path const& path, std::string_view mark, std::string const& key) {
  std::string const content = content_of(path);
  std::uint64_t sum = 0, length = 0;
  if (content.size() < sizeof(sum)) return {};
  std::string_view const body(content.data(), content.size() - sizeof(sum));
  std::memcpy(&sum, content.data() + body.size(), sizeof(sum));
  PackingReader file(body);
  if (digest_of(body) != sum || !file.skip(mark) || !file.take(length) || length != key.size() || !file.skip(key))
    return {};
  Packing packing;
  transfer(file, packing);
  return file.good() ? std::optional(std::move(packing)) : std::nullopt;
}

}  // namespace

std::uint64_t digest_of(std::string_view text) {
  Digest digest(text.size());
  digest.add(text);
  return digest.value();
}

std::string packing_name(std::string const& key) { return fmt::format("packed-{:016x}.cloud", digest_of(key)); }

void write_packing(std::filesystem::path const& path, std::string const& key, geometry::Packing const& packing) {
  write_content(path, finished_mark, key, packing);
}

std::optional<geometry::Packing> read_packing(std::filesystem::path const& path, std::string const& key) {
  return read_content<geometry::Packing>(path, finished_mark, key);
}

void write_unfinished(std::filesystem::path const& path, std::string const& key,
                      geometry::UnfinishedPacking const& packing) {
  PIOLA_EXPECTS(packing.listed.size() == packing.X.size() && packing.known_at.size() == packing.X.size());
  PIOLA_EXPECTS(packing.away.size() == packing.X.size());
  write_content(path, unfinished_mark, key, packing);
}

std::optional<geometry::UnfinishedPacking> read_unfinished(std::filesystem::path const& path, std::string const& key) {
  auto packing = read_content<geometry::UnfinishedPacking>(path, unfinished_mark, key);
  return packing && !packing->X.empty() ? std::move(packing) : std::nullopt;
}

}  // namespace piola
