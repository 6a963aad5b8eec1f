// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "mesh.hpp"
#include <algorithm>
#include <utility>

namespace bricks {

/// Results of a sweep over all bricks, in addition to the forces.
struct Watch {
  double energy = 0;      ///< strain energy, J
  double frequency2 = 0;  ///< bound of the square of the largest angular frequency, 1/s^2
};

/// Forces of eight-node bricks of a neo-Hookean solid with mean dilatation (Q1P0):
///   W = mu/2 (J^(-2/3) F:F - 3) at the 2 x 2 x 2 Gauss points + kappa/2 (theta - 1)^2, theta = mean of J over a brick
/// The forces are the exact derivative of this energy, so that central differences keep energy and momenta.
class Bricks {
 public:
  Bricks(Material const& material, Mesh const& mesh) : mu_(material.mu()), kappa_(material.kappa()) {
    density_ = material.density;
    volume_ = mesh.spacing[0] * mesh.spacing[1] * mesh.spacing[2];
    for (std::size_t c = 0; c < 3; ++c) over_spacing_[c] = 1 / mesh.spacing[c];
  }

  /// Adds minus the internal forces to mesh.f. Layers of bricks in two turns, even and odd: no two threads add to one
  /// node, and the order of the sums does not depend on their number.
  template <bool watching>
  Watch add_forces(Mesh& mesh) const {
    double energy = 0, frequency2 = 0;
    for (std::ptrdiff_t turn = 0; turn < 2; ++turn) {
      std::vector<Watch> seen(static_cast<std::size_t>(mesh.cells[2]));
#pragma omp parallel for schedule(static)
      for (std::ptrdiff_t k = turn; k < mesh.cells[2]; k += 2)
        seen[static_cast<std::size_t>(k)] = layer<watching>(mesh, k * mesh.layer);
      for (Watch const& w : seen) {
        energy += w.energy;
        frequency2 = std::max(frequency2, w.frequency2);
      }
    }
    return {energy, frequency2};
  }

 private:
  using Vec = std::array<Pack, 3>;
  /// Columns of F, or rows of derivatives of the energy by them: [axis][the four Gauss lines along it].
  using Lines = std::array<std::array<Vec, 4>, 3>;

  static Vec cross(Vec const& a, Vec const& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Pack dot(Vec const& a, Vec const& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  // Corners and Gauss points are numbered by bits: 1 high in x, 2 in y, 4 in z. A line along an axis has the two other
  // bits, closed up.
  static constexpr std::size_t line(std::size_t point, std::size_t axis) {
    std::size_t const below = point & ((1U << axis) - 1);
    return below | ((point >> (axis + 1)) << axis);
  }

  /// F at Gauss points. x = sum of 8 modes (1, xi, eta, xi eta, ...); d/dxi does not depend on xi, so that there are
  /// four values of each column.
  void gradients(std::array<Vec, 8> const& corners, Lines& F) const {
    constexpr double gauss = 0.57735026918962576451;  // 1/sqrt(3)
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<Pack, 4> d;
        for (std::size_t n = 0; n < 8; ++n) {
          if ((n >> axis & 1) == 0) d[line(n, axis)] = corners[n + (1U << axis)][c] - corners[n][c];
        }
        double const a = 0.25 * over_spacing_[axis];
        Pack const mean = a * ((d[0] + d[1]) + (d[2] + d[3])), r = (a * gauss) * ((d[1] - d[0]) + (d[3] - d[2])),
                   s = (a * gauss) * ((d[2] + d[3]) - (d[0] + d[1])),
                   t = (a * gauss * gauss) * ((d[0] - d[1]) + (d[3] - d[2]));
        F[axis][0][c] = (mean - s) - (r - t);
        F[axis][1][c] = (mean - s) + (r - t);
        F[axis][2][c] = (mean + s) - (r + t);
        F[axis][3][c] = (mean + s) + (r + t);
      }
    }
  }

