// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/render.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/film.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/output/frames.hpp"
#include "piola/pictures/case_scene.hpp"
#include "piola/pictures/frame_pictures.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace piola {
namespace {

namespace fs = std::filesystem;

/// The way to draw bodies that this word of an option names.
Representation representation_of(std::string const& word) {
  auto const found = std::find(representation_words.begin(), representation_words.end(), word);
  if (found == representation_words.end())
    throw InputError(fmt::format("--as: {} is no way to draw bodies (allowed: {}) - choose one of these", word,
                                 fmt::join(representation_words, ", ")));
  return static_cast<Representation>(found - representation_words.begin());
}

/// Applies the options "WORD" and "BODY=WORD".
void draw_bodies_as(std::vector<std::string> const& options, std::vector<BodySpec> const& bodies,
                    Appearance& appearance) {
  std::vector<std::string> names;
  for (BodySpec const& body : bodies) names.push_back(body.name);
  std::size_t const count = std::max<std::size_t>(bodies.size(), 1);
  for (std::string const& one : options) {
    auto const sign = one.find('=');
    std::string const body = one.substr(0, sign);
    Representation const as = representation_of(sign == std::string::npos ? one : one.substr(sign + 1));
    if (sign == std::string::npos) {
      appearance.as.assign(count, as);
      continue;
    }
    auto const found = std::find(names.begin(), names.end(), body);
    if (found == names.end())
      throw InputError(
          fmt::format("--as: there is no body '{}' (allowed: {}) - name one of these", body,
                      names.empty() ? "none without a case.toml" : fmt::format("{}", fmt::join(names, ", "))));
    appearance.as.resize(count, Representation::automatic);
    appearance.as[static_cast<std::size_t>(found - names.begin())] = as;
  }
}

/// The pictures of a case with the requested fields, range and view.
PicturesSpec as_asked(CaseSpec const& spec, RenderOptions const& options) {
  PicturesSpec pictures = spec.output.pictures;
  auto const change = [&](PictureSpec& picture) {
    for (auto const& change_one : options.look) change_one(picture);
    draw_bodies_as(options.as, spec.bodies, picture.appearance);
    if (options.panels) return;
    picture.field = options.field;
    picture.component = options.component;
    picture.range = options.range;
  };
  change(pictures);
  if (options.panels && pictures.panels.empty())
    throw InputError("--panels: the case of the run has none - add [[output.pictures.panel]] to its case.toml");
  if (!options.panels) pictures.panels.clear();
  for (PictureSpec& panel : pictures.panels) change(panel);
  if (options.more_fields.empty()) return pictures;
  pictures.panels.assign(1 + options.more_fields.size(), pictures);
  for (std::size_t k = 0; k < pictures.panels.size(); ++k) {
    PictureSpec& panel = pictures.panels[k];
    if (k > 0) panel.field = options.more_fields[k - 1], panel.component.clear();
    panel.caption = title_of(spec.title, panel);
  }
  pictures.width = pictures.height = pictures.columns = 0;  // each panel has the size of a picture
  return pictures;
}

std::vector<std::size_t> chosen(RenderOptions const& options, std::size_t count) {
  if (options.last && count > 0) return {count - 1};
  std::vector<std::size_t> numbers = options.only;
  for (std::size_t const k : numbers) {
    if (k < count) continue;
    throw InputError(
        fmt::format("--frame: there is no frame {} (allowed: 0 to {}) - choose one of these", k, count - 1));
  }
  for (std::size_t k = 0; options.only.empty() && k < count; k += std::max<std::size_t>(options.every, 1))
    numbers.push_back(k);
  return numbers;
}

/// The pictures of the run in a folder.
FramePictures open_pictures(fs::path const& folder, RenderOptions const& options) {
  if (!fs::exists(folder / "frames.hdf.series"))
    throw InputError(fmt::format(
        "{}: has no frames to draw (no frames.hdf.series) - run the case with --set output.frames.every=TIME",
        folder.string()));
  PicturedRun run = PicturedRun::in(folder);
  run.spec.output.pictures = as_asked(run.spec, options);
  FramePictures pictures(std::move(run));
  for (auto const& [time, frame] : list_frames(folder)) pictures.add(frame, pictures.count());
  if (pictures.count() == 0)
    throw InputError(fmt::format("{}: has no frames to draw - let the run write some", folder.string()));
  return pictures;
}

/// Pictures of one run, or of several runs in adjacent panels, by the frame numbers of the first.
class Pictures {
 public:
  Pictures(fs::path const& folder, RenderOptions const& options) {
    std::vector<fs::path> folders{folder};
    folders.insert(folders.end(), options.beside.begin(), options.beside.end());
    for (fs::path const& one : folders) runs_.push_back(open_pictures(one, options));
    for (int pass = 0; pass < 2; ++pass)  // the first run has the range and scale of all after the first pass
      for (std::size_t k = 1; k < runs_.size(); ++k) runs_[0].share_with(runs_[k]);
    std::set<std::string> titles;
    for (FramePictures const& run : runs_) titles.insert(run.title());
    for (std::size_t k = 0; k < runs_.size(); ++k)
      names_.push_back(titles.size() == runs_.size() ? runs_[k].title() : name_of(folders[k]));
  }
  FramePictures const& first() const { return runs_[0]; }

