// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/kernels/wendland_c2.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include "piola/particles/body_range.hpp"
#include "piola/setup/cloud_checks.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

using CloudPoints = std::vector<std::array<double, 3>>;

constexpr double cloud_h = 1.2;            // smoothing length over spacing: the widest that cases use
constexpr double even_asymmetry = 0.02;    // |sum V r W| / (h sum V W) of neighbours on all sides
constexpr double cone_cosine = 0.7071;     // neighbours within 45 degrees of the sparse side
constexpr double smallest_part = 1e-15;    // of the box: with smaller cells, it has more than a grid can count
constexpr double cell_growth = 4;          // from one search to the next
constexpr std::size_t probed_points = 64;  // points compared with all others to estimate the spacing

double square_distance(std::array<double, 3> const& a, std::array<double, 3> const& b) {
  double const x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

double longest_side(CloudPoints const& X) {
  double longest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    auto const [low, high] =
        std::minmax_element(X.begin(), X.end(), [c](auto const& a, auto const& b) { return a[c] < b[c]; });
    longest = std::max(longest, (*high)[c] - (*low)[c]);
  }
  return longest;
}

/// A radius within which most points have a neighbour, or a smaller one if some are much closer.
double first_radius(CloudPoints const& X, double longest) {
  std::vector<double> distances;
  std::size_t const step = X.size() / std::min(X.size(), probed_points);
  for (std::size_t i = 0; i < X.size(); i += step) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < X.size(); ++j)
      if (j != i) least = std::min(least, square_distance(X[i], X[j]));
    distances.push_back(std::sqrt(least));
  }
  std::sort(distances.begin(), distances.end());
  double const median = distances[distances.size() / 2], smallest = distances.front();
  return std::max(1.3 * (smallest < 0.1 * median ? smallest : median), smallest_part * longest);
}

/// The sums over the neighbours of one point.
struct CloudSums {
  double density = 0;     ///< sum V W
  double neighbours = 0;  ///< of it, what is not of the point itself
  int count = 0;
  std::array<double, 3> first{};  ///< sum V r W
  SymMat<3> second{};             ///< sum V (-W'/r) r r
};

class CloudSurroundings {
 public:
  explicit CloudSurroundings(PointCloud const& cloud)
      : cloud_(cloud), h_(cloud_h * cloud.spacing), grid_(cloud.X, WendlandC2::support * h_) {
    scale_ = WendlandC2::sigma(cloud.dimension) / std::pow(h_, cloud.dimension);
  }

  CloudMoment at(std::size_t i) const {
    CloudSums const sums = sums_at(i);
    CloudMoment moment;
    moment.density = sums.density;
    moment.neighbours = sums.count;
    SymMat<3> matrix = sums.second;
    double trace = 0;
    for (int c = 0; c < cloud_.dimension; ++c) trace += matrix(c, c);
    for (int c = cloud_.dimension; c < 3; ++c)
      matrix(c, c) = trace + 1;  // directions that do not exist: never the least
    moment.inside = surrounded(i, sums);
    if (!std::isfinite(trace)) return moment;  // volumes without measure
    moment.mean_eigenvalue = trace / cloud_.dimension;
    auto const eigen = symmetric_eigen(matrix);
    moment.least_eigenvalue = std::max(0.0, *std::min_element(eigen.value, eigen.value + 3));
    return moment;
  }

 private:
  /// f(j, q, d): neighbours with their distance over h and their place relative to i.
  template <class F>
  void visit(std::size_t i, F const& f) const {
    auto const& x = cloud_.X[i];
    grid_.visit(x, [&](Index other) {
      auto const j = static_cast<std::size_t>(other);
      auto const& y = cloud_.X[j];
      double const q = std::sqrt(square_distance(x, y)) / h_;
      if (j != i && q < WendlandC2::support) f(j, q, std::array{y[0] - x[0], y[1] - x[1], y[2] - x[2]});
    });
  }

  CloudSums sums_at(std::size_t i) const {
    CloudSums sums;
    visit(i, [&](std::size_t j, double q, std::array<double, 3> const& d) {
      double const w = cloud_.kernel_volume[j] * scale_ * WendlandC2::w(cloud_.dimension, q);
      double const slope = -cloud_.kernel_volume[j] * scale_ * WendlandC2::dw(cloud_.dimension, q) / (q * h_ * h_);
      sums.neighbours += w;
      ++sums.count;
      for (int a = 0; a < 3; ++a) {
        auto const da = d[static_cast<std::size_t>(a)];
        sums.first[static_cast<std::size_t>(a)] += w * da;
        for (int b = a; b < 3; ++b) sums.second(a, b) += slope * da * d[static_cast<std::size_t>(b)];
      }
    });
    sums.density = sums.neighbours + cloud_.kernel_volume[i] * scale_ * WendlandC2::w(cloud_.dimension, 0.0);
    return sums;
  }

