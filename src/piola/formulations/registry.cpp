// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/registry.hpp"
#include "piola/base/problems.hpp"
#include "piola/formulations/jst_advection/options.hpp"
#include "piola/formulations/jst_advection/solver.hpp"
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/formulations/jst_sph/solver.hpp"
#include "piola/formulations/make.hpp"
#include "piola/formulations/taylor_sph/options.hpp"
#include "piola/formulations/taylor_sph/solver.hpp"
#include <array>

namespace piola {
namespace {

struct Entry {
  FormulationInfo info;
  std::unique_ptr<Formulation> (*make)(Assembly const&);
};

/// Adding a formulation: its folder and one line here.
std::array const all{Entry{jst_sph::info(), &jst_sph::make}, Entry{jst_advection::info(), &jst_advection::make},
                     Entry{taylor_sph::info(), &taylor_sph::make}};

std::array const infos{all[0].info, all[1].info, all[2].info};

}  // namespace

std::span<FormulationInfo const> formulations() { return infos; }

std::optional<FormulationInfo> find_formulation(std::string_view name) {
  for (auto const& entry : all)
    if (entry.info.name == name) return entry.info;
  return std::nullopt;
}

std::unique_ptr<Formulation> make_formulation(Assembly const& assembly) {
  std::string const name = assembly.formulations.empty() ? std::string() : assembly.formulations.front().name;
  for (auto const& other : assembly.formulations)
    if (other.name != name)
      throw InputError("formulations '" + name + "' and '" + other.name +
                       "' cannot run together - give all bodies the same one");
  for (auto const& entry : all)
    if (entry.info.name == name) return entry.make(assembly);
  throw InputError("no formulation is named '" + name + "'");
}

}  // namespace piola
