// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/input/observer_keys.hpp"
#include "piola/input/sections.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

using Kind = ProbeSpec::Kind;

/// Whether a probe measures the debris of a whole body.
bool is_cluster_probe(Kind kind) { return kind == Kind::fragment || kind == Kind::rim || kind == Kind::hole; }

/// `the kinds "twist", "extent" and "rim"`
std::string kinds_text(unsigned kinds) {
  std::vector<std::string> words;
  for (std::size_t k = 0; k < probe_kinds.size(); ++k)
    if ((kinds & 1U << k) != 0) words.push_back(in_quotes(probe_kinds[k].word));
  if (words.size() == 1) return "the kind " + words.front();
  std::string const last = words.back();
  words.pop_back();
  return "the kinds " + joined(words) + " and " + last;
}

void refuse_keys_of_other_kinds(Section const& section, Kind kind) {
  for (ProbeKey const& key : probe_keys())
    if (!key.is_used_by(kind)) section.refuse(key.row.info.key, "is used only by " + kinds_text(key.kinds));
}

/// Reads the keys that only fill a member; reports missing ones that the kind needs.
void read_keys_of_kind(Section const& section, ProbeSpec& probe) {
  for (ProbeKey const& key : probe_keys()) {
    if (!key.is_used_by(probe.kind)) continue;
    std::string_view const name = key.row.info.key;
    if (!key.needed_for.empty() && !section.has(name))
      section.report_missing(name, key.needed_for, std::string(name) + " = " + std::string(key.example));
    else
      read_member(section, key.row, probe);
  }
}

bool fits(Section const& section, Kind kind, int dimension) {
  int const wanted = info_of(kind).dimension;
  if (wanted == 0 || wanted == dimension) return true;
  section.problems().add(section.place_of("kind"), "probe.kind is " + in_quotes(info_of(kind).word) +
                                                       " for a body in " + std::to_string(dimension) +
                                                       "D (allowed in " + std::to_string(wanted) +
                                                       "D) - choose another kind");
  return false;
}

void read_at(Section const& section, std::string_view about, int dimension, ProbeSpec& probe) {
  if (!section.has("at"))
    section.report_missing("at", about, "at = [\"0 m\", ...]");
  else
    read_components(section, "at", dimension, probe.at);
}

void read_line(Section const& section, int dimension, ProbeSpec& probe) {
  read_at(section, "a point of the axis", dimension, probe);
  if (probe.axis < dimension) return;
  section.problems().add(section.place_of("axis"), "probe.axis does not fit a body in " + std::to_string(dimension) +
                                                       "D (allowed: " + (dimension == 1 ? "x" : "x, y") + ")");
}

/// Reads the particles or the point of a probe that measures no debris.
void read_place(Section const& section, BodyNames const* body, ProbeSpec& probe) {
  if (probe.kind == Kind::point || probe.kind == Kind::stress_intensity) {
    if (body != nullptr) read_at(section, "the point of the probe", body->dimension, probe);
    section.refuse("where", "is not used by the kinds \"point\" and \"stress_intensity\"");
  } else if (!is_cluster_probe(probe.kind)) {
    probe.where = section.formula("where", body != nullptr ? body->names : Names{});
  }
}

/// Reads the line of fragments; without near_axis they have none.
void read_line_of_fragment(Section const& section, BodyNames const* body, ProbeSpec& probe) {
  if (std::isfinite(probe.near_axis)) {
    if (body != nullptr) read_line(section, body->dimension, probe);
    return;
  }
  for (std::string_view const key : {"at", "axis"})
    if (!section.has("near_axis")) section.refuse(key, "is used by the kind \"fragment\" only with near_axis");
}

void read_anchor(Section const& section, BodyNames const* body, ProbeSpec& probe) {
  bool const free = probe.kind == Kind::fragment && probe.fragment == ProbeSpec::Fragment::largest_free;
  if (probe.kind == Kind::fragment && !free) {
    section.refuse("anchored_where", "is used only with fragment = \"largest_free\"");
    return;
  }
  if ((free || probe.kind == Kind::rim) && !section.has("anchored_where"))
    section.report_missing("anchored_where", "which particles stay in place", "anchored_where = \"abs(X) > 0.04\"");
  else
    probe.anchored_where = section.formula("anchored_where", body != nullptr ? body->names : Names{});
}

void read_cavity(Section const& section, ProbeSpec& probe) {
  if (section.has("slab_from")) check_order(section, {"slab_from", probe.slab_from}, {"slab_to", probe.slab_to}, "m");
  probe.cavity_from = probe.slab_from;
  section.read("cavity_from", probe.cavity_from);
  check_order(section, {section.has("cavity_from") ? "cavity_from" : "slab_from", probe.cavity_from},
              {"cavity_to", probe.cavity_to}, "m");
}

