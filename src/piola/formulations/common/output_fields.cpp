// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/output_fields.hpp"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace piola {
namespace {

using P = ParticleOutput;

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

/// Adding a field: a line here and its value where a formulation fills an ParticleOutput.
constexpr std::array table{
    OutputField{"position", "Position", "m", 3, [](P const& p, double* out) { std::copy_n(p.x.begin(), 3, out); }},
    OutputField{"displacement", "Displacement", "m", 3,
                [](P const& p, double* out) { std::copy_n(p.displacement.begin(), 3, out); }},
    OutputField{"velocity", "Velocity", "m/s", 3, [](P const& p, double* out) { std::copy_n(p.v.begin(), 3, out); }},
    OutputField{"momentum", "Momentum", "kg/m^2/s", 3, &put_momentum},
    OutputField{"pressure", "Pressure", "Pa", 1, [](P const& p, double* out) { *out = p.pressure; }},
    OutputField{"jacobian", "Jacobian", "1", 1, [](P const& p, double* out) { *out = p.J; }},
    OutputField{"von_mises_stress", "VonMisesStress", "Pa", 1, &put_von_mises},
    OutputField{"cauchy_stress", "CauchyStress", "Pa", 6,
                [](P const& p, double* out) { std::copy_n(p.cauchy.c, 6, out); }},
    OutputField{"first_piola_stress", "FirstPiolaStress", "Pa", 9,
                [](P const& p, double* out) { std::copy_n(p.P.c, 9, out); }},
    OutputField{"deformation_gradient", "DeformationGradient", "1", 9,
                [](P const& p, double* out) { std::copy_n(p.F.c, 9, out); }},
    OutputField{"equivalent_plastic_strain", "EquivalentPlasticStrain", "1", 1,
                [](P const& p, double* out) { *out = p.plastic_strain; }},
    OutputField{"plastic_strain", "EquivalentPlasticStrain", "1", 1, not_stored},  // the same in short
    OutputField{"damage", "Damage", "1", 1, [](P const& p, double* out) { *out = p.damage; }},
    OutputField{"temperature", "Temperature", "K", 1, [](P const& p, double* out) { *out = p.temperature; }},
    OutputField{"density", "Density", "kg/m^3", 1, [](P const& p, double* out) { *out = p.density; }},
    OutputField{"specific_energy", "InternalEnergy", "J/kg", 1,
                [](P const& p, double* out) { *out = p.specific_energy; }},
    OutputField{"kernel_type", "KernelType", "1", 1, [](P const& p, double* out) { *out = p.kernel_type; }},
    OutputField{"cell_pressure", "CellPressure", "Pa", 1, [](P const& p, double* out) { *out = p.cell_pressure; }},
    OutputField{"cell_jacobian_min", "CellJacobianMin", "1", 1, [](P const& p, double* out) { *out = p.least_J; }},
    OutputField{"compressive_pressure", "CompressivePressure", "Pa", 1, not_stored},
    OutputField{"principal_stress", "PrincipalStress", "Pa", 3, not_stored},
    OutputField{"principal_strain", "PrincipalStrain", "1", 3, not_stored},
    OutputField{"strain_drift", "StrainDrift", "1", 1, [](P const& p, double* out) { *out = p.strain_drift; }},
    OutputField{"contact_pressure", "ContactPressure", "Pa", 1,
                [](P const& p, double* out) { *out = p.contact_pressure; }},
    OutputField{"contact_gap", "ContactGap", "m", 1, [](P const& p, double* out) { *out = p.contact_gap; }},
    OutputField{"slip", "Slip", "m", 1, [](P const& p, double* out) { *out = p.slip; }},
    OutputField{"friction_heat", "FrictionHeat", "J/m^2", 1, [](P const& p, double* out) { *out = p.friction_heat; }},
    OutputField{"", "Neighbours", "1", 1, [](P const& p, double* out) { *out = p.neighbours; }},
    OutputField{"", "Body", "1", 1, [](P const& p, double* out) { *out = p.body; }},
    OutputField{"", "Id", "1", 1, [](P const& p, double* out) { *out = p.id; }}};

}  // namespace

std::span<OutputField const> output_field_table() { return table; }

OutputField const& find_output_field(std::string_view name, std::span<std::string_view const> offered) {
  auto const found = std::find_if(table.begin(), table.end(), [&](auto const& f) { return f.name == name; });
  if (found == table.end() || std::find(offered.begin(), offered.end(), name) == offered.end())
    throw std::invalid_argument("no field is named '" + std::string(name) + "'");
  return *found;
}

std::vector<FieldInfo> field_infos(std::span<std::string_view const> offered) {
  std::vector<FieldInfo> infos;
  for (std::string_view const name : offered) {
    OutputField const& f = find_output_field(name, offered);
    infos.push_back({std::string(f.name), std::string(f.unit), f.components});
  }
  return infos;
}

}  // namespace piola
