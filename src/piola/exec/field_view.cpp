// SPDX-License-Identifier: Apache-2.0
#include "piola/exec/field_view.hpp"
#include <stdexcept>
#include <string>

namespace piola {

void stale_halo(char const* field) {
  throw std::logic_error("field '" + std::string(field) +
                         "' is read at neighbours but its halo is older than its owners: add it to halo.refresh() "
                         "before this pass");
}

}  // namespace piola
