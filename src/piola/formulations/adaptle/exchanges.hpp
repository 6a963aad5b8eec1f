// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/material_lists.hpp"
#include "piola/formulations/adaptle/near_exchange.hpp"
#include "piola/formulations/adaptle/spatial_lists.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/parallel/halo_plan.hpp"
#include <vector>

namespace piola::adaptle {

/// What ranks tell each other in a step. Each works on its part of the tiles of every body, and its results are those
/// of these slots; all have the same descriptions and marks of cells, and convert the same particles.
/// Reference neighbours are told by halos, who is near in space by NearExchange. What is told, and when, stands in
/// exchanges.cpp alone; every function is collective.
class Exchanges {
 public:
  /// system: of a run that several ranks share, with its tables. cuts: who has what of each body.
  Exchanges(System const& system, MaterialLists const& lists, std::vector<Shares> cuts, ParticleOrder const& order);

  /// Between the parts of a step (Machine), in this order. After the first one all ranks know of a failure of any; what
  /// it returns is for the lists of the step.
  SpatialLists::Others before_lists(System const& system);
  void after_prediction(System const& system);
  void after_lists(System const& system);
  void after_half_state(System const& system);
  void after_correction(System const& system);

  /// What a body would tell in a step from its state as it is, of a run on one rank.
  static Talk talk(System const& system, SpatialLists const& lists, int body);

 private:
  /// What one body tells its reference neighbours.
  struct ToNeighbours {
    HaloPlan plan;
    FieldRef motion, stress;
    std::vector<FieldRef> hourglass;  ///< F and its rate, where neighbours read them
  };
  ToNeighbours to_neighbours(System const& system, MaterialLists const& lists, int body) const;

  NearExchange near_;
  std::vector<Shares> cuts_;
  std::vector<ToNeighbours> to_neighbours_;
};

}  // namespace piola::adaptle