void read_debris(Section const& section, BodyNames const* body, ProbeSpec& probe) {
  section.refuse("where", "is not used by the kinds \"fragment\", \"rim\" and \"hole\", which look at the whole body");
  if (probe.kind != Kind::fragment && body != nullptr) read_line(section, body->dimension, probe);
  read_keys_of_kind(section, probe);
  if (probe.kind == Kind::fragment) read_line_of_fragment(section, body, probe);
  if (probe.kind == Kind::hole) read_cavity(section, probe);
  read_anchor(section, body, probe);
}

/// The field and the formulas that the kind "error" compares.
void read_comparison(Section const& section, Names const& names, ProbeSpec& probe) {
  auto const value = section.find("field");
  auto const word = value ? read_word(*value, known_fields(), section.problems()) : std::nullopt;
  auto const reference = section.find("reference");
  if (!word || !reference) return;
  probe.field = *word;
  auto const& field = *std::find_if(field_names().begin(), field_names().end(),
                                    [&](FieldName const& candidate) { return candidate.name == *word; });
  auto formulas =
      read_formulas(*reference, field.unit, static_cast<std::size_t>(field.components), names, section.problems());
  if (formulas) probe.reference = std::move(*formulas);
}

/// Reads the direction of the range ahead of a crack tip that the kind "stress_intensity" evaluates.
void read_ahead(Section const& section, ProbeSpec& probe) {
  read_direction(section, "direction", info_of(probe.kind).dimension, probe.direction);
  if (section.has("from")) check_order(section, {"from", probe.from}, {"to", probe.to}, "m");
}

void check_axis(Section const& section, int dimension, ProbeSpec const& probe) {
  bool const twist = probe.kind == Kind::twist;
  bool const bad_twist = twist && (dimension == 1 || (dimension == 2 && probe.axis != 2));
  bool const bad_extent = probe.kind == Kind::extent && probe.axis >= dimension;
  if (!bad_twist && !bad_extent) return;
  section.problems().add(section.place_of("axis"), std::string("probe.axis does not fit a body in ") +
                                                       std::to_string(dimension) + "D (allowed: " +
                                                       (bad_extent       ? dimension == 1 ? "x" : "x, y"
                                                        : dimension == 2 ? "z"
                                                                         : "no twist in 1D") +
                                                       ")");
}

void read_quantities(Section const& section, ProbeSpec& probe) {
  std::vector<std::string> known;
  auto const own = info_of(probe.kind).quantities;
  for (HistoryName const& quantity : own) known.emplace_back(quantity.name);
  if (own.empty())
    for (FieldQuantity const& quantity : all_quantities()) known.push_back(quantity.name);
  auto const value = section.find("quantities");
  if (!value) {
    if (!own.empty())
      probe.quantities = known;
    else
      section.report_missing("quantities", "what to record, for example velocity_x or pressure",
                             "quantities = [\"pressure\"]");
    return;
  }
  auto const items = read_list(*value, 1, 100, section.problems());
  if (!items) return;
  for (Value const& item : *items) {
    if (auto const quantity = read_word(item, known, section.problems())) probe.quantities.push_back(*quantity);
  }
}

}  // namespace

ProbeSpec read_probe(Section const& section, std::vector<BodyNames> const& bodies) {
  ProbeSpec probe;
  section.read("name", probe.name);
  BodyNames const* const body = find_body(section, bodies, probe.body);
  if (int const kind = section.word_index("kind"); kind >= 0) probe.kind = static_cast<Kind>(kind);
  if (int const axis = section.word_index("axis"); axis >= 0) probe.axis = axis;
  refuse_keys_of_other_kinds(section, probe.kind);
  read_place(section, body, probe);
  if (body == nullptr || fits(section, probe.kind, body->dimension)) {
    if (is_cluster_probe(probe.kind))
      read_debris(section, body, probe);
    else
      read_keys_of_kind(section, probe);
    if (probe.kind == Kind::error) read_comparison(section, body != nullptr ? body->names : Names{}, probe);
    if (probe.kind == Kind::stress_intensity) read_ahead(section, probe);
    if (body != nullptr) check_axis(section, body->dimension, probe);
  }
  read_quantities(section, probe);
  section.refuse_unknown();
  probe.places =
      places_of(section, {"where", "at", "body", "name", "reference", "from", "anchored_where", "quantities"});
  return probe;
}

}  // namespace piola
