// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/conduction.hpp"
#include "piola/domain/halo.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/scaled_body.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

/// Largest part of the difference to its neighbours that a temperature may lose in a part of a step.
constexpr double most_change = 0.5;

/// Deformation gradient of a cell as its last step left it, mean over its points.
Mat<3> mean_gradient(FieldRef const& history, Index i, int D) {
  int const points = Fields::points(D);
  Mat<3> F = identity<3>();
  for (int c = 0; c < D * D; ++c) F(c / D, c % D) = 0;
  if (D == 2) F(2, 2) = 0;
  for (int q = 0; q < points; ++q) {
    int const at = HistoryLayout::point(q, D) + HistoryLayout::F;
    for (int c = 0; c < D * D; ++c) F(c / D, c % D) += value_at(history, i, at + c) / points;
    if (D == 2) F(2, 2) += value_at(history, i, at + D * D) / points;
  }
  return F;
}

double mean_temperature(FieldRef const& history, Index i, int D) {
  int const points = Fields::points(D);
  double sum = 0;
  for (int q = 0; q < points; ++q)
    sum += value_at(history, i, HistoryLayout::point(q, D) + HistoryLayout::temperature) / points;
  return sum;
}

}  // namespace

/// Local slots of a material.
Range Conduction::own_of(MaterialRange const& range) const {
  Index const first = std::max(range.first, body_.own().first);
  return {first, std::max(first, std::min(range.last, body_.own().last))};
}

/// k J C^-1 = k cof F^T cof F / J of the local cells; 0 of those that have failed.
void Conduction::put_conductivities() {
  BodyState& s = body_.state();
  for (MaterialRange const& range : body_.materials()) {
    double const k = heat_of(range.material).conductivity;
    exec_host::parallel_for(own_of(range), [&](Index i) {
      Mat<3> const F = mean_gradient(s.history, i, dimension_), H = cofactor(F);
      double const J = determinant(F);
      bool const intact = J > 0 && (!s.has.failure || body_.condition(i) < CellCondition::broken);
      Mat<3> const K = transpose(H) * H;
      SymMat<3> of_cell;
      for (int a = 0; a < 3; ++a)
        for (int b = a; b < 3; ++b) of_cell(a, b) = intact ? k * K(a, b) / J : 0;
      for (int c = 0; c < 6; ++c) value_at(s.heat, i, At::conductivity + c) = of_cell.c[c];
    });
  }
}

/// Temperatures of the local cells; then ghosts get all of the field `heat`. Collective.
void Conduction::put_temperatures() {
  BodyState& s = body_.state();
  exec_host::parallel_for(
      body_.own(), [&](Index i) { value_at(s.heat, i, At::temperature) = mean_temperature(s.history, i, dimension_); });
  Halo{s.halo}.refresh(s.heat);
}

/// Conductivity of a cell along a direction [W/(m K)].
double Conduction::along(std::array<double, 3> const& n, Index i) const {
  SymMat<3> K;
  for (int c = 0; c < 6; ++c) K.c[c] = value_at(body_.state().heat, i, At::conductivity + c);
  double sum = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) sum += n[static_cast<std::size_t>(a)] * K(a, b) * n[static_cast<std::size_t>(b)];
  return sum;
}

/// Finds the conductances of the facets, with the harmonic mean of the conductivities of their cells along the line
/// between the particles. Returns the largest sum of a cell over its heat capacity [1/s]. Collective.
double Conduction::find_conductances() {
  FacetList const& facets = body_.reference().facets;
  std::vector<double> rate(facets.begin.size() - 1);
  for (MaterialRange const& range : body_.materials()) {
    double const capacity = range.constants.rho0 * heat_of(range.material).specific_heat;
    exec_host::parallel_for(own_of(range), [&](Index i) {
      auto const at = static_cast<std::size_t>(i - body_.own().first);
      double sum = 0;
      for (std::size_t k = facets.begin[at]; k < facets.begin[at + 1]; ++k) {
        CellNeighbour const& other = facets.neighbour[k];
        double const mine = along(other.direction, i), its = along(other.direction, other.slot);
        conductance_[k] = mine > 0 && its > 0 ? other.area_over_distance * 2 * mine * its / (mine + its) : 0;
        sum += conductance_[k];
      }
      rate[at] = sum / (capacity * value_at(body_.state().V, i));
    });
  }
  double most = rate.empty() ? 0 : *std::max_element(rate.begin(), rate.end());
  if (body_.shared()) comm::allreduce_max(most);
  return most;
}

/// Sums over the facets of a cell have the same order on any number of ranks.
void Conduction::conduct(double dt) {
  BodyState& s = body_.state();
  FacetList const& facets = body_.reference().facets;
  for (MaterialRange const& range : body_.materials()) {
    Heat const heat = heat_of(range.material);
    if (!(heat.conductivity > 0)) continue;
    exec_host::parallel_for(own_of(range), [&](Index i) {
      auto const at = static_cast<std::size_t>(i - body_.own().first);
      double power = 0;
      for (std::size_t k = facets.begin[at]; k < facets.begin[at + 1]; ++k)
        power += conductance_[k] *
                 (value_at(s.heat, facets.neighbour[k].slot, At::temperature) - value_at(s.heat, i, At::temperature));
      double const warmer = dt * power / (range.constants.rho0 * heat.specific_heat * value_at(s.V, i));
      value_at(s.history, i, HistoryLayout::energy) += heat.specific_heat * warmer;
      for (int q = 0; q < Fields::points(dimension_); ++q)
        value_at(s.history, i, HistoryLayout::point(q, dimension_) + HistoryLayout::temperature) += warmer;
    });
  }
}

void Conduction::advance(double dt) {
  put_conductivities();
  put_temperatures();
  double const parts = std::max(1.0, std::ceil(dt * find_conductances() / most_change));
  for (double part = 0; part < parts; ++part) {
    if (part > 0) put_temperatures();
    conduct(dt / parts);
  }
}

FacetList conducting_facets(SetUp const& from, ScaledBody const& scaled) {
  Range const own{from.own_slots().first, std::min(from.own_slots().last, from.order.particles)};
  ItemsOfParticles const of(static_cast<std::size_t>(from.order.particles), [&](auto const& add) {
    for (std::size_t f = 0; f < scaled.facets.size(); ++f)
      for (Index const a : {scaled.facets[f].a, scaled.facets[f].b})
        if (a >= own.first && a < own.last) add(a, f);
  });
  FacetList list;
  list.begin.push_back(0);
  for (Index i = own.first; i < own.last; ++i) {
    for (std::size_t const f : of.of(static_cast<std::size_t>(i))) {
      CellFacet const& facet = scaled.facets[f];
      double const sign = facet.a == i ? 1 : -1;
      Index const other = facet.a == i ? facet.b : facet.a;
      CellNeighbour to{from.source_of(other), 0, {}};
      double square = 0, flux = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        double const scaled_distance =
            scaled.X[static_cast<std::size_t>(other)][c] - scaled.X[static_cast<std::size_t>(i)][c];
        to.direction[c] = scaled.h[c] * scaled_distance;
        square += to.direction[c] * to.direction[c];
        flux += sign * facet.moments[c][0] * scaled_distance;
      }
      for (double& d : to.direction) d /= std::sqrt(square);
      to.area_over_distance = scaled.h_volume * flux / square;
      if (to.slot != i && to.area_over_distance > 0) list.neighbour.push_back(to);
    }
    list.begin.push_back(list.neighbour.size());
  }
  return list;
}

}  // namespace piola::nodal
