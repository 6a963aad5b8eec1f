// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/measures/clusters.hpp"
#include <vector>

/// Width of a hole that a shot along an axis made in a body. Distances are between centres of particles.
namespace piola {

/// Kind rim, in 3D: of the clusters with a particle of the anchor region, in each of `sectors` equal angles about the
/// axis the particle furthest along the axis (of several the one nearest to the axis) of those not further than
/// `within` from it. Twice their mean radius [m], their mean coordinate along the axis minus `base` [m], and the number
/// of sectors that have one; all zero if none has.
std::vector<double> rim_values(Measured const& measured, FieldCache& cache);

/// Kind hole, in 2D. First the hole in the slab [m]: the smallest distance from the axis on one side plus that on the
/// other, over particles now between `slab_from` and `slab_to` along the axis that belong to a main fragment: a cluster
/// with a particle of the anchor region; if there is no such region, on each side the cluster with the most particles
/// there. Then the cavity [m]: the same distance over all particles of the body, in bins along the axis of `bin`
/// initial spacings from `cavity_from` to `cavity_to`; the largest of the bins with particles on both sides. Particles
/// on the axis are on both sides. Nan where one side has no particles. In half sections of axisymmetric bodies both
/// sides are alike.
std::vector<double> hole_values(Measured const& measured, FieldCache& cache);

}  // namespace piola
