// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/input/history_names.hpp"
#include "piola/input/output_keys.hpp"
#include "piola/input/run_keys.hpp"
#include "piola/input/sections.hpp"
#include "piola/materials/block_law.hpp"
#include <limits>
#include <span>

namespace piola {
namespace {

void read_threads(Section const& section, RunSpec& run) {
  auto const value = section.find("threads");
  if (!value || value->node.is_text("auto")) return;
  if (value->node.is_text()) {
    section.problems().add(value->node.place, "run.threads is " + in_quotes(value->node.text) +
                                                  " (allowed: \"auto\" or a whole number from 1 to 4096)");
  } else if (auto const threads = section.whole("threads")) {
    run.threads = static_cast<int>(*threads);
  }
}

void read_repartition(Section const& section, RunSpec& run) {
  auto const value = section.find("repartition");
  if (!value || value->node.is_text("auto")) return;
  if (value->node.is_text("never")) {
    run.repartition.never = true;
  } else if (value->node.kind == Node::Kind::integer && value->node.integer > 0 &&
             value->node.integer <= std::numeric_limits<int>::max()) {
    run.repartition.every = static_cast<int>(value->node.integer);
  } else {
    section.problems().add(value->node.place, "run.repartition is " + shown(value->node) +
                                                  " (allowed: \"auto\", \"never\" or a whole number of steps)");
  }
}

void read_jacobian(Section const& section, GuardLimits& limits) {
  auto const value = section.find("jacobian");
  if (!value) return;
  if (value->node.is_text("off")) {
    limits.jacobian = {0, GuardLimits::never};
    return;
  }
  auto const items = read_list(*value, 2, 2, section.problems());
  if (!items) return;
  Interval const allowed = section.info_of("jacobian").allowed;
  auto const low = read_number((*items)[0], "1", allowed, section.problems());
  auto const high = read_number((*items)[1], "1", allowed, section.problems());
  if (!low || !high) return;
  if (*low >= *high)
    section.problems().add(value->node.place, "run.guards.jacobian is empty (allowed: the lower value first)");
  limits.jacobian = {*low, *high};
}

void read_guards(Section const& run, GuardLimits& limits) {
  Node const* const node = run.node().find("guards");
  if (node != nullptr && node->is_text("off")) {
    limits.on = false;
    return;
  }
  auto const section = run.table("guards");
  if (!section) return;
  read_members(*section, guard_keys(), limits);
  read_jacobian(*section, limits);
  section->refuse_unknown();
}

/// Names of the values that laws on blocks of points keep.
void add_history_names(std::span<BodySpec const> bodies, std::vector<std::string>& names) {
  auto const add = [&](MaterialParameters const& material) {
    piola_material const* const law = law_of(material).block;
    for (int h = 0; law != nullptr && h < law->history_count; ++h) names.emplace_back(law->history[h].name);
  };
  for (BodySpec const& body : bodies) {
    add(body.material);
    for (PartSpec const& part : body.parts) add(part.material);
  }
}

void read_frames(Section const& section, std::span<BodySpec const> bodies, OutputSpec& output) {
  read_members(section, output_keys(), output);
  auto known = known_fields();
  add_history_names(bodies, known);
  if (auto const fields = section.find("fields")) {
    auto const items = read_list(*fields, 1, 1000, section.problems());
    if (items) {
      for (Value const& item : *items) {
        if (auto const field = read_word(item, known, section.problems())) output.frame_fields.push_back(*field);
      }
    }
  }
  section.refuse_unknown();
}

}  // namespace

std::vector<std::string> known_fields() {
  std::vector<std::string> names;
  for (FieldName const& field : field_names()) names.emplace_back(field.name);
  return names;
}

void read_run(Section const& section, RunSpec& run) {
  read_members(section, run_keys(), run);
  if (!run.relax) {
    section.refuse("relax_tolerance", "is used only with relax = true");
    section.refuse("relax_method", "is used only with relax = true");
  }
  if (run.minimises()) section.refuse("damping", "has no effect with relax_method = \"conjugate_gradients\"");
  read_threads(section, run);
  read_repartition(section, run);
  read_guards(section, run.guards);
  if (run.min_step >= run.max_step) {
    section.problems().add(section.place_of("min_step"), "run.min_step is not below run.max_step (allowed: less than " +
                                                             quantity_text(run.max_step, "s") + ")");
  }
  section.refuse_unknown();
  run.places = places_of(section, {"end", "cfl", "max_step", "relax_method"});
}

void read_output(Section const& section, OutputSpec& output, std::span<BodySpec const> bodies) {
  if (auto const frames = section.table("frames")) read_frames(*frames, bodies, output);
  if (auto const history = section.table("history")) {
    read_members(*history, output_keys(), output);
    history->refuse_unknown();
  }
  if (auto const pictures = section.table("pictures")) read_pictures(*pictures, output.pictures, bodies);
  if (auto const checkpoints = section.table("checkpoints")) {
    read_members(*checkpoints, output_keys(), output);
    checkpoints->refuse_unknown();
  }
  section.refuse_unknown();
}

}  // namespace piola
