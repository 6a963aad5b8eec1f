// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/observers/observer.hpp"
#include <limits>
#include <utility>

namespace piola {

/// Logs what limits the next step, each time it has halved since the longest step or the last such line.
class StepObserver : public Observer {
 public:
  explicit StepObserver(Results results) : results_(std::move(results)) {}
  void observe(Formulation const& formulation, TimeState const& moment) override;

 private:
  Results results_;
  // Not in checkpoints: the log of a resumed run keeps the lines before.
  double longest_ = 0, logged_ = std::numeric_limits<double>::infinity();  ///< [s]
};

}  // namespace piola
