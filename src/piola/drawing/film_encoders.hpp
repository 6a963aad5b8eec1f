// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/film.hpp"

namespace piola {

struct Film::FilmEncoder {
  virtual ~FilmEncoder() = default;
  virtual void add(Image const& picture) = 0;
  virtual void finish() = 0;
};

std::unique_ptr<Film::FilmEncoder> make_webp(std::filesystem::path const& path, int width, int height,
                                             FilmPace const& pace);
std::unique_ptr<Film::FilmEncoder> make_mp4(std::filesystem::path const& path, int width, int height,
                                            FilmPace const& pace);

}  // namespace piola
