// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/study/convergence.hpp"
#include "piola/study/study.hpp"
#include <span>
#include <string>
#include <vector>

namespace piola {

/// The quantities of a case at two or three spacings, with orders, extrapolated values and estimated errors.
class ConvergenceTable {
 public:
  /// `spacings` [m]: from the coarsest to the finest; `outcomes`: of the runs with these.
  ConvergenceTable(std::vector<QuantitySpec> const& quantities, std::vector<double> spacings,
                   std::vector<RunOutcome> const& outcomes);
  /// Whether there is an estimate of the error of every quantity.
  bool has_errors() const;
  /// A table for people, and a sentence for each quantity that does not converge monotonically.
  std::string text() const;
  /// A line for each quantity: values, unit, kind, order, extrapolated value, estimated errors.
  std::string csv() const;

 private:
  struct Row {
    std::string name, unit;
    Convergence convergence;
  };
  std::vector<double> spacings_;
  std::vector<Row> rows_;
};

}  // namespace piola
