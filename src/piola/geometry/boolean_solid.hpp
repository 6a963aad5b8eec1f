// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/solid.hpp"

namespace piola::geometry {

enum class BooleanOperation { join, cut, common };  ///< union; the first without the rest; intersection

/// A boolean combination of solids of one dimension. Distances are the least or greatest of those of the parts: exact
/// next to every face, too small near seams. A common face belongs to the first part; opposite faces in a union vanish.
/// Patches are named "1.outer": number of the part, from 1, and name of its patch.
SolidPtr combined(BooleanOperation how, std::vector<SolidPtr> parts);

}  // namespace piola::geometry
