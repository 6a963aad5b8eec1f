// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// CRC-32 (IEEE 802.3) of bytes that are added in pieces. Detects every change of up to 32 consecutive bits, and any
/// other with probability 1 - 2^-32.
class CheckSum {
 public:
  void add(std::span<std::byte const> bytes);
  void add(std::string_view text);
  /// Appends `bytes` further bytes of which only the check sum is given.
  void add(std::uint32_t check_sum, std::uint64_t bytes);
  std::uint32_t value() const { return value_; }

 private:
  std::uint32_t value_ = 0;
};

/// The checksum trailer is the last line of a binary file: "piola seal: CRC-32 1a2b3c4d over 00000000000000001234
/// bytes\n". Readers of HDF5 ignore bytes after the end that a file states itself, so that files with it stay ordinary
/// HDF5 files.
std::string checksum_trailer_of(CheckSum const& sum, std::uint64_t bytes);

/// Whether the last line of a file has the form of a checksum trailer; it is not verified. False for a file that cannot
/// be read.
bool has_checksum_trailer(std::filesystem::path const& path);

/// Verifies a file; call before any other access. Throws FileError unless its last line is the trailer of all preceding
/// bytes. Reads the whole file.
void verify_checksum_trailer(std::filesystem::path const& path);

}  // namespace piola
