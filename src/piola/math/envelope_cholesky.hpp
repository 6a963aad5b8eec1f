// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace piola {

/// Solves A x = b for a symmetric positive semidefinite matrix whose rows are stored from their first entry on.
/// Equations that depend linearly on earlier ones are detected and skipped; their unknowns are zero. Host only.
class EnvelopeCholesky {
 public:
  /// first[i] <= i: the first column of row i that may differ from zero.
  explicit EnvelopeCholesky(std::vector<std::size_t> first);

  /// Entry of the lower triangle, first[i] <= j <= i; to be filled before `factorise`.
  double& at(std::size_t i, std::size_t j) { return values_[begin_[i] + j - first_[i]]; }
  /// scale[i]: reference of the pivot of row i; nothing: its diagonal.
  void factorise(std::span<double const> scale = {});
  /// b becomes x.
  void solve(std::span<double> b) const;
  std::size_t rank() const;
  std::size_t size() const { return first_.size(); }
  std::size_t bytes() const { return values_.size() * sizeof(double); }

 private:
  /// A pivot below this fraction of the scale of its row counts as zero.
  static constexpr double smallest_pivot = 1e-10;
  double entry(std::size_t i, std::size_t j) const { return values_[begin_[i] + j - first_[i]]; }

  std::vector<std::size_t> first_, begin_;
  std::vector<double> values_;
  std::vector<bool> dependent_;
};

}  // namespace piola
