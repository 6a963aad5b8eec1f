// SPDX-License-Identifier: Apache-2.0
#include "piola/model/read_case.hpp"
#include "piola/base/read_file.hpp"
#include "piola/base/text.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/document_limits.hpp"
#include "piola/input/identify.hpp"
#include "piola/input/material_library.hpp"
#include "piola/input/sections.hpp"
#include "piola/model/case_particles.hpp"
#include "piola/model/clearance.hpp"
#include "piola/setup/packed_bodies.hpp"
#include "piola/setup/solids_of_revolution.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <unistd.h>

namespace piola {
namespace {

constexpr std::size_t longest_title = 500;  // of which pictures show what has room

/// The tables of a list such as [[body]]; a problem if it is no such list.
std::vector<Section> tables_of(Section const& top, std::string_view key) {
  std::vector<Section> tables;
  auto const value = top.find(key);
  if (!value) return tables;
  std::string const heading = "[[" + std::string(key) + "]]";
  if (!value->node.is_array()) {
    top.problems().add(value->node.place, std::string(key) + " is " + shown(value->node) +
                                              " (allowed: a list of tables) - write " + heading);
    // The table is read all the same: supports that name the body would be refused, too.
    if (value->node.is_table()) tables.emplace_back(value->node, std::string(key), top.problems());
    return tables;
  }
  for (Node const& item : value->node.items) {
    if (item.is_table())
      tables.emplace_back(item, std::string(key), top.problems());
    else
      top.problems().add(item.place,
                         std::string(key) + " holds " + shown(item) + " (allowed: tables) - write " + heading);
  }
  if (value->node.items.empty() && key_info("", key).required()) {
    top.problems().add(value->node.place, "the case has no " + std::string(key) + " - add " + heading);
  }
  return tables;
}

/// Names that are given twice, by the sections that give them again.
template <class Spec>
void refuse_twins(std::vector<Section> const& sections, std::vector<Spec> const& specs, std::string const& what) {
  for (std::size_t i = 0; i < specs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (specs[i].name.empty() || specs[i].name != specs[j].name) continue;
      sections[i].problems().add(
          sections[i].place_of("name"),
          fmt::format("the name {} is taken by another {} (allowed: one {} per name) - choose another name",
                      in_quotes(specs[i].name), what, what));
      break;
    }
  }
}

/// Names that columns of history.csv begin with.
struct ColumnOwner {
  Section section;
  std::string name, kind;
};

template <class Spec>
void add_owners(std::vector<ColumnOwner>& owners, std::vector<Section> const& sections, std::vector<Spec> const& specs,
                std::string const& kind) {
  refuse_twins(sections, specs, kind);
  for (std::size_t k = 0; k < specs.size(); ++k) owners.push_back({sections[k], specs[k].name, kind});
}

/// Refuses equal names in sections of different kinds, whose columns could be confused.
void refuse_shared_names(std::vector<ColumnOwner> const& owners) {
  for (std::size_t i = 0; i < owners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      ColumnOwner const &a = owners[i], &b = owners[j];
      if (a.name.empty() || a.name != b.name || a.kind == b.kind) continue;
      a.section.problems().add(
          a.section.place_of("name"),
          "the name " + in_quotes(a.name) + " is taken by a " + b.kind +
              " (allowed: one name for one support, load, rigid shape, spring, tie or probe) - choose another "
              "name");
      break;
    }
}

/// Supports have columns whether they are named or not.
void name_supports(std::vector<SupportSpec>& supports) {
  for (std::size_t k = 0; k < supports.size(); ++k)
    if (supports[k].name.empty()) supports[k].name = "support_" + std::to_string(k);
}

// One dimension holds for all bodies.
void check_bodies_together(std::vector<Section> const& sections, std::vector<BodySpec> const& bodies) {
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    Problems& problems = sections[i].problems();
    if (bodies[i].shape.dimension != bodies[0].shape.dimension) {
      problems.add(sections[i].place_of("shape"),
                   "body " + in_quotes(bodies[i].name) + " is in " + std::to_string(bodies[i].shape.dimension) +
                       "D, body " + in_quotes(bodies[0].name) + " in " + std::to_string(bodies[0].shape.dimension) +
                       "D (allowed: one dimension for all) - give all shapes as many components");
    }
  }
}

