// SPDX-License-Identifier: Apache-2.0
#include "piola/input/key_tables.hpp"
#include <array>

namespace piola {
namespace {

using enum KeyInfo::Kind;

constexpr std::array region_keys{
    KeyInfo{"body.part", "name", name, "", any_value, "part_1, part_2, ...", "what it is called in messages"},
    KeyInfo{"body.part", "where", formula, "", any_value, "",
            "condition in X, Y, Z, regions, depth that selects particles; a region with a shape alone cuts a packed "
            "body along its surface"},
    KeyInfo{"body.part", "material", table, "", any_value, "", "law and parameters there"},

    KeyInfo{"region", "name", name, "", any_value, "", "its name in formulas, where it is 1 inside and 0 outside"},
    KeyInfo{"region", "where", formula, "", any_value, "none", "condition in X, Y, Z, constants and regions before it"},
    KeyInfo{"region", "shape", table, "", any_value, "none", "the inside of a shape, as of a part of a solid"},
    KeyInfo{"region", "near", table, "", any_value, "none", "places close to a surface from a file"},

    KeyInfo{"region.near", "file", text, "", any_value, "", "path from the case file: .stl, .obj or .ply"},
    KeyInfo{"region.near", "unit", text, "", any_value, "", "what one is in the file, such as mm"},
    KeyInfo{"region.near", "within", quantity, "m", above(0, 1e15), "", "largest distance from the surface"},
};

}  // namespace

std::vector<KeyInfo> keys_of_regions() { return {region_keys.begin(), region_keys.end()}; }

}  // namespace piola
