// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

namespace bricks {

/// Number of bricks that are handled at once: -DBRICKS_WIDTH=1 compiles the loop over single bricks, to compare with.
#if defined(BRICKS_WIDTH)
inline constexpr std::ptrdiff_t width = BRICKS_WIDTH;
#elif defined(__AVX512F__)
inline constexpr std::ptrdiff_t width = 8;
#else
inline constexpr std::ptrdiff_t width = 4;
#endif
static_assert(width == 1 || width == 2 || width == 4 || width == 8);

/// One value for each of `width` bricks.
typedef double Pack __attribute__((vector_size(width * sizeof(double))));

inline Pack load(double const* at) {
  Pack p;
  std::memcpy(&p, at, sizeof p);
  return p;
}
inline void store(double* at, Pack p) { std::memcpy(at, &p, sizeof p); }
inline Pack all(double value) { return value - Pack{}; }

/// x^(-1/3) of positive numbers, to round-off: a guess from the exponent, then Newton's method.
inline Pack power_minus_third(Pack x) {
  typedef float Floats __attribute__((vector_size(width * sizeof(float))));
  typedef int Ints __attribute__((vector_size(width * sizeof(int))));
  Floats const single = __builtin_convertvector(x, Floats);
  Ints bits;
  std::memcpy(&bits, &single, sizeof bits);
  // The bits of a float, taken as an integer, are nearly linear in its logarithm.
  constexpr float one = 1065353216.0F, shift = 1.0F / 3.0F, fit = 300000.0F;
  Ints const guess =
      __builtin_convertvector((one * (1 + shift) - fit) - shift * __builtin_convertvector(bits, Floats), Ints);
  Floats start;
  std::memcpy(&start, &guess, sizeof start);
  Pack y = __builtin_convertvector(start, Pack);
  for (int k = 0; k < 4; ++k) y = y * (4.0 - x * y * y * y) * (1.0 / 3.0);
  return y;
}

struct Material {
  double density = 0;         ///< kg/m^3
  double youngs_modulus = 0;  ///< Pa
  double poissons_ratio = 0;
  double mu() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }
  double kappa() const { return youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }
};

struct Box {
  std::array<double, 3> low{}, high{};
};

/// Nodes of a box of equal bricks. Node (i, j, k) stands at i + j row + k layer; rows are padded so that packs of the
/// last row do not reach into the next layer. A brick has the index of its lowest node.
struct Mesh {
  std::array<std::ptrdiff_t, 3> cells{};
  std::array<double, 3> spacing{}, low{};
  std::ptrdiff_t row = 0, layer = 0, size = 0;
  std::vector<double> active;                   ///< 1 where a brick begins, else 0
  std::vector<double> mass;                     ///< lumped, kg; 0 at padding
  std::array<std::vector<double>, 3> x, v, f;   ///< m, m/s (half a step back), N (minus the internal force)
  std::array<std::vector<double>, 3> mobility;  ///< 1/mass, or 0 where a component is held

  Mesh(Box const& box, std::array<std::ptrdiff_t, 3> const& count, double density) : cells(count), low(box.low) {
    row = std::max(cells[0] + 1, width);
    layer = row * (cells[1] + 1);
    size = layer * (cells[2] + 1);
    auto const padded = static_cast<std::size_t>(size + width);
    active.assign(padded, 0);
    mass.assign(padded, 0);
    for (std::size_t c = 0; c < 3; ++c) {
      spacing[c] = (box.high[c] - box.low[c]) / static_cast<double>(cells[c]);
      for (auto* field : {&x[c], &v[c], &f[c], &mobility[c]}) field->assign(padded, 0);
    }
    double const corner = density * spacing[0] * spacing[1] * spacing[2] / 8;
    for_each_node([&](std::size_t n, std::array<std::ptrdiff_t, 3> const& at) {
      bool begins = true;
      mass[n] = corner;
      for (std::size_t c = 0; c < 3; ++c) {
        x[c][n] = place(at[c], c);
        if (at[c] > 0 && at[c] < cells[c]) mass[n] *= 2;
        begins = begins && at[c] < cells[c];
      }
      if (begins) active[n] = 1;
      for (auto& m : mobility) m[n] = 1 / mass[n];
    });
  }

  double place(std::ptrdiff_t at, std::size_t axis) const {
    return low[axis] + static_cast<double>(at) * spacing[axis];
  }
  template <class Do>
  void for_each_node(Do const& act) const {
    for (std::ptrdiff_t k = 0; k <= cells[2]; ++k) {
      for (std::ptrdiff_t j = 0; j <= cells[1]; ++j) {
        for (std::ptrdiff_t i = 0; i <= cells[0]; ++i)
          act(static_cast<std::size_t>(i + j * row + k * layer), std::array{i, j, k});
      }
    }
  }
};

}  // namespace bricks
