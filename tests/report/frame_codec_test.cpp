// SPDX-License-Identifier: Apache-2.0
#include "piola/report/frame_codec.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <stdexcept>

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

TEST(Lattice, GivesBackPlacesToHalfACell) {
  Lattice const lattice = Lattice::of({-3, 0, 5}, {3, 0.1, 5}, 14);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 10'000; ++k) {
    double const x = -3 + 6 * share(random), y = 0.1 * share(random);
    EXPECT_LE(std::abs(lattice.value(lattice.code(x, 0), 0) - x), 6.0 / (1 << 14));
    EXPECT_LE(std::abs(lattice.value(lattice.code(y, 1), 1) - y), 0.1 / (1 << 14));
  }
  EXPECT_EQ(lattice.value(lattice.code(5, 2), 2), 5);  // a plane has one cell
  EXPECT_EQ(lattice.value(lattice.code(-3, 0), 0), -3);
  EXPECT_NEAR(lattice.value(lattice.code(3, 0), 0), 3, 1e-12);
}

TEST(Lattice, HasNoPlaceForWhatIsOutsideOrNotFinite) {
  for (int const bits : {2, 12, 16}) {
    Lattice const lattice = Lattice::of({0, 0, 0}, {1, 1, 1}, bits);
    for (double const x : {none, std::numeric_limits<double>::infinity(), -1e300, 1e300, -1.0, 2.0}) {
      EXPECT_EQ(lattice.code(x, 0), lattice.missing()) << x;
      EXPECT_TRUE(std::isnan(lattice.value(lattice.code(x, 0), 0)));
    }
    EXPECT_NE(lattice.code(1, 0), lattice.missing());
  }
}

TEST(ByteScale, SaturatesAndKnowsWhatIsNoNumber) {
  ByteScale const scale{-2, 6};
  EXPECT_EQ(scale.code(none), 0);
  EXPECT_TRUE(std::isnan(scale.value(0)));
  EXPECT_EQ(scale.code(-100), 1);
  EXPECT_EQ(scale.code(100), 255);
  EXPECT_EQ(scale.value(255), 6);
  for (double v = -2; v <= 6; v += 0.01) EXPECT_LE(std::abs(scale.value(scale.code(v)) - v), 0.5 * 8 / 254 + 1e-12);
  EXPECT_EQ((ByteScale{3, 3}.code(3)), 1);
}

TEST(FrameCodec, GivesBackEveryCode) {
  for (std::size_t const particles : {0u, 1u, 2u, 777u})
    for (std::size_t const fields : {0u, 1u, 3u})
      for (int const bits : {2, 14, 16}) {
        FrameCodec in, out;
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
  FrameCodec in, out;
  for (int k = 0; k < 10; ++k) in.encode(some_frame(50, 2, k, 14), k == 0);
  FrameCodes const key = some_frame(50, 2, 10, 14), next = some_frame(50, 2, 11, 14);
  auto const first = in.encode(key, true), second = in.encode(next, false);
  EXPECT_EQ(out.decode(first, 50, 2, true).x, key.x);
  EXPECT_EQ(out.decode(second, 50, 2, false).fields, next.fields);
}

TEST(FrameCodec, RefusesBytesOfAnotherFrame) {
  FrameCodec out;
  EXPECT_THROW(out.decode(std::vector<std::uint8_t>(48), 7, 1, true), std::invalid_argument);
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
