// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// One value per particle for probes: a component of a field, or the magnitude of a vector.
struct FieldQuantity {
  std::string name;   ///< as in a case file, e.g. "velocity_x"
  std::string field;  ///< VTK style field name, e.g. "Velocity"
  int component = 0;  ///< index into the field's components; `magnitude` for the length of a vector
  std::string unit;   ///< SI, UDUNITS notation
  static constexpr int magnitude = -1;
};

/// Returns the field component of a quantity name; empty if the name is unknown. "position_x", "_y", "_z" have the
/// field "Position", i.e. X + Displacement, which callers compute.
std::optional<FieldQuantity> find_quantity(std::string_view name);

/// All quantity names, for suggestions and the manual.
std::vector<FieldQuantity> const& all_quantities();

/// A field computed from another one, independent of the formulation.
struct DerivedField {
  std::string_view name, from;
  std::string_view unit;
  void (*put)(double const* from, double* out);  ///< one particle
};
/// "PrincipalStress" [Pa]: eigenvalues of the Cauchy stress. "PrincipalStrain": principal logarithmic (Hencky) strains
/// ln(lambda), with the principal stretches lambda of the deformation gradient; in plane strain one of them is zero.
/// Both in falling order. "CompressivePressure" [Pa]: -Pressure. Computed by derived_fields.hpp.
std::span<DerivedField const> derived_fields();
bool is_derived(std::string_view field);

/// A number of history.csv that belongs to a named part of the case, as NAME.word.
struct PartQuantity {
  std::string_view word;
  std::string_view unit;  ///< SI, UDUNITS notation
};

/// Force and moment on the bodies, in the order of Action, of each support, rigid shape and named load.
std::span<PartQuantity const> action_quantities();
/// Quantities of each free or rotating rigid shape, in the order of RigidState.
std::span<PartQuantity const> rigid_quantities();
/// Quantities of each body of a case with several bodies, in the order of BodyDiagnostics.
std::span<PartQuantity const> body_quantities();

/// Names of the components of a field with `components` of them: x y z, xx yy zz xy yz xz, or xx xy xz yx ...; empty
/// for a scalar.
std::span<std::string_view const> component_words(int components);

/// Returns the component that a word names, in small or capital letters; for three components also "1", "2", "3"
/// (principal values). whole_field for "" and, for a vector, "magnitude". Empty if the field has no such component.
inline constexpr int whole_field = -1;
std::optional<int> find_component(std::string_view word, int components);

}  // namespace piola
