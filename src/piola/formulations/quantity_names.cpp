// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/quantity_names.hpp"
#include <algorithm>
#include <array>

namespace piola {
namespace {

struct FieldWord {
  std::string_view word, field, unit;
  int components;
};

constexpr std::array fields{
    FieldWord{"position", "Position", "m", 3},
    FieldWord{"displacement", "Displacement", "m", 3},
    FieldWord{"velocity", "Velocity", "m/s", 3},
    FieldWord{"momentum", "Momentum", "kg/m^2/s", 3},
    FieldWord{"pressure", "Pressure", "Pa", 1},
    FieldWord{"jacobian", "Jacobian", "1", 1},
    FieldWord{"von_mises_stress", "VonMisesStress", "Pa", 1},
    FieldWord{"cauchy_stress", "CauchyStress", "Pa", 6},
    FieldWord{"first_piola_stress", "FirstPiolaStress", "Pa", 9},
    FieldWord{"deformation_gradient", "DeformationGradient", "1", 9},
    FieldWord{"equivalent_plastic_strain", "EquivalentPlasticStrain", "1", 1},
    FieldWord{"plastic_strain", "EquivalentPlasticStrain", "1", 1},  // the same in short
    FieldWord{"damage", "Damage", "1", 1},
    FieldWord{"temperature", "Temperature", "K", 1},
    FieldWord{"density", "Density", "kg/m^3", 1},
    FieldWord{"specific_energy", "InternalEnergy", "J/kg", 1},
    FieldWord{"kernel_type", "KernelType", "1", 1},
};

constexpr std::array<std::string_view, 3> vector_suffix{"_x", "_y", "_z"};
constexpr std::array<std::string_view, 6> symmetric_suffix{"_xx", "_yy", "_zz", "_xy", "_yz", "_xz"};
constexpr std::array<std::string_view, 9> tensor_suffix{"_xx", "_xy", "_xz", "_yx", "_yy", "_yz", "_zx", "_zy", "_zz"};

std::string_view suffix(int components, int c) {
  auto const i = static_cast<std::size_t>(c);
  if (components == 3) return vector_suffix[i];
  if (components == 6) return symmetric_suffix[i];
  if (components == 9) return tensor_suffix[i];
  return "";
}

std::vector<FieldQuantity> make_table() {
  std::vector<FieldQuantity> table;
  for (FieldWord const& f : fields) {
    for (int c = 0; c < f.components; ++c) {
      table.push_back(
          {std::string(f.word) + std::string(suffix(f.components, c)), std::string(f.field), c, std::string(f.unit)});
    }
    if (f.components == 3) {
      table.push_back(
          {std::string(f.word) + "_magnitude", std::string(f.field), FieldQuantity::magnitude, std::string(f.unit)});
    }
  }
  return table;
}

}  // namespace

std::vector<FieldQuantity> const& all_quantities() {
  static std::vector<FieldQuantity> const table = make_table();
  return table;
}

std::optional<FieldQuantity> find_quantity(std::string_view name) {
  auto const& table = all_quantities();
  auto const found = std::find_if(table.begin(), table.end(), [&](FieldQuantity const& q) { return q.name == name; });
  if (found == table.end()) return std::nullopt;
  return *found;
}

}  // namespace piola
