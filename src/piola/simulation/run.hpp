// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/simulation/moment.hpp"
#include "piola/simulation/observers.hpp"
#include "piola/simulation/relaxation.hpp"
#include <atomic>
#include <optional>
#include <span>
#include <string>

namespace piola {

/// How the main loop ended.
struct March {
  Ending ending = Ending::completed;
  std::optional<Failure> failure;  ///< set if ending is failed
  std::string causes;              ///< likely ones, where more is known than the failure says
};

/// The main loop: from `moment` to the end time of `run`, or until the bodies are at rest if `relaxation` looks for
/// that, or until the physics fails or an observer objects, or until `stop` is not zero. Observers see the const state
/// after each step; they never change the step.
March march(Formulation& formulation, RunSpec const& run, Moment& moment, std::span<Observer* const> observers,
            std::atomic<int> const& stop, Relaxation* relaxation = nullptr);

}  // namespace piola
