// SPDX-License-Identifier: Apache-2.0
#include "piola/output/checksum_trailer.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/read_file.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <libdeflate.h>

namespace piola {
namespace {

constexpr std::size_t block = std::size_t{1} << 20;  // bytes read at once

std::string trailer_text(std::uint32_t check_sum, std::uint64_t bytes) {
  return fmt::format("piola seal: CRC-32 {:08x} over {:020} bytes\n", check_sum, bytes);
}

// Bytes are polynomials over {0, 1}; a check sum is the rest of a division by a fixed one. Its highest bit is the
// coefficient of x^0, its lowest that of x^31.
constexpr std::uint32_t divisor = 0xedb88320, one = 0x80000000, x_to_the_8 = 0x00800000;

/// The rest of a product of two.
std::uint32_t product(std::uint32_t a, std::uint32_t b) {
  std::uint32_t sum = 0;
  for (std::uint32_t bit = one; bit != 0; bit >>= 1) {
    if ((a & bit) != 0) sum ^= b;
    b = (b >> 1) ^ ((b & 1) != 0 ? divisor : 0);  // times x
  }
  return sum;
}

/// Factor, modulo the polynomial, by which `bytes` further bytes multiply the check sum of all previous ones.
std::uint32_t shift_by(std::uint64_t bytes) {
  std::uint32_t power = x_to_the_8, shift = one;
  for (; bytes != 0; bytes >>= 1) {
    if ((bytes & 1) != 0) shift = product(shift, power);
    power = product(power, power);
  }
  return shift;
}

constexpr std::string_view trailer_start = "piola seal: ";
std::size_t const trailer_length = trailer_text(0, 0).size();

}  // namespace

void CheckSum::add(std::span<std::byte const> bytes) { value_ = libdeflate_crc32(value_, bytes.data(), bytes.size()); }

void CheckSum::add(std::string_view text) { add(std::as_bytes(std::span(text.data(), text.size()))); }

void CheckSum::add(std::uint32_t check_sum, std::uint64_t bytes) {
  value_ = product(value_, shift_by(bytes)) ^ check_sum;
}

std::string checksum_trailer_of(CheckSum const& sum, std::uint64_t bytes) { return trailer_text(sum.value(), bytes); }

bool has_checksum_trailer(std::filesystem::path const& path) {
  std::string trailer(trailer_length, '\0');
  if (!FileToRead(path).problem().empty()) return false;
  std::ifstream file(path, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(trailer_length), std::ios::end);
  file.read(trailer.data(), static_cast<std::streamsize>(trailer_length));
  return file && trailer.starts_with(trailer_start);
}

void verify_checksum_trailer(std::filesystem::path const& path) {
  FileToRead file(path);
  if (file.size() == 0)
    throw FileError(fmt::format("{}: cannot be read - it is missing, empty or not a file", path.string()));
  auto const content = file.size() - std::min<std::uint64_t>(file.size(), trailer_length);
  CheckSum sum;
  std::vector<char> buffer(std::min<std::uint64_t>(content, block));
  for (std::uint64_t left = content; left > 0;) {
    auto const part = file.read(std::span(buffer).first(std::min<std::uint64_t>(left, block)));
    if (part == 0) break;
    sum.add(std::string_view(buffer.data(), part));
    left -= part;
  }
  std::string trailer(trailer_length, '\0');
  if (file.read(trailer) < trailer_length || !trailer.starts_with(trailer_start)) {
    throw FileError(fmt::format(
        "{}: does not end with its check sum - the file is cut off or was written by another program", path.string()));
  }
  if (trailer != trailer_text(sum.value(), content)) {
    throw FileError(
        fmt::format("{}: does not have the check sum it was written with - the file is damaged", path.string()));
  }
}

}  // namespace piola
