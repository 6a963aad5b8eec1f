// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/spline_levels.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

constexpr double finest = 2;  ///< spacings between knots
constexpr int most_levels = 12;

/// Derivative `order` of the four cubic splines on an interval of length one, at t in it.
std::array<double, 4> splines_at(double t, int order) {
  double const u = 1 - t;
  switch (order) {
    case 0:
      return {u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * u * u + 3 * u * u * u) / 6, t * t * t / 6};
    case 1: return {-u * u / 2, (-12 * t + 9 * t * t) / 6, (12 * u - 9 * u * u) / 6, t * t / 2};
    case 2: return {u, -2 + 3 * t, -2 + 3 * u, t};
    default: return {-1, 3, -3, 1};
  }
}

/// Integrals over a length of the squares of each spline's derivatives 0 ... 3.
std::vector<std::array<double, 4>> energies(double length, double spacing, int intervals) {
  std::vector<std::array<double, 4>> r(static_cast<std::size_t>(intervals) + 3);
  constexpr int samples = 8;
  for (int k = 0; k < intervals; ++k) {
    double const covered = std::min(1.0, length / spacing - k);
    for (int s = 0; s < samples; ++s)
      for (int order = 0; order < 4; ++order) {
        auto const of = splines_at((s + 0.5) / samples * covered, order);
        for (std::size_t b = 0; b < 4; ++b)
          r[static_cast<std::size_t>(k) + b][static_cast<std::size_t>(order)] +=
              of[b] * of[b] * covered / samples * std::pow(spacing, 1 - 2 * order);
      }
  }
  return r;
}

/// |grad^3|^2 of a product of three: derivatives along one axis once, along two three times, along all six times.
double third_derivatives(std::array<std::array<double, 4>, 3> const& e) {
  double sum = 6 * e[0][1] * e[1][1] * e[2][1];
  for (std::size_t a = 0; a < 3; ++a) {
    std::size_t const b = (a + 1) % 3, c = (a + 2) % 3;
    sum += e[a][3] * e[b][0] * e[c][0] + 3 * e[a][2] * (e[b][1] * e[c][0] + e[b][0] * e[c][1]);
  }
  return sum;
}

std::size_t number(std::array<int, 3> const& count, int i, int j, int k) {
  return (static_cast<std::size_t>(k) * count[1] + j) * count[0] + i;
}

/// f(spline of the fine level, factor) for the parts of a spline of twice the spacing along one axis.
template <class F>
void each_part(int coarse, int fine_count, F const& f) {
  constexpr std::array<double, 5> binomial{0.125, 0.5, 0.75, 0.5, 0.125};
  if (fine_count == 1) return f(0, 1.0);  // a direction that does not exist
  for (int k = 0; k < 5; ++k)
    if (int const i = 2 * coarse - 3 + k; i >= 0 && i < fine_count) f(i, binomial[static_cast<std::size_t>(k)]);
}

/// f(coarse spline, fine spline, factor)
template <class F>
void each_pair(std::array<int, 3> const& coarse, std::array<int, 3> const& fine, F const& f) {
  for (int K = 0; K < coarse[2]; ++K)
    for (int J = 0; J < coarse[1]; ++J)
      for (int I = 0; I < coarse[0]; ++I)
        each_part(K, fine[2], [&](int k, double of_k) {
          each_part(J, fine[1], [&](int j, double of_j) {
            each_part(I, fine[0], [&](int i, double of_i) {
              f(number(coarse, I, J, K), number(fine, i, j, k), of_i * of_j * of_k);
            });
          });
        });
}

}  // namespace

template <int D>
SplineLevels<D>::SplineLevels(Points const& X, std::optional<DistributedSlots> const& shared) : X_(X), shared_(shared) {
  double longest = 0;
  for (std::size_t c = 0; c < D; ++c) {
    auto const [low, high] =
        std::minmax_element(X.begin(), X.end(), [c](auto const& p, auto const& q) { return p[c] < q[c]; });
    low_[c] = (*low)[c];
    length_[c] = std::max((*high)[c] - (*low)[c], 1e-9);
    longest = std::max(longest, length_[c]);
  }
  for (double spacing = finest; levels_.empty() || (spacing < longest && levels_.size() < most_levels); spacing *= 2)
    add_level(spacing);
}

template <int D>
void SplineLevels<D>::add_level(double spacing) {
  PIOLA_EXPECTS(spacing > 0);
  Level level;
  level.spacing = spacing;
  std::array<std::vector<std::array<double, 4>>, 3> e;
  for (std::size_t c = 0; c < 3; ++c) {
    e[c] = {{1, 0, 0, 0}};
    if (c >= D) continue;
    level.intervals[c] = std::max(1, static_cast<int>(std::ceil(length_[c] / spacing - 1e-9)));
    level.splines[c] = level.intervals[c] + 3;
    e[c] = energies(length_[c], spacing, level.intervals[c]);
  }
  for (int k = 0; k < level.splines[2]; ++k)
    for (int j = 0; j < level.splines[1]; ++j)
      for (int i = 0; i < level.splines[0]; ++i)
        level.energy.push_back(third_derivatives(
            {e[0][static_cast<std::size_t>(i)], e[1][static_cast<std::size_t>(j)], e[2][static_cast<std::size_t>(k)]}));
  level.value.resize(level.energy.size() * D);
  levels_.push_back(std::move(level));
}

