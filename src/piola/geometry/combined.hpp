// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"

namespace piola::geometry {

enum class Combination { join, cut, common };  ///< union; the first without the rest; intersection

/// A boolean combination of solids of one dimension. Distances are the least or greatest of the parts': exact next to
/// every face, too small beside seams. Where parts share a face the first one owns it, and faces against each other in
/// a union vanish. Patches are named "1.outer": the part, counted from 1, and its own.
SolidPtr combined(Combination how, std::vector<SolidPtr> parts);

}  // namespace piola::geometry
