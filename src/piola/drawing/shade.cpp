// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/shade.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

constexpr float tool_opacity = 0.45F;  // where it hides a body
constexpr float ghost_opacity = 0.12F;
constexpr float edge_darkness = 0.45F;  // what an edge leaves of the colour
constexpr float stripe_darkness = 0.35F;
constexpr Colour ground_grey{205, 208, 212}, dark_ground_grey{66, 69, 76};
constexpr Colour line_grey{115, 115, 115};

/// Linear light of sRGB's 256 steps (IEC 61966-2-1).
std::array<float, 256> const& decoding() {
  static std::array<float, 256> const table = [] {
    std::array<float, 256> t{};
    for (std::size_t k = 0; k < t.size(); ++k) {
      double const c = static_cast<double>(k) / 255;
      t[k] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return t;
  }();
  return table;
}

/// The step whose linear light is nearest, for 4096 equal parts of it.
std::array<std::uint8_t, 4097> const& encoding() {
  static std::array<std::uint8_t, 4097> const table = [] {
    std::array<std::uint8_t, 4097> t{};
    for (std::size_t k = 0; k < t.size(); ++k) {
      double const l = static_cast<double>(k) / 4096;
      double const c = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
      t[k] = static_cast<std::uint8_t>(std::lround(255 * c));
    }
    return t;
  }();
  return table;
}

float luminance(Light3 const& c) { return 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2]; }

