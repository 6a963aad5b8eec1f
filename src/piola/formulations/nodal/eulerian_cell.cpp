// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/eulerian_cell.hpp"
#include "piola/formulations/nodal/field_set_up.hpp"
#include "piola/materials/finite_increment.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>

namespace piola::nodal {
namespace {

constexpr int pressure_iterations = 3;
/// Damage from which a cell softens.
constexpr double least_damage = 0.999;

/// Values of a point that Eulerian cells have.
constexpr int shared_values[]{
    HistoryLayout::S,      HistoryLayout::S + 1,       HistoryLayout::S + 2,          HistoryLayout::S + 3,
    HistoryLayout::S + 4,  HistoryLayout::S + 5,       HistoryLayout::plastic_strain, HistoryLayout::temperature,
    HistoryLayout::damage, HistoryLayout::plastic_work};

double& point_value(BodyState const& body, Index slot, int q, int c) {
  return value_at(body.history, slot, HistoryLayout::point(q, body.dimension) + c);
}
double& failure_value(BodyState const& body, Index slot, int of) {
  return value_at(body.history, slot, Fields::failure_value(of, body.dimension));
}

double contract(SymMat<3> const& sigma, Mat<3> const& A) {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += sigma(i, j) * A(i, j);
  return sum;
}

}  // namespace

double volume_ratio_at(BodyState const& body, Index slot) {
  int const D = body.dimension, points = Fields::points(D);
  double sum = 0;
  for (int q = 0; q < points; ++q) {
    Mat<3> F = identity<3>();
    for (int c = 0; c < D * D; ++c) F(c / D, c % D) = point_value(body, slot, q, HistoryLayout::F + c);
    if (D == 2) F(2, 2) = point_value(body, slot, q, HistoryLayout::F + 4);
    sum += determinant(F) / points;
  }
  return sum * failure_value(body, slot, FailureLayout::volume_factor);
}

EulerianCell eulerian_cell_at(BodyState const& body, Index slot, double V0) {
  EulerianCell cell;
  cell.V0 = V0;
  cell.J = failure_value(body, slot, FailureLayout::volume_factor);
  cell.pressure = value_at(body.history, slot, HistoryLayout::pressure);
  cell.energy = value_at(body.history, slot, HistoryLayout::energy);
  cell.softening = failure_value(body, slot, FailureLayout::softening);
  auto const value = [&](int c) { return point_value(body, slot, 0, c); };
  SolidHistory& h = cell.history;
  for (int c = 0; c < 6; ++c) h.S.c[c] = value(HistoryLayout::S + c);
  h.plastic_strain = value(HistoryLayout::plastic_strain);
  h.temperature = value(HistoryLayout::temperature);
  h.damage = value(HistoryLayout::damage);
  h.plastic_work = value(HistoryLayout::plastic_work);
  h.toughness = failure_value(body, slot, FailureLayout::toughness);
  return cell;
}

void store(EulerianCell const& cell, BodyState const& body, Index slot) {
  failure_value(body, slot, FailureLayout::volume_factor) = cell.J;
  failure_value(body, slot, FailureLayout::softening) = cell.softening;
  value_at(body.history, slot, HistoryLayout::pressure) = cell.pressure;
  value_at(body.history, slot, HistoryLayout::energy) = cell.energy;
  SolidHistory const& h = cell.history;
  for (int q = 0; q < Fields::points(body.dimension); ++q) {
    auto const put = [&](int c, double now) { point_value(body, slot, q, c) = now; };
    for (int c = 0; c < 6; ++c) put(HistoryLayout::S + c, h.S.c[c]);
    put(HistoryLayout::plastic_strain, h.plastic_strain);
    put(HistoryLayout::temperature, h.temperature);
    put(HistoryLayout::damage, h.damage);
    put(HistoryLayout::plastic_work, h.plastic_work);
  }
}

void make_eulerian(BodyState const& body, Index slot, double J) {
  int const points = Fields::points(body.dimension);
  for (int const c : shared_values) {
    double mean = 0;
    for (int q = 0; q < points; ++q) mean += point_value(body, slot, q, c) / points;
    for (int q = 0; q < points; ++q) point_value(body, slot, q, c) = mean;
  }
  for (int q = 0; q < points; ++q) point_value(body, slot, q, HistoryLayout::spread) = 0;
  failure_value(body, slot, FailureLayout::volume_factor) = J;
  failure_value(body, slot, FailureLayout::refitted) = 0;
  value_at(body.history, slot, HistoryLayout::shock_pressure) = 0;
  put_reference_shape(body.history, slot, body.dimension);
}

void advance(EulerianCell& cell, MaterialRange const& range, EulerianStep const& step) {
  with_solid(range.material, [&](auto const& law) {
    double const mass = law.rho0 * cell.V0;
    double work = step.viscous_work + 0.5 * cell.volume() * contract(cell.stress(), step.before);
    cell.J = step.J;
    double const rho = law.rho0 / cell.J;
    if (cell.softening < 1) {
      Mat<3> const I = identity<3>();
      SymMat<3> const trial = trial_deviator(cell.history.S, law.mu, I, I + step.strain);
      law.update(cell.history, trial, law.pressure(cell.history, rho, cell.energy), rho, step.dt);
      if (range.failure.damages && cell.history.damage > least_damage)
        cell.softening = std::min(1.0, cell.softening + range.failure.per_time * step.dt);
    }
    if (!(cell.softening < 1)) cell.history.S = {};
    cell.pressure = 0;
    work += 0.5 * cell.volume() * contract(cell.stress(), step.after);
    double const per_pressure = 0.5 * cell.volume() * trace(step.after) / mass, without = cell.energy + work / mass;
    for (int k = 0; k < pressure_iterations; ++k) {
      double const p = law.pressure(cell.history, rho, without - per_pressure * cell.pressure);
      cell.pressure = p < 0 ? (1 - cell.softening) * p : p;
    }
    cell.energy = without - per_pressure * cell.pressure;
  });
}

double sound_speed_of(EulerianCell const& cell, MaterialRange const& range) {
  double c = 0;
  with_solid(range.material, [&](auto const& law) { c = law.sound_speed(law.rho0 / cell.J, cell.energy); });
  return c;
}

}  // namespace piola::nodal
