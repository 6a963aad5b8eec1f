// SPDX-License-Identifier: Apache-2.0
#include "piola/input/key_tables.hpp"
#include <array>

namespace piola {
namespace {

using enum KeyInfo::Kind;

constexpr std::array<std::string_view, 2> filling_words{"packed", "lattice"};
constexpr std::array<std::string_view, 4> repair_words{"none", "orient", "holes", "faces"};

/// Kinds of solids, allowed as shapes and as parts of combined solids.
struct SolidKey {
  std::string_view key, meaning;
  KeyInfo::Kind kind = table;
};
constexpr std::array solid_rows{
    SolidKey{"torus", "a ring of circular cross-section"},
    SolidKey{"cone", "a cone or a frustum"},
    SolidKey{"capsule", "all places within a radius of a line; 2D, too"},
    SolidKey{"half_space", "one side of a plane or line; only in an intersection or to be cut away"},
    SolidKey{"formula", "the places that satisfy a formula"},
    SolidKey{"extrude", "a polygon, drawn along z in 3D"},
    SolidKey{"revolve", "a polygon in radius and height, turned about an axis"},
    SolidKey{"mesh", "the inside of a surface from a CAD program"},
    SolidKey{"union", "a list of shapes: what is in one of them or more", list},
    SolidKey{"difference", "a list of shapes: what is in the first and in none of the others", list},
    SolidKey{"intersection", "a list of shapes: what is in all of them", list},
    SolidKey{"transform", "scales, turns and moves the shape, in this order"},
};
constexpr std::array plain_rows{SolidKey{"box", "a box"}, SolidKey{"sphere", "a sphere or disc"},
                                SolidKey{"cylinder", "a cylinder"}};

constexpr std::array parameters{
    KeyInfo{"body.shape", "arrangement", word, "", any_value,
            "\"lattice\" for a box, sphere or cylinder as it is, else \"packed\"",
            "packed: particles of equal volume pushed apart until they fill the shape evenly; lattice: cells of a "
            "lattice whose middle is inside",
            filling_words},

    KeyInfo{"body.shape", "cache", flag, "", any_value, "false",
            "keeps the packing beside the case as packed-....cloud for the next run; results folders always have it"},
    KeyInfo{"body.shape", "points", table, "", any_value, "none", "particles from a file"},
    KeyInfo{"body.shape.points", "file", text, "", any_value, "",
            "path from the case file: .csv, .h5, or a frame (.hdf)"},
    KeyInfo{"body.shape.points", "unit", text, "", any_value, "m", "of a file that gives no units"},
    KeyInfo{"body.shape.points", "volume", quantity, "m^3", positive, "the column volume",
            "of the body, shared equally; in 2D a number in m^2"},
    KeyInfo{"body.shape.points", "body", text, "", any_value, "all rows", "only rows with this in the column body"},
    KeyInfo{"body.shape.points", "group", text, "", any_value, "the file itself", "of an HDF5 file of another program"},

    KeyInfo{"body.shape.torus", "centre", point, "m", place_range, "", "centre"},
    KeyInfo{"body.shape.torus", "radius", quantity, "m", length_range, "", "from the centre to that of the tube"},
    KeyInfo{"body.shape.torus", "tube_radius", quantity, "m", length_range, "", "radius of the tube"},
    KeyInfo{"body.shape.torus", "axis", word, "", any_value, "\"z\"", "direction of its axis", axis_words},

    KeyInfo{"body.shape.cone", "centre", point, "m", place_range, "", "centre of the lower end"},
    KeyInfo{"body.shape.cone", "radius", quantity, "m", not_negative, "", "radius at the lower end"},
    KeyInfo{"body.shape.cone", "end_radius", quantity, "m", not_negative, "0", "radius at the upper end"},
    KeyInfo{"body.shape.cone", "length", quantity, "m", length_range, "", "from the lower to the upper end"},
    KeyInfo{"body.shape.cone", "axis", word, "", any_value, "\"z\"", "direction from the lower to the upper end",
            axis_words},

    KeyInfo{"body.shape.capsule", "from", point, "m", place_range, "", "beginning of the line"},
    KeyInfo{"body.shape.capsule", "to", point, "m", place_range, "", "end of the line"},
    KeyInfo{"body.shape.capsule", "radius", quantity, "m", length_range, "", "radius about the line"},

    KeyInfo{"body.shape.half_space", "point", point, "m", place_range, "", "a place on the plane"},
    KeyInfo{"body.shape.half_space", "normal", point, "1", place_range, "", "direction out of the material"},

    KeyInfo{"body.shape.formula", "inside", text, "", any_value, "",
            "a comparison of formulas in X, Y, Z with < or >, such as \"(X/a)^2 + Y^2 < 1\""},
    KeyInfo{"body.shape.formula", "min", point, "m", place_range, "", "lowest corner of a box around the shape"},
    KeyInfo{"body.shape.formula", "max", point, "m", place_range, "", "highest corner of that box"},

    KeyInfo{"body.shape.extrude", "polygon", list, "", any_value, "", "corners [x, y] of the outline, in order"},
    KeyInfo{"body.shape.extrude", "holes", list, "", any_value, "none", "polygons cut out of it"},
    KeyInfo{"body.shape.extrude", "from", quantity, "m", place_range, "2D", "3D: z at the lower end"},
    KeyInfo{"body.shape.extrude", "to", quantity, "m", place_range, "2D", "3D: z at the upper end"},

    KeyInfo{"body.shape.revolve", "polygon", list, "", any_value, "", "corners [radius, height], in order"},
    KeyInfo{"body.shape.revolve", "axis", word, "", any_value, "\"z\"", "axis through the origin", axis_words},

    KeyInfo{"body.shape.mesh", "file", text, "", any_value, "", "path from the case file: .stl, .obj or .ply"},
    KeyInfo{"body.shape.mesh", "unit", text, "", any_value, "",
            "what one is in the file, such as mm: meshes do not say"},
    KeyInfo{"body.shape.mesh", "repair", word, "", any_value, "\"none\"",
            "orient: faces are turned until neighbours agree; holes: holes are allowed up to largest_hole; faces: "
            "faces that stand twice or have no area are removed, the others turned",
            repair_words},
    KeyInfo{"body.shape.mesh", "largest_hole", quantity, "m", positive, "none", "repair = \"holes\""},
    KeyInfo{"body.shape.mesh", "merge", quantity, "m", positive, "none", "corners nearer than this become one"},
    KeyInfo{"body.shape.mesh", "feature_angle", quantity, "rad", above(0, 3.2), "30 degree",
            "patches end where the surface turns by more; a file with groups has these as patches"},

    KeyInfo{"body.shape.transform", "scale", quantity, "1", positive, "1", "factor on all lengths"},
    KeyInfo{"body.shape.transform", "rotate", table, "", any_value, "none",
            "a turn about the origin, or a list of them in order: { axis = [0, 0, 1], angle = \"30 degree\" }; in 2D "
            "without axis"},
    KeyInfo{"body.shape.transform", "move", point, "m", place_range, "none", "displacement after that"},

    KeyInfo{"body.shape.rotate", "axis", point, "1", place_range, "[0, 0, 1]", "direction of the axis"},
    KeyInfo{"body.shape.rotate", "angle", quantity, "rad", place_range, "", "positive as a right-handed screw"},
};

}  // namespace

std::vector<KeyInfo> keys_of_solids() {
  std::vector<KeyInfo> all;
  auto const add = [&](std::string_view section, SolidKey const& k) {
    all.push_back({section, k.key, k.kind, "", any_value, "none", k.meaning});
  };
  for (SolidKey const& k : solid_rows) add("body.shape", k);
  for (SolidKey const& k : plain_rows) add("body.shape.part", k);
  for (SolidKey const& k : solid_rows) add("body.shape.part", k);
  all.insert(all.end(), parameters.begin(), parameters.end());
  return all;
}

}  // namespace piola