double memory_of_machine() {
  long const pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGE_SIZE);
  return pages > 0 && size > 0 ? static_cast<double>(pages) * static_cast<double>(size) : 1e300;
}

void check_size(std::vector<Section> const& sections, CaseSpec const& spec, ReadLimits const& limits) {
  double total = 0;
  for (BodySpec const& body : spec.bodies) total += static_cast<double>(count_particles(body.shape));
  if (sections.empty()) return;
  Section const& first = sections.front();
  std::string const count = total < 1e15 ? count_text(static_cast<std::int64_t>(total)) : number_text(total, 3);
  double const bytes = total * least_bytes_per_particle;
  if (total > static_cast<double>(limits.particles)) {
    first.problems().add(first.place_of("shape"), "the case has " + count + " particles (allowed: at most " +
                                                      count_text(limits.particles) + ") - use a larger spacing");
  } else if (limits.memory && bytes > memory_of_machine()) {
    first.problems().add(first.place_of("shape"), "the case has " + count + " particles, which need at least " +
                                                      size_text(bytes) +
                                                      " of memory (allowed: " + size_text(memory_of_machine()) +
                                                      ", what this machine has) - use a larger spacing");
  }
}

/// Parts with a shape of their own cut a packed body along their surfaces.
void cut_by_parts(BodySpec& body, std::vector<RegionSpec> const& regions) {
  SolidParticles* const particles = body.shape.solid_particles.get();
  if (particles == nullptr) return;
  for (PartSpec const& part : body.parts) {
    if (!part.region) continue;
    RegionSpec const& region = regions[*part.region];
    if (region.solid->dimension() != body.shape.dimension) continue;
    particles->parts.push_back(region.solid);
    particles->key += "\ncut " + region.text;
  }
}

/// Constants, and the regions by their names.
Names read_regions(Section const& top, std::map<std::string, double> const& constants, CaseSpec& spec) {
  Names common{constants, {}};
  std::vector<Section> const sections = tables_of(top, "region");
  for (Section const& section : sections) {
    spec.regions.push_back(read_region(section, common));
    if (RegionSpec const& region = spec.regions.back(); !region.name.empty()) common.places[region.name] = region.holds;
  }
  refuse_twins(sections, spec.regions, "region");
  return common;
}

void read_bodies(Section const& top, Names const& common, CaseSpec& spec, std::vector<BodyNames>& names,
                 ReadLimits const& limits) {
  CaseLibrary const library = read_case_library(top);
  std::size_t const before = top.problems().count();
  std::vector<Section> const sections = tables_of(top, "body");
  for (Section const& section : sections) {
    spec.bodies.push_back(read_body(section, common, library, names.emplace_back()));
    BodySpec& body = spec.bodies.back();
    body.parts = read_parts(section, names.back(), spec.regions, library);
    if (spec.axisymmetric && body.shape.dimension == 2) {
      body.shape.axisymmetric = true;
      cut_at_axis(body.shape);
    }
    if (body.shape.arrangement == ShapeSpec::Arrangement::packed) cut_by_parts(body, spec.regions);
  }
  refuse_twins(sections, spec.bodies, "body");
  for (BodySpec const& body : spec.bodies) {
    if (!body.shape.solid_particles) continue;
    body.shape.solid_particles->unfinished = limits.unfinished;
    if (limits.packing)
      body.shape.solid_particles->progress = [ask = limits.packing, name = body.name](double done) {
        return ask(name, done);
      };
  }
  if (top.problems().count() > before) return;
  check_bodies_together(sections, spec.bodies);
  check_size(sections, spec, limits);
}

/// Title, geometry and [run], and what the document itself tells.
void read_head(Document const& document, Section const& top, CaseSpec& spec) {
  spec.source = document.source;
  spec.old_spellings = document.old_spellings;
  spec.files = files_named_in(document.root);
  if (auto const run = top.table("run")) read_run(*run, spec.run);
  spec.axisymmetric = top.word_index("geometry") == 1;
  std::string& title = spec.title;
  top.read("title", title);
  if (title.size() <= longest_title) return;
  top.problems().add(top.place_of("title"),
                     fmt::format("the title has {} characters (allowed: at most {}) - shorten it",
                                 count_text(static_cast<std::int64_t>(title.size())), longest_title));
}

