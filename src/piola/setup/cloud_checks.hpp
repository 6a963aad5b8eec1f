// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/particles/particle_set.hpp"
#include "piola/setup/cloud_file.hpp"
#include "piola/setup/cloud_table.hpp"

namespace piola {

/// The nearest other point of each point.
struct NearestPoint {
  double distance = 0;  ///< m
  std::int64_t other = -1;
};

/// Finds them; time grows with the number of points, also of clouds that are dense in one place and sparse in another.
/// No position may be there twice; there are at least two.
std::vector<NearestPoint> nearest_points(std::vector<std::array<double, 3>> const& X);

/// How the surroundings of a point are filled, seen with Wendland's kernel C2 of h = 1.2 spacings (support 2h).
struct CloudMoment {
  double density = 0;          ///< sum_j V_j W_ij, itself included: 1 in a full neighbourhood
  double mean_eigenvalue = 0;  ///< of sum_j V_j grad W_ij (x_j - x_i): 1 in a full neighbourhood
  double least_eigenvalue = 0;
  int neighbours = 0;   ///< within the support
  bool inside = false;  ///< there are neighbours on the side where fewer are
};
std::vector<CloudMoment> cloud_moments(PointCloud const& cloud);

/// The place where a gradient is hardest to form.
struct WorstNeighbourhood {
  std::size_t point = 0;
  double least = 0;    ///< eigenvalue of its matrix
  double typical = 0;  ///< median over all points of the mean eigenvalue
  int neighbours = 0;
  double part() const { return typical > 0 ? least / typical : 0; }
};
/// Worst of the moments of at least one point.
WorstNeighbourhood worst_neighbourhood(std::vector<CloudMoment> const& moments);
/// Worst neighbourhood of a body with at least one particle; the point is an id.
WorstNeighbourhood worst_neighbourhood(ParticleSet const& particles, Body const& body);

/// Refuses numbers that are not finite or absurd, and volumes that are not positive.
void check_cloud_numbers(PointCloud const& cloud, CloudSource const& source, std::vector<std::string>& problems);

/// Refuses clouds with too few points, points too close to each other, volumes inconsistent with the distances, or
/// places where no gradient can be formed. Adds notes on uneven spacing. Precondition: the numbers have passed their
/// check.
void check_cloud_places(PointCloud& cloud, CloudSource const& source, std::vector<std::string>& problems);

}  // namespace piola
