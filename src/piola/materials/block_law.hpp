// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/materials/piola_material.h"
#include "piola/materials/registry.hpp"
#include <array>
#include <cmath>
#include <string>

namespace piola {

/// A law that advances blocks of points, through the interface piola_material.h: one of Piola or of a user's library.
class BlockLaw {
 public:
  static constexpr int most_parameters = MaterialParameters::max_values - 1;  ///< without the density
  /// Parameters, then the indices of the words of Piola's own laws (LawInfo::choices).
  static constexpr int most_values = most_parameters + MaterialParameters::max_words;
  static constexpr int most_history = 256;

  /// Finds the moduli at rest by small strains of a point at rest.
  explicit BlockLaw(MaterialParameters const& material);

  double rho0;       ///< reference density [kg/m^3]
  double kappa = 0;  ///< bulk modulus at rest [Pa]; of anisotropic laws from the stiffest direction
  double mu = 0;     ///< shear modulus at rest [Pa]; of the stiffest plane
  double p_wave_speed() const { return std::sqrt((kappa + 4 * mu / 3) / rho0); }  ///< at rest [m/s]
  double s_wave_speed() const { return std::sqrt(mu / rho0); }                    ///< at rest [m/s]

  bool elastic() const { return (law_->properties & PIOLA_ELASTIC) != 0; }
  bool yields() const { return (law_->properties & PIOLA_YIELDS) != 0; }
  bool corotated() const { return law_->stress == PIOLA_COROTATED_CAUCHY; }
  int history_count() const { return law_->history_count; }
  /// Number of the value of this name; -1: the law has none.
  int history_index(std::string_view name) const;
  piola_material const& description() const { return *law_; }

  /// Sets the history of a point at the start of a run.
  void start(double* history) const;
  /// Advances the points; sets density and parameters. Returns what the law returns: 0, or why not.
  int update(piola_points& points) const;
  /// Stress at a stretch U = I + e from rest, dt = 0, with an internal energy `heat` [J/kg]: xx yy zz xy yz xz of the
  /// Cauchy stress [Pa].
  std::array<double, 6> stress_at(std::array<double, 6> const& e, double heat = 0) const;

 private:
  piola_material const* law_;
  std::array<double, most_values> parameters_{};
};

/// Whether the law of the material works on blocks of points.
inline bool is_block_law(MaterialParameters const& material) { return law_of(material).block != nullptr; }

/// Calls f(BlockLaw) for a material of such a law; does nothing for others.
template <class F>
void with_block_law(MaterialParameters const& material, F const& f) {
  if (is_block_law(material)) f(BlockLaw(material));
}

/// Reason why the parameters of a block law cannot be used together: the law refuses them, or its moduli at rest are
/// not positive numbers; empty: they can.
std::string problem_of_block_law(MaterialParameters const& material);

/// Name of the law whose library code this thread runs now; nullptr: none. For the handler of a crash.
char const* running_block_law();

}  // namespace piola