/// Rigid shapes and their springs.
void read_rigids(std::vector<Section> const& shapes, std::vector<Section> const& springs, BodyNames const& names,
                 CaseSpec& spec) {
  for (Section const& section : shapes) spec.rigids.push_back(read_rigid(section, names));
  for (Section const& section : springs) spec.springs.push_back(read_spring(section, names, spec.rigids));
  name_unnamed("spring", spec.springs);
}

CaseSpec read_document(Document const& document, Problems& problems, ReadLimits const& limits) {
  Section const top(document.root, "", problems);
  CaseSpec spec;
  read_head(document, top, spec);
  std::vector<BodyNames> names;
  std::map<std::string, double> constants;
  if (auto const value = top.find("constants")) constants = read_constants(*value, top.problems());
  read_bodies(top, read_regions(top, constants, spec), spec, names, limits);
  std::vector<Section> const supports = tables_of(top, "support"), loads = tables_of(top, "load");
  for (Section const& section : supports) spec.supports.push_back(read_support(section, names));
  name_supports(spec.supports);
  for (Section const& section : loads) spec.loads.push_back(read_load(section, names));
  for (Section const& section : tables_of(top, "mirror")) spec.mirrors.push_back(read_mirror(section, names));
  for (Section const& section : tables_of(top, "crack")) spec.cracks.push_back(read_crack(section, names));
  int const dimension = names.empty() ? 3 : names.front().dimension;
  std::vector<Section> const rigids = tables_of(top, "rigid"), springs = tables_of(top, "spring");
  read_rigids(rigids, springs, {"", dimension, spec.axisymmetric, {}, {constants, {}}}, spec);
  if (auto const contact = top.find("contact")) read_contact(*contact, dimension, problems, spec);
  std::vector<Section> const ties = tables_of(top, "tie");
  for (Section const& section : ties) spec.ties.push_back(read_tie(section, names, spec.rigids));
  name_unnamed("tie", spec.ties);
  std::vector<Section> const probes = tables_of(top, "probe");
  for (Section const& section : probes) spec.probes.push_back(read_probe(section, names));
  std::vector<ColumnOwner> owners;
  add_owners(owners, supports, spec.supports, "support");
  add_owners(owners, loads, spec.loads, "load");
  add_owners(owners, rigids, spec.rigids, "rigid shape");
  add_owners(owners, springs, spec.springs, "spring");
  add_owners(owners, ties, spec.ties, "tie");
  add_owners(owners, probes, spec.probes, "probe");
  refuse_shared_names(owners);
  std::vector<Section> const quantities = tables_of(top, "quantity");
  for (Section const& section : quantities) spec.quantities.push_back(read_quantity_section(section, spec, constants));
  refuse_twins(quantities, spec.quantities, "quantity");
  if (auto const output = top.table("output")) read_output(*output, spec.output, spec.bodies);
  top.refuse_unknown();
  return spec;
}

}  // namespace

CaseSpec read_case_text(std::string_view text, std::string const& name, std::vector<std::string> const& overrides,
                        ReadLimits const& limits, ParticleSet* made) {
  Problems problems;
  auto document = parse_document(text, name, problems);
  if (document) {
    // A place without a known line is reported without a position.
    document->root.place = {name, 0, 0};
    apply_overrides(*document, overrides, problems);
    if (limits.of_results) use_kept_files(document->root, std::filesystem::path(name).parent_path(), problems);
  }
  problems.raise_if_any();
  CaseSpec spec = read_document(*document, problems, limits);
  if (problems.empty()) {
    spec.identity = identity_of(spec);
    ParticleSet particles = make_particles(spec, problems);
    add_surface_contact(spec, particles);
    check_with_particles(spec, particles, problems);
    if (made != nullptr) *made = std::move(particles);
  }
  problems.sort_by_place();
  problems.raise_if_any();
  return spec;
}

CaseSpec read_case(std::filesystem::path const& path, std::vector<std::string> const& overrides,
                   ReadLimits const& limits, ParticleSet* made) {
  std::filesystem::path const file = std::filesystem::is_directory(path) ? path / "case.toml" : path;
  return read_case_text(read_input_file(file, most_case_bytes), file.string(), overrides, limits, made);
}

}  // namespace piola
