// SPDX-License-Identifier: Apache-2.0
#include "piola/input/history_names.hpp"
#include <array>

namespace piola {
namespace {

constexpr std::array columns{
    HistoryName{"time", "s"},
    HistoryName{"step", "1"},
    HistoryName{"dt", "s"},
    HistoryName{"kinetic_energy", "J"},
    HistoryName{"strain_energy", "J"},
    HistoryName{"total_energy", "J"},
    HistoryName{"stabilisation_loss", "J"},
    HistoryName{"external_work", "J"},
    HistoryName{"linear_momentum_x", "kg m/s"},
    HistoryName{"linear_momentum_y", "kg m/s"},
    HistoryName{"linear_momentum_z", "kg m/s"},
    HistoryName{"angular_momentum_x", "kg m^2/s"},
    HistoryName{"angular_momentum_y", "kg m^2/s"},
    HistoryName{"angular_momentum_z", "kg m^2/s"},
    HistoryName{"jacobian_min", "1"},
    HistoryName{"jacobian_max", "1"},
    HistoryName{"pressure_min", "Pa"},
    HistoryName{"pressure_max", "Pa"},
    HistoryName{"pressure_oscillation", "1"},
    HistoryName{"projection_loss", "J"},
    HistoryName{"damping_loss", "J"},
};

constexpr std::array fields{
    FieldName{"Displacement", "m", 3},
    FieldName{"Velocity", "m/s", 3},
    FieldName{"Momentum", "kg/m^2/s", 3},
    FieldName{"Pressure", "Pa", 1},
    FieldName{"CauchyStress", "Pa", 6},
    FieldName{"FirstPiolaStress", "Pa", 9},
    FieldName{"DeformationGradient", "1", 9},
    FieldName{"Jacobian", "1", 1},
    FieldName{"VonMisesStress", "Pa", 1},
    FieldName{"Density", "kg/m^3", 1},
    FieldName{"Damage", "1", 1},
    FieldName{"EquivalentPlasticStrain", "1", 1},
    FieldName{"Temperature", "K", 1},
    FieldName{"InternalEnergy", "J/kg", 1},
    FieldName{"KernelType", "1", 1},
    FieldName{"CellPressure", "Pa", 1},
    FieldName{"CellJacobianMin", "1", 1},
    FieldName{"ContactPressure", "Pa", 1},
    FieldName{"ContactGap", "m", 1},
    FieldName{"Slip", "m", 1},
    FieldName{"FrictionHeat", "J/m^2", 1},
    FieldName{"Neighbours", "1", 1},
    FieldName{"CompressivePressure", "Pa", 1},
    FieldName{"PrincipalStress", "Pa", 3},
    FieldName{"PrincipalStrain", "1", 3},
    FieldName{"Body", "1", 1},
    FieldName{"Id", "1", 1},
};

}  // namespace

std::span<HistoryName const> history_names() { return columns; }
std::span<FieldName const> field_names() { return fields; }

}  // namespace piola
