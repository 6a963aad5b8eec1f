// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/formulations/adaptle/reference_lists.hpp"
#include "piola/formulations/adaptle/spatial_halo_exchange.hpp"
#include "piola/formulations/adaptle/spatial_lists.hpp"
#include <vector>

namespace piola::adaptle {

/// Communication in a step. Each rank owns a range of slots of every body and computes the results of these slots.
/// Kernel types, cell marks and conversions are replicated. Ghosts in the reference configuration are exchanged by
/// halos, spatial ghosts by SpatialHaloExchange. step_halo_exchanges.cpp alone determines the fields and their order.
/// All members are collective.
class StepHaloExchanges {
 public:
  /// system: of a distributed run, with its tables. cuts: partition of each body.
  StepHaloExchanges(System const& system, ReferenceLists const& lists, std::vector<Partition> cuts);

  /// To be called between the parts of a step (Backend), in this order. before_lists() also broadcasts a failure of any
  /// rank and returns the input of the step's lists.
  SpatialLists::RemoteParticles before_lists(System const& system);
  void after_prediction(System const& system);
  void after_lists(System const& system);
  void after_half_state(System const& system);
  void after_correction(System const& system);

 private:
  /// Exchange between reference neighbours of one body.
  struct ReferenceHalo {
    HaloPlan plan;
    FieldRef motion, stress;
    std::vector<FieldRef> hourglass;  ///< F and its rate, if neighbours read them
  };
  ReferenceHalo reference_halo(System const& system, ReferenceLists const& lists, int body) const;

  SpatialHaloExchange near_;
  std::vector<Partition> cuts_;
  std::vector<ReferenceHalo> to_neighbours_;
};

}  // namespace piola::adaptle
