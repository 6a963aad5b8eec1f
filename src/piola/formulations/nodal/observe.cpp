// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/observe.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/sum_over_slots.hpp"
#include "piola/formulations/common/output_fields.hpp"
#include "piola/formulations/common/sample_local.hpp"
#include "piola/materials/finite_increment.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <array>

namespace piola::nodal {
namespace {

enum CellValue { energy, mean_J, least_J };

double cell(NodalBody const& body, Index i, CellValue what) {
  return NodalBody::value(body.state().cell, i, static_cast<int>(what));
}

Mat<3> first_piola(NodalBody const& body, Index i) {
  Mat<3> P;
  for (int c = 0; c < 9; ++c) P.c[c] = NodalBody::value(body.state().P, i, c);
  return P;
}

/// Pressure of the cell, positive in tension [Pa]: at its mean volume ratio if the law has a volumetric part.
double cell_pressure(NodalBody const& body, Index i) {
  if (is_hypoelastic(body.material(i).material))
    return -NodalBody::value(body.state().history, i, HistoryLayout::pressure);
  double modulus = 0;
  with_law(body.material(i).material, [&](auto const& law) {
    if (std::decay_t<decltype(law)>::volumetric_split && !body.state().constants.stress_free) modulus = law.kappa;
  });
  if (modulus > 0) return modulus * (cell(body, i, mean_J) - 1);
  Mat<3> const F = body.F(i);
  SymMat<3> const s = cauchy_stress(first_piola(body, i), F, determinant(F));
  return (s.c[0] + s.c[1] + s.c[2]) / 3;
}

/// Per slot, of the particles of this rank.
LazyZeroArray<double> cell_pressures(NodalBody const& body) {
  LazyZeroArray<double> p(static_cast<std::size_t>(body.slots()));
  for (Index i = body.own().first; i < body.own().last; ++i) p[static_cast<std::size_t>(i)] = cell_pressure(body, i);
  return p;
}

void add_oscillation(NodalBody const& body, LazyZeroArray<double> const& by_slot, DiagnosticsSum& o) {
  LatticeLineHalo* const lines = body.lattice_line_halo();
  std::vector<double> by_id(lines != nullptr ? 0 : static_cast<std::size_t>(body.particles()));
  for (Index i = body.own().first; i < body.own().last; ++i)
    (lines != nullptr ? lines->pressure(i) : by_id[static_cast<std::size_t>(body.id(i) - body.body().first)]) =
        by_slot[static_cast<std::size_t>(i)];
  if (lines != nullptr)
    lines->add_oscillation(o);
  else
    o.add_oscillation(body.set(), body.body(), by_id);
}

void add_failure(NodalBody const& body, Index i, NodalDiagnosticsSum& o) {
  FailureConstants const& law = body.material(i).failure;
  double const V = body.volume(i), failed = body.is_broken(i) ? 1 : 0;
  std::array const numbers{failed, V * body.failure_value(i, FailureLayout::fracture_energy),
                           law.strength < unbounded ? failed * V / law.band : 0, body.is_eulerian(i) ? 1.0 : 0.0};
  o.failure.add(numbers.data());
}

}  // namespace

void add_diagnostics(NodalBody const& body, NodalDiagnosticsSum& o) {
  o.begin_body(body.body().name);
  o.axisymmetric = body.set().axisymmetric;
  auto const of_cells = cell_pressures(body), smooth = body.smoothing()(of_cells);
  exec::ReproducibleSums<1> strain;
  for (Index i = body.own().first; i < body.own().last; ++i) {
    double const V = body.volume(i), p = smooth[static_cast<std::size_t>(i)], least = cell(body, i, least_J),
                 of_cell = V * cell(body, i, energy), plastic = V * body.mean_of_points(i, HistoryLayout::plastic_work);
    strain.add(&of_cell);
    o.plastic_work.add(&plastic);
    if (body.state().has.failure) add_failure(body, i, o);
    o.least_jacobian = std::min(o.least_jacobian, least);
    // The volume ratio of a broken cell that follows its gradients is the width of its crack.
    double const J = body.is_broken(i) && !body.is_eulerian(i) ? 1 : cell(body, i, mean_J);
    o.add_state(J, p, V);
    o.add_motion(body.x(i), body.v(i), body.mass(i));
    o.of_cells.add_state(J, of_cells[static_cast<std::size_t>(i)], V);
  }
  if (body.shared()) comm::allreduce_sum(strain);
  o.add_strain_energy(strain.value() + body.fragment_energy());
  o.totals.damping_loss += body.damping_loss();
  o.totals.stabilisation_loss += body.viscous_loss();
  o.totals.external_work += body.boundary().external_work().over_ranks();
  o.radiated_energy += body.boundary().radiated_energy();
  add_oscillation(body, smooth, o);
  add_oscillation(body, of_cells, o.of_cells);
}

Diagnostics finish(NodalDiagnosticsSum o) {
  if (comm::is_parallel()) {
    o.share();
    o.of_cells.share();
    comm::allreduce_sum(o.plastic_work);
    comm::allreduce_sum(o.failure);
    double below = -o.least_jacobian;
    comm::allreduce_max(below);
    o.least_jacobian = -below;
  }
  Diagnostics d = o.finish();
  d.more = {{"cell_jacobian_min", o.least_jacobian},
            {"repeated_steps", o.repeated_steps},
            {"cell_pressure_oscillation", o.of_cells.finish().pressure_oscillation},
            {"plastic_work", o.plastic_work.value(0)},
            {"internal_energy", d.strain_energy},
            {"failed_particles", o.failure.value(0)},
            {"fracture_energy", o.failure.value(1)},
            {"crack_area", o.failure.value(2)},
            {"eulerian_particles", o.failure.value(3)},
            {"radiated_energy", o.radiated_energy}};
  return d;
}

namespace {

constexpr std::array<std::string_view, 21> offered{"Displacement",
                                                   "Position",
                                                   "Velocity",
                                                   "Momentum",
                                                   "Pressure",
                                                   "CellPressure",
                                                   "CauchyStress",
                                                   "FirstPiolaStress",
                                                   "DeformationGradient",
                                                   "Jacobian",
                                                   "CellJacobianMin",
                                                   "VonMisesStress",
                                                   "Density",
                                                   "Neighbours",
                                                   "Body",
                                                   "Id",
                                                   "EquivalentPlasticStrain",
                                                   "Damage",
                                                   "Temperature",
                                                   "InternalEnergy",
                                                   "KernelType"};
/// The others belong to solids in rate form, and the last one to bodies whose cells become Eulerian.
constexpr std::size_t of_every_law = 16, of_solids = 20;

void add_history(NodalBody const& body, Index i, ParticleOutput& p) {
  p.plastic_strain = body.mean_of_points(i, HistoryLayout::plastic_strain);
  p.damage = std::max(body.mean_of_points(i, HistoryLayout::damage), body.failure_value(i, FailureLayout::softening));
  p.temperature = body.mean_of_points(i, HistoryLayout::temperature);
  p.specific_energy = NodalBody::value(body.state().history, i, HistoryLayout::energy);
}

}  // namespace

std::vector<FieldInfo> output_field_names(bool solids, bool converts) {
  return field_infos(std::span(offered).first(converts ? offered.size() : solids ? of_solids : of_every_law));
}

void add_fields_of_laws(NodalBody const& body, std::vector<FieldInfo>& fields) {
  for (MaterialRange const& range : body.materials())
    for (int h = 0; range.block != nullptr && h < range.block->history_count(); ++h) {
      piola_history const& value = range.block->description().history[h];
      if (std::none_of(fields.begin(), fields.end(), [&](FieldInfo const& f) { return f.name == value.name; }))
        fields.push_back({value.name, value.unit, 1});
    }
}

namespace {

/// Mean over the points of a cell of a history value of a law on blocks of points; 0 if it has none of this name.
double law_value(NodalBody const& body, Index i, std::string_view name) {
  BlockLaw const* const law = body.material(i).block;
  int const h = law == nullptr ? -1 : law->history_index(name);
  if (h < 0) return 0;
  using At = BlockLawLayout;
  int const D = body.state().dimension, points = Fields::points(D);
  double sum = 0;
  for (int q = 0; q < points; ++q)
    sum += NodalBody::value(body.state().history, i, At::point(q, D, law->history_count()) + At::history(D) + h);
  return sum / points;
}

/// The field of this name: a history value of a law on blocks of points, else one that the formulation offers. A body
/// whose laws have no such value shows zero.
OutputField field_of(NodalBody const& body, std::string_view name) {
  bool kept = std::find(offered.begin(), offered.end(), name) == offered.end();
  for (MaterialRange const& range : body.materials())
    kept = kept || (range.block != nullptr && range.block->history_index(name) >= 0);
  if (!kept) return find_output_field(name, offered);
  return {"", name, "", 1, [](ParticleOutput const& p, double* out) { *out = p.law_value; }};
}

/// f(slot, particle) of the particles of this rank.
template <class F>
void observe_each(NodalBody const& body, int body_number, std::string_view field, LazyZeroArray<double> const& smooth,
                  F const& f) {
  for (Index i = body.own().first; i < body.own().last; ++i) {
    ParticleOutput p;
    p.id = static_cast<double>(body.id(i));
    p.body = body_number;
    p.neighbours = body.reference().neighbours(i);
    p.x = body.x(i);
    p.v = body.v(i);
    auto const X = body.X(i);
    for (std::size_t c = 0; c < 3; ++c) p.displacement[c] = p.x[c] - X[c];
    p.F = body.F(i);
    p.P = first_piola(body, i);
    p.J = cell(body, i, mean_J);
    p.cauchy = cauchy_stress(p.P, p.F, body.is_eulerian(i) ? p.J : determinant(p.F));
    p.least_J = cell(body, i, least_J);
    p.pressure = smooth.empty() ? 0 : smooth[static_cast<std::size_t>(i)];
    p.cell_pressure = cell_pressure(body, i);
    p.inertia = body.material(i).constants.rho0;
    p.density = p.inertia / p.J;
    p.kernel_type = body.is_eulerian(i) ? 1 : 0;
    if (is_hypoelastic(body.material(i).material)) add_history(body, i, p);
    p.law_value = law_value(body, i, field);
    f(i, p);
  }
}

/// Smooths the pressure of the cells if a field needs it. Collective if the body is distributed.
LazyZeroArray<double> smooth_pressure(NodalBody const& body, std::string_view field) {
  return field == "Pressure" ? body.smoothing()(cell_pressures(body)) : LazyZeroArray<double>{};
}

}  // namespace

void sample_on_root(NodalBody const& body, int body_number, std::string_view field, std::span<double> values) {
  PIOLA_EXPECTS(body_number >= 0);
  LazyZeroArray<double> const smooth = smooth_pressure(body, field);
  gather_field_on_root(body, field_of(body, field), values,
                       [&](auto const& f) { observe_each(body, body_number, field, smooth, f); });
}

void sample_local_slots(NodalBody const& body, int body_number, std::string_view field, std::span<double> values) {
  LazyZeroArray<double> const smooth = smooth_pressure(body, field);
  piola::sample_local_slots(body, field_of(body, field), values,
                            [&](auto const& f) { observe_each(body, body_number, field, smooth, f); });
}

double NodalBody::kinetic_energy() const {
  return sum_over_slots(shared(), own(), [&](Index i) { return kinetic_energy_of(i); });
}

double NodalBody::kinetic_energy_of(Index slot) const {
  auto const v = this->v(slot);
  return 0.5 * mass(slot) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double NodalBody::strain_energy() const {
  return sum_over_slots(shared(), own(), [&](Index i) { return volume(i) * value(state_.cell, i, 0); });
}

double NodalBody::viscous_loss() const {
  if (!state_.has.viscosity) return 0;
  int const loss = Fields::viscous_values(state_.dimension) - 1;
  return sum_over_slots(shared(), own(), [&](Index i) { return volume(i) * value(state_.viscous, i, loss); });
}

double NodalBody::mean_of_points(Index slot, int number) const {
  int const D = state_.dimension, points = state_.has.solids ? Fields::points(D) : 0;
  double sum = 0;
  for (int q = 0; q < points; ++q) sum += value(state_.history, slot, HistoryLayout::point(q, D) + number) / points;
  return sum;
}

Mat<3> NodalBody::F(Index slot) const {
  Mat<3> r = identity<3>();
  if (is_eulerian(slot)) return r;
  int const D = state_.dimension;
  for (int c = 0; c < D * D; ++c) r(c / D, c % D) = value(state_.F, slot, c);
  for (int c = D; c < 3; ++c) r(c, c) = value(state_.cell, slot, 3);
  return r;
}

Smoothing const& NodalBody::smoothing() const {
  if (!smoothing_) smoothing_.emplace(reference_, state_.dimension, own(), halo_ ? &halo_->plan : nullptr);
  return *smoothing_;
}

}  // namespace piola::nodal
