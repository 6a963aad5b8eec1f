// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/smoothing.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace piola::nodal {
namespace {

constexpr double support = 2.4;     ///< in spacings
constexpr int most_sweeps = 50;     ///< each at least halves the error of the rows
constexpr double tolerance = 1e-4;  ///< for the sums of rows; the rest is assigned to the particle itself

/// Wendland C2 of r in spacings, without its factor.
double kernel(double r) {
  double const rest = std::max(0.0, 1 - r / support), square = rest * rest;
  return square * square * (1 + 4 * r / support);
}

}  // namespace

Smoothing::Smoothing(Reference const& reference, int dimension, Range own, HaloPlan const* halo)
    : reference_(reference),
      begin_(reference.begin),
      neighbour_(reference.neighbour),
      V_(reference.V),
      range_(own),
      halo_(halo) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  find_weights(reference, static_cast<std::size_t>(dimension));
  balance();
}

template <class F>
void Smoothing::each_particle(F const& f) const {
  exec_host::parallel_for(range_.last - range_.first, [&](Index k) { f(static_cast<std::size_t>(range_.first + k)); });
}

/// Exchanges the ghost values.
void Smoothing::tell(LazyZeroArray<double>& values) const {
  if (halo_ != nullptr) exchange_once(*halo_, {.data = values.data()}, 1);
}

void Smoothing::find_weights(Reference const& reference, std::size_t dimension) {
  weight_.resize(neighbour_.size());
  each_particle([&](std::size_t a) {
    for (auto k = static_cast<std::size_t>(begin_[a]); k < static_cast<std::size_t>(begin_[a + 1]); ++k) {
      auto const b = static_cast<std::size_t>(neighbour_[k]);
      double square = 0;
      for (std::size_t c = 0; c < dimension; ++c) {
        double const r = reference.X[b * dimension + c] - reference.X[a * dimension + c];
        square += r * r;
      }
      weight_[k] = kernel(std::sqrt(square));
    }
  });
}

/// d <- sqrt(d / sum_b W_ab V_b d_b), b = a included, as long as a row is off. The sums of rows are exact in the end.
void Smoothing::balance() {
  LazyZeroArray<double> d(V_.size()), sum(V_.size());
  each_particle([&](std::size_t a) { d[a] = 1 / std::sqrt(V_[a]); });
  double off = 1;
  for (int sweep = 0; sweep < most_sweeps && off > tolerance; ++sweep) {
    tell(d);
    each_particle([&](std::size_t a) {
      sum[a] = V_[a] * d[a];
      for (auto k = static_cast<std::size_t>(begin_[a]); k < static_cast<std::size_t>(begin_[a + 1]); ++k) {
        auto const b = owner(k);
        sum[a] += weight_[k] * V_[b] * d[b];
      }
    });
    off = 0;
    for (auto a = static_cast<std::size_t>(range_.first); a < static_cast<std::size_t>(range_.last); ++a)
      off = std::max(off, std::abs(d[a] * sum[a] - 1));
    if (halo_ != nullptr) comm::allreduce_max(off);
    each_particle([&](std::size_t a) { d[a] = std::sqrt(d[a] / sum[a]); });
  }
  tell(d);
  own_ = LazyZeroArray<double>(V_.size());
  each_particle([&](std::size_t a) {
    own_[a] = 1;
    for (auto k = static_cast<std::size_t>(begin_[a]); k < static_cast<std::size_t>(begin_[a + 1]); ++k) {
      auto const b = owner(k);
      weight_[k] *= d[a] * d[b] * V_[b];
      own_[a] -= weight_[k];
    }
  });
}

LazyZeroArray<double> Smoothing::once(LazyZeroArray<double> f) const {
  tell(f);
  LazyZeroArray<double> smooth(f.size());
  each_particle([&](std::size_t a) {
    smooth[a] = own_[a] * f[a];
    for (auto k = static_cast<std::size_t>(begin_[a]); k < static_cast<std::size_t>(begin_[a + 1]); ++k)
      smooth[a] += weight_[k] * f[owner(k)];
  });
  return smooth;
}

LazyZeroArray<double> Smoothing::operator()(LazyZeroArray<double> f) const { return once(once(std::move(f))); }

}  // namespace piola::nodal
