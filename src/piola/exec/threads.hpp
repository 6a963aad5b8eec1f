// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::exec_host {

/// Sets the number of threads of all later loops; 0: one per core that this process may use. Returns the number.
int set_threads(int threads);
int threads();
/// Pins each thread to one of the cores that this process may use (benchmarks).
void pin_threads();

}  // namespace piola::exec_host
