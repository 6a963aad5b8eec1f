// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>

namespace piola {

/// Set-up was ended before the first step, by a signal or because the wall time is used up: exit code 4.
class SetUpStopped : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace piola
