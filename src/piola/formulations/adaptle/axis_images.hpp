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

/// Visits the changes near the axis of the marked particles of a group: f(lane, particle, neighbour, sign of the radius
/// of the neighbour or its image, change). The own change of a deleted neighbour is 0.
template <class F>
PIOLA_FN void for_each_axis_change(AxisCorrectionTable const& table, Index particles, Components const& active, Group g,
                                   Lanes const& marks, F const& f) {
  for (int l = 0; l < g.count; ++l) {
    Index const i = g.first + l;
    for (Offset k = table.begin[i]; k < table.begin[i + 1] && lane(marks, l) > 0; ++k) {
      Index const j = source_of(table.neighbour[k], particles);
      AxisChange change = table.change[k];
      if (!(active.at(j) > 0)) change.own[0] = change.own[1] = 0;
      f(l, i, j, j != table.neighbour[k] ? -1.0 : 1.0, change);
    }
  }
}

/// Additions to the gradients of displacements and of velocities at half time of a group of particles near the axis,
/// row by row; zero in lanes that are not marked.
struct AxisGradients {
  AxisCorrectionTable table;
  Index particles;
  Components X, x, v_half, active;

  PIOLA_FN void operator()(Group g, Lanes const& marks, Lanes (&of_u)[4], Lanes (&of_v)[4]) const {
    double u[4][lane_count]{}, v[4][lane_count]{};
    auto const add = [&](int l, Index i, Index j, double side, AxisChange const& change) {
      for (int p = 0; p < 2; ++p) {
        double const sign = p == 0 ? side : 1;
        double const du = sign * (x.at(j, p) - X.at(j, p)) - (x.at(i, p) - X.at(i, p));
        double const dv = sign * v_half.at(j, p) - v_half.at(i, p);
        for (int q = 0; q < 2; ++q) {
          u[2 * p + q][l] += change.own[q] * du;
          v[2 * p + q][l] += change.own[q] * dv;
        }
      }
    };
    for_each_axis_change(table, particles, active, g, marks, add);
    for (int c = 0; c < 4; ++c) {
      of_u[c] = load<Lanes>(u[c]);
      of_v[c] = load<Lanes>(v[c]);
    }
  }
};

/// Forces of the same changes on a group of particles, of their own stress and in reaction to that of neighbours.
struct AxisForces {
  AxisCorrectionTable table;
  Index particles;
  Components section_stress, active;

  PIOLA_FN void operator()(Group g, Lanes const& marks, Lanes (&force)[2]) const {
    double sum[2][lane_count]{};
    auto const add = [&](int l, Index i, Index j, double side, AxisChange const& change) {
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) {
          int const c = 2 * p + q;
          double const sign = turns(p, q) ? side : 1;
          sum[p][l] += change.own[q] * section_stress.at(i, c) - change.back[q] * sign * section_stress.at(j, c);
        }
    };
    for_each_axis_change(table, particles, active, g, marks, add);
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
