// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/formulations/common/mirror_images.hpp"
#include "piola/formulations/nodal/quadratic.hpp"
#include <array>

namespace piola::nodal {

/// Vector fields of a body with mirror planes, D values per particle, images after the body's own particles.
template <int D>
class SymmetryReduction {
 public:
  SymmetryReduction(MirrorImages const& images, std::size_t particles) : images_(images), particles_(particles) {}

  std::size_t particles() const { return particles_; }  ///< without images
  /// Sets images from their sources, and removes components across a plane on particles that lie on it.
  void extend(LazyZeroArray<double>& u) const {
    for (std::size_t a = 0; a < particles_; ++a)
      for (std::size_t c = 0; c < D; ++c)
        if (images_.on_plane(static_cast<Index>(a), c)) u[a * D + c] = 0;
    each_image([&](std::size_t image, std::size_t source, std::size_t c, double sign) {
      u[image * D + c] = sign * u[source * D + c];
    });
  }
  /// Transpose of extend() in the product of products(), followed by extend(): turns a preconditioner of the whole body
  /// into one of symmetric fields.
  void gather(LazyZeroArray<double>& z) const {
    each_image([&](std::size_t image, std::size_t source, std::size_t c, double sign) {
      z[source * D + c] += sign * z[image * D + c];
    });
    for (std::size_t a = 0; a < particles_; ++a)
      for (std::size_t c = 0; c < D; ++c) z[a * D + c] *= images_.multiplicity(static_cast<Index>(a));
    extend(z);
  }
  /// Scalar products over the body itself, one per column.
  std::array<double, static_cast<std::size_t>(D)> products(LazyZeroArray<double> const& u,
                                                           LazyZeroArray<double> const& v) const {
    std::array<double, static_cast<std::size_t>(D)> sum{};
    for (std::size_t a = 0; a < particles_; ++a)
      for (std::size_t c = 0; c < D; ++c)
        sum[c] += u[a * D + c] * v[a * D + c] / images_.multiplicity(static_cast<Index>(a));
    return sum;
  }
  /// Between two planes the matrix has no quadratic null space.
  bool endless() const {
    for (std::size_t axis = 0; axis < D; ++axis)
      if (images_.endless(axis)) return true;
    return false;
  }

 private:
  template <class F>
  void each_image(F const& f) const {
    for (Index k = 0; k < images_.count(); ++k)
      for (std::size_t c = 0; c < D; ++c)
        f(particles_ + static_cast<std::size_t>(k),
          static_cast<std::size_t>(images_.particles().source[static_cast<std::size_t>(k)]), c, images_.sign(k)[c]);
  }

  MirrorImages const& images_;
  std::size_t particles_;
};

}  // namespace piola::nodal
