// SPDX-License-Identifier: Apache-2.0
#include "piola/report/frame_codec.hpp"
#include "piola/base/contracts.hpp"
#include <cmath>
#include <limits>
#include <stdexcept>

namespace piola::report {
namespace {

constexpr std::uint16_t fold(std::uint16_t difference) {
  return static_cast<std::uint16_t>((difference << 1) ^ (difference >= 0x8000 ? 0xFFFF : 0));
}
constexpr std::uint16_t unfold(std::uint16_t folded) {
  return static_cast<std::uint16_t>((folded >> 1) ^ ((folded & 1) != 0 ? 0xFFFF : 0));
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

double Lattice::value(std::uint16_t code, std::size_t axis) const {
  return code == missing() ? std::numeric_limits<double>::quiet_NaN() : low[axis] + code * step[axis];
}

std::uint8_t ByteScale::code(double value) const {
  if (!std::isfinite(value)) return 0;
  if (!(high > low)) return 1;
  double const at = std::round((value - low) / (high - low) * 254);
  return static_cast<std::uint8_t>(1 + (at < 0 ? 0 : at > 254 ? 254 : at));
}

double ByteScale::value(std::uint8_t code) const {
  return code == 0 ? std::numeric_limits<double>::quiet_NaN() : low + (code - 1) * (high - low) / 254;
}

std::uint16_t FrameCodec::expected(std::size_t axis, std::size_t i) const {
  if (known_ == 0) return 0;
  if (known_ == 1) return last_.x[axis][i];
  return static_cast<std::uint16_t>(2 * last_.x[axis][i] - before_.x[axis][i]);
}

void FrameCodec::keep(FrameCodes frame, bool key) {
  before_ = std::move(last_);
  last_ = std::move(frame);
  known_ = key ? 1 : known_ < 2 ? known_ + 1 : 2;
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
  keep(frame, key);
  return bytes;
}

FrameCodes FrameCodec::decode(std::span<std::uint8_t const> bytes, std::size_t particles, std::size_t fields,
                              bool key) {
  if (bytes.size() != particles * (6 + fields)) throw std::invalid_argument("a frame has another length");
  if (key) known_ = 0;
  FrameCodes frame;
  for (std::size_t c = 0; c < 3; ++c) {
    std::uint16_t residual = 0;
    for (std::size_t i = 0; i < particles; ++i) {
      std::size_t const at = 2 * c * particles + i;
      residual = static_cast<std::uint16_t>(
          residual + unfold(static_cast<std::uint16_t>(bytes[at] | (bytes[at + particles] << 8))));
      frame.x[c].push_back(static_cast<std::uint16_t>(residual + expected(c, i)));
    }
  }
  for (std::size_t f = 0; f < fields; ++f) {
    auto& values = frame.fields.emplace_back();
    for (std::size_t i = 0; i < particles; ++i) {
      std::uint8_t const from = known_ > 0 ? last_.fields[f][i] : i > 0 ? values[i - 1] : std::uint8_t{0};
      values.push_back(static_cast<std::uint8_t>(bytes[(6 + f) * particles + i] + from));
    }
  }
  keep(frame, key);
  return frame;
}

std::vector<std::uint8_t> encode_numbers(std::span<std::uint16_t const> numbers) {
  std::vector<std::uint8_t> bytes;
  put_differences(bytes, numbers.size(), [&](std::size_t i) { return numbers[i]; });
  return bytes;
}

}  // namespace piola::report
