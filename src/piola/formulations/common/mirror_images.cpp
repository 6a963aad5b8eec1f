// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/mirror_images.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/particles/body_extents.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace piola {

MirrorImages::MirrorImages(Assembly const& assembly, std::size_t body, SlotOrder const& order,
                           std::array<double, 3> const& reach)
    : D_(assembly.particles.dimension), first_(order.slots()) {
  PIOLA_EXPECTS(body < assembly.particles.bodies.size());
  mirrored_ = std::any_of(assembly.mirrors.begin(), assembly.mirrors.end(),
                          [body](MirrorPlane const& plane) { return plane.body == body; });
  if (!mirrored_) return;
  find_places(assembly, body);
  find_planes(assembly, body, order);
  add_images(assembly, order, reach);
}

void MirrorImages::find_places(Assembly const& assembly, std::size_t body) {
  BodyExtents const ends = extents_of(assembly.particles, assembly.particles.bodies[body]);
  low_ = ends.low;
  high_ = ends.high;
  at_ = ends.at;
  tolerance_ = ends.tolerance;
}

void MirrorImages::find_planes(Assembly const& assembly, std::size_t body, SlotOrder const& order) {
  auto const& set = assembly.particles;
  Body const& b = set.bodies[body];
  for (auto const& plane : assembly.mirrors) {
    if (plane.body != body) continue;
    if (plane.axis < 0 || plane.axis >= D_)
      throw InputError(
          fmt::format("body '{}': a mirror plane across {} in {} dimension{} - take an axis that the body has", b.name,
                      "XYZ"[plane.axis], D_, D_ == 1 ? "" : "s"));
    plane_[static_cast<std::size_t>(plane.axis)][plane.upper ? 1 : 0] = {true, plane.skew};
    skew_ = skew_ || plane.skew;
  }
  multiplicity_.assign(order.id.size(), 1);
  on_plane_.assign(order.id.size(), 0);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t side = 0; side < 2; ++side) {
      if (!plane_[c][side].mirror) continue;
      Support on_plane;
      for (std::size_t k = 0; k < 3; ++k) on_plane.fix[k] = (k == c) != plane_[c][side].skew;
      for (Index i = 0; i < order.particles; ++i) {
        auto const id = order.id[static_cast<std::size_t>(i)];
        double const X = set.X[static_cast<std::size_t>(id)][c];
        if (std::abs(X - at_[c][side]) > tolerance_) continue;
        multiplicity_[static_cast<std::size_t>(i)] *= 2;
        on_plane_[static_cast<std::size_t>(i)] |= static_cast<std::uint8_t>(1U << c);
        on_plane.particles.push_back(id);
      }
      std::sort(on_plane.particles.begin(), on_plane.particles.end());
      planes_.push_back(on_plane);
    }
}

/// Identity first, then reflections and, between two planes, their products that come within reach of the body.
std::vector<MirrorImages::AxisMap> MirrorImages::maps_along(std::size_t axis, double reach) const {
  std::vector<AxisMap> maps{{1, 0, 1}};
  double const a = at_[axis][0], b = at_[axis][1];
  auto const [lower, upper] = plane_[axis];
  auto const add = [&](AxisMap const& m) {
    double const p = m.sign * a + m.shift, q = m.sign * b + m.shift;
    if (std::min(p, q) < b + reach && std::max(p, q) > a - reach) maps.push_back(m);
  };
  int const periods = lower.mirror && upper.mirror ? static_cast<int>(reach / (b - a)) + 2 : 0;
  for (int k = -periods; k <= periods; ++k) {
    double const period = 2 * k * (b - a), turn = k % 2 == 0 ? 1 : lower.turn() * upper.turn();
    if (k != 0) add({1, period, turn});
    if (lower.mirror) {
      add({-1, 2 * a + period, lower.turn() * turn});
    } else if (upper.mirror) {
      add({-1, 2 * b, upper.turn()});
    }
  }
  return maps;
}

