// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/film.hpp"
#include "piola/base/errors.hpp"
#include "piola/output/atomic_file.hpp"
#include "support/key_words.hpp"
#include "support/temporary_folder.hpp"
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <webp/demux.h>

namespace piola {
namespace {

using test::expect_words;

/// A square that moves to the right.
Image moment(int k, bool transparent = false) {
  Image image(80, 60, {255, 255, 255});
  if (transparent) image.alpha.assign(80 * 60, 0);
  for (int y = 20; y < 40; ++y)
    for (int x = 10 * k; x < 10 * k + 20; ++x) {
      image.set(x, y, {200, 30, 30});
      if (transparent) image.alpha[static_cast<std::size_t>(80 * y + x)] = 255;
    }
  return image;
}

struct Decoded {
  int width = 0, height = 0;
  std::vector<int> ends;                            ///< ms
  std::vector<std::vector<std::uint8_t>> pictures;  ///< RGBA
};

Decoded decoded(std::filesystem::path const& path) {
  std::string const bytes = read_text_file(path);
  WebPData const data{reinterpret_cast<std::uint8_t const*>(bytes.data()), bytes.size()};
  Decoded out;
  WebPAnimDecoder* const decoder = WebPAnimDecoderNew(&data, nullptr);
  if (!decoder) return out;
  WebPAnimInfo info;
  WebPAnimDecoderGetInfo(decoder, &info);
  out.width = static_cast<int>(info.canvas_width);
  out.height = static_cast<int>(info.canvas_height);
  while (WebPAnimDecoderHasMoreFrames(decoder)) {
    std::uint8_t* pixels = nullptr;
    int end = 0;
    if (!WebPAnimDecoderGetNext(decoder, &pixels, &end)) break;
    out.ends.push_back(end);
    out.pictures.emplace_back(pixels, pixels + 4 * out.width * out.height);
  }
  WebPAnimDecoderDelete(decoder);
  return out;
}

void make_film(std::filesystem::path const& path, bool transparent = false) {
  Film film(path, 80, 60, {.pictures_per_second = 10, .hold_end = 0.5});
  for (int k = 0; k < 5; ++k) film.add(moment(k, transparent));
  film.finish();
}

TEST(Film, IsReadBackWithAllPicturesAtTheirTimes) {
  testing::TemporaryFolder const folder;
  make_film(folder / "a.webp");
  Decoded const film = decoded(folder / "a.webp");
  EXPECT_EQ(film.width, 80);
  EXPECT_EQ(film.height, 60);
  EXPECT_EQ(film.ends, (std::vector<int>{100, 200, 300, 400, 1000}));
  for (int k = 0; k < 5; ++k) {
    auto const& picture = film.pictures[static_cast<std::size_t>(k)];
    auto const at = [&](int x, int y, int c) { return picture[static_cast<std::size_t>(4 * (80 * y + x) + c)]; };
    EXPECT_GT(at(10 * k + 10, 30, 0), 170) << k;
    EXPECT_LT(at(10 * k + 10, 30, 1), 70) << k;
    EXPECT_GT(at(10 * k + 10, 50, 1), 230) << k;
  }
}

TEST(Film, IsTheSameEachTime) {
  testing::TemporaryFolder const folder;
  make_film(folder / "a.webp");
  make_film(folder / "b.webp");
  EXPECT_EQ(read_text_file(folder / "a.webp"), read_text_file(folder / "b.webp"));
}

TEST(Film, KeepsTransparency) {
  testing::TemporaryFolder const folder;
  make_film(folder / "a.webp", true);
  Decoded const film = decoded(folder / "a.webp");
  ASSERT_EQ(film.pictures.size(), 5u);
  EXPECT_EQ(film.pictures[2][3], 0);
  EXPECT_EQ(film.pictures[2][4 * (80 * 30 + 30) + 3], 255);
}

TEST(Film, IsNotThereUnlessFinished) {
  testing::TemporaryFolder const folder;
  {
    Film film(folder / "a.webp", 80, 60, {});
    film.add(moment(0));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  Film none(folder / "none.webp", 80, 60, {});
  EXPECT_THROW(none.finish(), FileError);
}

std::string refusal(std::filesystem::path const& path, int width = 80) {
  try {
    Film(path, width, 60, {});
  } catch (InputError const& error) {
    return error.what();
  }
  return "";
}

TEST(Film, SaysWhatItCannotMake) {
  expect_words(refusal("a.gif"), {"a.gif: ", "name of a film", ".webp or .mp4"});
  EXPECT_NE(refusal("a.webp", 20000).find("too large"), std::string::npos);
}

/// A program in place of ffmpeg, alone on the path, until the end of the test.
class InPlaceOfFfmpeg {
 public:
  explicit InPlaceOfFfmpeg(char const* script) : before_(std::getenv("PATH")) {
    if (script) {
      std::ofstream(folder / "ffmpeg") << "#!/bin/sh\nPATH=" << before_ << "\n" << script;
      std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
    }
    setenv("PATH", folder.path().c_str(), 1);
  }
  ~InPlaceOfFfmpeg() { setenv("PATH", before_.c_str(), 1); }
  testing::TemporaryFolder folder;

 private:
  std::string before_;
};

TEST(Film, GivesAllPicturesToFfmpeg) {
  testing::TemporaryFolder const folder;
  InPlaceOfFfmpeg const program("for last; do :; done\necho \"$@\" > \"$last\"\nwc -c >> \"$last\"\n");
  make_film(folder / "a.mp4");
  std::string const got = read_text_file(folder / "a.mp4");
  EXPECT_NE(got.find("-s 80x60 -r 10 -i -"), std::string::npos) << got;
  EXPECT_NE(got.find("yuv420p"), std::string::npos);
  EXPECT_NE(got.find("\n" + std::to_string(80 * 60 * 3 * 10) + "\n"), std::string::npos)
      << "5, and 5 more held: " << got;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "nothing else is left";
}

TEST(Film, TellsWhatFfmpegComplainsOf) {
  testing::TemporaryFolder const folder;
  for (char const* const script :
       {"echo 'no such encoder' >&2\nexit 1\n", "cat > /dev/null\necho 'no such encoder' >&2\nexit 1\n"}) {
    InPlaceOfFfmpeg const program(script);
    try {
      make_film(folder / "a.mp4");
      FAIL();
    } catch (FileError const& error) {
      EXPECT_NE(std::string(error.what()).find("(no such encoder)"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
  InPlaceOfFfmpeg const nothing(nullptr);
  EXPECT_NE(refusal("a.mp4").find("need the program ffmpeg, which is not there"), std::string::npos);
}

}  // namespace
}  // namespace piola
