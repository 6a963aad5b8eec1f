// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/boundary_keys.hpp"
#include "piola/input/sections.hpp"
#include <array>

namespace piola {
namespace {

// Letters name directions of the axes; the words of frames refer to the normal.
void read_fix(Section const& section, int dimension, SupportSpec& support) {
  std::string fix;
  if (!section.read("fix", fix)) return;
  std::string const is = "support.fix is " + in_quotes(fix);
  std::vector<std::string> words;
  for (std::size_t frame = 1; frame < support_frames.size(); ++frame) {
    words.push_back(in_quotes(support_frames[frame].word));
    if (fix != support_frames[frame].word) continue;
    support.frame = static_cast<Support::Frame>(frame);
    if (!section.has("normal"))
      section.report_missing("normal", "the direction that fix refers to", "normal = [1, 1, 0]");
    return;
  }
  if (section.has("normal")) {
    section.problems().add(section.place_of("fix"),
                           is + " (allowed with a normal: " + joined(words) + ") - choose one, or remove normal");
    return;
  }
  support.fix = fixed_axes(section, fix, dimension);
}

/// The faces that a box of this dimension has.
std::string faces_of(int dimension) {
  std::string text;
  for (int axis = 0; axis < dimension; ++axis)
    text += (axis > 0 ? ", " : "") + face_text({}, {axis, false}) + ", " + face_text({}, {axis, true});
  return text;
}

/// A face of the body, which must be a box; `what` needs one.
void read_face(Section const& section, BodyNames const& body, std::string const& what, Face& face) {
  int const word = section.word_index("face");
  if (word < 0) return;
  face = {word / 2, word % 2 == 1};
  if (body.shape.kind != ShapeSpec::Kind::box) {
    section.problems().add(section.place_of("face"),
                           "body " + in_quotes(body.name) + " has no face " + in_quotes(face_text(body.shape, face)) +
                               ", because it is no box " + "(allowed: " + what + " of boxes)");
  } else if (face.axis >= body.dimension) {
    section.problems().add(section.place_of("face"),
                           section.name_of("face") + " is " + in_quotes(face_text(body.shape, face)) + " (allowed in " +
                               std::to_string(body.dimension) + "D: " + faces_of(body.dimension) + ")");
  }
}

/// Whether a body has such a face to load.
bool has_face(ShapeSpec const& shape, Face const& face) {
  bool const box = shape.kind == ShapeSpec::Kind::box;
  if (shape.kind == ShapeSpec::Kind::solid || shape.kind == ShapeSpec::Kind::points) return false;
  if (face.part == Face::Part::outer) return !box;
  if (face.part == Face::Part::inner) return !box && shape.inner_radius > 0;
  return (box && face.axis < shape.dimension) || (shape.kind == ShapeSpec::Kind::cylinder && face.axis == shape.axis);
}

/// The faces of a body that tractions and pressures may act on.
std::string loadable_faces(ShapeSpec const& shape) {
  if (shape.kind == ShapeSpec::Kind::solid) return "none of packed shapes, which have patches: patch = \"NAME\"";
  std::string text;
  for (auto const part : {Face::Part::flat, Face::Part::outer, Face::Part::inner})
    for (int axis = 0; axis < (part == Face::Part::flat ? 3 : 1); ++axis)
      for (bool const upper : {false, true})
        if (Face const face{axis, upper, part}; has_face(shape, face) && (part == Face::Part::flat || !upper))
          text += (text.empty() ? "" : ", ") + face_text(shape, face);
  return text;
}

/// The patch of a solid that a section names; nothing (and a problem) if there is none.
std::optional<Face> read_patch(Section const& section, BodyNames const& body) {
  std::string wanted;
  if (!section.read("patch", wanted)) return {};
  if (body.shape.kind != ShapeSpec::Kind::solid || !body.shape.solid) {
    section.problems().add(section.place_of("patch"),
                           "body " + in_quotes(body.name) +
                               " has no patches, because its shape is a box, sphere or "
                               "cylinder as it is (allowed: face, where) - use face or where, or give the shape "
                               "arrangement = \"packed\"");
    return {};
  }
  auto const patches = body.shape.solid->patches();
  std::string names;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    if (patches[k].name == wanted) return Face{static_cast<int>(k), false, Face::Part::patch};
    if (k < 20) names += (k > 0 ? ", " : "") + patches[k].name;
  }
  if (patches.size() > 20) names += ", ... " + std::to_string(patches.size()) + " in all";
  section.problems().add(section.place_of("patch"), "body " + in_quotes(body.name) + " has no patch " +
                                                        in_quotes(wanted) + " (allowed: " + names +
                                                        ") - piola check tells where they are");
  return {};
}

void read_loaded_face(Section const& section, BodyNames const& body, LoadSpec& load) {
  load.shape = body.shape;
  if (section.has("patch")) {
    section.refuse("face", "and patch exclude each other");
    if (auto const patch = read_patch(section, body)) load.face = *patch;
    return;
  }
  int const word = section.word_index("face");
  if (word < 0) return;
  constexpr int flat = 6;
  load.face = word < flat ? Face{word / 2, word % 2 == 1}
                          : Face{0, false, word == flat ? Face::Part::outer : Face::Part::inner};
  if (has_face(body.shape, load.face)) return;
  section.problems().add(section.place_of("face"), "body " + in_quotes(body.name) + " has no face " +
                                                       in_quotes(face_text(body.shape, load.face)) +
                                                       " (allowed: " + loadable_faces(body.shape) + ")");
}

void read_absorption(Section const& section, BodyNames const& body, LoadSpec& load) {
  bool absorbs = true;
  if (section.read("non_reflecting", absorbs) && !absorbs)
    section.problems().add(section.place_of("non_reflecting"),
                           "load.non_reflecting is false (allowed: true) - remove the load");
  if (auto value = read_vector(section, "background_velocity", body)) load.value = std::move(*value);
  if (auto const given = section.point("impedance")) {
    if (given->size() == 2)
      load.absorption.impedance = {given->front(), given->back()};
    else
      section.problems().add(section.place_of("impedance"),
                             "load.impedance has " + std::to_string(given->size()) +
                                 " numbers (allowed: two, along the normal and across it) - write [1, 1]");
  }
  double angle = 0;
  if (!section.read("angle", angle)) return;
  section.refuse("impedance", "and angle exclude each other");
  load.absorption.angle = angle;
}

void read_load_value(Section const& section, BodyNames const* body, LoadSpec& load) {
  constexpr std::array kinds{"traction", "body_force", "acceleration", "pressure", "non_reflecting"};
  int given = 0;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (!section.has(kinds[k])) continue;
    ++given;
    load.kind = static_cast<LoadSpec::Kind>(k);
    if (body == nullptr) continue;
    if (load.kind == LoadSpec::Kind::non_reflecting) {
      read_absorption(section, *body, load);
      continue;
    }
    if (load.kind == LoadSpec::Kind::pressure) {
      if (auto value = section.formula("pressure", body->names)) load.value[0] = std::move(*value);
      continue;
    }
    if (auto value = read_vector(section, kinds[k], *body)) load.value = std::move(*value);
  }
  if (given == 1) return;
  section.refuse_count("load", given, "traction, pressure, body_force, acceleration, non_reflecting");
}

}  // namespace

