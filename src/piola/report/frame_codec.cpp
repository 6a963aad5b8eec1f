// SPDX-License-Identifier: Apache-2.0
#include "piola/report/frame_codec.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace piola::report {
namespace {

constexpr std::uint16_t fold(std::uint16_t difference) {
  return static_cast<std::uint16_t>((difference << 1) ^ (difference >= 0x8000 ? 0xFFFF : 0));
}

/// Folded differences to the entry before, low bytes, then high bytes.
template <class Residual>
void put_differences(std::vector<std::uint8_t>& bytes, std::size_t count, Residual const& residual) {
  std::size_t const at = bytes.size();
  bytes.resize(at + 2 * count);
  std::uint16_t before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint16_t const now = residual(i), folded = fold(static_cast<std::uint16_t>(now - before));
    bytes[at + i] = static_cast<std::uint8_t>(folded & 0xFF);
    bytes[at + count + i] = static_cast<std::uint8_t>(folded >> 8);
    before = now;
  }
}

}  // namespace

Lattice Lattice::of(std::array<double, 3> const& low, std::array<double, 3> const& high, int bits) {
  PIOLA_EXPECTS(bits >= 2 && bits <= 16);
  Lattice lattice{.low = low, .bits = bits};
  for (std::size_t c = 0; c < 3; ++c) lattice.step[c] = (high[c] - low[c]) / (lattice.missing() - 1);
  return lattice;
}

std::uint16_t Lattice::code(double value, std::size_t axis) const {
  double const at = step[axis] > 0 ? std::round((value - low[axis]) / step[axis]) : value - low[axis];
  return at >= 0 && at < missing() ? static_cast<std::uint16_t>(at) : missing();
}

std::uint8_t ByteScale::code(double value) const {
  if (!std::isfinite(value)) return 0;
  if (!(high > low)) return 1;
  double const at = std::round((value - low) / (high - low) * 254);
  return static_cast<std::uint8_t>(1 + (at < 0 ? 0 : at > 254 ? 254 : at));
}

std::uint16_t FrameCodec::expected(std::size_t axis, std::size_t i) const {
  if (known_ == 0) return 0;
  if (known_ == 1) return last_.x[axis][i];
  return static_cast<std::uint16_t>(2 * last_.x[axis][i] - before_.x[axis][i]);
}

std::vector<std::uint8_t> FrameCodec::encode(FrameCodes const& frame, bool key) {
  PIOLA_EXPECTS(frame.x[1].size() == frame.x[0].size() && frame.x[2].size() == frame.x[0].size());
  std::size_t const n = frame.x[0].size();
  if (key) known_ = 0;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(n * (6 + frame.fields.size()));
  for (std::size_t c = 0; c < 3; ++c)
    put_differences(bytes, n,
                    [&](std::size_t i) { return static_cast<std::uint16_t>(frame.x[c][i] - expected(c, i)); });
  for (std::size_t f = 0; f < frame.fields.size(); ++f)
    for (std::size_t i = 0; i < n; ++i) {
      std::uint8_t const from = known_ > 0 ? last_.fields[f][i] : i > 0 ? frame.fields[f][i - 1] : std::uint8_t{0};
      bytes.push_back(static_cast<std::uint8_t>(frame.fields[f][i] - from));
    }
  before_ = std::move(last_);
  last_ = frame;
  known_ = key ? 1 : std::min(known_ + 1, 2);
  return bytes;
}

std::vector<std::uint8_t> encode_numbers(std::span<std::uint16_t const> numbers) {
  std::vector<std::uint8_t> bytes;
  put_differences(bytes, numbers.size(), [&](std::size_t i) { return numbers[i]; });
  return bytes;
}

}  // namespace piola::report