Light3 mixed(Light3 const& a, Light3 const& b, float share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

/// Colours of one owner, tabulated for Shading::steps values of the range.
class Paint {
 public:
  Paint(SurfaceFinish const& finish, std::array<double, 2> const& range) : one_(linear(finish.colour)) {
    if (!finish.map) return;
    low_ = static_cast<float>(range[0]);
    scale_ = static_cast<float>((steps - 1) / (range[1] - range[0]));
    for (int k = 0; k < steps; ++k)
      table_.push_back(linear(finish.map(range[0] + (range[1] - range[0]) * k / (steps - 1))));
    one_ = linear(finish.map(std::numeric_limits<double>::quiet_NaN()));
  }
  Light3 const& operator()(float value) const {
    if (table_.empty() || std::isnan(value)) return one_;
    float const step = std::clamp((value - low_) * scale_ + 0.5F, 0.0F, static_cast<float>(steps - 1));
    return table_[static_cast<std::size_t>(step)];
  }

 private:
  static constexpr int steps = Shading::steps;
  std::vector<Light3> table_;
  Light3 one_;
  float low_ = 0, scale_ = 0;
};

/// A layer with what shading needs of it.
struct Prepared {
  SurfaceBuffers const* surfaces = nullptr;
  std::vector<SurfaceFinish> const* finish = nullptr;
  std::vector<Paint> paint;
  std::vector<float> open;  ///< per pixel
  float fine = 2;

  Prepared(ShadedLayer const& layer, Shading const& all)
      : surfaces(layer.surfaces), finish(&layer.finish), fine(static_cast<float>(all.fine)) {
    for (SurfaceFinish const& f : layer.finish) paint.emplace_back(f, all.range);
  }
  float depth(std::size_t sample) const { return surfaces ? surfaces->depth[sample] : -infinity; }

  /// Colour and light of a sample that shows something.
  Light3 seen(int x, int y, std::size_t pixel) const {
    std::size_t const at = surfaces->at(x, y);
    Owner const owner = surfaces->owner[at];
    SurfaceFinish const& f = (*finish)[owner];
    Light3 const colour = paint[owner](surfaces->value[at]);
    auto const light = f.flat ? Reflected{} : reflected(SurfaceBuffers::unpacked(surfaces->normal[at]));
    constexpr float dark = 0.0852F;  // linear light of L* = 35
    float const closed = open.empty() ? 0 : 1 - open[pixel];
    float factor = 1 - (luminance(colour) < dark ? 0.5F : 1.0F) * closed;
    if (is_edge(x, y, 1.5F * f.spacing)) factor *= edge_darkness;
    if (f.hatch > 0 && (x + y) % f.hatch < f.hatch / 4) factor *= stripe_darkness;
    Light3 out{};
    for (std::size_t c = 0; c < 3; ++c) out[c] = factor * (light.colour * colour[c] + light.white);
    return out;
  }

 private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  /// Whether the depth falls by more than `jump` close to it, beyond what its slope explains.
  bool is_edge(int x, int y, float jump) const {
    SurfaceBuffers const& s = *surfaces;
    if (!(jump > 0)) return false;
    std::size_t const at = s.at(x, y);
    auto const n = SurfaceBuffers::unpacked(s.normal[at]);
    int const reach = static_cast<int>(fine);
    constexpr std::array<std::array<int, 2>, 4> sides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (auto const& side : sides) {
      int const i = x + reach * side[0], j = y + reach * side[1];
      if (i < 0 || j < 0 || i >= s.width || j >= s.height) continue;
      float const fall = s.depth[at] - s.depth[s.at(i, j)];
      if (fall <= jump) continue;
      float const along = n[0] * static_cast<float>(side[0]) + n[1] * static_cast<float>(side[1]);
      float const slope = static_cast<float>(reach) * along / std::max(n[2], 0.05F);
      if (fall - std::max(slope, 0.0F) > jump) return true;
    }
    return false;
  }
};

/// The nearest depth of both layers.
std::vector<float> nearest_of(std::vector<PixelSurface> const& layers) {
  std::vector<float> depth = layers.front().depth;
  for (std::size_t k = 1; k < layers.size(); ++k)
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = std::max(depth[i], layers[k].depth[i]);
  return depth;
}

/// Colour of a sample.
struct Sampler {
  Shading const& shading;
  Prepared const &bodies, &tools, &ghosts;
  Light3 background, line, ground;

  /// Whether a sample shows the background, if only through a shade.
  bool shows_background(std::size_t at) const { return bodies.depth(at) == nothing && tools.depth(at) == nothing; }

  /// Whether the pixel with the first sample (x, y) shows the background alone, so that one sample suffices.
  bool is_empty(int x, int y) const {
    return shading.ground.empty() && !any_sample(x, y, [&](std::size_t at) {
             return bodies.depth(at) > nothing || tools.depth(at) > nothing || ghosts.depth(at) > nothing ||
                    (!shading.lines.empty() && shading.lines[at] > 0);
           });
  }

  Light3 operator()(int x, int y, std::size_t pixel) const {
    std::size_t const at = shading.bodies.surfaces->at(x, y);
    Light3 const seen = solid(x, y, pixel, at);
    bool const ghost = ghosts.depth(at) > std::max(bodies.depth(at), tools.depth(at));
    return ghost ? mixed(seen, ghosts.seen(x, y, pixel), ghost_opacity) : seen;
  }

 private:
  static constexpr float nothing = -std::numeric_limits<float>::infinity();

  /// Whether f(its place in the buffers) is true of a sample of the pixel from (x, y) on.
  template <class F>
  bool any_sample(int x, int y, F const& f) const {
    for (int k = 0; k < shading.fine * shading.fine; ++k)
      if (f(shading.bodies.surfaces->at(x + k % shading.fine, y + k / shading.fine))) return true;
    return false;
  }

  Light3 solid(int x, int y, std::size_t pixel, std::size_t at) const {
    float const body = bodies.depth(at), tool = tools.depth(at);
    if (shows_background(at)) {
      Light3 behind = background;
      if (!shading.ground.empty()) {
        GroundLight const& there = shading.ground[pixel];
        behind =
            mixed(behind, {there.light * ground[0], there.light * ground[1], there.light * ground[2]}, there.share);
      }
      return shading.lines.empty() ? behind : mixed(behind, line, shading.lines[at]);
    }
    if (body >= tool) return bodies.seen(x, y, pixel);
    if (body == nothing) return tools.seen(x, y, pixel);
    return mixed(bodies.seen(x, y, pixel), tools.seen(x, y, pixel), tool_opacity);
  }
};

/// Pixels as the mean of their samples; and on another background, if that is asked for, where it shows.
void draw_pixels(Image& image, Image* other, Sampler const& sample, Sampler const& on_other) {
  int const width = image.width, fine = sample.shading.fine;
  float const samples = static_cast<float>(fine * fine);
  auto const add = [&](Light3& sum, Light3 const& one) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += std::min(one[c], 1.0F) / samples;
  };
  exec_host::parallel_for_chunks(image.height, width * image.height, [&](Index y) {
    for (int x = 0; x < width; ++x) {
      auto const pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (sample.is_empty(x * fine, y * fine)) {
        image.set(x, y, encoded(sample(x * fine, y * fine, pixel)));
        if (other) other->set(x, y, encoded(on_other(x * fine, y * fine, pixel)));
        continue;
      }
      Light3 sum{}, sum_on_other{};
      for (int k = 0; k < fine * fine; ++k) {
        int const i = x * fine + k % fine, j = y * fine + k / fine;
        Light3 const one = sample(i, j, pixel);
        add(sum, one);
        if (!other) continue;
        bool const shows = sample.shows_background(sample.shading.bodies.surfaces->at(i, j));
        add(sum_on_other, shows ? on_other(i, j, pixel) : one);
      }
      image.set(x, y, encoded(sum));
      if (other) other->set(x, y, encoded(sum_on_other));
    }
  });
}

}  // namespace

