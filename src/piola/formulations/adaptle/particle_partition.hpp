// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/domain/partition.hpp"
#include "piola/exec/host_loops.hpp"
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace piola::adaptle {

/// The partition of the particles of a run, and the gather of their values on rank 0: `width` per particle, on each
/// rank in the order of its bodies and slots, on rank 0 in the order of ids. One rank has all.
class ParticlePartition {
 public:
  ParticlePartition() = default;
  /// cuts: of each body.
  explicit ParticlePartition(std::vector<Partition> cuts) : cuts_(std::move(cuts)) {
    for (Partition const& body : cuts_) own_.push_back(body.own());
  }

  std::vector<Partition> const& cuts() const { return cuts_; }
  /// The local slots of each body.
  std::vector<Range> const& own() const { return own_; }
  /// Calls f(slot, index among the particles of the rank).
  template <class F>
  void each(int rank, F const& f) const {
    std::size_t before = 0;
    for (Partition const& body : cuts_) {
      Range const part = body.of(rank);
      exec_host::parallel_for(part.last - part.first,
                              [&](Index k) { f(part.first + k, before + static_cast<std::size_t>(k)); });
      before += static_cast<std::size_t>(part.last - part.first);
    }
  }
  std::size_t count(int rank) const {
    std::size_t sum = 0;
    for (Partition const& body : cuts_) sum += static_cast<std::size_t>(body.of(rank).last - body.of(rank).first);
    return sum;
  }
  std::vector<std::int64_t> ids() const {
    std::vector<std::int64_t> ids(count(comm::rank()));
    each(comm::rank(), [&](Index i, std::size_t k) { ids[k] = i; });
    return ids;
  }

  /// Gathers on rank 0, one rank after the other. all: receives the values on rank 0. Collective.
  void collect(std::size_t width, std::vector<double> mine, std::span<double> all) const {
    for (int rank = 0; rank < comm::size(); ++rank) {
      if (comm::rank() == 0 && rank > 0) mine.resize(count(rank) * width);
      if (rank > 0) comm::send_to(rank, 0, mine);
      if (comm::rank() != 0) continue;
      each(rank, [&](Index i, std::size_t k) {
        for (std::size_t c = 0; c < width; ++c) all[static_cast<std::size_t>(i) * width + c] = mine[k * width + c];
      });
    }
  }

 private:
  std::vector<Partition> cuts_;
  std::vector<Range> own_;
};

}  // namespace piola::adaptle
