// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/observe.hpp"
#include "piola/materials/laws.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace piola::nodal {
namespace {

using Point = std::array<double, 3>;

enum CellValue { energy, mean_J, least_J };

double cell(NodalBody const& body, Index i, CellValue what) {
  return NodalBody::value(body.state().cell, i, static_cast<int>(what));
}

Mat<3> first_piola(NodalBody const& body, Index i) {
  Mat<3> P;
  for (int c = 0; c < 9; ++c) P.c[c] = NodalBody::value(body.state().P, i, c);
  return P;
}

/// (1/J) P F^T of the mean stress and the gradient at the centroid [Pa].
Mat<3> cauchy(Mat<3> const& P, Mat<3> const& F) { return (1.0 / determinant(F)) * (P * transpose(F)); }

/// Of the cell, positive in tension [Pa]: of its mean volume ratio where the law has a volumetric part.
double cell_pressure(NodalBody const& body, Index i) {
  double p = 0;
  with_law(body.state().material, [&](auto const& law) {
    if (std::decay_t<decltype(law)>::volumetric_split && !body.state().constants.stress_free)
      p = law.kappa * (cell(body, i, mean_J) - 1);
    else
      p = trace(cauchy(first_piola(body, i), body.F(i))) / 3;
  });
  return p;
}

std::vector<double> cell_pressures(NodalBody const& body) {
  std::vector<double> p(static_cast<std::size_t>(body.particles()));
  for (Index i = 0; i < body.particles(); ++i) p[static_cast<std::size_t>(i)] = cell_pressure(body, i);
  return p;
}

/// From slots to ids, counted from the body's first.
std::vector<double> by_id(NodalBody const& body, std::vector<double> const& by_slot) {
  std::vector<double> values(by_slot.size());
  for (Index i = 0; i < body.particles(); ++i)
    values[static_cast<std::size_t>(body.id(i) - body.body().first)] = by_slot[static_cast<std::size_t>(i)];
  return values;
}

}  // namespace

void observe(NodalBody const& body, NodalObservation& o) {
  bool const first = !(o.volume > 0);
  o.open_body(body.body().name);
  auto const of_cells = cell_pressures(body), smooth = body.smoothing()(of_cells);
  for (Index i = 0; i < body.particles(); ++i) {
    double const V = body.volume(i), p = smooth[static_cast<std::size_t>(i)], least = cell(body, i, least_J);
    o.add_strain_energy(V * cell(body, i, energy));
    o.least_jacobian = first && i == 0 ? least : std::min(o.least_jacobian, least);
    o.add_state(cell(body, i, mean_J), p, V);
    o.add_motion(body.x(i), body.v(i), body.mass(i));
    o.of_cells.add_state(cell(body, i, mean_J), of_cells[static_cast<std::size_t>(i)], V);
  }
  o.totals.damping_loss += body.damping_loss();
  o.totals.stabilisation_loss += body.viscous_loss();
  o.totals.external_work += body.boundary().external_work();
  o.add_oscillation(body.set(), body.body(), by_id(body, smooth));
  o.of_cells.add_oscillation(body.set(), body.body(), by_id(body, of_cells));
}

Diagnostics finish(NodalObservation const& o) {
  Diagnostics d = o.finish();
  d.more = {{"least_jacobian", o.least_jacobian},
            {"repeated_steps", o.repeated_steps},
            {"cell_pressure_oscillation", o.of_cells.finish().pressure_oscillation}};
  return d;
}