  /// The transpose of gradients(): minus what the nodes feel.
  void scatter(Lines const& P, std::array<Vec, 8>& out) const {
    constexpr double gauss = 0.57735026918962576451;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        auto const& p = P[axis];
        double const a = 0.25 * over_spacing_[axis];
        Pack const mean = a * ((p[0][c] + p[1][c]) + (p[2][c] + p[3][c])),
                   r = (a * gauss) * ((p[1][c] - p[0][c]) + (p[3][c] - p[2][c])),
                   s = (a * gauss) * ((p[2][c] + p[3][c]) - (p[0][c] + p[1][c])),
                   t = (a * gauss * gauss) * ((p[0][c] - p[1][c]) + (p[3][c] - p[2][c]));
        std::array<Pack, 4> const d{(mean - s) - (r - t), (mean - s) + (r - t), (mean + s) - (r + t),
                                    (mean + s) + (r + t)};
        for (std::size_t n = 0; n < 8; ++n) {
          Pack const part = d[line(n, axis)];
          Pack const sign_part = (n >> axis & 1) == 0 ? part : -part;
          out[n][c] = axis == 0 ? sign_part : out[n][c] + sign_part;
        }
      }
    }
  }

  /// Stresses times volumes of a pack of bricks, summed along Gauss lines.
  template <bool watching>
  Watch stresses(Lines const& F, Lines& P, Pack active) const {
    Watch watch;
    std::array<Pack, 8> J;
    Pack theta{};
    for (std::size_t g = 0; g < 8; ++g) {
      Pack const det = dot(F[0][line(g, 0)], cross(F[1][line(g, 1)], F[2][line(g, 2)]));
      J[g] = det * active + (1.0 - active);  // what is no brick has no finite power of J
      theta += 0.125 * J[g];
    }
    for (auto& axis : P) axis.fill(Vec{});
    Pack const weight = (0.125 * volume_) * active;
    Pack const p = kappa_ * (theta - 1.0);
    Pack energy = 8.0 * weight * (0.5 * kappa_) * (theta - 1.0) * (theta - 1.0), bound{};
    for (std::size_t g = 0; g < 8; ++g) {
      Vec const &a = F[0][line(g, 0)], &b = F[1][line(g, 1)], &c = F[2][line(g, 2)];
      std::array<Vec, 3> const H{cross(b, c), cross(c, a), cross(a, b)};
      Pack const invariant = dot(a, a) + dot(b, b) + dot(c, c), root = power_minus_third(J[g]);
      Pack const shear = mu_ * root * root;
      Pack const on_F = weight * shear, on_H = weight * (p - shear * invariant * (root * root * root) * (1.0 / 3.0));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Vec& sum = P[axis][line(g, axis)];
        Vec const& column = F[axis][line(g, axis)];
        for (std::size_t i = 0; i < 3; ++i) sum[i] += on_F * column[i] + on_H * H[axis][i];
      }
      if constexpr (watching) {
        energy += 0.5 * weight * (shear * invariant - 3.0 * mu_);
        Pack here{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          double const h2 = over_spacing_[axis] * over_spacing_[axis];
          here += h2 * ((kappa_ + 2.0 * shear) * dot(H[axis], H[axis]) + 2.0 * shear);
        }
        Pack const larger = here * active;
        for (std::ptrdiff_t l = 0; l < width; ++l) bound[l] = std::max(bound[l], larger[l]);
      }
    }
    if constexpr (watching) {
      for (std::ptrdiff_t l = 0; l < width; ++l) {
        watch.energy += energy[l];
        watch.frequency2 = std::max(watch.frequency2, 4 * bound[l] / density_);
      }
    }
    return watch;
  }

  /// One layer of bricks, pack by pack. The high corners in x of a brick are the low ones of the next: both are joined
  /// in registers, so that each node is read and written four times only.
  template <bool watching>
  Watch layer(Mesh& mesh, std::ptrdiff_t begin) const {
    Watch watch;
    std::array<std::ptrdiff_t, 4> const lows{0, mesh.row, mesh.layer, mesh.layer + mesh.row};
    std::array<Vec, 4> last{};
    for (std::ptrdiff_t e = begin; e < begin + mesh.layer - mesh.row; e += width) {
      std::array<Vec, 8> corners;
      for (std::size_t n = 0; n < 8; ++n) {
        for (std::size_t c = 0; c < 3; ++c) corners[n][c] = load(&mesh.x[c][0] + e + lows[n / 2] + (n & 1));
      }
      Lines F, P;
      gradients(corners, F);
      Watch const seen = stresses<watching>(F, P, load(&mesh.active[0] + e));
      watch.energy += seen.energy;
      watch.frequency2 = std::max(watch.frequency2, seen.frequency2);
      scatter(P, corners);
      for (std::size_t q = 0; q < 4; ++q) {
        for (std::size_t c = 0; c < 3; ++c) {
          double* const at = &mesh.f[c][0] + e + lows[q];
          Pack const high = corners[2 * q + 1][c];
          store(at, load(at) + corners[2 * q][c] + shifted(last[q][c], high));
          last[q][c] = high;
        }
      }
    }
    return watch;
  }

  /// The last lane of the pack before, then all of this one but its last.
  static Pack shifted(Pack before, Pack now) { return shifted(before, now, std::make_index_sequence<width>()); }
  template <std::size_t... lane>
  static Pack shifted(Pack before, Pack now, std::index_sequence<lane...>) {
    return __builtin_shufflevector(before, now, (width - 1 + lane)...);
  }

  double mu_, kappa_, density_ = 0, volume_ = 0;
  std::array<double, 3> over_spacing_{};
};

}  // namespace bricks
