// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/registry.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/formulations/adaptle/options.hpp"
#include "piola/formulations/adaptle/solver.hpp"
#include "piola/formulations/coupling/coupled_formulations.hpp"
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/formulations/jst_sph/solver.hpp"
#include "piola/formulations/make_formulation.hpp"
#include "piola/formulations/nodal/options.hpp"
#include "piola/formulations/nodal/solver.hpp"
#include "piola/formulations/taylor_sph/options.hpp"
#include "piola/formulations/taylor_sph/solver.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace piola {
namespace {

struct Entry {
  FormulationInfo info;
  std::unique_ptr<Formulation> (*make)(Assembly const&);
  void (*add_setting_warnings)(Assembly const&, std::size_t body, BodyWarnings&);
};

/// Adding a formulation: its folder and one line here.
std::array const all{Entry{jst_sph::info(), &jst_sph::make, &jst_sph::add_setting_warnings},
                     Entry{taylor_sph::info(), &taylor_sph::make, &taylor_sph::add_setting_warnings},
                     Entry{adaptle::info(), &adaptle::make, &adaptle::add_setting_warnings},
                     Entry{nodal::info(), &nodal::make, &nodal::add_setting_warnings}};

std::array const infos{all[0].info, all[1].info, all[2].info, all[3].info};

bool knows(FormulationInfo const& info, std::string_view what) {
  if (what == "cracks") return info.cracks;
  if (what == "mirrors") return info.mirrors;
  if (what == "parts") return info.parts;
  if (what == "axisymmetric bodies") return info.axisymmetric;
  if (what == "non-reflecting faces") return info.absorbs;
  if (what == "points from files") return info.off_lattice && !info.outline;
  return what == "rings" || what == "packed clouds" ? info.off_lattice : info.contact || info.can_be_coupled;
}

bool has_scattered(ParticleSet const& particles) {
  return std::any_of(particles.bodies.begin(), particles.bodies.end(),
                     [](Body const& body) { return body.off_lattice; });
}

/// The axis of axisymmetric bodies is none.
bool has_mirrors(Assembly const& assembly) {
  return std::any_of(assembly.mirrors.begin(), assembly.mirrors.end(),
                     [&](MirrorPlane const& mirror) { return !assembly.particles.axisymmetric || mirror.axis != 0; });
}

bool has_absorbing(Assembly const& assembly) {
  return std::any_of(assembly.loads.begin(), assembly.loads.end(), [](Load const& l) { return l.absorbs.has_value(); });
}

/// Rejects features of a case that the formulation does not support.
void check_abilities(FormulationInfo const& info, Assembly const& assembly) {
  Problems problems;
  if (!info.cracks && !assembly.particles.cracks.empty()) problems.add({}, refusal(info, "cracks"));
  if (!info.mirrors && has_mirrors(assembly)) problems.add({}, refusal(info, "mirrors"));
  if (!info.parts && !assembly.parts.empty()) problems.add({}, refusal(info, "parts"));
  if (!info.axisymmetric && assembly.particles.axisymmetric) problems.add({}, refusal(info, "axisymmetric bodies"));
  if (!info.absorbs && has_absorbing(assembly)) problems.add({}, refusal(info, "non-reflecting faces"));
  if (!info.off_lattice && has_scattered(assembly.particles)) problems.add({}, refusal(info, "rings"));
  if (!info.contact && !assembly.rigid_shapes.empty()) problems.add({}, refusal(info, "rigid shapes"));
  problems.raise_if_any();
}

/// All bodies have the same formulation.
std::unique_ptr<Formulation> make_one(Assembly const& assembly) {
  std::string const name = assembly.formulations.empty() ? std::string() : assembly.formulations.front().name;
  for (auto const& entry : all) {
    if (entry.info.name != name) continue;
    check_abilities(entry.info, assembly);
    return entry.make(assembly);
  }
  throw InputError("no formulation is named '" + name + "'");
}

}  // namespace

std::span<FormulationInfo const> formulations() { return infos; }

std::optional<FormulationInfo> find_formulation(std::string_view name) {
  for (auto const& entry : all)
    if (entry.info.name == name) return entry.info;
  return std::nullopt;
}

