// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/probe_set.hpp"
#include "piola/base/contracts.hpp"
#include <limits>

namespace piola {

ProbeSet::ProbeSet(CaseSpec const& spec, ParticleSet const& particles) : particles_(particles) {
  for (ProbeSpec const& probe : spec.probes) probes_.emplace_back(probe, particles);
}

std::vector<std::vector<double>> ProbeSet::evaluate(Formulation const& formulation, double time) {
  std::vector<std::vector<double>> values(probes_.size());
  std::vector<std::size_t> of_all;  // probes that need all particles
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    if (probes_[k].is_reducible()) continue;
    of_all.push_back(k);
    values[k].assign(probes_[k].columns().size(), std::numeric_limits<double>::quiet_NaN());
  }
  if (of_all.size() < probes_.size()) evaluate_additive(formulation, time, values);
  if (of_all.empty()) return values;
  evaluate_on_root(formulation, particles_, [&](FieldCache& all) {
    for (std::size_t const k : of_all) values[k] = probes_[k].evaluate(all, time);
  });
  return values;
}

/// Restricts probes to the local particles. Recreates those that were restricted to an earlier partition.
void ProbeSet::distribute(std::optional<std::vector<std::int64_t>> const& local) {
  for (Probe& probe : probes_) {
    if (!probe.is_reducible()) continue;
    if (distributed_to_) {
      double const state = probe.state();
      probe = Probe(probe.spec(), particles_);
      probe.restore(state);
    }
    probe.share(local);
  }
  distributed_to_ = local;
}

void ProbeSet::evaluate_additive(Formulation const& formulation, double time,
                                 std::vector<std::vector<double>>& values) {
  FieldCache own(formulation, particles_, FieldCache::Of::local);
  if (own.local_particles() != distributed_to_) distribute(own.local_particles());
  for (std::size_t k = 0; k < probes_.size(); ++k)
    if (probes_[k].is_reducible()) values[k] = probes_[k].evaluate(own, time);
}

}  // namespace piola
