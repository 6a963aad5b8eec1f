// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/count_coupled_communication.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/heap_tuning.hpp"
#include "piola/formulations/coupling/coupled_formulations.hpp"
#include "piola/formulations/make_formulation.hpp"
#include <memory>
#include <utility>

namespace piola {
namespace {

/// Builds a formulation as a rank without particles of its own would: arrays have full length, but almost no pages are
/// touched.
std::unique_ptr<Formulation> known(Assembly assembly) {
  struct LazyAllocationGuard {
    LazyAllocationGuard() { exec_host::set_lazy_allocation(2); }
    LazyAllocationGuard(LazyAllocationGuard const&) = delete;
    LazyAllocationGuard& operator=(LazyAllocationGuard const&) = delete;
    ~LazyAllocationGuard() { exec_host::set_lazy_allocation(comm::size()); }
  } const in_parts;
  assembly.for_estimate_only = true;
  return make_formulation(assembly);
}

}  // namespace

void count_talk_between(Assembly const& assembly, Estimate& cost) {
  std::vector<FormulationGroup> parts = split_by_formulation(assembly);
  std::vector<std::size_t> const read = coupled_particle_counts(assembly, parts);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Assembly of_part = std::move(parts[k].assembly);
    auto const info = find_formulation(parts[k].formulation);
    auto const formulation = info && info->has_spatial_halo ? known(std::move(of_part)) : nullptr;
    for (std::size_t j = 0; j < parts[k].blocks.size(); ++j) {
      std::optional<CommPattern>& talk = cost.talk[parts[k].blocks[j].body];
      if (!talk) continue;
      if (formulation) {
        double const stages = talk->stages;
        talk = formulation->comm_pattern(j).value_or(CommPattern{});
        talk->stages = stages;
        if (talk->near) talk->near->group = k;
      }
      if (j == 0) talk->add_coupled_particles(read[k]);
    }
  }
}

}  // namespace piola
