// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/state.hpp"
#include "piola/formulations/assembly.hpp"
#include <array>
#include <vector>

namespace piola::adaptle {

/// Pressure that two flat lattices at stand-off dp exert on each other per eps dp^(d-2) / dp^(2(d-1)): the number C_n
/// of the impedance-matched contact. h and dp [m].
double contact_number(int dimension, double h, double dp, double exponent);

/// Reference pressure of contact between two bodies at the closing speed v [Pa]: the largest pressure of two half
/// spaces, Z_a Z_b / (Z_a + Z_b) v (1 + v / (2 c)), or the one at which the weaker body yields, 3 sy + rho v^2 / 2, if
/// that is less; at least a quarter of the former and a hundredth of the smaller bulk modulus.
double reference_pressure(BodyConstants const& a, BodyConstants const& b, double v);

/// Exponent n of the kernel law between two bodies at the closing speed v: 4 (1 + x^2 (3 - 2x) (1 - p_f / p_s)^2), and
/// 4 if p_s is not above p_f. p_s is the pressure of their shock; p_f = 3 sy + rho v^2 / 2 is that at which the weaker
/// one yields; x goes from 0 to 1 as the strength 3 sy goes from 0.4 to 0.9 of p_f. So n is 4 if waves or inertia
/// dominate, and up to 8 if strength does.
double contact_exponent(BodyConstants const& a, BodyConstants const& b, double v);

/// Stiffness and exponent of every pair of bodies, [body][body]. mean_velocity: of each body at the start [m/s].
std::vector<KernelContactPair> contact_pairs(int dimension, ContactRule const& rule,
                                             std::vector<BodyConstants> const& bodies,
                                             std::vector<std::array<double, 3>> const& mean_velocity);

/// Switches kernel contact of tied bodies off: they have surface contact after the tie has failed.
void exclude_tied_pairs(std::vector<contact::TieRule> const& ties, std::size_t bodies,
                        std::vector<KernelContactPair>& pairs);

/// Marks the pairs of bodies that have surface contact first: those of the case's contact_pairs, to which reading the
/// case adds total-Lagrangian bodies that touch at the start.
void mark_surface_contact(Assembly const& assembly, std::vector<KernelContactPair>& pairs);

/// Potential energy of kernel contact [J] that has appeared because surfaces were lost since `lost_before`
/// (LostSurfaces::by_slot). The lists must be those of the last step. Collective.
double opened_energy(System const& system, std::vector<std::uint8_t> const& lost_before);

/// Potential energy of all contacts at the current positions [J]: bodies may start in contact with each other or with a
/// rigid shape. The lists must be those of the present positions. Collective.
double contact_energy(System const& system);

}  // namespace piola::adaptle
