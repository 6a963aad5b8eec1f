// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/sections.hpp"
#include "piola/mechanics/rigid_mass.hpp"
#include <algorithm>
#include <array>

/// How a rigid shape moves.
namespace piola {
namespace {

enum class Motion { fixed, driven, free };

using Formulas = std::array<Expression, 3>;

// A rigid shape moves as one, so that no place can be meant; a free one has one velocity at the start.
void refuse_variables(Section const& section, std::string_view key, Formulas const& formulas, bool at_start) {
  for (std::size_t d = 0; d < formulas.size(); ++d) {
    std::string const formula =
        section.name_of(key) + "[" + std::to_string(d) + "], formula " + in_quotes(formulas[d].text());
    constexpr std::array<std::string_view, 3> coordinates{"X", "Y", "Z"};
    auto const place = std::find_if(coordinates.begin(), coordinates.end(),
                                    [&](std::string_view coordinate) { return formulas[d].uses(coordinate); });
    if (place != coordinates.end()) {
      section.problems().add(section.place_of(key), formula + " uses " + std::string(*place) +
                                                        " (allowed: t and the constants) - a rigid shape moves as one");
    } else if (at_start && formulas[d].depends_on_time()) {
      section.problems().add(section.place_of(key), formula +
                                                        " uses t (allowed: the constants) - of a free shape it is the "
                                                        "value at the start");
    }
  }
}

/// In 2D there is one turn, about z.
void read_turning(Section const& section, BodyNames const& names, RigidSpec& rigid) {
  auto const value = section.find("angular_velocity");
  if (!value) return;
  if (names.dimension == 1) return section.refuse("angular_velocity", "has no meaning in 1D");
  std::size_t const axes = names.dimension == 3 ? 3 : 1;
  auto formulas = read_formulas(*value, "rad/s", axes, names.names, section.problems());
  if (formulas) std::move(formulas->begin(), formulas->end(), rigid.angular_velocity.end() - static_cast<int>(axes));
}

Motion read_motion(Section const& section) {
  bool const moves = section.has("velocity") || section.has("angular_velocity");
  int const word = section.word_index("motion");
  if (word < 0) return moves ? Motion::driven : Motion::fixed;
  auto const motion = static_cast<Motion>(word);
  if (motion == Motion::fixed)
    for (char const* key : {"velocity", "angular_velocity"}) section.refuse(key, "is used only by shapes that move");
  if (motion == Motion::driven && !moves)
    section.report_missing("velocity", "how it is driven", "velocity = [\"1 m/s\", ...], or angular_velocity");
  return motion;
}

void read_mass(Section const& section, BodyNames const& names, RigidSpec& rigid) {
  bool const mass = section.has("mass"), density = section.has("density");
  if (mass == density) {
    section.problems().add(section.place_of(mass ? "mass" : "motion"),
                           std::string("a free rigid shape has ") + (mass ? "mass and density" : "no mass") +
                               " (allowed: mass or density) - give one of them");
    return;
  }
  if (auto const value = section.find("mass"); mass && value) {
    auto const number = read_number(*value, names.dimension == 2 && !names.axisymmetric ? "kg/m" : "kg",
                                    key_info("rigid", "mass").allowed, section.problems());
    if (number) rigid.mass = *number;
  }
  double rho = 0;
  if (density && section.read("density", rho))
    rigid.mass = rho * (names.axisymmetric ? swept_volume_of(rigid) : volume_of(rigid, names.dimension));
}

/// Force and torque on a free shape.
void read_forces(Section const& section, BodyNames const& names, RigidSpec& rigid) {
  bool const per_length = names.dimension == 2 && !names.axisymmetric;
  auto const d = static_cast<std::size_t>(names.dimension), axes = d == 3 ? 3 : std::size_t{1};
  if (auto const value = section.find("force"))
    if (auto force = read_formulas(*value, per_length ? "N/m" : "N", d, names.names, section.problems()))
      std::move(force->begin(), force->end(), rigid.force.begin());
  if (auto const value = section.find("torque"))
    if (auto torque = read_formulas(*value, per_length ? "N" : "N m", axes, names.names, section.problems()))
      std::move(torque->begin(), torque->end(), rigid.torque.end() - static_cast<int>(axes));
  for (char const* key : {"force", "torque"})
    refuse_variables(section, key, key[0] == 'f' ? rigid.force : rigid.torque, false);
  if (!section.has("torque")) section.refuse("torque_axes", "is used only with a torque");
}

void read_free(Section const& section, BodyNames const& names, RigidSpec& rigid) {
  rigid.free = true;
  if (rigid.kind == RigidShape::Kind::plane && section.has("plane"))
    section.problems().add(section.place_of("motion"),
                           "a plane is free (allowed: sphere, cylinder, box) - a half-space has no mass; take a box");
  else if (names.dimension == 1)
    section.problems().add(section.place_of("motion"), "a rigid shape is free in 1D (allowed: 2D, 3D)");
  else
    read_mass(section, names, rigid);
  if (names.dimension > 1) read_inertia(section, names.dimension, rigid);
  refuse_variables(section, "velocity", rigid.velocity, true);
  refuse_variables(section, "angular_velocity", rigid.angular_velocity, true);
  if (auto gravity = read_vector(section, "gravity", names)) rigid.gravity = std::move(*gravity);
  refuse_variables(section, "gravity", rigid.gravity, false);
  read_forces(section, names, rigid);
  if (std::string fix; section.read("fix", fix)) rigid.held = fixed_axes(section, fix, names.dimension);
  section.read("turns", rigid.can_turn);
  if (names.axisymmetric) {  // moves along the axis
    rigid.held[0] = true;
    rigid.can_turn = false;
  }
  if (!rigid.can_turn)
    for (char const* key : {"angular_velocity", "inertia", "torque"})
      section.refuse(key, "has no meaning with turns = false");
}

}  // namespace

void read_rigid_motion(Section const& section, BodyNames const& names, RigidSpec& rigid) {
  if (auto velocity = read_vector(section, "velocity", names)) rigid.velocity = std::move(*velocity);
  read_turning(section, names, rigid);
  if (read_motion(section) == Motion::free) {
    read_free(section, names, rigid);
    return;
  }
  refuse_variables(section, "velocity", rigid.velocity, false);
  refuse_variables(section, "angular_velocity", rigid.angular_velocity, false);
  for (char const* key : {"mass", "density", "inertia", "gravity", "force", "torque", "torque_axes", "fix", "turns"})
    section.refuse(key, "is used only with motion = \"free\"");
}

}  // namespace piola
