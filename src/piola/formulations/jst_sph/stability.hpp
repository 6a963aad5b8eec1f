// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/body.hpp"

namespace piola::jst_sph {

/// Stability of velocity Verlet for a body, in the reference configuration. With h the smallest spacing and c_p0 the
/// p-wave speed: frequency = omega_max h / c_p0 of the internal force, damping = h / c_p0 times the largest rate of the
/// stabilisation. A step alpha h / c_p0 is stable while alpha^2 frequency^2 + 2 alpha damping <= 4.
struct StabilityLimit {
  double frequency = 0, damping = 0;
  double alpha() const;  ///< the largest stable alpha
};

/// By power iteration with the machine's own passes; leaves the state of the body as it was.
StabilityLimit stability_limit(JstBody& body, Machine const& machine);

}  // namespace piola::jst_sph
