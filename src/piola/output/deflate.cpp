// SPDX-License-Identifier: Apache-2.0
#include "piola/output/deflate.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/threads.hpp"
#include <algorithm>
#include <atomic>
#include <cstring>
#include <libdeflate.h>
#include <memory>
#include <new>
#include <thread>

namespace piola {
namespace {

constexpr int level = 1;  // higher levels take several times longer and gain a few per cent on floating-point data

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;

void group_bytes(std::span<std::byte const> in, std::span<std::byte> out, std::size_t width) {
  std::size_t const count = in.size() / width;
  for (std::size_t b = 0; b < width; ++b) {
    for (std::size_t i = 0; i < count; ++i) out[b * count + i] = in[i * width + b];
  }
}

std::vector<std::byte> deflate_one(libdeflate_compressor* compressor, std::span<std::byte const> part,
                                   std::size_t chunk, std::size_t width) {
  std::vector<std::byte> plain(chunk), shuffled(chunk);
  std::memcpy(plain.data(), part.data(), part.size());
  group_bytes(plain, shuffled, width);
  std::vector<std::byte> packed(libdeflate_zlib_compress_bound(compressor, chunk));
  packed.resize(libdeflate_zlib_compress(compressor, shuffled.data(), chunk, packed.data(), packed.size()));
  packed.shrink_to_fit();
  return packed;
}

}  // namespace

std::vector<std::vector<std::byte>> deflate_chunks(std::span<std::byte const> bytes, std::size_t chunk,
                                                   std::size_t width) {
  PIOLA_EXPECTS(width > 0 && chunk > 0 && chunk % width == 0);
  std::size_t const count = (bytes.size() + chunk - 1) / chunk;
  std::vector<std::vector<std::byte>> packed(count);
  std::size_t const workers =
      std::clamp<std::size_t>(static_cast<std::size_t>(exec_host::threads()), 1, std::max<std::size_t>(count, 1));
  std::vector<Compressor> compressors;  // made here so that a lack of memory is reported before any thread starts
  for (std::size_t w = 0; w < workers; ++w) {
    compressors.emplace_back(libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
    if (!compressors.back()) throw std::bad_alloc();
  }
  std::atomic<std::size_t> next = 0;
  auto const work = [&](std::size_t w) {
    for (std::size_t k = next++; k < count; k = next++) {
      auto const part = bytes.subspan(k * chunk, std::min(chunk, bytes.size() - k * chunk));
      packed[k] = deflate_one(compressors[w].get(), part, chunk, width);
    }
  };
  std::vector<std::jthread> threads;
  for (std::size_t w = 1; w < workers; ++w) threads.emplace_back(work, w);
  work(0);
  threads.clear();  // joins
  return packed;
}

}  // namespace piola
