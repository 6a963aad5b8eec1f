// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/axis_correction.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/math/tensor.hpp"
#include <algorithm>
#include <cmath>

namespace piola::adaptle {
namespace {

/// A neighbour as the correction sees it: an image stands for its particle, with the sign of what is odd in the radius.
struct Neighbour {
  Index slot;
  double sign, R, Z;  ///< R, Z: relative to the particle [spacings]
};

Neighbour neighbour_at(AxisCorrection::Sums const& sums, Index a, Offset k, double spacing) {
  Index const j = sums.neighbour[at(k)];
  ParticleField const& X = sums.fields.X;
  return {source_of(j, sums.particles), j > sums.particles ? -1.0 : 1.0, (X.at(j) - X.at(a)) / spacing,
          (X.at(j, 1) - X.at(a, 1)) / spacing};
}

/// Calls f(k, neighbour) for the pairs of a particle.
template <class F>
void each_pair(AxisCorrection::Sums const& sums, Index a, double spacing, F const& f) {
  for (Offset k = sums.begin[at(a)]; k < sums.begin[at(a) + 1]; ++k)
    if (sums.neighbour[at(k)] != sums.particles) f(k, neighbour_at(sums, a, k, spacing));
}

/// K moment, K symmetric.
std::array<double, 3> solved(std::array<double, 6> const& K, double const (&moment)[3]) {
  return {K[0] * moment[0] + K[1] * moment[1] + K[2] * moment[2],
          K[1] * moment[0] + K[3] * moment[1] + K[4] * moment[2],
          K[2] * moment[0] + K[4] * moment[1] + K[5] * moment[2]};
}

}  // namespace

AxisCorrection::AxisCorrection(Sums const& sums, std::span<Body const> bodies) : bodies_(bodies.begin(), bodies.end()) {
  std::size_t const n = at(sums.particles);
  fits_.resize(n);
  residual_.assign(n, 0);
  spacing_.assign(n, 1);
  own_weight_.assign(n, 0);
  closed_.assign(n, 0);
  each_particle([&](Index a, Body const& body) {
    spacing_[at(a)] = body.spacing;
    own_weight_[at(a)] = body.own_weight;
  });
  set_fits(sums);
  set_residuals(sums);
  std::array<std::vector<double>, 2> changes{radial_changes(sums, solve(sums)),
                                             std::vector<double>(sums.neighbour.size())};
  each_particle([&](Index a, Body const&) { add_axial_changes(sums, a, changes[1]); });
  store(sums, changes);
}

void AxisCorrection::set_fits(Sums const& sums) {
  each_particle([&](Index a, Body const& body) {
    Mat<3> m;
    for (double& c : m.c) c = 0;
    m(0, 0) = body.own_weight;
    each_pair(sums, a, body.spacing, [&](Offset k, Neighbour const& b) {
      double const p[3]{1, b.R, b.Z};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m(i, j) += sums.s[at(k)] * p[i] * p[j];
    });
    double const scale = m(0, 0);
    for (double& c : m.c) c /= scale;
    Mat<3> const K = inverse(m);
    fits_[at(a)] = {K(0, 0) / scale, K(0, 1) / scale, K(0, 2) / scale,
                    K(1, 1) / scale, K(1, 2) / scale, K(2, 2) / scale};
  });
}

/// Whether the neighbourhood of a particle, with images, is complete: its kernel has no first moment.
bool AxisCorrection::is_complete(Sums const& sums, Index a) const {
  double moment[2]{}, weight = 0;
  each_pair(sums, a, spacing_[at(a)], [&](Offset k, Neighbour const& b) {
    double const share = sums.fields.weight().at(b.slot) * sums.s[at(k)];
    moment[0] += share * b.R;
    moment[1] += share * b.Z;
    weight += share * std::hypot(b.R, b.Z);
  });
  constexpr double few = 0.01;
  return std::hypot(moment[0], moment[1]) < few * weight;
}

bool AxisCorrection::is_on_axis(Sums const& sums, Index a) const {
  return sums.fields.X.at(a) < 1e-3 * spacing_[at(a)];
}

/// Weight of the radial stress of a particle. On the axis that includes the hoop stress.
double AxisCorrection::weight(Sums const& sums, Index a) const {
  return (is_on_axis(sums, a) ? 2 : 1) * sums.fields.volume.at(a);
}

/// R_b = -sum_a V0_a (A0_b G_ab + h_ab) along the radius, of particles with a complete neighbourhood; h_aa = 1/R_a.
void AxisCorrection::set_residuals(Sums const& sums) {
  each_particle([&](Index a, Body const& body) {
    double const V = weight(sums, a);
    double own = is_on_axis(sums, a) ? 0 : 1 / sums.fields.X.at(a);
    each_pair(sums, a, body.spacing, [&](Offset k, Neighbour const& b) {
      residual_[at(b.slot)] -= V * b.sign * sums.radial[at(k)];
      own -= sums.radial[at(k)];
    });
    residual_[at(a)] -= V * own;
  });
  each_particle([&](Index a, Body const&) {
    closed_[at(a)] = !is_on_axis(sums, a) && is_complete(sums, a) ? 1 : 0;
    if (closed_[at(a)] == 0) residual_[at(a)] = 0;
  });
}

std::array<double, 3> AxisCorrection::fitted(Sums const& sums, Index a, std::span<double const> mu) const {
  double moment[3]{own_weight_[at(a)] * mu[at(a)], 0, 0};
  each_pair(sums, a, spacing_[at(a)], [&](Offset k, Neighbour const& b) {
    double const value = sums.s[at(k)] * b.sign * mu[at(b.slot)];
    moment[0] += value;
    moment[1] += value * b.R;
    moment[2] += value * b.Z;
  });
  return solved(fits_[at(a)], moment);
}

double AxisCorrection::change(Sums const& sums, Index a, Offset k, std::span<double const> mu,
                              std::array<double, 3> const& fit) const {
  Neighbour const b = neighbour_at(sums, a, k, spacing_[at(a)]);
  return sums.s[at(k)] * (b.sign * mu[at(b.slot)] - fit[0] - fit[1] * b.R - fit[2] * b.Z);
}

/// sum_a V0_a g_ab at every particle b, for the changes g that belong to mu.
void AxisCorrection::apply(Sums const& sums, std::span<double const> mu, std::vector<double>& to) const {
  std::fill(to.begin(), to.end(), 0);
  each_particle([&](Index a, Body const& body) {
    std::array const fit = fitted(sums, a, mu);
    double const V = weight(sums, a);
    to[at(a)] += V * body.own_weight * (mu[at(a)] - fit[0]);
    each_pair(sums, a, body.spacing,
              [&](Offset k, Neighbour const& b) { to[at(b.slot)] += V * b.sign * change(sums, a, k, mu, fit); });
  });
  each_particle([&](Index a, Body const&) {
    if (closed_[at(a)] == 0) to[at(a)] = 0;
  });
}

/// Conjugate gradients with the diagonal. The changes are the smallest that remove the residuals and keep gradients of
/// linear fields.
std::vector<double> AxisCorrection::solve(Sums const& sums) {
  std::size_t const n = residual_.size();
  std::vector<double> mu(n, 0), direction(n, 0), image(n, 0), diagonal(n, 0);
  each_particle([&](Index a, Body const& body) {
    double const V = weight(sums, a);
    diagonal[at(a)] += V * body.own_weight;
    each_pair(sums, a, body.spacing, [&](Offset k, Neighbour const& b) { diagonal[at(b.slot)] += V * sums.s[at(k)]; });
  });
  auto const squares = [&](auto const& weight) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += residual_[i] * residual_[i] * weight(i);
    return sum;
  };
  auto const unweighted = [](std::size_t) { return 1.0; };
  constexpr double tolerance = 1e-4;
  double const goal = tolerance * tolerance * squares(unweighted);
  double before = 0;
  constexpr int most_steps = 20000;  // 1,700 for 12 particles per radius of a rod in a target of 96
  for (int step = 0; step < most_steps && squares(unweighted) > goal; ++step) {
    double const now = squares([&](std::size_t i) { return 1 / diagonal[i]; });
    for (std::size_t i = 0; i < n; ++i)
      direction[i] = residual_[i] / diagonal[i] + (step > 0 ? now / before * direction[i] : 0);
    before = now;
    apply(sums, direction, image);
    double curvature = 0;
    for (std::size_t i = 0; i < n; ++i) curvature += direction[i] * image[i];
    if (!(curvature > 0)) break;
    for (std::size_t i = 0; i < n; ++i) {
      mu[i] += now / curvature * direction[i];
      residual_[i] -= now / curvature * image[i];
    }
  }
  if (!(squares(unweighted) <= goal))
    throw InputError(
        "adaptle: geometry is \"axisymmetric\", and gradients near the axis cannot be corrected (the solution does not "
        "converge) - this is an error of the program: please report it with the case; another spacing may avoid it");
  return mu;
}

