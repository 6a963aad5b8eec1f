// SPDX-License-Identifier: Apache-2.0
#include "piola/math/envelope_cholesky.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

/// Dot product of n numbers in eight partial sums: several times as fast as one sum, whose additions depend on each
/// other.
double product(double const* a, double const* b, std::size_t n) {
  constexpr std::size_t parts = 8;
  double sum[parts]{};
  std::size_t k = 0;
  for (; k + parts <= n; k += parts)
    for (std::size_t l = 0; l < parts; ++l) sum[l] += a[k + l] * b[k + l];
  for (; k < n; ++k) sum[0] += a[k] * b[k];
  return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

}  // namespace

EnvelopeCholesky::EnvelopeCholesky(std::vector<std::size_t> first) : first_(std::move(first)) {
  std::size_t total = 0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    PIOLA_EXPECTS(first_[i] <= i);
    begin_.push_back(total);
    total += i + 1 - first_[i];
  }
  values_.assign(total, 0);
  dependent_.assign(first_.size(), false);
}

void EnvelopeCholesky::factorise(std::span<double const> scale) {
  PIOLA_EXPECTS(scale.empty() || scale.size() == size());
  for (std::size_t i = 0; i < size(); ++i) {
    double rest = entry(i, i);
    double const size = scale.empty() ? rest : scale[i];
    for (std::size_t j = first_[i]; j < i; ++j) {
      std::size_t const from = std::max(first_[i], first_[j]);
      double const sum = entry(i, j) - product(&at(i, from), &at(j, from), j - from);
      double const l = dependent_[j] ? 0 : sum / entry(j, j);
      at(i, j) = l;
      rest -= l * l;
    }
    dependent_[i] = !(rest > smallest_pivot * size);
    at(i, i) = dependent_[i] ? 1 : std::sqrt(rest);
  }
}

void EnvelopeCholesky::solve(std::span<double> b) const {
  PIOLA_EXPECTS(b.size() == size());
  for (std::size_t i = 0; i < size(); ++i) {
    double const sum = b[i] - product(values_.data() + begin_[i], &b[first_[i]], i - first_[i]);
    b[i] = dependent_[i] ? 0 : sum / entry(i, i);
  }
  for (std::size_t i = size(); i-- > 0;) {
    b[i] = dependent_[i] ? 0 : b[i] / entry(i, i);
    for (std::size_t k = first_[i]; k < i; ++k) b[k] -= entry(i, k) * b[i];
  }
}

std::size_t EnvelopeCholesky::rank() const {
  PIOLA_EXPECTS(dependent_.size() == size());
  return size() - static_cast<std::size_t>(std::count(dependent_.begin(), dependent_.end(), true));
}

}  // namespace piola
