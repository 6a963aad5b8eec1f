// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/load_balancer.hpp"
#include "piola/formulations/adaptle/particle_data.hpp"
#include "piola/formulations/adaptle/particle_partition.hpp"
#include "piola/formulations/adaptle/step_halo_exchanges.hpp"
#include "piola/formulations/common/lattice_line_halo.hpp"
#include <memory>
#include <optional>
#include <vector>

namespace piola::adaptle {

/// Distribution over ranks: each rank owns a contiguous range of slots per body, which repartitioning may change; it
/// stores fields of these and of their reference ghosts. Kernel type and deletion flag of all particles are replicated.
class Distribution {
 public:
  explicit Distribution(Repartition when) : balance_(when) {}

  /// Sets the partition of each body, and the local slots of `system`.
  void assign(std::vector<Partition> cuts, System& system);
  /// Builds the exchanges with other ranks, if there are any, for the tables of the local particles. Collective.
  void connect(ParticleData const& particles, ReferenceLists const& neighbours);
  /// Returns a partition that saves time by the measured work, or nothing: the present one stays. Call once before
  /// each step. Collective.
  std::optional<std::vector<Partition>> plan(ParticleData const& particles);
  /// Sends the fields of a checkpoint, except the replicated ones, from the old owners of particles to the present
  /// ones.
  void migrate(ParticleData& particles, std::vector<Partition> const& from);

  /// Null on one rank.
  StepHaloExchanges* exchanges() const { return exchanges_.get(); }
  ParticlePartition const& partition() const { return partition_; }
  /// Lattice lines for observers on several ranks; null on one rank.
  LatticeLineHalo* lines(int body) const {
    return lines_.empty() ? nullptr : lines_[static_cast<std::size_t>(body)].get();
  }
  /// Busy time of this rank [s], to which steps add.
  double& busy() { return balance_.busy(); }
  RepartitionStatistics const& statistics() const { return balance_.repartition_statistics(); }

 private:
  ParticlePartition partition_;
  std::unique_ptr<StepHaloExchanges> exchanges_;
  std::vector<std::unique_ptr<LatticeLineHalo>> lines_;
  LoadBalancer balance_;
};

}  // namespace piola::adaptle
