// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/facet_fluxes.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/hoop_stretch.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace piola::nodal {
namespace {

/// Largest admissible entry on the diagonal of the inverse of the normal equations: 116 in a lattice, 720 with jitter.
constexpr double worst_condition = 1e4;
/// Beside cracks, where a linear fit is the alternative, and of that.
constexpr double worst_beside_cracks = 1000, worst_linear = 10;
/// Added to the squared distance from the middle of a facet in the weights: particles that share a facet dominate.
constexpr double core = 0.05;

/// Cholesky factorisation of the normal equations of a fit.
template <int N>
class NormalEquations {
 public:
  using Row = std::array<double, static_cast<std::size_t>(N)>;

  void add(double weight, Row const& p) {
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j <= i; ++j) A_[i][j] += weight * p[i] * p[j];
  }
  /// Returns the largest entry on the diagonal of the inverse; infinite if there is none.
  double factorise() {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double rest = A_[i][j];
        for (std::size_t k = 0; k < j; ++k) rest -= A_[i][k] * A_[j][k];
        if (i == j && !(rest > 0)) return infinite;
        A_[i][j] = i == j ? std::sqrt(rest) : rest / A_[j][j];
      }
    double worst = 0;
    for (std::size_t column = 0; column < N; ++column) {
      Row unit{};
      unit[column] = 1;
      double square = 0;
      for (double const x : forwards(unit)) square += x * x;
      worst = std::max(worst, square);
    }
    return worst;
  }
  Row solve(Row const& right) const {
    Row x = forwards(right);
    for (std::size_t i = N; i-- > 0;) {
      for (std::size_t k = i + 1; k < N; ++k) x[i] -= A_[k][i] * x[k];
      x[i] /= A_[i][i];
    }
    return x;
  }

 private:
  Row forwards(Row x) const {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t k = 0; k < i; ++k) x[i] -= A_[i][k] * x[k];
      x[i] /= A_[i][i];
    }
    return x;
  }
  double A_[N][N]{};
};

/// The moments of a facet that D dimensions have, in the order of monomials().
template <int D>
std::array<double, static_cast<std::size_t>(Quadratic<D>::values)> of_dimension(std::array<double, 10> const& m) {
  std::array<double, static_cast<std::size_t>(Quadratic<D>::values)> r{};
  for (std::size_t c = 0; c <= D; ++c) r[c] = m[c];
  for (int n = 0; n < Quadratic<D>::second; ++n) r[std::size_t{1 + D} + n] = m[4 + moment_of_second<D>(n)];
  return r;
}

template <int D>
std::array<double, static_cast<std::size_t>(Quadratic<D>::values)> monomials_at(std::array<double, 3> const& X) {
  Vec<D> r;
  for (int c = 0; c < D; ++c) r[c] = X[static_cast<std::size_t>(c)];
  double p[Quadratic<D>::values];
  monomials<D>(r, p);
  std::array<double, static_cast<std::size_t>(Quadratic<D>::values)> result;
  std::copy_n(p, result.size(), result.begin());
  return result;
}

}  // namespace

template <int D>
FacetFluxes<D>::FacetFluxes(LocalFits<D>& fits, ScaledBody const& body, CrackLines const* cracks)
    : fits_(fits),
      body_(body),
      cracks_(cracks),
      facets_(fits.X().size(),
              [&](auto const& f) {
                for (std::size_t k = 0; k < body.facets.size(); ++k) {
                  f(body.facets[k].a, k);
                  f(body.facets[k].b, k);
                }
              }),
      patches_(fits.X().size(), [&](auto const& f) {
        for (std::size_t k = 0; k < body.patches.size(); ++k) f(body.patches[k].particle, k);
      }) {
  std::vector<char> good;
  do {
    if (fits_.unsolvable() >= 0) return;
    good.assign(fits_.X().size(), 1);
    flux_.assign(fits_.pairs().neighbour.size() * D, 0);
    exec_host::parallel_for(fits_.rows().size(), [&](Index row) {
      std::size_t const a = fits_.rows()[row];
      if (fits_.representative(a) == a) good[a] = fill_row(a) ? 1 : 0;
    });
  } while (!fits_.refine(good));
}

template <int D>
bool FacetFluxes<D>::fill_row(std::size_t a) {
  auto const candidates = candidates_of(a);
  bool good = true;
  for (std::size_t const k : facets_.of(a)) good = add_facet(a, body_.facets[k], candidates) && good;
  for (std::size_t const k : patches_.of(a)) add_surface(body_.patches[k]);
  each_hoop_share(a, [&](std::size_t k, double share) {
    if (k != itself) flux_[k * D] -= share;
  });
  return good;
}

