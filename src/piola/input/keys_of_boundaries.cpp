// SPDX-License-Identifier: Apache-2.0
#include "piola/input/boundary_keys.hpp"
#include "piola/input/key_tables.hpp"
#include <algorithm>
#include <array>
#include <vector>

namespace piola {
namespace {

using enum KeyInfo::Kind;

constexpr std::array<std::string_view, 5> contact_words{"kernel", "linear", "published", "surface", "none"};
constexpr std::array<std::string_view, 2> hold_words{"surface", "particles"};
constexpr std::array<std::string_view, 2> axes_words{"space", "body"};
constexpr std::array<std::string_view, 3> motion_words{"fixed", "driven", "free"};
constexpr std::array<std::string_view, 6> face_words{"-x", "+x", "-y", "+y", "-z", "+z"};
constexpr std::array<std::string_view, 8> surface_words{"-x", "+x", "-y", "+y", "-z", "+z", "outer", "inner"};

/// The laws in the order of contact_words, which is not that of the enumerators.
constexpr std::array law_order{ContactRule::Law::kernel, ContactRule::Law::linear, ContactRule::Law::as_published,
                               ContactRule::Law::surface, ContactRule::Law::none};
constexpr Member<ContactSpec> law_member = WordMember<ContactSpec>{
    [](ContactSpec const& contact) {
      return static_cast<std::size_t>(std::find(law_order.begin(), law_order.end(), contact.law) - law_order.begin());
    },
    [](ContactSpec& contact, std::size_t word) { contact.law = law_order[word]; }};

constexpr std::array support_rows{
    SupportKey{{"support", "name", name, "", any_value, "support_0, support_1, ...",
                "first part of the columns NAME.force_x to NAME.moment_z of history.csv"},
               fills<&SupportSpec::name>},
    SupportKey{{"support", "body", name, "", any_value, "", "name of the body"}},
    SupportKey{{"support", "where", formula, "", any_value, "by patch", "condition in X, Y, Z that selects particles"}},
    SupportKey{
        {"support", "patch", text, "", any_value, "by where", "the particles along a patch of a solid's surface"}},
    SupportKey{
        {"support", "hold", word, "", any_value, "surface with nodal, particles else and if axisymmetric",
         "patch: what is held; surface: the patch itself, second order; particles: those along it, half a spacing "
         "inside, first order",
         hold_words}},
    SupportKey{
        {"support", "fix", text, "", any_value, "",
         "directions held: letters of \"xyz\"; with normal: \"normal\" (a roller) or \"tangent\" (across the normal)"}},
    SupportKey{{"support", "normal", point, "1", place_range, "none", "direction that fix refers to, of any length"}},
    SupportKey{{"support", "velocity", formulas, "m/s", any_value, "at rest",
                "prescribed velocity, one formula in X, Y, Z, t per direction; only the held directions count"}},
    SupportKey{{"support", "until", quantity, "s", positive, "the end of the run", "released at this time"},
               fills<&SupportSpec::until>},
};

constexpr std::array load_rows{
    LoadKey{{"load", "name", name, "", any_value, "none: not recorded",
             "first part of the columns NAME.force_x to NAME.moment_z of history.csv"},
            fills<&LoadSpec::name>},
    LoadKey{{"load", "body", name, "", any_value, "", "name of the body"}},
    LoadKey{{"load", "where", formula, "", any_value, "all particles", "condition in X, Y, Z that selects particles"}},
    LoadKey{{"load", "traction", formulas, "Pa", any_value, "none",
             "force per reference area of a face, one formula in X, Y, Z, t per direction"}},
    LoadKey{{"load", "pressure", formula, "Pa", any_value, "none",
             "force per area of a face, against its outward normal; a formula in X, Y, Z, t"}},
    LoadKey{{"load", "follower", flag, "", any_value, default_of_member,
             "pressure, not with adaptle: it acts on the deformed face, along its current normal; else along that of "
             "the start"},
            fills<&LoadSpec::follower>,
            true},
    LoadKey{
        {"load", "non_reflecting", flag, "", any_value, "false",
         "the face or patch lets waves leave the body, with nodal: dashpots with the impedances of the material, in "
         "addition to tractions and pressures on the same face"}},
    LoadKey{{"load", "background_velocity", formulas, "m/s", any_value, "at rest",
             "non_reflecting: the velocity against which the dashpots work, one formula in X, Y, Z, t per direction; "
             "twice the velocity of a wave that comes in there"}},
    LoadKey{{"load", "impedance", point, "1", closed(0, 100), "[1, 1]",
             "non_reflecting: factors on the impedances of pressure and of shear waves, along the normal and across "
             "it"}},
    LoadKey{{"load", "angle", quantity, "rad", closed(0, 1.4), "head on",
             "non_reflecting, in place of impedance: pressure waves at this angle to the normal leave no reflection"}},
    LoadKey{{"load", "face", word, "", any_value, "none",
             "traction, pressure, non_reflecting (required there): a face of a box or an end of a cylinder; outer: the "
             "curved surface "
             "of a cylinder, ball or disc; inner: that of its hole",
             surface_words}},
    LoadKey{{"load", "patch", text, "", any_value, "none",
             "traction, pressure, non_reflecting on a solid: a patch of its surface"}},
    LoadKey{{"load", "body_force", formulas, "N/m^3", any_value, "none",
             "force per reference volume, one formula in X, Y, Z, t per direction"}},
    LoadKey{{"load", "acceleration", formulas, "m/s^2", any_value, "none",
             "force per mass, for example gravity, one formula in X, Y, Z, t per direction"}},
    LoadKey{{"load", "until", quantity, "s", positive, "the end of the run", "gone from this time on"},
            fills<&LoadSpec::until>},
};

constexpr std::array mirror_rows{
    MirrorKey{{"mirror", "body", name, "", any_value, "", "name of the body, a box with particles on its faces"}},
    MirrorKey{{"mirror", "face", word, "", any_value, "", "the face that is the plane of symmetry", face_words}},
    MirrorKey{{"mirror", "antisymmetric", flag, "", any_value, default_of_member,
               "the image moves the opposite way: held along the plane instead of across it; for small strains"},
              fills<&MirrorSpec::antisymmetric>},
};

constexpr std::array crack_rows{
    KeyInfo{"crack", "body", name, "", any_value, "", "name of the body, a two-dimensional box"},
    KeyInfo{"crack", "from", point, "m", place_range, "", "one end, at a particle; inside the body it is a tip"},
    KeyInfo{"crack", "to", point, "m", place_range, "", "the other end, at a particle"},
};

constexpr std::array rigid_rows{
    RigidKey{{"rigid", "name", name, "", any_value, "", "name in messages and of columns"}, fills<&RigidSpec::name>},
    RigidKey{{"rigid", "plane", table, "", any_value, "none", "a plane"}},
    RigidKey{{"rigid", "sphere", table, "", any_value, "none", "a sphere or disc"}},
    RigidKey{{"rigid", "cylinder", table, "", any_value, "none", "a cylinder"}},
    RigidKey{{"rigid", "box", table, "", any_value, "none", "a box"}},
    RigidKey{
        {"rigid", "velocity", formulas, "m/s", any_value, "at rest",
         "prescribed velocity, one formula in t and the constants per direction; of a free shape that at the start"}},
    RigidKey{{"rigid", "angular_velocity", formulas, "rad/s", any_value, "none",
              "the same about the centre: formulas for x, y and z; in 2D a list of one"}},
    RigidKey{{"rigid", "motion", word, "", any_value, "driven with a velocity or angular_velocity, else fixed",
              "fixed: at rest; driven: as prescribed; free: a rigid body that what it touches moves, not for planes",
              motion_words}},
    RigidKey{{"rigid", "mass", quantity, "", positive, "from density",
              "free (one of mass and density is required there): mass, in kg; in 2D per length, in kg/m (not "
              "axisymmetric)"}},
    RigidKey{{"rigid", "density", quantity, "kg/m^3", positive, "from mass", "free: density of the whole shape"}},
    RigidKey{
        {"rigid", "inertia", list, "", any_value, "of the homogeneous shape",
         "free: moments of inertia about x, y and z through the centre at the start, or the rows of the tensor, in "
         "kg m^2, for a shape that stands in for another one; in 2D a list of one, in kg m"}},
    RigidKey{{"rigid", "gravity", formulas, "m/s^2", any_value, "none",
              "free: acceleration, one formula in t and the constants per direction"}},
    RigidKey{
        {"rigid", "force", formulas, "N", any_value, "none",
         "free: force on the centre, one formula in t and the constants per direction; in 2D per length, in N/m (not "
         "axisymmetric)"}},
    RigidKey{{"rigid", "torque", formulas, "N m", any_value, "none",
              "free: torque about the centre: formulas for x, y and z; in 2D a list of one, per length, in N"}},
    RigidKey{{"rigid", "torque_axes", word, "", any_value, default_of_member,
              "torque: axes of space, or those that turn with the body and are x, y and z at the start", axes_words},
             fills<&RigidSpec::torque_axes>},
    RigidKey{{"rigid", "fix", text, "", any_value, "none",
              "free: directions in which it keeps the velocity of the start: letters of \"xyz\""}},
    RigidKey{{"rigid", "turns", flag, "", any_value, default_of_member, "free: false keeps it from turning"},
             fills<&RigidSpec::can_turn>,
             true},
    RigidKey{{"rigid.plane", "point", point, "m", place_range, "", "a point of the plane"}},
    RigidKey{{"rigid.plane", "normal", point, "1", place_range, "", "direction towards the bodies, of any length"}},
    RigidKey{{"rigid.sphere", "centre", point, "m", place_range, "", "centre"}},
    RigidKey{{"rigid.sphere", "radius", quantity, "m", length_range, "", "radius"}, fills<&RigidSpec::radius>},
    RigidKey{{"rigid.cylinder", "centre", point, "m", place_range, "", "middle of the axis"}},
    RigidKey{{"rigid.cylinder", "axis", point, "1", place_range, "", "direction of the axis, of any length"}},
    RigidKey{{"rigid.cylinder", "radius", quantity, "m", length_range, "", "radius"}, fills<&RigidSpec::radius>},
    RigidKey{{"rigid.cylinder", "length", quantity, "m", length_range, "", "from end to end"}},
    RigidKey{{"rigid.box", "min", point, "m", place_range, "none", "lowest corner"}},
    RigidKey{{"rigid.box", "max", point, "m", place_range, "none", "highest corner"}},
    RigidKey{{"rigid.box", "centre", point, "m", place_range, "none", "middle"}},
    RigidKey{{"rigid.box", "lengths", point, "m", length_range, "none", "edges"}},
};

constexpr std::array contact_rows{
    ContactKey{
        {"contact", "law", word, "", any_value,
         "\"kernel\"; surface contact for total-Lagrangian bodies that touch at the start",
         "what keeps bodies of adaptle apart (other bodies have surface contact; those of nodal with conversion = "
         "\"eulerian\" that collide at more than a fifth of the speed of sound that of all their particles, unless "
         "this "
         "is \"surface\"); kernel: repulsion by the kernel, "
         "stiffness from the impedances; linear: a spring with the stiffness of the material, for slow impacts; "
         "published: as in the paper, with a constant that you give; surface: as other formulations have, with "
         "friction, if all stay total-Lagrangian; none: no contact of any body, Eulerian bodies merge",
         contact_words},
        law_member},
    ContactKey{
        {"contact", "scale", quantity, "1", positive, default_of_member, "all but none: factor on the stiffness"},
        fills<&ContactSpec::scale>},
    ContactKey{
        {"contact", "between", list, "", any_value, "all pairs that can be in contact",
         "in [[contact]]: the pair that this table is for, by the names of two bodies, of a body and a rigid shape, "
         "or twice the same for a body that touches itself; what it leaves out is as in the table without between"}},
    ContactKey{{"contact", "self", flag, "", any_value, default_of_member,
                "whether bodies with a surface touch themselves; one alone: between = [\"a\", \"a\"]"},
               fills<&ContactSpec::self>},
    ContactKey{{"contact", "stiffness", quantity, "", positive, "none",
                "published (required there): constant K, in Pa/m^2 in 2D, in Pa/m^3 in 3D"}},
    ContactKey{{"contact", "closing_speed", quantity, "m/s", positive, "from the initial velocities",
                "kernel: speed of the impact that the stiffness is made for"},
               fills<&ContactSpec::closing_speed>},
    ContactKey{{"contact", "exponent", quantity, "1", closed(1, 100),
                "4; kernel: up to 8 where the strength of the weaker body counts",
                "kernel, published: exponent of the ratio of kernels; 8 holds half the energy of 4"},
               fills<&ContactSpec::exponent>},
};

constexpr std::array friction_rows{
    FrictionKey{{"contact", "friction", quantity, "1", closed(0, 10), default_of_member,
                 "coefficient of Coulomb friction between surfaces, and of surfaces on rigid shapes (not in the kernel "
                 "contact of adaptle)"},
                fills<&contact::FrictionLaw::kinetic>},
    FrictionKey{{"contact", "static_friction", quantity, "1", closed(0, 10), "friction",
                 "coefficient at rest; at the sliding speed v it is friction + (static_friction - friction) exp(-v / "
                 "decay_speed)"}},
    FrictionKey{{"contact", "decay_speed", quantity, "m/s", positive, "none",
                 "required with static_friction: speed over which it falls to friction"},
                fills<&contact::FrictionLaw::decay_speed>},
    FrictionKey{{"contact", "shear_limit", quantity, "Pa", positive, "none", "no shear stress of friction is larger"},
                fills<&contact::FrictionLaw::shear_limit>},
};

constexpr std::array spring_rows{
    SpringKey{{"spring", "name", name, "", any_value, "spring_0, spring_1, ...",
               "first part of the columns NAME.force_x to NAME.moment_z of history.csv: on the first shape"},
              fills<&SpringSpec::name>},
    SpringKey{{"spring", "between", list, "", any_value, "",
               "names of two rigid shapes, one of them free; or of a free one, for a spring to a point at rest"}},
    SpringKey{
        {"spring", "points", list, "", any_value, "", "places of both ends at the start, in the order of between"}},
    SpringKey{{"spring", "stiffness", quantity, "", not_negative, "0",
               "force per elongation, in N/m; in 2D per length, in N/m^2 (not axisymmetric)"}},
    SpringKey{{"spring", "damping", quantity, "", not_negative, "0",
               "force per rate of elongation, in N s/m; in 2D per length, in N s/m^2 (not axisymmetric)"}},
    SpringKey{{"spring", "rest_length", quantity, "m", not_negative, "the distance of the points",
               "length without force of the spring"}},
};

constexpr std::array tie_rows{
    TieKey{{"tie", "name", name, "", any_value, "tie_0, tie_1, ...",
            "first part of the columns NAME.force_x to NAME.moment_z of history.csv, what the second one does to the "
            "first"},
           fills<&TieSpec::name>},
    TieKey{{"tie", "between", list, "", any_value, "", "names of two bodies, or of a body and a rigid shape"}},
    TieKey{{"tie", "where", formula, "", any_value, "the whole surface",
            "condition in X, Y, Z, at the start, that selects surface points; names are those of the first body"}},
    TieKey{
        {"tie", "stiffness", quantity, "1", positive, default_of_member,
         "factor on the stiffness, that of a layer of one spacing: more reflects less of a wave and shortens the step"},
        fills<&TieSpec::stiffness>},
    TieKey{{"tie", "strength", quantity, "Pa", positive, "none: it never fails",
            "largest traction in opening, from which on it softens"},
           fills<&TieSpec::strength>},
    TieKey{{"tie", "toughness", quantity, "J/m^2", positive, "none",
            "strength (required there): energy that failure takes per area, the area under the curve"}},
    TieKey{{"tie", "shear_weight", quantity, "1", above(0, 100), default_of_member,
            "strength: weight of sliding in the effective opening; the shear strength is this times the strength"},
           fills<&TieSpec::shear_weight>,
           true},
};

}  // namespace

std::span<SupportKey const> support_keys() { return support_rows; }
std::span<LoadKey const> load_keys() { return load_rows; }
std::span<MirrorKey const> mirror_keys() { return mirror_rows; }
std::span<RigidKey const> rigid_keys() { return rigid_rows; }
std::span<SpringKey const> spring_keys() { return spring_rows; }
std::span<ContactKey const> contact_keys() { return contact_rows; }
std::span<FrictionKey const> friction_keys() { return friction_rows; }
std::span<TieKey const> tie_keys() { return tie_rows; }

std::vector<KeyInfo> keys_of_boundaries() {
  constexpr std::size_t before_friction = 3;
  auto keys = joined_keys(support_keys(), load_keys(), mirror_keys(), rigid_keys(), spring_keys(),
                          contact_keys().first(before_friction), friction_keys(),
                          contact_keys().subspan(before_friction), tie_keys());
  keys.insert(keys.end(), crack_rows.begin(), crack_rows.end());
  return keys;
}

}  // namespace piola
