// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/state.hpp"
#include "piola/materials/hypoelastic_solid.hpp"
#include "piola/math/tensor.hpp"

/// One Eulerian cell: its stress follows from the motion of the particles around, not from gradients in the reference
/// configuration. Theory: docs/theory/nodal.md, "Eulerian cells".
namespace piola::nodal {

struct EulerianCell {
  double V0 = 0;         ///< reference volume [m^D]
  double J = 1;          ///< volume over reference volume
  double pressure = 0;   ///< of what the cell carries, positive in compression [Pa]
  double energy = 0;     ///< specific internal energy [J/kg]
  double softening = 0;  ///< share of tension and shear that is lost, 0 to 1
  SolidHistory history;

  double volume() const { return J * V0; }
  /// Cauchy stress [Pa].
  SymMat<3> stress() const {
    SymMat<3> sigma;
    for (int c = 0; c < 6; ++c) sigma.c[c] = (1 - softening) * history.S.c[c] - (c < 3 ? pressure : 0);
    return sigma;
  }
};

/// Volume ratio of any cell, by its stored gradients.
double volume_ratio_at(BodyState const& body, Index slot);
/// The cell of a slot, stored in the field `history` as the values that its points share.
EulerianCell eulerian_cell_at(BodyState const& body, Index slot, double V0);
void store(EulerianCell const& cell, BodyState const& body, Index slot);
/// Makes the cell of a slot, which follows its gradients so far, Eulerian: stress, density and energy stay, points get
/// their mean. J: its volume ratio.
void make_eulerian(BodyState const& body, Index slot, double J);

/// Motion around an Eulerian cell in a step.
struct EulerianStep {
  double dt = 0;    ///< [s]
  Mat<3> strain{};  ///< velocity gradient times dt, by which density and stress change
  Mat<3> before{};  ///< sum over neighbours of volume times relative displacement times kernel gradient, at the start
  Mat<3> after{};   ///< the same at the end
  double J = 1;     ///< volume ratio of the cell at the end of the step
  double viscous_work = 0;  ///< on the cell in the step [J]
};

/// Advances a cell by a step. Its energy grows by the mean of V sigma : before, with volume and stress of the start,
/// and V sigma : after, with those of the end, and by the viscous work: what the kinetic energy loses in a Verlet step.
void advance(EulerianCell& cell, MaterialRange const& range, EulerianStep const& step);

/// Speed of pressure waves [m/s].
double sound_speed_of(EulerianCell const& cell, MaterialRange const& range);

}  // namespace piola::nodal