/// In increasing order, so that both cells of a facet add the same numbers in the same order.
template <int D>
std::vector<typename FacetFluxes<D>::Candidate> FacetFluxes<D>::candidates_of(std::size_t a) const {
  auto const& pairs = fits_.pairs();
  std::vector<Candidate> all;
  all.reserve(pairs.end(a) - pairs.first(a) + 1);
  for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
    if (pairs.at(k) > a && (k == pairs.first(a) || pairs.at(k - 1) < a)) all.push_back({a, itself});
    all.push_back({pairs.at(k), k});
  }
  if (all.size() == pairs.end(a) - pairs.first(a)) all.push_back({a, itself});
  return all;
}

/// Adds the fluxes of the field that is fitted to the members on a facet. Returns whether they determine one well.
template <int D>
template <int N>
bool FacetFluxes<D>::add_members(CellFacet const& facet, double sign, std::vector<Member<N>> const& members,
                                 double worst) {
  NormalEquations<N> equations;
  for (Member<N> const& member : members) equations.add(member.weight, member.p);
  if (members.size() < static_cast<std::size_t>(N) || !(equations.factorise() < worst)) return false;
  for (std::size_t J = 0; J < D; ++J) {
    auto const moments = of_dimension<D>(facet.moments[J]);
    std::array<double, static_cast<std::size_t>(N)> of_field;
    std::copy_n(moments.begin(), of_field.size(), of_field.begin());
    auto const y = equations.solve(of_field);
    for (Member<N> const& member : members) {
      if (member.k == itself) continue;  // rows sum to zero
      double value = 0;
      for (std::size_t m = 0; m < y.size(); ++m) value += y[m] * member.p[m];
      flux_[member.k * D + J] += sign * member.weight * value;
    }
  }
  return true;
}

/// The candidates of a cell that the cell and `other`, on the other side of a facet, see.
template <int D>
std::vector<typename FacetFluxes<D>::template Member<FacetFluxes<D>::values>> FacetFluxes<D>::members_of(
    std::size_t other, CellFacet const& facet, std::vector<Candidate> const& candidates) const {
  auto const low = static_cast<std::size_t>(facet.a), high = static_cast<std::size_t>(facet.b);
  // Particles that cracks hide from `other` have no weight in the fit of `other`, if this rank has that fit.
  std::optional<CrackLines::View> from_other;
  if (cracks_ != nullptr && !fits_.has(other)) from_other.emplace(*cracks_, other);
  auto const across = fits_.difference(low, high);
  std::vector<Member<values>> members;
  members.reserve(candidates.size());
  for (auto const& [c, k] : candidates) {
    bool const a_sees = k == itself || fits_.pairs().weight[k] > 0;
    if (!a_sees || !fits_.sees(other, c) || (from_other && from_other->hides(c))) continue;
    auto r = fits_.difference(low, c);
    double square = core;
    for (std::size_t i = 0; i < 3; ++i) {
      r[i] -= 0.5 * across[i];
      square += r[i] * r[i];
    }
    double const weight = fits_.nearness(low, c) * fits_.nearness(high, c) / square;
    members.push_back({k, weight, monomials_at<D>(r)});
  }
  return members;
}

template <int D>
bool FacetFluxes<D>::add_facet(std::size_t a, CellFacet const& facet, std::vector<Candidate> const& candidates) {
  auto const low = static_cast<std::size_t>(facet.a);
  std::size_t const other = a == low ? static_cast<std::size_t>(facet.b) : low;
  if (cracks_ != nullptr && cracks_->is_face(a, other)) {
    add_crack_face(a, facet);
    return true;
  }
  auto const members = members_of(other, facet, candidates);
  double const sign = a == low ? 1 : -1;
  bool const cracked = cracks_ != nullptr && cracks_->any();
  if (add_members<values>(facet, sign, members, cracked ? worst_beside_cracks : worst_condition)) return true;
  if (!cracked) return false;
  // Cracks leave too few for a quadratic: a linear field, or the mean of both particles.
  std::vector<Member<1 + D>> linear;
  std::vector<Member<1>> both;
  for (auto const& member : members) {
    linear.push_back({member.k, member.weight, {}});
    std::copy_n(member.p.begin(), 1 + D, linear.back().p.begin());
  }
  for (auto const& [c, k] : candidates)
    if (c == a || c == other) both.push_back({k, 1, {1}});
  if (!add_members<1 + D>(facet, sign, linear, worst_linear)) add_members<1>(facet, sign, both, worst_condition);
  return true;
}

