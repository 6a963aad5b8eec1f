// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::app {

/// Makes waiting threads sleep after some microseconds instead of spinning for milliseconds, which would take the time
/// of other programs on shared cores. OpenMP reads such settings from the environment before main starts, so this sets
/// them there and restarts the program in the same process. Returns if the user has set them (OMP_WAIT_POLICY,
/// GOMP_SPINCOUNT, KMP_BLOCKTIME) or if the program cannot be restarted.
void sleep_while_waiting(char** arguments);

}  // namespace piola::app
