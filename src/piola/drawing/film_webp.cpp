// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/drawing/film_encoders.hpp"
#include "piola/output/atomic_file.hpp"
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <webp/encode.h>
#include <webp/mux.h>

namespace piola {
namespace {

/// Pictures of a film as libwebp takes them: one number per pixel.
struct WebpPicture {
  WebPPicture picture;
  explicit WebpPicture(Image const& image) {
    good = WebPPictureInit(&picture) != 0;
    picture.use_argb = 1;
    picture.width = image.width;
    picture.height = image.height;
    good = good && WebPPictureAlloc(&picture) != 0;
    for (int y = 0; good && y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        Colour const c = image.at(x, y);
        auto const at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
        std::uint32_t const alpha = image.alpha.empty() ? 255u : image.alpha[at];
        picture.argb[static_cast<std::ptrdiff_t>(y) * picture.argb_stride + x] =
            alpha << 24 | static_cast<std::uint32_t>(c[0]) << 16 | static_cast<std::uint32_t>(c[1]) << 8 | c[2];
      }
  }
  ~WebpPicture() { WebPPictureFree(&picture); }
  WebpPicture(WebpPicture const&) = delete;
  WebpPicture& operator=(WebpPicture const&) = delete;
  bool good = false;
};

class WebpEncoder : public Film::Encoder {
 public:
  WebpEncoder(std::filesystem::path const& path, int width, int height, FilmPace const& pace)
      : path_(path), pace_(pace) {
    WebPAnimEncoderOptions options;
    good_ = WebPAnimEncoderOptionsInit(&options) != 0 && WebPConfigInit(&config_) != 0;
    constexpr float quality = 85;  // letters stay sharp; a fifth of the size of PNG
    config_.quality = quality;
    encoder_ = good_ ? WebPAnimEncoderNew(width, height, &options) : nullptr;
  }
  ~WebpEncoder() override { WebPAnimEncoderDelete(encoder_); }
  WebpEncoder(WebpEncoder const&) = delete;
  WebpEncoder& operator=(WebpEncoder const&) = delete;

  void add(Image const& picture) override {
    WebpPicture frame(picture);
    if (!encoder_ || !frame.good || !WebPAnimEncoderAdd(encoder_, &frame.picture, milliseconds(count_), &config_))
      fail();
    count_ += 1;
  }

  void finish() override {
    int const end = milliseconds(count_) + static_cast<int>(std::lround(1000 * pace_.hold_end));
    WebPData data;
    WebPDataInit(&data);
    if (!encoder_ || !WebPAnimEncoderAdd(encoder_, nullptr, end, nullptr) ||
        !WebPAnimEncoderAssemble(encoder_, &data)) {
      WebPDataClear(&data);
      fail();
    }
    std::vector<std::byte> bytes(data.size);
    if (data.size > 0) std::memcpy(bytes.data(), data.bytes, data.size);
    WebPDataClear(&data);
    write_whole_file(path_, bytes);
  }

 private:
  int milliseconds(double pictures) const {
    return static_cast<int>(std::lround(1000 * pictures / pace_.pictures_per_second));
  }
  [[noreturn]] void fail() const {
    char const* const why = encoder_ ? WebPAnimEncoderGetError(encoder_) : "no memory";
    throw FileError(fmt::format("{}: cannot be made ({}) - choose a smaller or a shorter film", path_.string(), why));
  }

  std::filesystem::path path_;
  FilmPace pace_;
  WebPConfig config_{};
  WebPAnimEncoder* encoder_ = nullptr;
  double count_ = 0;
  bool good_ = false;
};

}  // namespace

std::unique_ptr<Film::Encoder> make_webp(std::filesystem::path const& path, int width, int height,
                                         FilmPace const& pace) {
  if (width > WEBP_MAX_DIMENSION || height > WEBP_MAX_DIMENSION)
    throw InputError(
        fmt::format("{}: pictures of {} x {} pixels are too large (allowed in .webp: {}) - choose a smaller size",
                    path.string(), width, height, WEBP_MAX_DIMENSION));
  return std::make_unique<WebpEncoder>(path, width, height, pace);
}

}  // namespace piola
