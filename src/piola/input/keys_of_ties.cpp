// SPDX-License-Identifier: Apache-2.0
#include "piola/input/key_tables.hpp"
#include <array>

namespace piola {
namespace {

using enum KeyInfo::Kind;

constexpr std::array tie_keys{
    KeyInfo{"tie",
            "name",
            name,
            "",
            {},
            "tie_0, tie_1, ...",
            "first part of the columns NAME.force_x to NAME.moment_z of history.csv, what the second one does to the "
            "first",
            {}},
    KeyInfo{"tie", "between", list, "", {}, "", "names of two bodies, or of a body and a rigid shape", {}},
    KeyInfo{"tie",
            "where",
            formula,
            "",
            {},
            "the whole surface",
            "condition in X, Y, Z, at the start, that selects surface points; names are those of the first body",
            {}},
    KeyInfo{
        "tie",
        "stiffness",
        quantity,
        "1",
        positive,
        "2",
        "factor on the stiffness, that of a layer of one spacing: more reflects less of a wave and shortens the step",
        {}},
    KeyInfo{"tie",
            "strength",
            quantity,
            "Pa",
            positive,
            "none: it never fails",
            "largest traction in opening, from which on it softens",
            {}},
    KeyInfo{"tie",
            "toughness",
            quantity,
            "J/m^2",
            positive,
            "none",
            "strength (required there): energy that failure takes per area, the area under the curve",
            {}},
    KeyInfo{"tie",
            "shear_weight",
            quantity,
            "1",
            {0, 100, true, false},
            "1",
            "strength: weight of sliding in the effective opening; the shear strength is this times the strength",
            {}},
};

}  // namespace

std::span<KeyInfo const> keys_of_ties() { return tie_keys; }

}  // namespace piola