/// Changes along the radius, per pair; zero farther away, where they vanish.
std::vector<double> AxisCorrection::radial_changes(Sums const& sums, std::span<double const> mu) {
  constexpr double negligible = 1e-6;
  std::vector<double> changes(sums.neighbour.size(), 0);
  each_particle([&](Index a, Body const& body) {
    std::array const fit = fitted(sums, a, mu);
    double largest = 0, steepest = 0;
    each_pair(sums, a, body.spacing, [&](Offset k, Neighbour const&) {
      changes[at(k)] = change(sums, a, k, mu, fit);
      largest = std::max(largest, std::fabs(changes[at(k)]));
      steepest = std::max(steepest, std::fabs(sums.radial[at(k)]));
    });
    if (largest > negligible * steepest) return;
    std::fill(changes.begin() + sums.begin[at(a)], changes.begin() + sums.begin[at(a) + 1], 0);
  });
  return changes;
}

/// Factor on the gradient along the axis of a pair, c_ab/R_a with c_ab = c_ba: without it the force of b has the weight
/// R_b, whose mean over neighbours exceeds R_a near the axis. Neighbours behind the axis have none.
double AxisCorrection::circle_ratio(Sums const& sums, Index a, Offset k) const {
  constexpr double first = 4, last = 12;  // [spacings], between which the factor fades to 1
  double const spacing = spacing_[at(a)];
  Neighbour const b = neighbour_at(sums, a, k, spacing);
  double const here = ring_radius(sums.fields.X.at(a), spacing), there = ring_radius(sums.fields.X.at(b.slot), spacing);
  double const mean = 0.5 * (here + there), faded = std::clamp((last - mean / spacing) / (last - first), 0.0, 1.0);
  bool const axis = is_on_axis(sums, a) || is_on_axis(sums, b.slot);
  double const circle = axis ? std::min(here, there) : b.sign > 0 ? mean : 0;
  return 1 + faded * (circle / here - 1);
}

