// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/probe_row.hpp"
#include "piola/simulation/ranks.hpp"
#include <algorithm>

namespace piola {

ProbeRow::ProbeRow(CaseSpec const& spec, ParticleSet const& particles) : particles_(particles), specs_(spec.probes) {
  for (ProbeSpec const& probe : spec.probes) probes_.emplace_back(probe, particles);
}

std::vector<std::vector<double>> ProbeRow::evaluate(Formulation const& formulation, double time) {
  std::vector<std::vector<double>> values(probes_.size());
  if (std::any_of(probes_.begin(), probes_.end(), [](Probe const& probe) { return probe.adds_up(); }))
    with_probes_of_all(time, [&] { values = evaluate_owned(formulation, time); });
  FieldCache all(formulation, particles_);
  for (std::size_t k = 0; k < probes_.size(); ++k)
    if (!probes_[k].adds_up()) values[k] = probes_[k].evaluate(all, time);
  return values;
}

void ProbeRow::take_part(Formulation const& formulation, double time) { evaluate_owned(formulation, time); }

/// Recreates probes that were restricted to the local particles of an earlier partition.
void ProbeRow::share(std::optional<std::vector<std::int64_t>> const& owned) {
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    Probe& probe = probes_[k];
    if (!probe.adds_up()) continue;
    if (shared_for_) {
      double const state = probe.state();
      probe = Probe(specs_[k], particles_);
      probe.restore(state);
    }
    probe.share(owned);
  }
}

std::vector<std::vector<double>> ProbeRow::evaluate_owned(Formulation const& formulation, double time) {
  auto const recuts = formulation.recuts();
  std::size_t const cuts = recuts ? recuts->imbalance.size() : 0;
  if (shared_for_ != cuts) share(formulation.owned());
  shared_for_ = cuts;
  FieldCache own(formulation, particles_, FieldCache::Of::owned);
  std::vector<std::vector<double>> values;
  for (Probe& probe : probes_) values.push_back(probe.adds_up() ? probe.evaluate(own, time) : std::vector<double>());
  return values;
}

}  // namespace piola