void MirrorImages::add_images(Assembly const& assembly, SlotOrder const& order, std::array<double, 3> const& reach) {
  auto const x = maps_along(0, reach[0]), y = maps_along(1, reach[1]), z = maps_along(2, reach[2]);
  auto const place = [](AxisMap const& m, double X) { return m.sign * X + m.shift; };
  // A particle on a plane is its own image: of maps that lead to the same place along an axis the first one counts.
  auto const is_new = [&](std::vector<AxisMap> const& maps, std::size_t k, double X) {
    return std::none_of(maps.begin(), maps.begin() + static_cast<std::ptrdiff_t>(k),
                        [&](AxisMap const& m) { return std::abs(place(m, X) - place(maps[k], X)) < tolerance_; });
  };
  std::vector<Index> by_id(static_cast<std::size_t>(order.particles));
  std::iota(by_id.begin(), by_id.end(), 0);
  auto const id = [&](Index slot) { return order.id[static_cast<std::size_t>(slot)]; };
  std::sort(by_id.begin(), by_id.end(), [&](Index a, Index b) { return id(a) < id(b); });
  for (std::size_t k = 0; k < z.size(); ++k)
    for (std::size_t j = 0; j < y.size(); ++j)
      for (std::size_t i = 0; i < x.size(); ++i) {
        if (i + j + k == 0) continue;
        auto const number = static_cast<std::int32_t>(maps_.size());
        maps_.push_back({{x[i].sign, y[j].sign, z[k].sign},
                         {x[i].shift, y[j].shift, z[k].shift},
                         x[i].turn * y[j].turn * z[k].turn});
        for (Index const slot : by_id) {
          auto const& X = assembly.particles.X[static_cast<std::size_t>(id(slot))];
          std::array const image{place(x[i], X[0]), place(y[j], X[1]), place(z[k], X[2])};
          bool wanted = is_new(x, i, X[0]) && is_new(y, j, X[1]) && is_new(z, k, X[2]);
          for (std::size_t c = 0; c < 3; ++c)
            wanted = wanted && image[c] > low_[c] - reach[c] && image[c] < high_[c] + reach[c];
          if (!wanted) continue;
          particles_.X.push_back(image);
          particles_.source.push_back(slot);
          source_X_.push_back(X);
          transform_.push_back(number);
        }
      }
}

namespace {

bool is_tensor(MirrorImages::Kind kind) {
  return kind == MirrorImages::Kind::tensor || kind == MirrorImages::Kind::deformation;
}
std::size_t size_of(MirrorImages::Kind kind, std::size_t D) {
  return kind == MirrorImages::Kind::scalar ? 1 : is_tensor(kind) ? D * D : D;
}

}  // namespace

/// Adds the constant parts of x' = X' + S (x - X) of an image, and of F' = I + turn S (F - I) S, beyond the sign times
/// position (or tensor) of the source. S = turn * sign.
void MirrorImages::add_shifts(std::vector<Kind> const& values, std::vector<double>& shifts) const {
  auto const D = static_cast<std::size_t>(D_);
  for (std::size_t k = 0; k < transform_.size(); ++k) {
    auto const& map = maps_[static_cast<std::size_t>(transform_[k])];
    for (Kind const kind : values) {
      for (std::size_t c = 0; c < size_of(kind, D); ++c) {
        double shift = 0;
        if (kind == Kind::position) shift = map.shift[c] + (1 - map.turn) * map.sign[c] * source_X_[k][c];
        if (kind == Kind::deformation && c % (D + 1) == 0) shift = 1 - map.turn;
        shifts.push_back(shift);
      }
    }
  }
}

void MirrorImages::keep(std::vector<Index> const& images) {
  PIOLA_EXPECTS(images.size() <= particles_.source.size());
  std::size_t to = 0;
  for (Index const image : images) {
    auto const from = static_cast<std::size_t>(image);
    particles_.X[to] = particles_.X[from];
    particles_.source[to] = particles_.source[from];
    transform_[to] = transform_[from];
    source_X_[to++] = source_X_[from];
  }
  particles_.X.resize(to);
  particles_.source.resize(to);
  transform_.resize(to);
  source_X_.resize(to);
}

Copies const* MirrorImages::copies(int values, std::function<bool(int value, int axis)> const& turns) {
  PIOLA_EXPECTS(values >= 1 && turns != nullptr);
  if (empty()) return nullptr;
  auto table = std::make_unique<Table>();
  for (auto const& map : maps_)
    for (int value = 0; value < values; ++value) {
      double sign = 1;
      for (int axis = 0; axis < D_; ++axis)
        if (turns(value, axis)) sign *= map.sign[static_cast<std::size_t>(axis)];
      table->sign.push_back(sign);
    }
  table->copies = {first_, count(), particles_.source.data(), transform_.data(), values, table->sign.data(), nullptr};
  tables_.push_back(std::move(table));
  return &tables_.back()->copies;
}

Copies const* MirrorImages::copies(std::vector<Kind> const& values) {
  if (empty()) return nullptr;
  auto table = std::make_unique<Table>();
  auto const D = static_cast<std::size_t>(D_);
  for (auto const& map : maps_)
    for (Kind const kind : values) {
      double const turn = kind == Kind::scalar || kind == Kind::geometric_vector ? 1 : map.turn;
      for (std::size_t c = 0; c < size_of(kind, D); ++c) {
        double const sign = kind == Kind::scalar ? 1
                            : is_tensor(kind)    ? map.sign[c / D] * map.sign[c % D]
                                                 : map.sign[c];
        table->sign.push_back(turn * sign);
      }
    }
  int const per_map = maps_.empty() ? 0 : static_cast<int>(table->sign.size() / maps_.size());
  table->copies = {first_, count(), particles_.source.data(), transform_.data(), per_map, table->sign.data(), nullptr};
  if (std::find(values.begin(), values.end(), Kind::position) != values.end()) {
    add_shifts(values, table->shift);
    table->copies.shift = table->shift.data();
  }
  tables_.push_back(std::move(table));
  return &tables_.back()->copies;
}

}  // namespace piola