/// Adds the changes of particle a along the axis, with which gradients of linear fields stay exact.
void AxisCorrection::add_axial_changes(Sums const& sums, Index a, std::vector<double>& to) const {
  double moment[3]{};
  each_pair(sums, a, spacing_[at(a)], [&](Offset k, Neighbour const& b) {
    double const value = (circle_ratio(sums, a, k) - 1) * sums.axial[at(k)];
    to[at(k)] = value;
    moment[0] += value;
    moment[1] += value * b.R;
    moment[2] += value * b.Z;
  });
  std::array const fit = solved(fits_[at(a)], moment);
  each_pair(sums, a, spacing_[at(a)],
            [&](Offset k, Neighbour const& b) { to[at(k)] -= sums.s[at(k)] * (fit[0] + fit[1] * b.R + fit[2] * b.Z); });
}

/// changes: per pair, along the radius and along the axis. Keeps those of particles that have any.
void AxisCorrection::store(Sums const& sums, std::array<std::vector<double>, 2> const& changes) {
  std::vector<std::uint8_t> kept(residual_.size(), 0);
  each_particle([&](Index a, Body const& body) {
    each_pair(sums, a, body.spacing, [&](Offset k, Neighbour const&) {
      if (changes[0][at(k)] != 0 || changes[1][at(k)] != 0) kept[at(a)] = 1;
    });
  });
  begin_.assign(residual_.size() + 1, 0);
  each_particle([&](Index a, Body const& body) {
    begin_[at(a)] = static_cast<Offset>(neighbour_.size());
    each_pair(sums, a, body.spacing, [&](Offset k, Neighbour const& b) {
      if (kept[at(a)] == 0 && kept[at(b.slot)] == 0) return;
      AxisChange both{{changes[0][at(k)], changes[1][at(k)]}, {}};
      // The pair of the neighbour with this particle: behind the axis, with that of its image.
      Index const there = b.sign > 0 ? a : sums.particles + 1 + a;
      for (Offset other = sums.begin[at(b.slot)]; other < sums.begin[at(b.slot) + 1]; ++other)
        if (sums.neighbour[at(other)] == there) {
          both.back[0] = b.sign * changes[0][at(other)];
          both.back[1] = changes[1][at(other)];
        }
      neighbour_.push_back(sums.neighbour[at(k)]);
      change_.push_back(both);
    });
    begin_[at(a) + 1] = static_cast<Offset>(neighbour_.size());
  });
}

AxisCorrectionTable AxisCorrection::view() const {
  if (begin_.empty()) return {};
  return {begin_.data(), neighbour_.data(), change_.data()};
}

std::size_t AxisCorrection::bytes() const {
  return sizeof(Fit) * fits_.size() + sizeof(AxisChange) * change_.size() + sizeof(double) * 3 * residual_.size() +
         sizeof(Index) * neighbour_.size() + sizeof(Offset) * begin_.size();
}

}  // namespace piola::adaptle
