// SPDX-License-Identifier: Apache-2.0
#include "piola/math/envelope_cholesky.hpp"
#include <algorithm>
#include <cmath>

namespace piola {

EnvelopeCholesky::EnvelopeCholesky(std::vector<std::size_t> first) : first_(std::move(first)) {
  std::size_t total = 0;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    begin_.push_back(total);
    total += i + 1 - first_[i];
  }
  values_.assign(total, 0);
  dependent_.assign(first_.size(), false);
}

void EnvelopeCholesky::factorise(std::span<double const> scale) {
  for (std::size_t i = 0; i < size(); ++i) {
    double rest = entry(i, i);
    double const size = scale.empty() ? rest : scale[i];
    for (std::size_t j = first_[i]; j < i; ++j) {
      double sum = entry(i, j);
      for (std::size_t k = std::max(first_[i], first_[j]); k < j; ++k) sum -= entry(i, k) * entry(j, k);
      double const l = dependent_[j] ? 0 : sum / entry(j, j);
      at(i, j) = l;
      rest -= l * l;
    }
    dependent_[i] = !(rest > smallest_pivot * size);
    at(i, i) = dependent_[i] ? 1 : std::sqrt(rest);
  }
}

void EnvelopeCholesky::solve(std::span<double> b) const {
  for (std::size_t i = 0; i < size(); ++i) {
    double sum = b[i];
    for (std::size_t k = first_[i]; k < i; ++k) sum -= entry(i, k) * b[k];
    b[i] = dependent_[i] ? 0 : sum / entry(i, i);
  }
  for (std::size_t i = size(); i-- > 0;) {
    b[i] = dependent_[i] ? 0 : b[i] / entry(i, i);
    for (std::size_t k = first_[i]; k < i; ++k) b[k] -= entry(i, k) * b[i];
  }
}

std::size_t EnvelopeCholesky::rank() const {
  return size() - static_cast<std::size_t>(std::count(dependent_.begin(), dependent_.end(), true));
}

}  // namespace piola
