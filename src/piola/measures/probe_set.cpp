// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/probe_set.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>

namespace piola {

ProbeSet::ProbeSet(CaseSpec const& spec, ParticleSet const& particles) : particles_(particles) {
  for (ProbeSpec const& probe : spec.probes) probes_.emplace_back(probe, particles);
}

std::vector<std::vector<double>> ProbeSet::evaluate(Formulation const& formulation, double time,
                                                    OnAllRanks on_all_ranks) {
  PIOLA_EXPECTS(on_all_ranks != nullptr);
  std::vector<std::vector<double>> values(probes_.size());
  if (std::any_of(probes_.begin(), probes_.end(), [](Probe const& probe) { return probe.is_reducible(); }))
    on_all_ranks(time, [&] { values = evaluate_additive(formulation, time); });
  FieldCache all(formulation, particles_);
  for (std::size_t k = 0; k < probes_.size(); ++k)
    if (!probes_[k].is_reducible()) values[k] = probes_[k].evaluate(all, time);
  return values;
}

void ProbeSet::evaluate_local(Formulation const& formulation, double time) { evaluate_additive(formulation, time); }

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

std::vector<std::vector<double>> ProbeSet::evaluate_additive(Formulation const& formulation, double time) {
  FieldCache own(formulation, particles_, FieldCache::Of::local);
  if (own.local_particles() != distributed_to_) distribute(own.local_particles());
  std::vector<std::vector<double>> values;
  for (Probe& probe : probes_)
    values.push_back(probe.is_reducible() ? probe.evaluate(own, time) : std::vector<double>());
  return values;
}

}  // namespace piola
