// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/input/sections.hpp"
#include <array>

namespace piola {
namespace {

using Kind = ProbeSpec::Kind;

/// Which of the three kinds use a key.
struct ClusterKey {
  std::string_view key;
  bool fragment, rim, hole;
};

constexpr std::array cluster_keys{
    ClusterKey{"link", true, true, true},
    ClusterKey{"anchored_where", true, true, true},
    ClusterKey{"fragment", true, false, false},
    ClusterKey{"near_axis", true, false, false},
    ClusterKey{"min_particles", true, false, false},
    ClusterKey{"within", false, true, false},
    ClusterKey{"base", false, true, false},
    ClusterKey{"sectors", false, true, false},
    ClusterKey{"slab_from", false, false, true},
    ClusterKey{"slab_to", false, false, true},
    ClusterKey{"cavity_from", false, false, true},
    ClusterKey{"cavity_to", false, false, true},
    ClusterKey{"bin", false, false, true},
};

bool uses(ClusterKey const& key, Kind kind) {
  return (kind == Kind::fragment && key.fragment) || (kind == Kind::rim && key.rim) || (kind == Kind::hole && key.hole);
}

void refuse_others(Section const& section, Kind kind) {
  for (ClusterKey const& key : cluster_keys) {
    if (uses(key, kind)) continue;
    section.refuse(key.key, key.fragment && key.rim ? "is used only by the kinds \"fragment\", \"rim\" and \"hole\""
                            : key.fragment          ? "is used only by the kind \"fragment\""
                            : key.rim               ? "is used only by the kind \"rim\""
                                                    : "is used only by the kind \"hole\"");
  }
}

void read_needed(Section const& section, std::string_view key, std::string_view about, double& target) {
  if (!section.has(key))
    section.report_missing(key, about, std::string(key) + " = \"1 mm\"");
  else
    section.read(key, target);
}

bool fits(Section const& section, Kind kind, int dimension) {
  int const wanted = kind == Kind::rim ? 3 : kind == Kind::hole ? 2 : dimension;
  if (wanted == dimension) return true;
  section.problems().add(section.place_of("kind"), std::string("probe.kind is \"") +
                                                       (kind == Kind::rim ? "rim" : "hole") + "\" for a body in " +
                                                       std::to_string(dimension) + "D (allowed in " +
                                                       std::to_string(wanted) + "D) - choose another kind");
  return false;
}

void read_line(Section const& section, int dimension, ProbeSpec& probe) {
  if (!section.has("at"))
    section.report_missing("at", "a point of the axis", "at = [\"0 m\", ...]");
  else if (auto const at = read_components(section, "at", dimension))
    probe.at = *at;
  if (probe.axis < dimension) return;
  section.problems().add(section.place_of("axis"), "probe.axis does not fit a body in " + std::to_string(dimension) +
                                                       "D (allowed: " + (dimension == 1 ? "x" : "x, y") + ")");
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

void read_fragment(Section const& section, BodyNames const* body, ProbeSpec& probe) {
  if (int const which = section.word_index("fragment"); which >= 0)
    probe.fragment = static_cast<ProbeSpec::Fragment>(which);
  if (auto const least = section.whole("min_particles")) probe.min_particles = static_cast<int>(*least);
  if (section.read("near_axis", probe.near_axis)) {
    if (body != nullptr) read_line(section, body->dimension, probe);
    return;
  }
  for (std::string_view const key : {"at", "axis"})
    if (!section.has("near_axis")) section.refuse(key, "is used by the kind \"fragment\" only with near_axis");
}

void read_rim(Section const& section, ProbeSpec& probe) {
  read_needed(section, "within", "the largest distance from the axis", probe.within);
  read_needed(section, "base", "the coordinate from which the height counts", probe.base);
  if (auto const sectors = section.whole("sectors")) probe.sectors = static_cast<int>(*sectors);
}

void check_order(Section const& section, std::string_view from, double low, std::string_view to, double high) {
  if (!section.has(to) || low <= high) return;
  section.problems().add(section.place_of(to), section.name_of(to) + " is " + quantity_text(high, "m") +
                                                   " (allowed: at least " + section.name_of(from) + ", which is " +
                                                   quantity_text(low, "m") + ")");
}

void read_hole(Section const& section, ProbeSpec& probe) {
  read_needed(section, "slab_from", "where the slab begins along the axis", probe.slab_from);
  read_needed(section, "slab_to", "where the slab ends along the axis", probe.slab_to);
  if (section.has("slab_from")) check_order(section, "slab_from", probe.slab_from, "slab_to", probe.slab_to);
  probe.cavity_from = probe.slab_from;
  section.read("cavity_from", probe.cavity_from);
  section.read("cavity_to", probe.cavity_to);
  check_order(section, section.has("cavity_from") ? "cavity_from" : "slab_from", probe.cavity_from, "cavity_to",
              probe.cavity_to);
  section.read("bin", probe.bin);
}

}  // namespace

bool is_cluster_probe(Kind kind) { return kind == Kind::fragment || kind == Kind::rim || kind == Kind::hole; }

void read_cluster_probe(Section const& section, BodyNames const* body, ProbeSpec& probe) {
  refuse_others(section, probe.kind);
  if (!is_cluster_probe(probe.kind)) return;
  if (body != nullptr && !fits(section, probe.kind, body->dimension)) return;
  section.refuse("where", "is not used by the kinds \"fragment\", \"rim\" and \"hole\", which look at the whole body");
  section.read("link", probe.link);
  if (probe.kind == Kind::fragment)
    read_fragment(section, body, probe);
  else if (body != nullptr)
    read_line(section, body->dimension, probe);
  if (probe.kind == Kind::rim) read_rim(section, probe);
  if (probe.kind == Kind::hole) read_hole(section, probe);
  read_anchor(section, body, probe);
}

}  // namespace piola
