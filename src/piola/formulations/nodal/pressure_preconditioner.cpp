// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/pressure_preconditioner.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <numeric>

namespace piola::nodal {
namespace {

/// A factor is made if a row has fewer entries than this, on average. Its solution then costs no more than a sweep.
constexpr double longest_row = 800;
/// A factor serves for tau from this fraction of its own to the inverse.
constexpr double near_enough = 0.8;

}  // namespace

PressurePreconditioner::PressurePreconditioner(NodalBody& body, int lanes)
    : body_(body), cells_(static_cast<std::size_t>(body.particles())), sorted_(cells_.size()) {
  PIOLA_EXPECTS(!body.shared());
  if (body.state().lattice.group != nullptr)
    read_lattice(body, lanes);
  else
    read_lists(body);
  hold(body);
  order_cells(body);
  diagonal_.assign(cells_.size(), 0);
  for (std::size_t b = 0; b < cells_.size(); ++b)
    for (Entry const& e : cells_[b])
      diagonal_[static_cast<std::size_t>(e.particle)] += product(e, e) / body.mass(static_cast<Index>(b));
}

void PressurePreconditioner::read_lists(NodalBody const& body) {
  auto const& list = body.state().list;
  int const D = body.state().dimension;
  for (Index a = 0; a < body.particles(); ++a) {
    Entry own{a, {}};
    for (std::int64_t k = list.begin[a]; k < list.begin[a + 1]; ++k) {
      Entry e{a, {}};
      for (int c = 0; c < D; ++c) {
        e.G[static_cast<std::size_t>(c)] = list.gradient[D * k + c];
        own.G[static_cast<std::size_t>(c)] -= e.G[static_cast<std::size_t>(c)];
      }
      cells_[static_cast<std::size_t>(list.neighbour[k])].push_back(e);
    }
    cells_[static_cast<std::size_t>(a)].push_back(own);
  }
}

void PressurePreconditioner::read_lattice(NodalBody const& body, int lanes) {
  LatticeTable const& table = body.state().lattice;
  int const D = body.state().dimension, numbers = D + Fields::second(D);
  for (Index a = 0; a < body.particles(); ++a) {
    Entry own{a, {}};
    double const* gradient = table.motion + static_cast<std::ptrdiff_t>(table.group[a / lanes]) * table.offsets *
                                                (static_cast<std::ptrdiff_t>(numbers) * lanes);
    for (int o = 0; o < table.offsets; ++o, gradient += numbers * lanes) {
      Entry e{a, {}};
      for (int c = 0; c < D; ++c) e.G[static_cast<std::size_t>(c)] = gradient[c * lanes + a % lanes];
      if (e.G == std::array<double, 3>{}) continue;
      for (std::size_t c = 0; c < 3; ++c) own.G[c] -= e.G[c];
      cells_[static_cast<std::size_t>(a + table.offset[o])].push_back(e);
    }
    cells_[static_cast<std::size_t>(a)].push_back(own);
  }
}

/// Removes what supports hold at the start.
void PressurePreconditioner::hold(NodalBody const& body) {
  auto const& boundary = body.state().boundary;
  for (Index n = 0; n < boundary.held_count; ++n) {
    PrescribedDirection const& h = boundary.held[n];
    for (Entry& e : cells_[static_cast<std::size_t>(h.slot)]) {
      double along = 0;
      for (std::size_t c = 0; c < 3; ++c) along += e.G[c] * h.direction[c];
      for (std::size_t c = 0; c < 3; ++c) e.G[c] -= along * h.direction[c];
    }
  }
}

void PressurePreconditioner::order_cells(NodalBody const& body) {
  std::array<double, 3> low = body.X(0), high = low;
  for (Index a = 0; a < body.particles(); ++a)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], body.X(a)[c]);
      high[c] = std::max(high[c], body.X(a)[c]);
    }
  std::size_t longest = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (high[c] - low[c] > high[longest] - low[longest]) longest = c;
  std::vector<Index> order(cells_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return body.X(a)[longest] < body.X(b)[longest]; });
  place_.resize(cells_.size());
  for (std::size_t k = 0; k < order.size(); ++k) place_[static_cast<std::size_t>(order[k])] = k;
}

/// Scalar product of two gradients for the same particle.
double PressurePreconditioner::product(Entry const& one, Entry const& other) const {
  return one.G[0] * other.G[0] + one.G[1] * other.G[1] + one.G[2] * other.G[2];
}

/// The first column of each row of the factor.
std::vector<std::size_t> PressurePreconditioner::envelope() const {
  std::vector<std::size_t> first(cells_.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (auto const& seeing : cells_) {
    std::size_t least = cells_.size();
    for (Entry const& e : seeing) least = std::min(least, place_[static_cast<std::size_t>(e.particle)]);
    for (Entry const& e : seeing) {
      auto& row = first[place_[static_cast<std::size_t>(e.particle)]];
      row = std::min(row, least);
    }
  }
  return first;
}

void PressurePreconditioner::prepare(double tau) {
  PIOLA_EXPECTS(tau > 0);
  if (tau_ > 0 && tau >= near_enough * tau_ && near_enough * tau <= tau_) return;
  tau_ = tau;
  if (slender_) factorise(tau);
}

void PressurePreconditioner::factorise(double tau) {
  if (!factor_) {
    auto first = envelope();
    double entries = 0;
    for (std::size_t i = 0; i < first.size(); ++i) entries += static_cast<double>(i + 1 - first[i]);
    slender_ = entries <= longest_row * static_cast<double>(first.size());
    if (!slender_) return;
    factor_.emplace(std::move(first));
  } else {
    factor_.emplace(envelope());
  }
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    double const per_mass = tau / body_.mass(static_cast<Index>(b));
    for (Entry const& one : cells_[b])
      for (Entry const& other : cells_[b]) {
        auto const i = place_[static_cast<std::size_t>(one.particle)],
                   j = place_[static_cast<std::size_t>(other.particle)];
        if (i >= j)
          factor_->at(i, j) +=
              per_mass * body_.volume(one.particle) * body_.volume(other.particle) * product(one, other);
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
  return total;
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
