// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/taylor_sph/particles.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include <vector>

namespace piola::taylor_sph {

/// The boxes of the lattice of a body on which the hourglass filter acts, with their tables for loops. Without boxes
/// there is no filter: in one dimension, and where the filter is off.
class HourglassBoxes {
 public:
  HourglassBoxes(ParticleSet const& set, Body const& body, Options const& options);

  bool empty() const { return boxes_.count() == 0; }
  /// Tables for these slots of particles.
  void make_tables(Particles const& particles, int lanes);
  void set_views(BodyState& state);
  std::size_t bytes() const;

 private:
  Cells boxes_;  ///< corners numbered within the body
  std::vector<Index> corner_, box_of_;
  std::vector<double> pattern_;
};

}  // namespace piola::taylor_sph
