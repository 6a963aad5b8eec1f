// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/quantity_names.hpp"
#include "piola/formulations/common/output_fields.hpp"
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
                            PartQuantity{"rotation_x", "rad"},
                            PartQuantity{"rotation_y", "rad"},
                            PartQuantity{"rotation_z", "rad"},
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

constexpr std::array derived{DerivedField{"PrincipalStress", "CauchyStress", "Pa", &put_principal_stress},
                             DerivedField{"PrincipalStrain", "DeformationGradient", "1", &put_principal_strain},
                             DerivedField{"CompressivePressure", "Pressure", "Pa", &put_negative}};

std::vector<FieldQuantity> make_table() {
  std::vector<FieldQuantity> table;
  for (OutputField const& f : output_field_table()) {
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
bool is_derived(std::string_view field) {
  return std::any_of(derived.begin(), derived.end(), [&](DerivedField const& d) { return d.name == field; });
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

std::optional<FieldQuantity> find_quantity(std::string_view name) {
  auto const& table = all_quantities();
  auto const found = std::find_if(table.begin(), table.end(), [&](FieldQuantity const& q) { return q.name == name; });
  if (found == table.end()) return std::nullopt;
  return *found;
}

}  // namespace piola