/// Adds a facet to a cell that is not intact, where the field is that of the fit of a.
template <int D>
void FacetFluxes<D>::add_crack_face(std::size_t a, CellFacet const& facet) {
  bool const is_low = a == static_cast<std::size_t>(facet.a);
  auto middle = fits_.difference(static_cast<std::size_t>(facet.a), static_cast<std::size_t>(facet.b));
  for (double& c : middle) c *= is_low ? -0.5 : 0.5;  // from the middle to a
  for (std::size_t J = 0; J < D; ++J)
    each_share<D>(fits_, a, moments_about(facet.moments[J], middle), [&](std::size_t k, double share) {
      if (k != itself) flux_[k * D + J] += is_low ? share : -share;
    });
}

template <int D>
bool FacetFluxes<D>::refill(std::size_t a) {
  auto const row =
      std::span(flux_).subspan(fits_.pairs().first(a) * D, (fits_.pairs().end(a) - fits_.pairs().first(a)) * D);
  std::vector<double> const before(row.begin(), row.end());
  std::fill(row.begin(), row.end(), 0.0);
  if (cracks_->condition(a) != CellCondition::detached) fill_row(a);
  return !std::equal(row.begin(), row.end(), before.begin());
}

template <int D>
void FacetFluxes<D>::add_surface(SurfacePatch const& patch) {
  for (std::size_t J = 0; J < D; ++J)
    each_share<D>(fits_, static_cast<std::size_t>(patch.particle), patch.moments[J], [&](std::size_t k, double share) {
      if (k != itself) flux_[k * D + J] += share;
    });
}

template <int D>
template <class F>
void FacetFluxes<D>::each_hoop_share(std::size_t a, F const& f) const {
  if (!body_.sections.empty()) each_share<D>(fits_, a, integral_over_section(body_.sections[a]), f);
}

/// Largest error of the gradients of the quadratic monomials.
template <int D>
double FacetFluxes<D>::error_of_row(std::size_t a) const {
  auto const& pairs = fits_.pairs();
  auto const& cell = body_.cells[a];
  double worst = 0;
  for (int J = 0; J < D; ++J) {
    typename LocalFits<D>::Monomials sum{};
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      auto const p = fits_.monomials_of(a, pairs.at(k));
      double const G = flux(a, k, J) / cell.volume;
      for (std::size_t m = 0; m < p.size(); ++m) sum[m] += G * p[m];
    }
    sum[static_cast<std::size_t>(J)] -= 1;
    for (int K = 0; K < D; ++K)
      sum[std::size_t{D} + Quadratic<D>::at(J, K)] -= cell.centroid[static_cast<std::size_t>(K)];
    for (double const error : sum) comm::max_or_nan(std::abs(error), worst);
  }
  return worst;
}

template <int D>
GradientQuality FacetFluxes<D>::measure(SurfaceIntegrals<D> const& surface) const {
  auto const& pairs = fits_.pairs();
  auto left = surface.surface_vectors();
  LazyZeroArray<double> steepest(fits_.X().size()), rows(steepest.size());
  scatter_in_order(fits_.own(), fits_.rows(), pairs.farthest(), [&](std::size_t a, auto const& mine) {
    bool const own = mine(a);
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      bool const other = mine(pairs.at(k));
      if (!own && !other) continue;
      double square = 0;
      for (int J = 0; J < D; ++J) {
        double const G = flux(a, k, J);
        square += G * G;
        if (other) left[pairs.at(k) * D + static_cast<std::size_t>(J)] -= G;
        if (own) left[a * D + static_cast<std::size_t>(J)] += G;
      }
      if (own) steepest[a] = std::max(steepest[a], std::sqrt(square) / body_.cells[a].volume);
    }
    // The divergence has a hoop part, which the particle itself has a share of.
    each_hoop_share(a, [&](std::size_t k, double share) {
      if (std::size_t const b = particle_of_share<D>(fits_, a, k); mine(b)) left[b * D] -= share;
    });
    if (own && fits_.representative(a) == a) rows[a] = error_of_row(a);
  });
  GradientQuality found;
  for (Index i = fits_.own().first; i < std::min(fits_.own().last, static_cast<Index>(body_.particles)); ++i) {
    auto const b = static_cast<std::size_t>(i);
    double const face = body_.sections.empty() ? 1 : std::max(1.0, std::abs(body_.X[b][0]));  // of rings
    for (std::size_t J = 0; J < D; ++J) comm::max_or_nan(std::abs(left[b * D + J]) / face, found.divergence);
    comm::max_or_nan(rows[b], found.rows);
    comm::max_or_nan(steepest[b], found.steepest);
  }
  found.enlarged = fits_.enlarged();
  if (fits_.shared()) comm::allreduce_sum(found);
  return found;
}

template class FacetFluxes<1>;
template class FacetFluxes<2>;
template class FacetFluxes<3>;

}  // namespace piola::nodal
