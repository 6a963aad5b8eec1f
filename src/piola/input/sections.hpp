// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/input/material_library.hpp"
#include "piola/input/section.hpp"
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace piola {

/// Readers of the sections of a case file. Each adds errors to the section's problems and returns what could be read,
/// so that one bad section does not hide the problems of another. model/read_case.cpp calls them in the order of
/// their data.

/// Facts about a body for readers of later sections. `names` may be used in formulas.
struct BodyNames {
  std::string name;
  int dimension = 3;
  bool axisymmetric = false;
  ShapeSpec shape;
  Names names;
  bool readable = true;  ///< whether the shape could be read, which gives the dimension
};

/// The body that a section names; null (and a problem) if there is none.
BodyNames const* find_body(Section const& section, std::vector<BodyNames> const& bodies, std::string& name);
/// One formula per direction of the body.
std::optional<std::array<Expression, 3>> read_vector(Section const& section, std::string_view key,
                                                     BodyNames const& body);
std::optional<std::vector<Expression>> read_formulas(Value const& value, std::string_view unit, std::size_t count,
                                                     Names const& names, Problems& problems);
/// As above for a list of counts[0] to counts[1] formulas.
std::optional<std::vector<Expression>> read_formulas(Value const& value, std::string_view unit,
                                                     std::array<std::size_t, 2> counts, Names const& names,
                                                     Problems& problems);
/// Numbers of directions that a list may have, least and most: any if the shape of the body could not be read.
std::array<std::size_t, 2> directions_of(BodyNames const& body);
/// Reads a point with as many components as the body has. The target of a missing or wrong one stays as it is.
bool read_components(Section const& section, std::string_view key, int dimension, std::array<double, 3>& target);
/// As read_components(), normalised to a unit vector.
bool read_direction(Section const& section, std::string_view key, int dimension, std::array<double, 3>& target);
/// The directions that the letters of the key `fix` name; a problem if there are other letters or none.
std::array<bool, 3> fixed_axes(Section const& section, std::string const& fix, int dimension);
/// A sub-table whose keys are those of the section `keys`; nothing (and a problem) if it is no table.
std::optional<Section> table_with_keys(Section const& section, std::string_view key, std::string keys);
/// The tables of a list of 1 to `most`, such as [[body.part]]. Items that are no tables are problems.
std::vector<Section> tables_in(Section const& section, std::string_view key, std::size_t most);
/// Reports the second of two keys if it is given and below the first: key, value.
void check_order(Section const& section, std::pair<std::string_view, double> low,
                 std::pair<std::string_view, double> high, std::string_view unit);
/// Places of the section and of those of `keys` that it gives.
Places places_of(Section const& section, std::initializer_list<char const*> keys);

void read_run(Section const& section, RunSpec& run);
void read_output(Section const& section, OutputSpec& output, std::span<BodySpec const> bodies);
/// The part of read_output that reads [output.pictures].
void read_pictures(Section const& section, PicturesSpec& pictures, std::span<BodySpec const> bodies);
/// Names of all fields.
std::vector<std::string> known_fields();
/// The part of read_pictures() for the appearance of bodies. Missing keys of a panel leave `appearance` unchanged.
void read_appearance(Section const& pictures, std::span<BodySpec const> bodies, Appearance& appearance);
std::map<std::string, double> read_constants(Value const& value, Problems& problems);

/// `names`: constants, for formulas.
ShapeSpec read_shape(Section const& section, Names const& names);
/// `names`: constants.
RegionSpec read_region(Section const& section, Names const& names);
/// `common`: constants and regions. Sets `names` to those of the body.
BodySpec read_body(Section const& section, Names const& common, CaseLibrary const& library, BodyNames& names);
/// The key `part` of a body. `regions`: for parts that are a region's shape.
std::vector<PartSpec> read_parts(Section const& section, BodyNames const& body, std::vector<RegionSpec> const& regions,
                                 CaseLibrary const& library);
void read_material(Section const& section, CaseLibrary const& library, BodySpec& body);
/// Words and numbers of a material of a library file, without their sources. `keys`: its other ones.
MaterialParameters read_law_values(Section const& section, LawInfo const& law, std::vector<std::string> keys);
std::vector<std::string> law_names();
/// `names` may be used in its formulas.
FormulationSpec read_formulation(Section const& section, Names const& names);
/// The part of read_formulation that reads the formulas of a formulation.
void read_formulation_formulas(Section const& section, std::span<FormulaInfo const> formulas, Names const& names,
                               FormulationSpec& spec);
std::vector<Definition> read_definitions(Value const& value, Names const& names, Problems& problems);

SupportSpec read_support(Section const& section, std::vector<BodyNames> const& bodies);
LoadSpec read_load(Section const& section, std::vector<BodyNames> const& bodies);
MirrorSpec read_mirror(Section const& section, std::vector<BodyNames> const& bodies);
CrackSpec read_crack(Section const& section, std::vector<BodyNames> const& bodies);
/// `dimension` is that of the bodies; `constants` may be used in the velocity.
RigidSpec read_rigid(Section const& section, BodyNames const& names);
/// The part of read_rigid that reads how the shape moves.
void read_rigid_motion(Section const& section, BodyNames const& names, RigidSpec& rigid);
/// The part of read_rigid() for the key `inertia` of a free shape in 2D or 3D.
void read_inertia(Section const& section, int dimension, RigidSpec& rigid);
/// `names`: of the case; `rigids`: the shapes that a spring may name.
SpringSpec read_spring(Section const& section, BodyNames const& names, std::vector<RigidSpec> const& rigids);
/// Reads the rule for all bodies and those of pairs: a table, a list of tables, or "none".
void read_contact(Value const& value, int dimension, Problems& problems, CaseSpec& spec);
/// `rigids`: the rigid shapes that a tie may name.
TieSpec read_tie(Section const& section, std::vector<BodyNames> const& bodies, std::vector<RigidSpec> const& rigids);
/// Gives ties or springs without a name KIND_0, KIND_1, ...: they have columns whether they are named or not.
template <class Spec>
void name_unnamed(std::string const& kind, std::vector<Spec>& specs) {
  for (std::size_t k = 0; k < specs.size(); ++k)
    if (specs[k].name.empty()) specs[k].name = kind + "_" + std::to_string(k);
}
ProbeSpec read_probe(Section const& section, std::vector<BodyNames> const& bodies);
/// `spec` holds the bodies and the probes, which decide what columns there are.
QuantitySpec read_quantity_section(Section const& section, CaseSpec const& spec,
                                   std::map<std::string, double> const& constants);

}  // namespace piola
