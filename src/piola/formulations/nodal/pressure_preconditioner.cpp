// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/pressure_preconditioner.hpp"
#include "piola/base/contracts.hpp"
#include "piola/particles/body_extents.hpp"
#include <algorithm>
#include <numeric>

namespace piola::nodal {
namespace {

/// A factor is made if its rows have fewer entries than this on average. A solution with it then costs no more than a
/// sweep.
constexpr double longest_row = 800;
/// Smallest ratio, of tau to the tau of a factor or the inverse, for which the factor is kept.
constexpr double near_enough = 0.8;

/// Calls f(b, G_ab) for the neighbours b of a particle, with G in three dimensions. lanes: of a group on lattices.
template <class F>
void each_gradient(BodyState const& s, int lanes, Index a, F const& f) {
  int const D = s.dimension, numbers = D + Fields::second(D);
  std::array<double, 3> G{};
  auto const take = [&](double const* first, int stride) {
    for (int c = 0; c < D; ++c) G[static_cast<std::size_t>(c)] = first[c * stride];
    return G != std::array<double, 3>{};  // a lattice has zeros where there is no neighbour
  };
  if (s.lattice.group == nullptr) {
    for (std::int64_t k = s.list.begin[a]; k < s.list.begin[a + 1]; ++k)
      if (take(s.list.gradient + D * k, 1)) f(s.list.neighbour[k], G);
    return;
  }
  std::ptrdiff_t const size = std::ptrdiff_t{numbers} * lanes;
  double const* const first = s.lattice.motion + s.lattice.group[a / lanes] * s.lattice.offsets * size + a % lanes;
  for (int o = 0; o < s.lattice.offsets; ++o)
    if (take(first + o * size, lanes)) f(static_cast<Index>(a + s.lattice.offset[o]), G);
}

}  // namespace

PressurePreconditioner::PressurePreconditioner(NodalBody const& body, int lanes)
    : body_(body), cells_(static_cast<std::size_t>(body.particles())), sorted_(cells_.size()) {
  PIOLA_EXPECTS(!body.shared());
  read_gradients(lanes);
  hold();
  order_cells();
  take_envelope();
  diagonal_.assign(cells_.size(), 0);
  for (std::size_t b = 0; b < cells_.size(); ++b)
    for (Entry const& e : cells_[b])
      diagonal_[static_cast<std::size_t>(e.cell)] += product(e, e) / body.mass(static_cast<Index>(b));
}

void PressurePreconditioner::read_gradients(int lanes) {
  for (Index a = 0; a < body_.particles(); ++a) {
    Entry own{a, {}};
    each_gradient(body_.state(), lanes, a, [&](Index b, std::array<double, 3> const& G) {
      cells_[static_cast<std::size_t>(b)].push_back({a, G});
      for (std::size_t c = 0; c < 3; ++c) own.G[c] -= G[c];
    });
    cells_[static_cast<std::size_t>(a)].push_back(own);
  }
}

/// Removes what supports hold at the start.
void PressurePreconditioner::hold() {
  auto const& boundary = body_.state().boundary;
  for (Index n = 0; n < boundary.held_count; ++n) {
    PrescribedDirection const& h = boundary.held[n];
    for (Entry& e : cells_[static_cast<std::size_t>(h.slot)]) {
      double along = 0;
      for (std::size_t c = 0; c < 3; ++c) along += e.G[c] * h.direction[c];
      for (std::size_t c = 0; c < 3; ++c) e.G[c] -= along * h.direction[c];
    }
  }
}

void PressurePreconditioner::order_cells() {
  auto const [low, high, planes, tolerance] = extents_of(body_.set(), body_.body());
  std::size_t longest = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (high[c] - low[c] > high[longest] - low[longest]) longest = c;
  std::vector<Index> order(cells_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return body_.X(a)[longest] < body_.X(b)[longest]; });
  place_.resize(cells_.size());
  for (std::size_t k = 0; k < order.size(); ++k) place_[static_cast<std::size_t>(order[k])] = k;
}

/// Scalar product of two gradients for the same particle.
double PressurePreconditioner::product(Entry const& one, Entry const& other) {
  return one.G[0] * other.G[0] + one.G[1] * other.G[1] + one.G[2] * other.G[2];
}

/// Finds the first column of each row of the factor; none if the rows are too long.
void PressurePreconditioner::take_envelope() {
  first_.resize(cells_.size());
  std::iota(first_.begin(), first_.end(), std::size_t{0});
  for (auto const& seeing : cells_) {
    std::size_t least = cells_.size();
    for (Entry const& e : seeing) least = std::min(least, place_[static_cast<std::size_t>(e.cell)]);
    for (Entry const& e : seeing) {
      auto& row = first_[place_[static_cast<std::size_t>(e.cell)]];
      row = std::min(row, least);
    }
  }
  double entries = 0;
  for (std::size_t i = 0; i < first_.size(); ++i) entries += static_cast<double>(i + 1 - first_[i]);
  if (entries > longest_row * static_cast<double>(first_.size())) first_.clear();
}

void PressurePreconditioner::prepare(double tau) {
  PIOLA_EXPECTS(tau > 0);
  if (tau_ > 0 && tau >= near_enough * tau_ && near_enough * tau <= tau_) return;
  tau_ = tau;
  if (!first_.empty()) factorise();
}

void PressurePreconditioner::factorise() {
  factor_.emplace(first_);
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    double const per_mass = tau_ / body_.mass(static_cast<Index>(b));
    for (Entry const& one : cells_[b])
      for (Entry const& other : cells_[b]) {
        auto const i = place_[static_cast<std::size_t>(one.cell)], j = place_[static_cast<std::size_t>(other.cell)];
        if (i >= j)
          factor_->at(i, j) += per_mass * body_.volume(one.cell) * body_.volume(other.cell) * product(one, other);
      }
  }
  for (Index a = 0; a < body_.particles(); ++a) {
    std::size_t const i = place_[static_cast<std::size_t>(a)];
    factor_->at(i, i) += body_.volume(a) / body_.material(a).constants.kappa;
  }
  factor_->factorise();
}

std::size_t PressurePreconditioner::bytes() const {
  std::size_t total = factor_ ? factor_->bytes() : 0;
  for (auto const& seeing : cells_) total += seeing.size() * sizeof(Entry);
  return total + (first_.size() + place_.size() + diagonal_.size() + sorted_.size()) * sizeof(double);
}

void PressurePreconditioner::solve(std::vector<double> const& r, std::vector<double>& z) {
  PIOLA_EXPECTS(tau_ > 0 && r.size() == cells_.size());
  z.resize(r.size());
  for (std::size_t a = 0; a < r.size(); ++a) {
    auto const slot = static_cast<Index>(a);
    double const V = body_.volume(slot);
    if (factor_)
      sorted_[place_[a]] = V * r[a];
    else
      z[a] = r[a] / (1 / body_.material(slot).constants.kappa + tau_ * V * diagonal_[a]);
  }
  if (!factor_) return;
  factor_->solve(sorted_);
  for (std::size_t a = 0; a < r.size(); ++a) z[a] = sorted_[place_[a]];
}

}  // namespace piola::nodal
