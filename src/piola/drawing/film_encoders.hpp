// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/film.hpp"

namespace piola {

struct Film::Encoder {
  virtual ~Encoder() = default;
  virtual void add(Image const& picture) = 0;
  virtual void finish() = 0;
};

std::unique_ptr<Film::Encoder> make_webp(std::filesystem::path const& path, int width, int height,
                                         FilmPace const& pace);
std::unique_ptr<Film::Encoder> make_mp4(std::filesystem::path const& path, int width, int height, FilmPace const& pace);

}  // namespace piola
