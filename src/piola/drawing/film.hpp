// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/image.hpp"
#include <filesystem>
#include <memory>

namespace piola {

/// How long the pictures of a film are shown.
struct FilmPace {
  double pictures_per_second = 20;
  double hold_end = 1;  ///< how much longer the last one stays [s]
};

/// A film of pictures of one size: NAME.webp, an animated WebP file that browsers show and that repeats, or NAME.mp4,
/// which the program `ffmpeg` makes (H.264). The same pictures give the same WebP file.
class Film {
 public:
  /// Throws InputError for another name, if the pictures are too large for the kind of film, and for .mp4 if there is
  /// no program ffmpeg.
  Film(std::filesystem::path path, int width, int height, FilmPace const& pace);
  ~Film();  ///< a film that was not finished is not there
  Film(Film const&) = delete;
  Film& operator=(Film const&) = delete;

  /// Throws FileError if the picture cannot be added.
  void add(Image const& picture);
  /// Writes the file; no picture can be added afterwards. Throws FileError.
  void finish();

  struct Encoder;  ///< of one kind of film

 private:
  std::filesystem::path path_;
  int width_, height_;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace piola