Light3 linear(Colour colour) {
  auto const& t = decoding();
  return {t[colour[0]], t[colour[1]], t[colour[2]]};
}

Colour encoded(Light3 const& light) {
  Colour out{};
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = encoding()[static_cast<std::size_t>(std::clamp(light[c], 0.0F, 1.0F) * 4096 + 0.5F)];
  return out;
}

Reflected reflected(std::array<float, 3> const& n) {
  constexpr std::array<float, 3> key{-0.42F, -0.56F, 0.714F}, fill{0.70F, 0.10F, 0.707F};
  auto const towards = [&](std::array<float, 3> const& lamp) {
    return std::max(0.0F, n[0] * lamp[0] + n[1] * lamp[1] + n[2] * lamp[2]);
  };
  // Half-way between key light and viewer.
  constexpr std::array<float, 3> half{-0.2268F, -0.3024F, 0.9258F};
  float const shine = towards(half), shine4 = shine * shine * shine * shine, shine8 = shine4 * shine4;
  float const shine40 = shine8 * shine8 * shine8 * shine8 * shine8;
  return {0.50F + 0.42F * towards(key) + 0.16F * towards(fill), 0.10F * shine40};
}

Image shade(Shading const& shading) {
  PIOLA_EXPECTS(shading.bodies.surfaces != nullptr);
  PIOLA_EXPECTS(shading.fine >= 1 && shading.directions >= 1);
  PIOLA_EXPECTS(shading.lines.empty() || shading.lines.size() == shading.bodies.surfaces->depth.size());
  std::vector<Prepared> layers;
  std::vector<PixelSurface> surfaces;
  for (ShadedLayer const* layer : {&shading.bodies, &shading.tools, &shading.ghosts}) {
    layers.emplace_back(*layer, shading);
    if (layer->surfaces && layer != &shading.ghosts) surfaces.emplace_back(*layer->surfaces, shading.fine);
  }
  auto const around = nearest_of(surfaces);
  float const radius = shading.radius / static_cast<float>(shading.fine);
  for (std::size_t k = 0; k < surfaces.size(); ++k)
    layers[k].open = openness(surfaces[k], around, radius, shading.directions);

  bool const dark = luminance(linear(shading.background)) < 0.5F && !shading.transparent;
  auto const sampler = [&](Colour background) {
    return Sampler{shading,
                   layers[0],
                   layers[1],
                   layers[2],
                   linear(background),
                   linear(line_grey),
                   linear(dark ? dark_ground_grey : ground_grey)};
  };
  int const width = surfaces.front().width, height = surfaces.front().height;
  if (!shading.transparent) {
    Image image(width, height, shading.background);
    draw_pixels(image, nullptr, sampler(shading.background), sampler(shading.background));
    return image;
  }
  Image on_black(width, height, {}), on_white(width, height, {});
  draw_pixels(on_black, &on_white, sampler({0, 0, 0}), sampler({255, 255, 255}));
  return without_background(on_black, on_white);
}

}  // namespace piola