  Image picture(std::size_t number) const {
    if (runs_.size() == 1) return first().picture(number);
    double const time = first().time(number);
    std::vector<FramePictures const*> runs;
    std::vector<std::size_t> frames;
    for (FramePictures const& run : runs_) {
      runs.push_back(&run);
      frames.push_back(run.nearest(time));
    }
    return FramePictures::sheet(runs, frames, names_, {"", "t = " + first().time_format().text(time)});
  }

 private:
  static std::string name_of(fs::path const& folder) {
    fs::path const whole = fs::absolute(folder).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  }
  std::vector<FramePictures> runs_;
  std::vector<std::string> names_;
};

/// `count` of the frames, those nearest to equal steps of time; a frame may be there several times.
std::vector<std::size_t> at_equal_steps(FramePictures const& renderer, std::vector<std::size_t> numbers,
                                        std::size_t count) {
  std::sort(numbers.begin(), numbers.end());
  double const first = renderer.time(numbers.front()), last = renderer.time(numbers.back());
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < count; ++k) {
    double const time =
        count < 2 ? last : first + (last - first) * static_cast<double>(k) / static_cast<double>(count - 1);
    out.push_back(*std::min_element(numbers.begin(), numbers.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(renderer.time(a) - time) < std::abs(renderer.time(b) - time);
    }));
  }
  return out;
}

}  // namespace

std::size_t render_film(fs::path const& folder, RenderOptions const& options, FilmOptions const& film) {
  Pictures const renderer(folder, options);
  auto const numbers = chosen(options, renderer.first().count());
  double const frames = static_cast<double>(numbers.size());
  FilmPace pace{.hold_end = film.hold_end};
  if (film.pictures_per_second) pace.pictures_per_second = *film.pictures_per_second;
  if (film.seconds && !film.pictures_per_second) pace.pictures_per_second = frames / *film.seconds;
  double const count = film.seconds ? std::max(1.0, std::round(*film.seconds * pace.pictures_per_second)) : frames;
  auto const order = at_equal_steps(renderer.first(), numbers, static_cast<std::size_t>(count));
  Image picture = renderer.picture(order.front());
  Film out(film.file, picture.width, picture.height, pace);
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k > 0 && order[k] != order[k - 1]) picture = renderer.picture(order[k]);
    out.add(picture);
  }
  out.finish();
  return order.size();
}

fs::path render_times(fs::path const& folder, RenderOptions const& options, std::vector<double> const& times) {
  Pictures const pictures(folder, options);
  fs::path const out = options.out.empty() ? folder / "pictures" : options.out;
  make_folder(out);
  fs::path path = out / pictures.first().name_of_times();
  write_png(path, pictures.first().picture_of_times(times));
  return path;
}

std::vector<fs::path> render_frames(fs::path const& folder, RenderOptions const& options) {
  Pictures const pictures(folder, options);
  fs::path const own = options.beside.empty() ? folder / "pictures" : fs::path("side-by-side");
  fs::path const out = options.out.empty() ? own : options.out;
  auto const numbers = chosen(options, pictures.first().count());
  make_folder(out);
  std::vector<fs::path> paths;
  for (std::size_t const k : numbers) {
    paths.push_back(out / pictures.first().name(k));
    write_png(paths.back(), pictures.picture(k));
  }
  return paths;
}

}  // namespace piola
