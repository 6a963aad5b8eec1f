// SPDX-License-Identifier: Apache-2.0
#include "piola/input/contact_capabilities.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include <algorithm>

namespace piola {

std::vector<FormulationInfo> formulations_of(CaseSpec const& spec) {
  std::vector<FormulationInfo> all;
  for (BodySpec const& body : spec.bodies) {
    auto const info = find_formulation(body.formulation.name);
    bool const known = std::any_of(all.begin(), all.end(),
                                   [&](FormulationInfo const& other) { return other.name == body.formulation.name; });
    if (info && !known) all.push_back(*info);
  }
  return all;
}

bool has_kernel_contact(CaseSpec const& spec, std::size_t body) {
  PIOLA_EXPECTS(body < spec.bodies.size());
  auto const info = find_formulation(spec.bodies[body].formulation.name);
  bool const surfaces = spec.contact && spec.contact->law == ContactRule::Law::surface;
  return info && info->contact && !surfaces;
}

bool is_tied(CaseSpec const& spec, std::size_t body) {
  return std::any_of(spec.ties.begin(), spec.ties.end(),
                     [&](TieSpec const& tie) { return tie.bodies[0] == body || tie.bodies[1] == body; });
}

bool has_own_contact(CaseSpec const& spec, std::size_t a, std::size_t b) {
  PIOLA_EXPECTS(a < spec.bodies.size() && b < spec.bodies.size());
  return has_kernel_contact(spec, a) && has_kernel_contact(spec, b) && !contact::is_tied(spec.ties, a, b) &&
         !starts_with_surface_contact(spec, a, b);
}

bool is_off(CaseSpec const& spec, std::string const& a, std::string const& b) {
  ContactPairSpec const* const pair = find_pair(spec.contact_pairs, a, b);
  return pair != nullptr && pair->off;
}

bool has_surface(CaseSpec const& spec, std::size_t body) {
  PIOLA_EXPECTS(body < spec.bodies.size());
  bool const off = spec.contact && spec.contact->law == ContactRule::Law::none;
  return !off && can_have_surface(spec, body);
}

namespace {

bool has_mirrors(CaseSpec const& spec, std::size_t body) {
  return std::any_of(spec.mirrors.begin(), spec.mirrors.end(),
                     [&](MirrorSpec const& mirror) { return mirror.body == spec.bodies[body].name; });
}

bool is_word(FormulationSpec const& spec, std::string_view name, std::string_view word) {
  auto const given = spec.words.find(name);
  return given != spec.words.end() && given->second == word;
}

/// Kernel sums hold the stress of free surfaces at zero, under contact, too: a push there is felt late and gains
/// energy.
bool uses_kernel_sums(FormulationSpec const& spec) {
  return spec.name == "taylor_sph" &&
         (is_word(spec, "exchange", "kernel_sums") ||
          (is_word(spec, "configuration", "fixed") && !is_word(spec, "exchange", "adjoint")));
}

bool can_be_pushed(CaseSpec const& spec, std::size_t body) {
  FormulationSpec const& formulation = spec.bodies[body].formulation;
  auto const info = find_formulation(formulation.name);
  return info && info->can_be_coupled && !uses_kernel_sums(formulation);
}

}  // namespace

bool can_have_surface(CaseSpec const& spec, std::size_t body) {
  PIOLA_EXPECTS(body < spec.bodies.size());
  BodySpec const& b = spec.bodies[body];
  auto const info = find_formulation(b.formulation.name);
  bool const open_ended = b.shape.kind == ShapeSpec::Kind::points;  // its surface is unknown
  if (!can_be_pushed(spec, body) || open_ended) return false;
  bool const mirrored = std::any_of(spec.mirrors.begin(), spec.mirrors.end(), [&](MirrorSpec const& mirror) {
    return mirror.body == b.name && mirror.antisymmetric;
  });
  bool const converts = info->contact && (!is_word(b.formulation, "description", "total_lagrangian") ||
                                          is_word(b.formulation, "failed", "delete"));
  return !mirrored && !converts;
}

bool pushed_by_colour(CaseSpec const& spec, std::size_t a, std::size_t b) {
  PIOLA_EXPECTS(a < spec.bodies.size() && b < spec.bodies.size());
  bool const off = spec.contact && spec.contact->law == ContactRule::Law::none;
  if (off || a == b || (can_have_surface(spec, a) && can_have_surface(spec, b)) || has_own_contact(spec, a, b) ||
      starts_with_surface_contact(spec, a, b))
    return false;
  ContactPairSpec const* const pair = find_pair(spec.contact_pairs, spec.bodies[a].name, spec.bodies[b].name);
  bool const able = can_be_pushed(spec, a) && can_be_pushed(spec, b) && !has_mirrors(spec, a) && !has_mirrors(spec, b);
  return able && (pair == nullptr || !pair->off);
}

bool can_lose_surface(CaseSpec const& spec, std::size_t body) {
  PIOLA_EXPECTS(body < spec.bodies.size());
  FormulationSpec const& formulation = spec.bodies[body].formulation;
  bool const has_none = is_word(formulation, "description", "eulerian") ||
                        is_word(formulation, "description", "patch") || is_word(formulation, "failed", "delete");
  return has_kernel_contact(spec, body) && can_be_pushed(spec, body) && !has_none &&
         spec.bodies[body].shape.kind != ShapeSpec::Kind::points;
}

bool starts_with_surface_contact(CaseSpec const& spec, std::size_t a, std::size_t b) {
  PIOLA_EXPECTS(a < spec.bodies.size() && b < spec.bodies.size());
  if (a == b || !can_lose_surface(spec, a) || !can_lose_surface(spec, b)) return false;
  if ((spec.contact && spec.contact->law == ContactRule::Law::none) || contact::is_tied(spec.ties, a, b)) return false;
  ContactPairSpec const* const pair = find_pair(spec.contact_pairs, spec.bodies[a].name, spec.bodies[b].name);
  return pair != nullptr && !pair->off;
}

std::string why_without_surface(CaseSpec const& spec, std::size_t body) {
  PIOLA_EXPECTS(body < spec.bodies.size());
  BodySpec const& b = spec.bodies[body];
  auto const info = find_formulation(b.formulation.name);
  if (b.shape.kind == ShapeSpec::Kind::points) return "particles from a file have no known surface";
  if (uses_kernel_sums(b.formulation))
    return "kernel sums of taylor_sph hold its surface free of stress; exchange = \"adjoint\" feels others";
  if (info && info->can_be_coupled)
    return info->contact ? "particles of adaptle that may turn Eulerian or be deleted have no surface; description = "
                           "\"total_lagrangian\" without failed = \"delete\" keeps it"
                         : "it has antisymmetric mirror planes";
  return "the formulation " + b.formulation.name + " knows no contact";
}

bool pushed_by_surface(CaseSpec const& spec, std::size_t a, std::size_t b) {
  PIOLA_EXPECTS(a < spec.bodies.size() && b < spec.bodies.size());
  if (starts_with_surface_contact(spec, a, b)) return true;
  ContactPairSpec const* const pair = find_pair(spec.contact_pairs, spec.bodies[a].name, spec.bodies[b].name);
  if (!has_surface(spec, a) || !has_surface(spec, b)) return false;
  if (a == b) return pair != nullptr ? !pair->off : spec.contact && spec.contact->self;
  return (pair == nullptr || !pair->off) && !has_own_contact(spec, a, b);
}

bool pushed_by_rigid(CaseSpec const& spec, std::size_t body, std::size_t rigid) {
  PIOLA_EXPECTS(body < spec.bodies.size() && rigid < spec.rigids.size());
  ContactPairSpec const* const pair = find_pair(spec.contact_pairs, spec.bodies[body].name, spec.rigids[rigid].name);
  return has_surface(spec, body) && (spec.rigids[rigid].turns() || !has_kernel_contact(spec, body)) &&
         (pair == nullptr || !pair->off);
}

bool has_contact_between(CaseSpec const& spec, std::size_t a, std::size_t b) {
  PIOLA_EXPECTS(a < spec.bodies.size() && b < spec.bodies.size());
  return has_own_contact(spec, a, b) || pushed_by_surface(spec, a, b) || pushed_by_colour(spec, a, b);
}

bool has_rigid_contact(CaseSpec const& spec, std::size_t body) {
  PIOLA_EXPECTS(body < spec.bodies.size());
  return has_kernel_contact(spec, body) || has_surface(spec, body);
}

bool has_surface_contact(CaseSpec const& spec) {
  for (std::size_t a = 0; a < spec.bodies.size(); ++a) {
    for (std::size_t r = 0; r < spec.rigids.size(); ++r)
      if (pushed_by_rigid(spec, a, r)) return true;
    for (std::size_t b = a; b < spec.bodies.size(); ++b)
      if (pushed_by_surface(spec, a, b)) return true;
  }
  return false;
}

bool bodies_are_pushed(CaseSpec const& spec) {
  for (std::size_t a = 0; a < spec.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < spec.bodies.size(); ++b)
      if (pushed_by_colour(spec, a, b)) return true;
  return has_surface_contact(spec) || !spec.ties.empty();
}

bool has_kernel_contact(CaseSpec const& spec) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (has_kernel_contact(spec, b)) return true;
  return false;
}

bool any_contact(CaseSpec const& spec) { return bodies_are_pushed(spec) || has_kernel_contact(spec); }

}  // namespace piola
