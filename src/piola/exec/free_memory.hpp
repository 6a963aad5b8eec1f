// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace piola::exec_host {

/// Gives memory that set-up has freed back to the system, which the C library would keep for later: what a run takes is
/// then what its arrays take.
void give_back_free_memory();

}  // namespace piola::exec_host
