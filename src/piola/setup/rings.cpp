// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/rings.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace piola {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

bool is_hollow(ShapeSpec const& shape) { return shape.inner_radius > 0; }

double circles_over(double length, double spacing) { return std::max(1.0, std::round(length / spacing)); }

/// The polar grid of a ring.
struct PolarGrid {
  double circles, spacing, around;
};

PolarGrid polar_grid(ShapeSpec const& shape) {
  double const width = shape.radius - shape.inner_radius, circles = circles_over(width, shape.spacing);
  double const spacing = width / circles, mean = (shape.radius + shape.inner_radius) / 2;
  return {circles, spacing, std::max(3.0, std::round(two_pi * mean / spacing))};
}

/// A disc as it grows: each particle represents a square of the spacing.
class Disc {
 public:
  explicit Disc(ShapeSpec const& shape)
      : shape_(shape), circles_(static_cast<int>(circles_over(shape.radius, shape.spacing))) {
    disc_.spacing = {shape.spacing, shape.spacing, 1};
    disc_.lattice = {2 * circles_ + 1, 2 * circles_ + 1, 1};
  }

  RingParticles rings() {
    add({0, 0});
    for (int i = 1; i <= circles_; ++i) add_circle(i, static_cast<int>(std::round(two_pi * i)));
    return std::move(disc_);
  }

  RingParticles lattice_with_rings() {
    std::int64_t const inner = std::max(0, circles_ - 2), limit = inner * inner;
    for (std::int64_t j = -inner; j <= inner; ++j)
      for (std::int64_t i = -inner; i <= inner; ++i)
        if (i * i + j * j < limit) add({static_cast<double>(i), static_cast<double>(j)});
    for (int i = std::max(1, circles_ - 1); i <= circles_; ++i) add_circle(i, static_cast<int>(two_pi * i));
    return std::move(disc_);
  }

 private:
  void add_circle(int radius, int count) {
    for (int k = 0; k < count; ++k) {
      double const angle = two_pi * k / count;
      add({radius * std::cos(angle), radius * std::sin(angle)});
    }
  }

  // `at` counts in spacings from the centre.
  void add(std::array<double, 2> at) {
    double const d = shape_.spacing;
    disc_.X.push_back({shape_.centre[0] + at[0] * d, shape_.centre[1] + at[1] * d, 0});
    disc_.volume.push_back(d * d);
    auto const cell = [&](double x) { return std::clamp(static_cast<int>(std::round(x)) + circles_, 0, 2 * circles_); };
    disc_.lattice_index.push_back({cell(at[0]), cell(at[1]), 0});
  }

  ShapeSpec const& shape_;
  int circles_;
  RingParticles disc_;
};

RingParticles ring(ShapeSpec const& shape) {
  PolarGrid const grid = polar_grid(shape);
  RingParticles ring;
  ring.spacing = {grid.spacing, grid.spacing, 1};
  ring.lattice = {static_cast<int>(grid.around), static_cast<int>(grid.circles), 1};
  for (int j = 0; j < ring.lattice[1]; ++j) {
    double const radius = shape.inner_radius + (j + 0.5) * grid.spacing;
    for (int i = 0; i < ring.lattice[0]; ++i) {
      double const angle = two_pi * i / grid.around;
      ring.X.push_back({shape.centre[0] + radius * std::cos(angle), shape.centre[1] + radius * std::sin(angle), 0});
      ring.lattice_index.push_back({i, j, 0});
      ring.volume.push_back(two_pi * radius * grid.spacing / grid.around);
    }
  }
  return ring;
}

}  // namespace

RingParticles ring_particles(ShapeSpec const& shape) {
  PIOLA_EXPECTS(shape.dimension == 2 && shape.arrangement != ShapeSpec::Arrangement::lattice);
  if (shape.arrangement == ShapeSpec::Arrangement::lattice_with_rings) return Disc(shape).lattice_with_rings();
  return is_hollow(shape) ? ring(shape) : Disc(shape).rings();
}

double count_ring_particles(ShapeSpec const& shape) {
  constexpr double countable = 6000;  // circles; about 1e8 particles
  if (is_hollow(shape)) {
    PolarGrid const grid = polar_grid(shape);
    return grid.circles * grid.around;
  }
  double const circles = circles_over(shape.radius, shape.spacing);
  if (circles > countable) return std::numbers::pi * circles * circles;
  if (shape.arrangement == ShapeSpec::Arrangement::lattice_with_rings)
    return static_cast<double>(ring_particles(shape).X.size());
  double count = 1;
  for (int i = 1; i <= static_cast<int>(circles); ++i) count += std::round(two_pi * i);
  return count;
}

}  // namespace piola
