// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/field_signs.hpp"
#include <algorithm>

namespace piola {
namespace {

/// The sign convention of a field, and of which of its components.
struct FieldSign {
  std::string_view field, sign;
  std::span<int const> components;
};
constexpr std::array<int, 1> scalar{whole_field};
constexpr std::array<int, 3> normal_of_symmetric{0, 1, 2}, normal_of_tensor{0, 4, 8};
constexpr std::array signs{FieldSign{"Pressure", "tension positive", scalar},
                           FieldSign{"CellPressure", "tension positive", scalar},
                           FieldSign{"CompressivePressure", "compression positive", scalar},
                           FieldSign{"ContactPressure", "compression positive", scalar},
                           FieldSign{"ContactGap", "overlap negative", scalar},
                           FieldSign{"CauchyStress", "tension positive", normal_of_symmetric},
                           FieldSign{"PrincipalStress", "tension positive", normal_of_symmetric},
                           FieldSign{"PrincipalStrain", "extension positive", normal_of_symmetric},
                           FieldSign{"FirstPiolaStress", "tension positive", normal_of_tensor}};

}  // namespace

std::string_view sign_of(std::string_view field, int component) {
  auto const found = std::find_if(signs.begin(), signs.end(), [&](FieldSign const& s) { return s.field == field; });
  if (found == signs.end()) return {};
  auto const& of = found->components;
  int const asked = of.size() == 1 ? whole_field : component;  // a scalar's only component has no name
  return std::find(of.begin(), of.end(), asked) != of.end() ? found->sign : std::string_view{};
}

std::optional<std::array<double, 2>> whole_range(std::string_view field) {
  if (field == "Damage" || field == "KernelType") return std::array{0.0, 1.0};
  return std::nullopt;
}

}  // namespace piola
