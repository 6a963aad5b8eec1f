// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/component_views.hpp"
#include "piola/formulations/adaptle/records.hpp"

/// Images of particles behind the axis of axisymmetric bodies, for sums over neighbours. An image has the values of its
/// particle with the radial direction turned. A particle sums over images as over particles: the force of an image on
/// it is, turned, what its own image does to the other particle.
namespace piola::adaptle::inline PIOLA_BACKEND {

/// Whether component (p, q) of a tensor changes its sign behind the axis.
PIOLA_FN bool turns(int p, int q) { return (p == 0) != (q == 0); }

/// Visits the weights near the axis of the marked particles of a group: f(lane, particle, neighbour, whether the
/// neighbour's image is meant, place of the weight in the table, own weight). The own weight of a broken neighbour is
/// 0.
template <class F>
PIOLA_FN void for_each_axis_weight(AxisCorrectionTable const& table, Index particles, Components const& active, Group g,
                                   Lanes const& marks, F const& f) {
  for (int l = 0; l < g.count; ++l) {
    Index const i = g.first + l;
    for (Offset k = table.begin[i]; k < table.begin[i + 1] && lane(marks, l) > 0; ++k) {
      Index const j = source_of(table.neighbour[k], particles);
      f(l, i, j, j != table.neighbour[k], k, active.at(j) > 0 ? table.own[k] : 0.0);
    }
  }
}

/// The gradients along the radius that a change of weights near the axis adds to those of a group of particles, of
/// displacements and of velocities at half time; zero in lanes that are not marked.
struct AxisGradients {
  AxisCorrectionTable table;
  Index particles;
  Components X, x, v_half, active;

  PIOLA_FN void operator()(Group g, Lanes const& marks, Lanes (&of_u)[2], Lanes (&of_v)[2]) const {
    double u[2][lane_count]{}, v[2][lane_count]{};
    auto const add = [&](int l, Index i, Index j, bool is_image, Offset, double weight) {
      for (int p = 0; p < 2; ++p) {
        double const sign = is_image && p == 0 ? -1 : 1;
        u[p][l] += weight * (sign * (x.at(j, p) - X.at(j, p)) - (x.at(i, p) - X.at(i, p)));
        v[p][l] += weight * (sign * v_half.at(j, p) - v_half.at(i, p));
      }
    };
    for_each_axis_weight(table, particles, active, g, marks, add);
    for (int p = 0; p < 2; ++p) {
      of_u[p] = load<Lanes>(u[p]);
      of_v[p] = load<Lanes>(v[p]);
    }
  }
};

/// Forces of the same weights on a group of particles, of their own stress and in reaction to that of neighbours.
struct AxisForces {
  AxisCorrectionTable table;
  Index particles;
  Components radial_stress, active;

  PIOLA_FN void operator()(Group g, Lanes const& marks, Lanes (&force)[2]) const {
    double sum[2][lane_count]{};
    auto const add = [&](int l, Index i, Index j, bool is_image, Offset k, double weight) {
      for (int p = 0; p < 2; ++p) {
        double const sign = is_image && p == 1 ? -1 : 1;
        sum[p][l] += weight * radial_stress.at(i, p) - table.back[k] * sign * radial_stress.at(j, p);
      }
    };
    for_each_axis_weight(table, particles, active, g, marks, add);
    for (int p = 0; p < 2; ++p) force[p] = load<Lanes>(sum[p]);
  }
};

/// Motion of the images of a block of particles.
struct ImageMotion {
  OwnComponents x, v_half;
  double* position;
  Index particles;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index i = block.first; i < block.last; ++i) {
      Index const image = particles + 1 + i;
      for (int c = 0; c < 2; ++c) {
        double const sign = c == 0 ? -1 : 1;
        x.at(image, c) = position[std::ptrdiff_t{3} * image + c] = sign * x.at(i, c);
        v_half.at(image, c) = sign * v_half.at(i, c);
      }
    }
  }
};

/// Components [first, last) of the records of images for sums over reference neighbours.
struct ImageMaterialRecords {
  using R = MaterialRecord<2>;
  MaterialTable table;
  Index particles;
  int stride, first, last;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index k = block.first; k < block.last; ++k) {
      double const* const from = table.record + std::ptrdiff_t{stride} * table.image[k];
      double* const to = table.record + std::ptrdiff_t{stride} * (particles + 1 + table.image[k]);
      for (int c = first; c < last; ++c) to[c] = is_odd(c) ? -from[c] : from[c];
    }
  }

 private:
  PIOLA_FN static bool is_odd(int c) {
    return c == R::u || c == R::v || c == R::X || c == R::A + 1 || c == R::A + 2 || c == R::a || c == R::N + 1 ||
           c == R::N + 2 || c == R::n;
  }
};

/// Records of images for spatial sums.
struct ImageSpatialRecords {
  using R = SpatialRecord<2, false>;
  SpatialTable table;
  Index particles;

  PIOLA_FN void operator()(Range block, Index) const {
    for (Index k = block.first; k < block.last; ++k) {
      Index const slot = table.slot[k];
      if (slot <= particles || (table.near != nullptr && table.near[slot] == 0)) continue;
      double const* const from =
          table.record + static_cast<std::ptrdiff_t>(table.sorted[slot - particles - 1]) * table.stride;
      double* const to = table.record + static_cast<std::ptrdiff_t>(k) * table.stride;
      for (int c = 0; c < table.stride; ++c) to[c] = is_odd(c) ? -from[c] : from[c];
    }
  }

 private:
  PIOLA_FN static bool is_odd(int c) {
    constexpr int shear = SymMat<2>::at(0, 1);
    return c == R::x || c == R::v || c == R::M + shear || c == R::R + shear;
  }
};

}  // namespace piola::adaptle::inline PIOLA_BACKEND
