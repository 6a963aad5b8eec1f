// SPDX-License-Identifier: Apache-2.0
#include "piola/report/frame_codec.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace piola::report {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Particles that swing, each in its own way, with a few that get lost.
FrameCodes some_frame(std::size_t particles, std::size_t fields, int number, int bits) {
  std::mt19937 random(static_cast<unsigned>(number));
  Lattice const lattice = Lattice::of({0, 0, 0}, {1, 1, 1}, bits);
  FrameCodes frame;
  frame.fields.resize(fields);
  for (std::size_t i = 0; i < particles; ++i) {
    double const phase = 0.1 * static_cast<double>(i) + 0.3 * number;
    for (std::size_t c = 0; c < 3; ++c) {
      double const x = 0.5 + 0.5 * std::sin(phase * static_cast<double>(c + 1));
      frame.x[c].push_back(lattice.code(random() % 50 == 0 ? none : x, c));
    }
    for (auto& values : frame.fields) values.push_back(static_cast<std::uint8_t>(random()));
  }
  return frame;
}

double value_of(Lattice const& lattice, std::uint16_t code, std::size_t axis) {
  return code == lattice.missing() ? none : lattice.low[axis] + code * lattice.step[axis];
}

double value_of(ByteScale const& scale, std::uint8_t code) {
  return code == 0 ? none : scale.low + (code - 1) * (scale.high - scale.low) / 254;
}

/// Inverse of FrameCodec, as in the script of the page.
class Decoder {
 public:
  FrameCodes decode(std::vector<std::uint8_t> const& bytes, std::size_t particles, std::size_t fields, bool key) {
    if (key) known_ = 0;
    FrameCodes frame;
    for (std::size_t c = 0; c < 3; ++c) {
      int residual = 0;
      for (std::size_t i = 0; i < particles; ++i) {
        std::size_t const at = 2 * c * particles + i;
        int const folded = bytes[at] | bytes[at + particles] << 8;
        residual += folded >> 1 ^ (folded & 1 ? 0xFFFF : 0);
        int const expected = known_ == 0 ? 0 : known_ == 1 ? last_.x[c][i] : 2 * last_.x[c][i] - before_.x[c][i];
        frame.x[c].push_back(static_cast<std::uint16_t>(residual + expected));
      }
    }
    for (std::size_t f = 0; f < fields; ++f) {
      auto& values = frame.fields.emplace_back();
      for (std::size_t i = 0; i < particles; ++i) {
        int const from = known_ > 0 ? last_.fields[f][i] : i > 0 ? values[i - 1] : 0;
        values.push_back(static_cast<std::uint8_t>(bytes[(6 + f) * particles + i] + from));
      }
    }
    before_ = last_;
    last_ = frame;
    known_ = std::min(known_ + 1, 2);
    return frame;
  }

 private:
  int known_ = 0;  ///< frames since the key frame, at most two
  FrameCodes last_, before_;
};

TEST(Lattice, GivesBackPlacesToHalfACell) {
  Lattice const lattice = Lattice::of({-3, 0, 5}, {3, 0.1, 5}, 14);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 10'000; ++k) {
    double const x = -3 + 6 * share(random), y = 0.1 * share(random);
    EXPECT_LE(std::abs(value_of(lattice, lattice.code(x, 0), 0) - x), 6.0 / (1 << 14));
    EXPECT_LE(std::abs(value_of(lattice, lattice.code(y, 1), 1) - y), 0.1 / (1 << 14));
  }
  EXPECT_EQ(value_of(lattice, lattice.code(5, 2), 2), 5);  // a plane has one cell
  EXPECT_EQ(value_of(lattice, lattice.code(-3, 0), 0), -3);
  EXPECT_NEAR(value_of(lattice, lattice.code(3, 0), 0), 3, 1e-12);
}

TEST(Lattice, HasNoPlaceForWhatIsOutsideOrNotFinite) {
  for (int const bits : {2, 12, 16}) {
    Lattice const lattice = Lattice::of({0, 0, 0}, {1, 1, 1}, bits);
    for (double const x : {none, std::numeric_limits<double>::infinity(), -1e300, 1e300, -1.0, 2.0}) {
      EXPECT_EQ(lattice.code(x, 0), lattice.missing()) << x;
      EXPECT_TRUE(std::isnan(value_of(lattice, lattice.code(x, 0), 0)));
    }
    EXPECT_NE(lattice.code(1, 0), lattice.missing());
  }
}

TEST(ByteScale, SaturatesAndKnowsWhatIsNoNumber) {
  ByteScale const scale{-2, 6};
  EXPECT_EQ(scale.code(none), 0);
  EXPECT_TRUE(std::isnan(value_of(scale, 0)));
  EXPECT_EQ(scale.code(-100), 1);
  EXPECT_EQ(scale.code(100), 255);
  EXPECT_EQ(value_of(scale, 255), 6);
  for (double v = -2; v <= 6; v += 0.01) EXPECT_LE(std::abs(value_of(scale, scale.code(v)) - v), 0.5 * 8 / 254 + 1e-12);
  EXPECT_EQ((ByteScale{3, 3}.code(3)), 1);
}

TEST(FrameCodec, GivesBackEveryCode) {
  for (std::size_t const particles : {0u, 1u, 2u, 777u})
    for (std::size_t const fields : {0u, 1u, 3u})
      for (int const bits : {2, 14, 16}) {
        FrameCodec in;
        Decoder out;
        for (int k = 0; k < 23; ++k) {
          bool const key = k % FrameCodec::key_every == 0;
          FrameCodes const frame = some_frame(particles, fields, k, bits);
          auto const bytes = in.encode(frame, key);
          FrameCodes const back = out.decode(bytes, particles, fields, key);
          ASSERT_EQ(back.x, frame.x) << particles << " " << fields << " " << bits << " " << k;
          ASSERT_EQ(back.fields, frame.fields);
        }
      }
}

TEST(FrameCodec, NeedsNothingFromBeforeAKeyFrame) {
  FrameCodec in;
  Decoder out;
  for (int k = 0; k < 10; ++k) in.encode(some_frame(50, 2, k, 14), k == 0);
  FrameCodes const key = some_frame(50, 2, 10, 14), next = some_frame(50, 2, 11, 14);
  auto const first = in.encode(key, true), second = in.encode(next, false);
  EXPECT_EQ(out.decode(first, 50, 2, true).x, key.x);
  EXPECT_EQ(out.decode(second, 50, 2, false).fields, next.fields);
}

TEST(FrameCodec, MakesSteadyMotionSmall) {
  constexpr std::size_t n = 10'000;
  FrameCodec coder;
  std::mt19937 random(3);
  FrameCodes start;
  for (auto& x : start.x)
    for (std::size_t i = 0; i < n; ++i) x.push_back(static_cast<std::uint16_t>(random() % 9000));
  std::size_t key = 0, other = 0;
  for (int k = 0; k < 4; ++k) {
    FrameCodes frame = start;
    for (auto& x : frame.x)
      for (std::size_t i = 0; i < n; ++i)
        x[i] = static_cast<std::uint16_t>(x[i] + static_cast<std::size_t>(k) * (i % 13));
    (k == 0 ? key : other) = packed_text(coder.encode(frame, k == 0)).size();
  }
  EXPECT_LT(other, key / 50);  // linear in time: nothing is left of it
}

TEST(Base64, IsAsItsStandardHasIt) {
  auto const of = [](std::string const& text) { return base64(std::vector<std::uint8_t>(text.begin(), text.end())); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace piola::report
