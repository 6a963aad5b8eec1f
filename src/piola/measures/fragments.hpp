// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/measures/clusters.hpp"
#include <vector>

/// Clumping of particles and fragmentation of bodies. Each function returns the values at one time in the order of
/// probe_kinds; its cost is linear in the number of particles.
namespace piola {

/// Kind spacing: distances from the measured particles to their nearest neighbours in any body, over the body's initial
/// spacing: smallest, percentiles 1, 5 and 50 (linear between the sorted values, position q (n - 1)), standard
/// deviation over n, and the fractions below 0.75 and 0.5. All nan if no particle has a neighbour.
std::vector<double> spacing_values(Measured const& measured, FieldCache& cache);

/// Kind fragment: the number of clusters, then of the chosen one (of several largest, the one with the first particle)
/// particles, reference volume [m^Dim], mean velocity weighted by volume [m/s], and extents [m] of its particles nearer
/// than `near_axis` to the axis; then of the clusters with `min_particles` or more their number, mean reference
/// volume [m^Dim], and the standard deviation of volumes over the mean. Values of a missing cluster are
/// zero; velocities are nan if the formulation has no field Velocity.
std::vector<double> fragment_values(Measured const& measured, FieldCache& cache);

}  // namespace piola
