// SPDX-License-Identifier: Apache-2.0
#include "piola/report/frame_codec.hpp"
#include <libdeflate.h>
#include <memory>
#include <new>

namespace piola::report {

std::string base64(std::span<std::uint8_t const> bytes) {
  constexpr char const* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  for (std::size_t i = 0, out = 0; i < bytes.size(); i += 3, out += 4) {
    std::size_t const rest = bytes.size() - i;
    std::uint32_t const three = static_cast<std::uint32_t>(bytes[i] << 16) |
                                static_cast<std::uint32_t>(rest > 1 ? bytes[i + 1] << 8 : 0) |
                                static_cast<std::uint32_t>(rest > 2 ? bytes[i + 2] : 0);
    for (std::size_t k = 0; k < 4 && k <= rest; ++k) text[out + k] = letters[(three >> (18 - 6 * k)) & 63];
  }
  return text;
}

std::string packed_text(std::span<std::uint8_t const> bytes) {
  constexpr int level = 6;  // higher ones take twice the time for one per cent
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> const compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::vector<std::uint8_t> packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
  return base64(packed);
}

}  // namespace piola::report
