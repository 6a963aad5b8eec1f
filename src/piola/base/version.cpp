// SPDX-License-Identifier: Apache-2.0
#include "piola/base/version.hpp"

#ifndef PIOLA_VERSION
#define PIOLA_VERSION "0.0.0"
#endif

namespace piola {

std::string_view version() { return PIOLA_VERSION; }

}  // namespace piola
