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

/// Largest change of a temperature in a part of a step, over its distance to those of the neighbours.
constexpr double most_change = 0.5;

/// Specific heat [J/(kg K)] and conductivity [W/(m K)] of a material; conductivity 0: heat does not flow.
struct HeatOf {
  double specific = unbounded, conductivity = 0;
  explicit HeatOf(MaterialParameters const& material) {
    with_solid(material, [&](auto const& law) {
      specific = law.heat().specific_heat;
      conductivity = law.heat().conductivity;
    });
  }
};

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

/// A facet of a cell: conductance [W/(m K) m^(D-2)] and temperature of the other cell over that of this one [K].
struct Conduction::Facet {
  double conductance, difference;
};

/// Local slots of a material.
Range Conduction::own_of(MaterialRange const& range) const {
  Index const first = std::max(range.first, body_.own().first);
  return {first, std::max(first, std::min(range.last, body_.own().last))};
}

/// Field `heat` of the local cells and their ghosts: temperature, and conductivity in the reference configuration k J
/// C^-1 = k cof F^T cof F / J.
void Conduction::put_heat() {
  BodyState& s = body_.state();
  for (MaterialRange const& range : body_.materials()) {
    HeatOf const heat(range.material);
    exec_host::parallel_for(own_of(range), [&](Index i) {
      Mat<3> const F = mean_gradient(s.history, i, dimension_), H = cofactor(F);
      double const J = determinant(F);
      bool const intact = J > 0 && (!s.has.failure || body_.condition(i) < CellCondition::broken);
      SymMat<3> K;
      for (int a = 0; a < 3; ++a)
        for (int b = a; b < 3; ++b) {
          double sum = 0;
          for (int c = 0; c < 3; ++c) sum += H(c, a) * H(c, b);
          K(a, b) = intact ? heat.conductivity * sum / J : 0;
        }
      value_at(s.heat, i, 0) = mean_temperature(s.history, i, dimension_);
      for (int c = 0; c < 6; ++c) value_at(s.heat, i, 1 + c) = K.c[c];
    });
  }
  Halo{s.halo}.refresh(s.heat);
}

/// Calls f(Facet) for the facets of a cell, in the same order on any number of ranks. The conductivity of a facet is
/// the harmonic mean of those of its cells along the line between the particles.
template <class F>
void Conduction::each_facet(Index slot, F const& f) const {
  FacetList const& facets = body_.reference().facets;
  FieldRef const& heat = body_.state().heat;
  auto const along = [&](Index i, std::array<double, 3> const& n) {
    SymMat<3> K;
    for (int c = 0; c < 6; ++c) K.c[c] = value_at(heat, i, 1 + c);
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) sum += n[static_cast<std::size_t>(a)] * K(a, b) * n[static_cast<std::size_t>(b)];
    return sum;
  };
  auto const at = static_cast<std::size_t>(slot - body_.own().first);
  for (std::size_t k = facets.begin[at]; k < facets.begin[at + 1]; ++k) {
    CellNeighbour const& other = facets.neighbour[k];
    double const mine = along(slot, other.direction), its = along(other.slot, other.direction);
    if (mine > 0 && its > 0)
      f(Facet{other.area_over_distance * 2 * mine * its / (mine + its),
              value_at(heat, other.slot, 0) - value_at(heat, slot, 0)});
  }
}

/// Largest sum of the conductances of a cell over its heat capacity [1/s]. Collective.
double Conduction::largest_rate() const {
  double most = 0;
  for (MaterialRange const& range : body_.materials()) {
    HeatOf const heat(range.material);
    Range const own = own_of(range);
    for (Index i = own.first; i < own.last; ++i) {
      double sum = 0;
      each_facet(i, [&](Facet const& facet) { sum += facet.conductance; });
      most = std::max(most, sum / (range.constants.rho0 * heat.specific * value_at(body_.state().V, i)));
    }
  }
  if (body_.shared()) comm::allreduce_max(most);
  return most;
}

void Conduction::conduct(double dt) {
  BodyState& s = body_.state();
  for (MaterialRange const& range : body_.materials()) {
    HeatOf const heat(range.material);
    if (!(heat.conductivity > 0)) continue;
    exec_host::parallel_for(own_of(range), [&](Index i) {
      double power = 0;
      each_facet(i, [&](Facet const& facet) { power += facet.conductance * facet.difference; });
      double const warmer = dt * power / (range.constants.rho0 * heat.specific * value_at(s.V, i));
      value_at(s.history, i, HistoryLayout::energy) += heat.specific * warmer;
      for (int q = 0; q < Fields::points(dimension_); ++q)
        value_at(s.history, i, HistoryLayout::point(q, dimension_) + HistoryLayout::temperature) += warmer;
    });
  }
}

void Conduction::advance(double dt) {
  put_heat();
  double const parts = std::max(1.0, std::ceil(dt * largest_rate() / most_change));
  for (double part = 0; part < parts; ++part) {
    if (part > 0) put_heat();
    conduct(dt / parts);
  }
}

FacetList conducting_facets(SetUp const& from, ScaledBody const& scaled) {
  Range const own{from.own_slots().first, std::min(from.own_slots().last, from.order.particles)};
  auto const source = [&](Index k) {
    return k < from.order.particles
               ? k
               : from.images->particles().source[static_cast<std::size_t>(k - from.order.particles)];
  };
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
      CellNeighbour to{source(other), 0, {}};
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
