// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace piola::report {

/// Whole numbers for coordinates: cells of equal size between two ends, `bits` bits each. The last number means that
/// there is none: not finite, or outside.
struct Lattice {
  std::array<double, 3> low{}, step{};  ///< m
  int bits = 14;                        ///< 2 to 16
  /// The cells of a box.
  static Lattice of(std::array<double, 3> const& low, std::array<double, 3> const& high, int bits);
  std::uint16_t missing() const { return static_cast<std::uint16_t>((1u << bits) - 1); }
  std::uint16_t code(double value, std::size_t axis) const;
};

/// One byte for the value of a field: 0 none, 1 and 255 also for all beyond the ends, linear between.
struct ByteScale {
  double low = 0, high = 0;
  std::uint8_t code(double value) const;
};

/// Codes of one state in a page; all lists have one entry per particle.
struct FrameCodes {
  std::array<std::vector<std::uint16_t>, 3> x;
  std::vector<std::vector<std::uint8_t>> fields;
};

/// Encodes frames as bytes that compress well. A key frame is independent. Other frames are differences to a prediction
/// from the previous frame, or by linear extrapolation from the previous two. Then follows the difference to the
/// particle before, signs folded into the lowest bit, low bytes of an axis before high ones. All modulo 2^16, so that
/// nothing is lost.
class FrameCodec {
 public:
  static constexpr int key_every = 10;
  /// The bytes of the next frame; it becomes a key frame if `key`, or if there are other particles than before.
  std::vector<std::uint8_t> encode(FrameCodes const& frame, bool key);

 private:
  std::uint16_t expected(std::size_t axis, std::size_t i) const;
  int known_ = 0;  ///< frames since the key frame, at most two
  FrameCodes last_, before_;
};

/// Numbers as differences to the one before, low bytes, then high bytes: for data that are constant in time.
std::vector<std::uint8_t> encode_numbers(std::span<std::uint16_t const> numbers);

/// Deflated in zlib's format, as text that a page may hold (base64). Throws std::bad_alloc.
std::string packed_text(std::span<std::uint8_t const> bytes);
std::string base64(std::span<std::uint8_t const> bytes);

}  // namespace piola::report