SupportSpec read_support(Section const& section, std::vector<BodyNames> const& bodies) {
  SupportSpec support;
  read_members(section, support_keys(), support);
  BodyNames const* const body = find_body(section, bodies, support.body);
  int const dimension = body != nullptr ? body->dimension : 3;
  if (!section.has("patch") && !section.has("where"))
    section.report_missing("where\" or \"patch", "the particles that are held", "where = \"X < 1\"");
  support.where = section.formula("where", body != nullptr ? body->names : Names{});
  if (body != nullptr && section.has("patch")) {
    support.patch = read_patch(section, *body);
    support.shape = body->shape;
  }
  if (!section.has("patch")) section.refuse("hold", "is used only by a support on a patch");
  if (int const word = section.word_index("hold"); word >= 0) support.hold = static_cast<SupportSpec::Hold>(word);
  read_fix(section, dimension, support);
  if (body != nullptr) {
    read_direction(section, "normal", dimension, support.normal);
    support.velocity = read_vector(section, "velocity", *body);
  }
  section.refuse_unknown();
  support.places = places_of(section, {"where", "patch", "hold", "body", "fix", "normal", "velocity"});
  return support;
}

LoadSpec read_load(Section const& section, std::vector<BodyNames> const& bodies) {
  LoadSpec load;
  read_members(section, load_keys(), load);
  BodyNames const* const body = find_body(section, bodies, load.body);
  load.where = section.formula("where", body != nullptr ? body->names : Names{});
  read_load_value(section, body, load);
  if (!load.on_face()) {
    section.refuse("face", "is used only by a traction, a pressure or a non-reflecting patch");
    section.refuse("patch", "is used only by a traction, a pressure or a non-reflecting patch");
  } else if (!section.has("face") && !section.has("patch"))
    section.report_missing("face\" or \"patch", "the part of the surface that the load acts on", "face = \"+x\"");
  else if (body != nullptr)
    read_loaded_face(section, *body, load);
  if (load.kind == LoadSpec::Kind::pressure)
    section.read("follower", load.follower);
  else
    section.refuse("follower", "is used only by a pressure");
  if (load.kind != LoadSpec::Kind::non_reflecting)
    for (char const* const key : {"background_velocity", "impedance", "angle"})
      section.refuse(key, "is used only with non_reflecting");
  section.refuse_unknown();
  load.places = places_of(section, {"where", "body", "face", "patch", "traction", "body_force", "acceleration",
                                    "pressure", "non_reflecting", "background_velocity", "follower"});
  return load;
}

MirrorSpec read_mirror(Section const& section, std::vector<BodyNames> const& bodies) {
  MirrorSpec mirror;
  BodyNames const* const body = find_body(section, bodies, mirror.body);
  read_face(section, body != nullptr ? *body : BodyNames{}, "mirrors at faces", mirror.face);
  read_members(section, mirror_keys(), mirror);
  section.refuse_unknown();
  mirror.places = places_of(section, {"body", "face"});
  return mirror;
}

CrackSpec read_crack(Section const& section, std::vector<BodyNames> const& bodies) {
  CrackSpec crack;
  BodyNames const* const body = find_body(section, bodies, crack.body);
  if (body != nullptr && (body->shape.kind != ShapeSpec::Kind::box || body->dimension != 2)) {
    std::string const what =
        body->shape.kind != ShapeSpec::Kind::box ? "no box" : "in " + std::to_string(body->dimension) + "D";
    section.problems().add(section.place_of("body"), "body " + in_quotes(body->name) +
                                                         " cannot have a crack, because it is " + what +
                                                         " (allowed: boxes in 2D) - remove the crack");
  }
  int const dimension = body != nullptr ? body->dimension : 2;
  read_components(section, "from", dimension, crack.from);
  read_components(section, "to", dimension, crack.to);
  section.refuse_unknown();
  crack.places = places_of(section, {"body", "from", "to"});
  return crack;
}

}  // namespace piola
