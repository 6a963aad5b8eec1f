// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/quantity_names.hpp"
#include "piola/formulations/observed.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>

namespace piola {
namespace {

constexpr std::array actions{PartQuantity{"force_x", "N"},    PartQuantity{"force_y", "N"},
                             PartQuantity{"force_z", "N"},    PartQuantity{"moment_x", "N m"},
                             PartQuantity{"moment_y", "N m"}, PartQuantity{"moment_z", "N m"}};
constexpr std::array rigids{PartQuantity{"x", "m"},
                            PartQuantity{"y", "m"},
                            PartQuantity{"z", "m"},
                            PartQuantity{"velocity_x", "m/s"},
                            PartQuantity{"velocity_y", "m/s"},
                            PartQuantity{"velocity_z", "m/s"},
                            PartQuantity{"turn_x", "rad"},
                            PartQuantity{"turn_y", "rad"},
                            PartQuantity{"turn_z", "rad"},
                            PartQuantity{"angular_velocity_x", "rad/s"},
                            PartQuantity{"angular_velocity_y", "rad/s"},
                            PartQuantity{"angular_velocity_z", "rad/s"},
                            PartQuantity{"kinetic_energy", "J"},
                            PartQuantity{"rotational_energy", "J"}};
constexpr std::array bodies{PartQuantity{"kinetic_energy", "J"}, PartQuantity{"strain_energy", "J"},
                            PartQuantity{"linear_momentum_x", "kg m/s"}, PartQuantity{"linear_momentum_y", "kg m/s"},
                            PartQuantity{"linear_momentum_z", "kg m/s"}};

constexpr std::array<std::string_view, 3> of_vectors{"x", "y", "z"};
constexpr std::array<std::string_view, 6> of_symmetric{"xx", "yy", "zz", "xy", "yz", "xz"};
constexpr std::array<std::string_view, 9> of_tensors{"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
constexpr std::array<std::string_view, 3> of_principals{"1", "2", "3"};

std::string suffix(std::string_view word, int components, int c) {
  std::span<std::string_view const> words = component_words(components);
  if (word.starts_with("principal_")) words = of_principals;
  return words.empty() ? "" : "_" + std::string(words[static_cast<std::size_t>(c)]);
}

void put_falling(SymMat<3> const& A, double* out) {
  auto const e = symmetric_eigen(A);
  std::copy_n(e.value, 3, out);
  std::sort(out, out + 3, std::greater<>());
}

void put_principal_stress(double const* stress, double* out) {
  SymMat<3> s;
  std::copy_n(stress, 6, s.c);
  put_falling(s, out);
}

/// ln(lambda) = 1/2 ln of the eigenvalues of F^T F.
void put_principal_strain(double const* F, double* out) {
  SymMat<3> C{};
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      for (int k = 0; k < 3; ++k) C(i, j) += F[3 * k + i] * F[3 * k + j];
  put_falling(C, out);
  for (int c = 0; c < 3; ++c) out[c] = 0.5 * std::log(out[c]);
}

void put_negative(double const* value, double* out) { *out = 0 - *value; }  // no -0 of a pressure of zero

constexpr std::array derived{DerivedField{"PrincipalStress", "CauchyStress", "Pa", 3, &put_principal_stress},
                             DerivedField{"PrincipalStrain", "DeformationGradient", "1", 3, &put_principal_strain},
                             DerivedField{"CompressivePressure", "Pressure", "Pa", 1, &put_negative}};

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

std::vector<FieldQuantity> make_table() {
  std::vector<FieldQuantity> table;
  for (ObservedField const& f : observed_table()) {
    std::string const word(f.word), field(f.name), unit(f.unit);
    for (int c = 0; c < f.components && !word.empty(); ++c)
      table.push_back({word + suffix(f.word, f.components, c), field, c, unit});
    if (f.components == 3 && !word.starts_with("principal_"))
      table.push_back({word + "_magnitude", field, FieldQuantity::magnitude, unit});
  }
  return table;
}

}  // namespace

std::span<DerivedField const> derived_fields() { return derived; }
void DerivedField::put_all(std::span<double const> values, std::span<double> out) const {
  auto const width = static_cast<std::size_t>(components), count = out.size() / width;
  for (std::size_t i = 0; i < count; ++i) put(&values[i * (values.size() / count)], &out[i * width]);
}

DerivedField const* find_derived(std::string_view field) {
  auto const found = std::find_if(derived.begin(), derived.end(), [&](auto const& d) { return d.name == field; });
  return found == derived.end() ? nullptr : &*found;
}

std::string stored_field(std::string const& field, std::span<std::string const> in_frame) {
  auto const there = [&](std::string_view name) {
    return std::find(in_frame.begin(), in_frame.end(), name) != in_frame.end();
  };
  if (there(field)) return field;
  DerivedField const* const made = find_derived(field);
  return made != nullptr && there(made->from) ? std::string(made->from) : "";
}

std::span<PartQuantity const> action_quantities() { return actions; }
std::span<PartQuantity const> rigid_quantities() { return rigids; }
std::span<PartQuantity const> body_quantities() { return bodies; }

std::vector<FieldQuantity> const& all_quantities() {
  static std::vector<FieldQuantity> const table = make_table();
  return table;
}

std::span<std::string_view const> component_words(int components) {
  if (components == 3) return of_vectors;
  if (components == 6) return of_symmetric;
  if (components == 9) return of_tensors;
  return {};
}

std::optional<int> find_component(std::string_view word, int components) {
  if (word.empty() || (components == 3 && word == "magnitude")) return whole_field;
  auto const same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  auto const words = component_words(components);
  for (std::size_t c = 0; c < words.size(); ++c)
    if (std::equal(word.begin(), word.end(), words[c].begin(), words[c].end(), same)) return static_cast<int>(c);
  for (std::size_t c = 0; components == 3 && c < of_principals.size(); ++c)
    if (word == of_principals[c]) return static_cast<int>(c);
  return std::nullopt;
}

std::string_view sign_of(std::string_view field, int component) {
  auto const found = std::find_if(signs.begin(), signs.end(), [&](FieldSign const& s) { return s.field == field; });
  if (found == signs.end()) return {};
  auto const& of = found->components;
  int const asked = of.size() == 1 ? whole_field : component;  // a scalar's only component has no name
  return std::find(of.begin(), of.end(), asked) != of.end() ? found->sign : std::string_view{};
}

std::optional<FieldQuantity> find_quantity(std::string_view name) {
  auto const& table = all_quantities();
  auto const found = std::find_if(table.begin(), table.end(), [&](FieldQuantity const& q) { return q.name == name; });
  if (found == table.end()) return std::nullopt;
  return *found;
}

}  // namespace piola