template <int D>
LazyZeroArray<double> SplineLevels<D>::probe() const {
  LazyZeroArray<double> u(X_.size() * D);
  Range const own = shared_ ? shared_->own() : Range{0, static_cast<Index>(X_.size())};
  for (auto k = static_cast<std::size_t>(own.first) * D; k < static_cast<std::size_t>(own.last) * D; ++k)
    for (std::size_t c = 0; c < D; ++c) {
      double const r = X_[k / D][c] - low_[c] - 0.5 * length_[c];
      u[k] += r * r * r / 6;
    }
  return u;
}

template <int D>
int SplineLevels<D>::interval(std::size_t a, std::size_t axis) const {
  Level const& level = levels_.front();
  return std::min(static_cast<int>((X_[a][axis] - low_[axis]) / level.spacing), level.intervals[axis] - 1);
}

template <int D>
template <class F>
void SplineLevels<D>::visit(std::size_t a, F const& f) const {
  Level const& level = levels_.front();
  std::array<int, 3> first{};
  std::array<std::array<double, 4>, 3> value{{{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}};
  for (std::size_t c = 0; c < D; ++c) {
    double const at = (X_[a][c] - low_[c]) / level.spacing;
    first[c] = interval(a, c);
    value[c] = splines_at(at - first[c], 0);
  }
  for (int k = 0; k < (D > 2 ? 4 : 1); ++k)
    for (int j = 0; j < (D > 1 ? 4 : 1); ++j) {
      double const across = value[1][static_cast<std::size_t>(j)] * value[2][static_cast<std::size_t>(k)];
      std::size_t const row = number(level.splines, first[0], first[1] + j, first[2] + k);
      for (std::size_t i = 0; i < 4; ++i) f(row + i, value[0][i] * across);
    }
}

template <int D>
void SplineLevels<D>::restrict_to(Level const& fine, Level& coarse) {
  std::fill(coarse.value.begin(), coarse.value.end(), 0);
  each_pair(coarse.splines, fine.splines, [&](std::size_t to, std::size_t from, double factor) {
    for (std::size_t J = 0; J < D; ++J) coarse.value[to * D + J] += factor * fine.value[from * D + J];
  });
}

template <int D>
void SplineLevels<D>::prolong(Level const& coarse, Level& fine) {
  each_pair(coarse.splines, fine.splines, [&](std::size_t from, std::size_t to, double factor) {
    for (std::size_t J = 0; J < D; ++J) fine.value[to * D + J] += factor * coarse.value[from * D + J];
  });
}

/// Threads, and ranks, have layers of splines across the last axis for their own and see all particles, so that each
/// spline gets its summands in the order of particles for any number of them.
template <int D>
void SplineLevels<D>::add_to_splines(LazyZeroArray<double> const& r) {
  Level& first = levels_.front();
  auto const particles = static_cast<Index>(X_.size());
  std::fill(first.value.begin(), first.value.end(), 0);
  constexpr auto last = static_cast<std::size_t>(D - 1);
  std::size_t const layer = first.value.size() / D / static_cast<std::size_t>(first.splines[last]);
  std::int64_t const layers = first.splines[last];
  int const count = shared_ ? comm::size() : 1, rank = shared_ ? comm::rank() : 0;
  auto const start = [&](int k) { return static_cast<int>(layers * k / count); };
  int const before = start(rank), mine = start(rank + 1) - before;
  Index const parts = std::max<Index>(1, std::min<Index>(exec_host::team_size(particles), mine));
  exec_host::parallel_for_chunks(parts, particles, [&](Index part) {
    auto const border = [&](Index k) { return before + static_cast<int>(std::int64_t{mine} * k / parts); };
    int const low = border(part), high = border(part + 1);
    for (std::size_t a = 0; a < X_.size(); ++a) {
      int const at = interval(a, last);
      if (at >= high || at + 4 <= low) continue;
      visit(a, [&](std::size_t spline, double value) {
        if (spline < static_cast<std::size_t>(low) * layer || spline >= static_cast<std::size_t>(high) * layer) return;
        for (std::size_t J = 0; J < D; ++J) first.value[spline * D + J] += value * r[a * D + J];
      });
    }
  });
  if (!shared_) return;
  std::vector<std::size_t> starts;
  for (int k = 0; k <= count; ++k) starts.push_back(static_cast<std::size_t>(start(k)) * layer * D);
  comm::allgather(first.value, starts);
}

template <int D>
void SplineLevels<D>::add(LazyZeroArray<double>& r, LazyZeroArray<double>& z) {
  Level& first = levels_.front();
  if (shared_) shared_->complete(r, D);
  add_to_splines(r);
  for (std::size_t l = 1; l < levels_.size(); ++l) restrict_to(levels_[l - 1], levels_[l]);
  for (Level& level : levels_)
    for (std::size_t k = 0; k < level.value.size(); ++k) level.value[k] /= stiffness_ * level.energy[k / D];
  for (std::size_t l = levels_.size() - 1; l > 0; --l) prolong(levels_[l], levels_[l - 1]);
  Range const own = shared_ ? shared_->own() : Range{0, static_cast<Index>(X_.size())};
  exec_host::parallel_for(own, [&](Index particle) {
    auto const a = static_cast<std::size_t>(particle);
    visit(a, [&](std::size_t spline, double value) {
      for (std::size_t J = 0; J < D; ++J) z[a * D + J] += value * first.value[spline * D + J];
    });
  });
}

template class SplineLevels<1>;
template class SplineLevels<2>;
template class SplineLevels<3>;

}  // namespace piola::nodal
