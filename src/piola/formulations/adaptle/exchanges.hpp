// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/material_lists.hpp"
#include "piola/formulations/adaptle/near_exchange.hpp"
#include "piola/formulations/adaptle/spatial_lists.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/parallel/halo_plan.hpp"
#include <vector>

namespace piola::adaptle {

/// Communication in a step. Each rank owns a range of slots of every body and computes the results of these slots.
/// Kernel types, cell marks and conversions are replicated. Ghosts in the reference configuration are exchanged by
/// halos, spatial ghosts by NearExchange. exchanges.cpp alone determines the fields and their order. All members are
/// collective.
class Exchanges {
 public:
  /// system: of a distributed run, with its tables. cuts: partition of each body.
  Exchanges(System const& system, MaterialLists const& lists, std::vector<Shares> cuts, ParticleOrder const& order);

  /// To be called between the parts of a step (Machine), in this order. before_lists() also broadcasts a failure of any
  /// rank and returns the input of the step's lists.
  SpatialLists::Others before_lists(System const& system);
  void after_prediction(System const& system);
  void after_lists(System const& system);
  void after_half_state(System const& system);
  void after_correction(System const& system);

  /// Communication pattern of a body in its current state, computed in a run on one rank.
  static Talk talk(System const& system, SpatialLists const& lists, int body);

 private:
  /// Exchange between reference neighbours of one body.
  struct ToNeighbours {
    HaloPlan plan;
    FieldRef motion, stress;
    std::vector<FieldRef> hourglass;  ///< F and its rate, if neighbours read them
  };
  ToNeighbours to_neighbours(System const& system, MaterialLists const& lists, int body) const;

  NearExchange near_;
  std::vector<Shares> cuts_;
  std::vector<ToNeighbours> to_neighbours_;
};

}  // namespace piola::adaptle
