// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::app {

/// Lets threads that wait for others sleep after some microseconds instead of turning idly for milliseconds, which
/// takes the time of other programs where cores are shared. OpenMP reads such wishes from the environment before main
/// starts, so this writes them there and starts the program once more in the same process; it returns where the user
/// has wishes of their own (OMP_WAIT_POLICY, GOMP_SPINCOUNT, KMP_BLOCKTIME) and where the program cannot be started
/// again.
void sleep_while_waiting(char** arguments);

}  // namespace piola::app
