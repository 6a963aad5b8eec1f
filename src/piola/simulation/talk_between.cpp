// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/talk_between.hpp"
#include "piola/exec/free_memory.hpp"
#include "piola/formulations/ensemble.hpp"
#include "piola/formulations/make.hpp"
#include "piola/parallel/ranks.hpp"
#include <memory>
#include <utility>

namespace piola {
namespace {

/// Builds a formulation as a rank without particles of its own would: arrays have full length, but almost no pages are
/// touched.
std::unique_ptr<Formulation> known(Assembly assembly) {
  struct InParts {
    InParts() { exec_host::fill_arrays_in_parts(2); }
    InParts(InParts const&) = delete;
    InParts& operator=(InParts const&) = delete;
    ~InParts() { exec_host::fill_arrays_in_parts(ranks::count()); }
  } const in_parts;
  assembly.only_known = true;
  return make_formulation(assembly);
}

}  // namespace

void count_talk_between(Assembly const& assembly, Estimate& cost) {
  std::vector<EnsemblePart> parts = split_by_formulation(assembly);
  std::vector<std::size_t> const read = read_between_bodies(assembly, parts);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Assembly of_part = std::move(parts[k].assembly);
    auto const info = find_formulation(parts[k].formulation);
    auto const formulation = info && info->tells_of_space ? known(std::move(of_part)) : nullptr;
    for (std::size_t j = 0; j < parts[k].blocks.size(); ++j) {
      std::optional<Talk>& talk = cost.talk[parts[k].blocks[j].body];
      if (!talk) continue;
      if (formulation) {
        double const stages = talk->stages;
        talk = formulation->talk(j).value_or(Talk{});
        talk->stages = stages;
        if (talk->near) talk->near->group = k;
      }
      if (j == 0) talk->read_motion_of(read[k]);
    }
  }
}

}  // namespace piola