  /// Whether point i has neighbours even on its sparser side, so that it is not next to a surface.
  bool surrounded(std::size_t i, CloudSums const& sums) const {
    auto const& g = sums.first;
    double const length = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    if (!(sums.neighbours > 0)) return false;
    if (length <= even_asymmetry * h_ * sums.neighbours) return true;
    bool found = false;
    visit(i, [&](std::size_t, double q, std::array<double, 3> const& d) {
      double const along = -(d[0] * g[0] + d[1] * g[1] + d[2] * g[2]) / length;
      found = found || along > cone_cosine * q * h_;
    });
    return found;
  }

  PointCloud const& cloud_;
  double h_, scale_ = 1;
  CellGrid grid_;
};

}  // namespace

std::vector<NearestPoint> nearest_points(CloudPoints const& X) {
  PIOLA_EXPECTS(X.size() >= 2);
  std::vector<NearestPoint> nearest(X.size());
  double const longest = longest_side(X);
  std::vector<std::size_t> left(X.size());
  for (std::size_t i = 0; i < X.size(); ++i) left[i] = i;
  for (double cell = first_radius(X, longest); !left.empty(); cell *= cell_growth) {
    CellGrid const grid(X, cell);
    exec_host::parallel_for(static_cast<Index>(left.size()), [&](Index k) {
      std::size_t const i = left[static_cast<std::size_t>(k)];
      double least = std::numeric_limits<double>::infinity();
      grid.visit(X[i], [&](Index other) {
        auto const j = static_cast<std::size_t>(other);
        double const square = square_distance(X[i], X[j]);
        // The order within cells does not matter: of equal ones the first counts.
        if (j == i || square > least || (square >= least && other > nearest[i].other)) return;
        least = square;
        nearest[i].other = other;
      });
      nearest[i].distance = std::sqrt(least);
    });
    // Beyond the edge of a cell there may be a nearer point than those found.
    std::erase_if(left, [&](std::size_t i) { return nearest[i].distance <= cell; });
    if (cell > 2 * longest) break;
  }
  return nearest;
}

std::vector<CloudMoment> cloud_moments(PointCloud const& cloud) {
  PIOLA_EXPECTS(cloud.dimension >= 1 && cloud.dimension <= 3 && cloud.spacing > 0);
  PIOLA_EXPECTS(cloud.kernel_volume.size() == cloud.X.size());
  std::vector<CloudMoment> moments(cloud.X.size());
  CloudSurroundings const surroundings(cloud);
  exec_host::parallel_for(static_cast<Index>(cloud.X.size()), [&](Index i) {
    moments[static_cast<std::size_t>(i)] = surroundings.at(static_cast<std::size_t>(i));
  });
  return moments;
}

WorstNeighbourhood worst_neighbourhood(std::vector<CloudMoment> const& moments) {
  PIOLA_EXPECTS(!moments.empty());
  std::vector<double> means;
  means.reserve(moments.size());
  for (CloudMoment const& m : moments) means.push_back(m.mean_eigenvalue);
  auto const middle = means.begin() + std::ssize(means) / 2;
  std::nth_element(means.begin(), middle, means.end());
  WorstNeighbourhood worst;
  for (std::size_t i = 0; i < moments.size(); ++i)
    if (moments[i].least_eigenvalue < moments[worst.point].least_eigenvalue) worst.point = i;
  worst.least = moments[worst.point].least_eigenvalue;
  worst.typical = *middle;
  worst.neighbours = moments[worst.point].neighbours;
  return worst;
}

WorstNeighbourhood worst_neighbourhood(ParticleSet const& particles, Body const& body) {
  PIOLA_EXPECTS(is_range_in(body, particles) && body.first < body.last);
  PointCloud cloud;
  cloud.dimension = particles.dimension;
  for (int c = 0; c < particles.dimension; ++c)
    cloud.spacing += body.spacing[static_cast<std::size_t>(c)] / particles.dimension;
  auto const part = [&](auto const& all, auto& to) { to.assign(all.begin() + body.first, all.begin() + body.last); };
  part(particles.X.seen(), cloud.X);
  part(particles.volume.seen(), cloud.volume);
  part(particles.kernel_volume.seen(), cloud.kernel_volume);
  WorstNeighbourhood worst = worst_neighbourhood(cloud_moments(cloud));
  worst.point += static_cast<std::size_t>(body.first);
  return worst;
}

}  // namespace piola
