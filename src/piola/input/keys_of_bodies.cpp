// SPDX-License-Identifier: Apache-2.0
#include "piola/input/key_tables.hpp"
#include <array>

namespace piola {
namespace {

using enum KeyInfo::Kind;

constexpr Interval half_open{0, 0.5, false, true};

constexpr std::array<std::string_view, 1> none_word{"none"};
constexpr std::array<std::string_view, 2> geometry_words{"cartesian", "axisymmetric"};
constexpr std::array<std::string_view, 3> placement_words{"on_boundary", "cell_centred", "random"};
constexpr std::array<std::string_view, 3> arrangement_words{"lattice", "rings", "lattice_with_rings"};

constexpr std::array body_keys{
    KeyInfo{"", "title", text, "", any_value, "", "what the case is called in files and pictures"},
    KeyInfo{"", "geometry", word, "", any_value, "\"cartesian\"",
            "axisymmetric: bodies of revolution, drawn in 2D as half sections with x the radius and y along the axis; "
            "masses, forces and energies are those of the full circle",
            geometry_words},
    KeyInfo{"", "constants", table, "", any_value, "none",
            "named numbers for formulas: name = \"105 rad/s\" or a number in SI units"},
    KeyInfo{"", "library", list, "", any_value, "none", "files with materials of your own, relative to the case"},
    KeyInfo{"", "run", table, "", any_value, "", "how long and how to run"},
    KeyInfo{"", "region", list, "", any_value, "none", "places with names"},
    KeyInfo{"", "body", list, "", any_value, "", "the bodies"},
    KeyInfo{"", "support", list, "", any_value, "none", "the supports"},
    KeyInfo{"", "load", list, "", any_value, "none", "the loads"},
    KeyInfo{"", "mirror", list, "", any_value, "none", "the planes of symmetry"},
    KeyInfo{"", "crack", list, "", any_value, "none", "the cracks"},
    KeyInfo{"", "rigid", list, "", any_value, "none", "the rigid obstacles"},
    KeyInfo{"", "spring", list, "", any_value, "none", "the springs of rigid shapes"},
    KeyInfo{"", "contact", table, "", any_value, "see [contact]", "what keeps bodies apart; \"none\": nothing",
            none_word},
    KeyInfo{"", "tie", list, "", any_value, "none", "what holds bodies together"},
    KeyInfo{"", "probe", list, "", any_value, "none", "the probes"},
    KeyInfo{"", "quantity", list, "", any_value, "none", "the quantities of the summary"},
    KeyInfo{"", "output", table, "", any_value, "a history only", "what is written"},

    KeyInfo{"body", "name", name, "", any_value, "", "name that supports and probes refer to"},
    KeyInfo{"body", "shape", table, "", any_value, "", "shape and particles"},
    KeyInfo{"body", "material", table, "", any_value, "", "law and parameters"},
    KeyInfo{"body", "formulation", table, "", any_value, "", "formulation and settings"},
    KeyInfo{"body", "part", list, "", any_value, "none", "parts of other materials"},
    KeyInfo{"body", "define", table, "", any_value, "none",
            "named formulas for the formulas of this body, its supports and probes"},
    KeyInfo{"body", "initial_velocity", formulas, "m/s", any_value, "at rest",
            "velocity at the start, one formula per direction"},
    KeyInfo{"body", "initial_displacement", formulas, "m", any_value, "none",
            "displacement at the start, one formula per direction"},
    KeyInfo{"body", "initial_deformation_gradient", formulas, "1", any_value, "the identity",
            "deformation gradient at the start, a list of rows of formulas"},
    KeyInfo{"body", "initial_temperature", formula, "K", any_value, "material.initial_temperature",
            "temperature at the start, above 0, for nodal; its difference to that of the material is heat"},

    KeyInfo{"body.shape", "box", table, "", any_value, "none", "a box"},
    KeyInfo{"body.shape", "sphere", table, "", any_value, "none", "a sphere, disc or interval"},
    KeyInfo{"body.shape", "cylinder", table, "", any_value, "none", "a cylinder"},
    KeyInfo{"body.shape", "particles", list, "", count_range, "from spacing", "box: particles per direction"},
    KeyInfo{"body.shape", "spacing", quantity, "m", length_range, "from particles",
            "distance of particles; a box takes the nearest that fits"},
    KeyInfo{"body.shape", "placement", word, "", any_value, "\"on_boundary\", cylinder: \"cell_centred\"",
            "box, and cylinder along its axis: particles on the faces, or in the middle of cells; box: random within "
            "faces as of on_boundary, then relaxed",
            placement_words},
    KeyInfo{"body.shape", "jitter", quantity, "1", half_open, "0",
            "random shift of inner particles as a fraction of the spacing"},
    KeyInfo{"body.shape", "seed", whole, "", closed(0, 4294967295.0), "1",
            "seed of the jitter or of the random places"},

    KeyInfo{"body.shape.box", "min", point, "m", place_range, "", "lowest corner"},
    KeyInfo{"body.shape.box", "max", point, "m", place_range, "", "highest corner"},
    KeyInfo{"body.shape.sphere", "centre", point, "m", place_range, "", "centre"},
    KeyInfo{"body.shape.sphere", "radius", quantity, "m", length_range, "", "radius"},
    KeyInfo{"body.shape.sphere", "inner_radius", quantity, "m", length_range, "no hole",
            "2D, 3D: radius of the hole of a ring or a shell"},
    KeyInfo{"body.shape.sphere", "arrangement", word, "", any_value, "\"lattice\"",
            "2D: particles on a lattice, on circles about the centre, or on a lattice within the two outermost circles",
            arrangement_words},
    KeyInfo{"body.shape.cylinder", "centre", point, "m", place_range, "", "centre of the lower end"},
    KeyInfo{"body.shape.cylinder", "radius", quantity, "m", length_range, "", "radius"},
    KeyInfo{"body.shape.cylinder", "inner_radius", quantity, "m", length_range, "no hole",
            "radius of the hole of a tube"},
    KeyInfo{"body.shape.cylinder", "length", quantity, "m", length_range, "", "length from the lower to the upper end"},
    KeyInfo{"body.shape.cylinder", "axis", word, "", any_value, "\"z\"", "direction from the lower to the upper end",
            axis_words},

    KeyInfo{"body.material", "law", text, "", any_value, "that of `name`",
            "name of the law; its words and parameters are further keys"},
    KeyInfo{"body.material", "name", text, "", any_value, "none",
            "a material of the library; further keys change its parameters. With `library`: which of its laws"},
    KeyInfo{"body.material", "library", text, "", any_value, "none",
            "path from the case file to a shared library with a law of your own; density and its parameters are "
            "further keys"},
    KeyInfo{"body.formulation", "name", text, "", any_value, "",
            "name of the formulation; its settings are further keys"},
};

}  // namespace

std::vector<KeyInfo> keys_of_bodies() { return {body_keys.begin(), body_keys.end()}; }

}  // namespace piola