namespace {

/// Names of the formulations for which is(info) holds.
template <class F>
std::vector<std::string_view> names_where(F const& is) {
  std::vector<std::string_view> names;
  for (FormulationInfo const& info : infos)
    if (is(info)) names.push_back(info.name);
  return names;
}

}  // namespace

std::string refusal(FormulationInfo const& info, std::string_view what) {
  auto const able = names_where([&](FormulationInfo const& other) { return knows(other, what); });
  std::string const text(what), one = text.back() == 's' ? text.substr(0, text.size() - 1) : text;
  return "the formulation " + in_quotes(info.name) + " knows no " + text +
         " (allowed: " + (able.empty() ? "no " + text + " at all" : text + " in " + joined(able)) + ") - remove the " +
         one + " or change body.formulation";
}

std::string refusal_of_ranks(FormulationInfo const& info) {
  auto const able = names_where([](FormulationInfo const& other) { return other.ranks; });
  return "the formulation " + in_quotes(info.name) + " runs on one rank (on several: " + joined(able) +
         ") - start it without mpirun, where run.threads takes all cores, or change body.formulation";
}

std::string_view word_of(FormulationSpec const& spec, std::span<Choice const> choices, std::string_view name) {
  auto const given = spec.words.find(name);
  if (given != spec.words.end()) return given->second;
  for (auto const& choice : choices)
    if (choice.name == name) return choice.allowed.front();
  return {};
}

bool is_stress_free(std::string_view assumption, int dimension, bool otherwise, Problems& problems) {
  if (assumption == "as_dimension") return otherwise;
  int const needed = assumption.starts_with("plane") ? 2 : 1;
  if (dimension != needed)
    problems.add({}, fmt::format("formulation: assumption = \"{}\" is for bodies in {}D, this one is in {}D - leave it "
                                 "out",
                                 assumption, needed, dimension));
  return assumption.ends_with("stress");
}

double number_of(FormulationSpec const& spec, std::string_view name, double otherwise) {
  auto const given = spec.numbers.find(name);
  return given != spec.numbers.end() ? given->second : otherwise;
}

std::vector<SettingWarning> setting_warnings(Assembly const& assembly) {
  std::vector<SettingWarning> found;
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t b = 0; b < assembly.formulations.size(); ++b) groups[group_name(assembly, b)].push_back(b);
  for (std::size_t b = 0; b < assembly.formulations.size(); ++b)
    for (auto const& entry : all) {
      if (entry.info.name != assembly.formulations[b].name) continue;
      BodyWarnings about(assembly, b, groups[group_name(assembly, b)], found);
      entry.add_setting_warnings(assembly, b, about);
    }
  return found;
}

std::unique_ptr<Formulation> make_formulation(Assembly const& assembly) {
  bool const mixed =
      std::any_of(assembly.formulations.begin(), assembly.formulations.end(),
                  [&](FormulationSpec const& spec) { return spec.name != assembly.formulations.front().name; });
  bool const turning = std::any_of(assembly.rigid_shapes.begin(), assembly.rigid_shapes.end(),
                                   [](RigidShape const& shape) { return shape.turns(); });
  if (turning && assembly.surfaces.empty())
    throw InputError("rigid shapes that are free or turn push surfaces of bodies, and no body has one");
  if (!mixed && assembly.surfaces.empty()) return make_one(assembly);
  std::vector<FormulationGroup> parts = split_by_formulation(assembly);
  bool const contact = std::any_of(parts.begin(), parts.end(), [](FormulationGroup const& part) {
    auto const info = find_formulation(part.formulation);
    return info && info->contact;
  });
  if (!contact && assembly.surfaces.empty() && !assembly.rigid_shapes.empty())
    throw InputError(refusal(*find_formulation(parts.front().formulation), "rigid shapes"));
  std::vector<std::unique_ptr<Formulation>> made;
  made.reserve(parts.size());
  for (FormulationGroup const& part : parts) made.push_back(make_one(part.assembly));
  return make_coupled_formulations(assembly, std::move(parts), std::move(made));
}

}  // namespace piola
