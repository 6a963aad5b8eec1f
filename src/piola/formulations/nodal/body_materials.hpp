// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/options.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/materials/block_law.hpp"
#include "piola/particles/ordering.hpp"
#include <list>
#include <string>
#include <vector>

namespace piola::nodal {

/// Geometric mean of the spacings of a body [m].
double mean_spacing(Body const& body, int dimension);

/// Width of the band of cells that a crack breaks: two rows, because an opening is between two particles, whose cells
/// both see it [m].
double width_of_crack(Body const& body, int dimension);

/// The materials of a body and of its parts, by slots.
class BodyMaterials {
 public:
  BodyMaterials(std::vector<MaterialParameters> const& materials, ParticleSet const& set, Body const& body,
                SlotOrder const& order, Options const& options);

  /// Sets materials, constants and viscosity of the state. Throws InputError (viscosity of several materials).
  void attach(BodyState& state, Options const& options) const;
  /// Reference densities [kg/m^3].
  std::vector<double> densities() const;
  MaterialRange const& of(Index slot) const;
  std::vector<MaterialRange> const& ranges() const { return ranges_; }

 private:
  std::string name_;         ///< of the body
  double mean_spacing_ = 1;  ///< [m]
  std::vector<MaterialRange> ranges_;
  std::list<BlockLaw> block_laws_;  ///< of ranges
};

}  // namespace piola::nodal
