// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/observed.hpp"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace piola {
namespace {

using P = ObservedParticle;

void put_momentum(P const& p, double* out) {
  for (std::size_t c = 0; c < 3; ++c) out[c] = p.inertia * p.v[c];
}

void put_von_mises(P const& p, double* out) {
  auto const& s = p.cauchy.c;
  double const mean = (s[0] + s[1] + s[2]) / 3;
  double sum = 0;
  for (int c = 0; c < 6; ++c) sum += c < 3 ? (s[c] - mean) * (s[c] - mean) : 2 * s[c] * s[c];
  *out = std::sqrt(1.5 * sum);
}

constexpr void (*not_stored)(P const&, double*) = nullptr;

/// Adding a field: a line here and its value where a formulation fills an ObservedParticle.
constexpr std::array table{
    ObservedField{"position", "Position", "m", 3, [](P const& p, double* out) { std::copy_n(p.x.begin(), 3, out); }},
    ObservedField{"displacement", "Displacement", "m", 3,
                  [](P const& p, double* out) { std::copy_n(p.displacement.begin(), 3, out); }},
    ObservedField{"velocity", "Velocity", "m/s", 3, [](P const& p, double* out) { std::copy_n(p.v.begin(), 3, out); }},
    ObservedField{"momentum", "Momentum", "kg/m^2/s", 3, &put_momentum},
    ObservedField{"pressure", "Pressure", "Pa", 1, [](P const& p, double* out) { *out = p.pressure; }},
    ObservedField{"jacobian", "Jacobian", "1", 1, [](P const& p, double* out) { *out = p.J; }},
    ObservedField{"von_mises_stress", "VonMisesStress", "Pa", 1, &put_von_mises},
    ObservedField{"cauchy_stress", "CauchyStress", "Pa", 6,
                  [](P const& p, double* out) { std::copy_n(p.cauchy.c, 6, out); }},
    ObservedField{"first_piola_stress", "FirstPiolaStress", "Pa", 9,
                  [](P const& p, double* out) { std::copy_n(p.P.c, 9, out); }},
    ObservedField{"deformation_gradient", "DeformationGradient", "1", 9,
                  [](P const& p, double* out) { std::copy_n(p.F.c, 9, out); }},
    ObservedField{"equivalent_plastic_strain", "EquivalentPlasticStrain", "1", 1,
                  [](P const& p, double* out) { *out = p.plastic_strain; }},
    ObservedField{"plastic_strain", "EquivalentPlasticStrain", "1", 1, not_stored},  // the same in short
    ObservedField{"damage", "Damage", "1", 1, [](P const& p, double* out) { *out = p.damage; }},
    ObservedField{"temperature", "Temperature", "K", 1, [](P const& p, double* out) { *out = p.temperature; }},
    ObservedField{"density", "Density", "kg/m^3", 1, [](P const& p, double* out) { *out = p.density; }},
    ObservedField{"specific_energy", "InternalEnergy", "J/kg", 1,
                  [](P const& p, double* out) { *out = p.specific_energy; }},
    ObservedField{"kernel_type", "KernelType", "1", 1, [](P const& p, double* out) { *out = p.kernel_type; }},
    ObservedField{"cell_pressure", "CellPressure", "Pa", 1, [](P const& p, double* out) { *out = p.cell_pressure; }},
    ObservedField{"least_jacobian", "LeastJacobian", "1", 1, [](P const& p, double* out) { *out = p.least_J; }},
    ObservedField{"compressive_pressure", "CompressivePressure", "Pa", 1, not_stored},
    ObservedField{"principal_stress", "PrincipalStress", "Pa", 3, not_stored},
    ObservedField{"principal_strain", "PrincipalStrain", "1", 3, not_stored},
    ObservedField{"parting", "Parting", "1", 1, [](P const& p, double* out) { *out = p.parting; }},
    ObservedField{"contact_pressure", "ContactPressure", "Pa", 1,
                  [](P const& p, double* out) { *out = p.contact_pressure; }},
    ObservedField{"contact_gap", "ContactGap", "m", 1, [](P const& p, double* out) { *out = p.contact_gap; }},
    ObservedField{"slip", "Slip", "m", 1, [](P const& p, double* out) { *out = p.slip; }},
    ObservedField{"friction_heat", "FrictionHeat", "J/m^2", 1, [](P const& p, double* out) { *out = p.friction_heat; }},
    ObservedField{"", "Neighbours", "1", 1, [](P const& p, double* out) { *out = p.neighbours; }},
    ObservedField{"", "Body", "1", 1, [](P const& p, double* out) { *out = p.body; }},
    ObservedField{"", "Id", "1", 1, [](P const& p, double* out) { *out = p.id; }}};

}  // namespace

std::span<ObservedField const> observed_table() { return table; }

ObservedField const& find_observed(std::string_view name, std::span<std::string_view const> offered) {
  auto const found = std::find_if(table.begin(), table.end(), [&](auto const& f) { return f.name == name; });
  if (found == table.end() || std::find(offered.begin(), offered.end(), name) == offered.end())
    throw std::invalid_argument("no field is named '" + std::string(name) + "'");
  return *found;
}

std::vector<FieldInfo> field_infos(std::span<std::string_view const> offered) {
  std::vector<FieldInfo> infos;
  for (std::string_view const name : offered) {
    ObservedField const& f = find_observed(name, offered);
    infos.push_back({std::string(f.name), std::string(f.unit), f.components});
  }
  return infos;
}

SymMat<3> cauchy_stress(Mat<3> const& P, Mat<3> const& F, double J) {
  Mat<3> const s = (1.0 / J) * (P * transpose(F));
  SymMat<3> r;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) r(i, j) = 0.5 * (s(i, j) + s(j, i));
  return r;
}

}  // namespace piola