namespace {

/// Everything an output formula may need of one particle.
struct Particle {
  Point X, x, v;
  Mat<3> F, P;
  double J, least_J, pressure, cell_pressure, mass, volume, body, neighbours, id;
};

void put_symmetric(Mat<3> const& s, double* out) {
  for (int k = 0; k < 6; ++k) {
    int const row = k < 3 ? k : k == 4 ? 1 : 0, column = k < 3 ? k : k == 3 ? 1 : 2;
    out[k] = 0.5 * (s(row, column) + s(column, row));
  }
}

double von_mises(Mat<3> const& s) {
  SymMat<3> d;
  put_symmetric(s, d.c);
  double const p = trace(s) / 3;
  double sum = 0;
  for (int c = 0; c < 6; ++c) sum += c < 3 ? (d.c[c] - p) * (d.c[c] - p) : 2 * d.c[c] * d.c[c];
  return std::sqrt(1.5 * sum);
}

struct Observed {
  char const* name;
  char const* unit;
  int components;
  void (*put)(Particle const&, double*);
};

constexpr std::array table{
    Observed{"Displacement", "m", 3,
             [](Particle const& p, double* out) {
               for (std::size_t c = 0; c < 3; ++c) out[c] = p.x[c] - p.X[c];
             }},
    Observed{"Position", "m", 3, [](Particle const& p, double* out) { std::copy(p.x.begin(), p.x.end(), out); }},
    Observed{"Velocity", "m/s", 3, [](Particle const& p, double* out) { std::copy(p.v.begin(), p.v.end(), out); }},
    Observed{"Momentum", "kg/(m2 s)", 3,
             [](Particle const& p, double* out) {
               for (std::size_t c = 0; c < 3; ++c) out[c] = p.mass / p.volume * p.v[c];
             }},
    Observed{"Pressure", "Pa", 1, [](Particle const& p, double* out) { *out = p.pressure; }},
    Observed{"CellPressure", "Pa", 1, [](Particle const& p, double* out) { *out = p.cell_pressure; }},
    Observed{"CauchyStress", "Pa", 6, [](Particle const& p, double* out) { put_symmetric(cauchy(p.P, p.F), out); }},
    Observed{"FirstPiolaStress", "Pa", 9, [](Particle const& p, double* out) { std::copy(p.P.c, p.P.c + 9, out); }},
    Observed{"DeformationGradient", "1", 9, [](Particle const& p, double* out) { std::copy(p.F.c, p.F.c + 9, out); }},
    Observed{"Jacobian", "1", 1, [](Particle const& p, double* out) { *out = p.J; }},
    Observed{"LeastJacobian", "1", 1, [](Particle const& p, double* out) { *out = p.least_J; }},
    Observed{"VonMisesStress", "Pa", 1, [](Particle const& p, double* out) { *out = von_mises(cauchy(p.P, p.F)); }},
    Observed{"Density", "kg/m3", 1, [](Particle const& p, double* out) { *out = p.mass / p.volume / p.J; }},
    Observed{"Neighbours", "1", 1, [](Particle const& p, double* out) { *out = p.neighbours; }},
    Observed{"Body", "1", 1, [](Particle const& p, double* out) { *out = p.body; }},
    Observed{"Id", "1", 1, [](Particle const& p, double* out) { *out = p.id; }}};

}  // namespace

std::vector<FieldInfo> observed_fields() {
  std::vector<FieldInfo> r;
  r.reserve(std::size(table));
  for (auto const& f : table) r.push_back({f.name, f.unit, f.components});
  return r;
}

void sample(NodalBody const& body, int body_number, std::string_view field, std::span<double> values) {
  auto const found = std::find_if(table.begin(), table.end(), [&](Observed const& f) { return field == f.name; });
  if (found == table.end()) throw std::invalid_argument("no field is named '" + std::string(field) + "'");
  std::vector<double> smooth(static_cast<std::size_t>(body.particles()), 0);
  if (field == "Pressure") smooth = body.smoothing()(cell_pressures(body));
  for (Index i = 0; i < body.particles(); ++i) {
    Particle const p{body.X(i),
                     body.x(i),
                     body.v(i),
                     body.F(i),
                     first_piola(body, i),
                     cell(body, i, mean_J),
                     cell(body, i, least_J),
                     smooth[static_cast<std::size_t>(i)],
                     cell_pressure(body, i),
                     body.state().constants.rho0 * body.volume(i),
                     body.volume(i),
                     static_cast<double>(body_number),
                     static_cast<double>(body.reference().neighbours(i)),
                     static_cast<double>(body.id(i))};
    found->put(p, &values[static_cast<std::size_t>(body.id(i) * found->components)]);
  }
}

}  // namespace piola::nodal
