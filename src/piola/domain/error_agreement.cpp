// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/error_agreement.hpp"
#include "piola/base/contracts.hpp"

namespace piola::comm {

void agree_after(std::function<void()> const& f) {
  PIOLA_EXPECTS(f != nullptr);
  if (!is_parallel()) return f();
  ErrorReport own;
  try {
    f();
  } catch (CollectiveError const&) {
    throw;  // on all ranks
  } catch (...) {
    own = report_of(std::current_exception());
  }
  if (ErrorReport const first = agree(own); first.code != 0) throw CollectiveError(first);
}

void on_root(std::function<void()> const& f) {
  agree_after([&] {
    if (rank() == 0) f();
  });
}

}  // namespace piola::comm
