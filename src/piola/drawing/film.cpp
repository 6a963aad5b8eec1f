// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/film.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/film_encoders.hpp"
#include <fmt/format.h>

namespace piola {

Film::Film(std::filesystem::path path, int width, int height, FilmPace const& pace)
    : path_(std::move(path)), width_(width), height_(height) {
  PIOLA_EXPECTS(width > 0 && height > 0);
  PIOLA_EXPECTS(pace.pictures_per_second > 0 && pace.hold_end >= 0);
  auto const extension = path_.extension();
  if (extension == ".webp")
    encoder_ = make_webp(path_, width, height, pace);
  else if (extension == ".mp4")
    encoder_ = make_mp4(path_, width, height, pace);
  else
    throw InputError(fmt::format(
        "{}: is not the name of a film (allowed: names that end in .webp or .mp4) - choose one", path_.string()));
}

Film::~Film() = default;

void Film::add(Image const& picture) {
  PIOLA_EXPECTS(picture.width == width_ && picture.height == height_);
  encoder_->add(picture);
}

void Film::finish() { encoder_->finish(); }

}  // namespace piola
