// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/fragment_contact.hpp"
#include "piola/domain/slot_collectives.hpp"
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>

namespace piola::nodal {
namespace {

/// Distance at which springs touch, and that in the reference configuration from which particles have one, in spacings.
constexpr double touching = 0.6, apart = 3;
/// Stiffness, in units of the P-wave modulus times the volume of a cell over the square of the spacing.
constexpr double stiffness = 0.5;

}  // namespace

void FragmentContact::add(Index slot) {
  if (known_.empty()) known_.resize(static_cast<std::size_t>(body_.slots()));
  char& known = known_[static_cast<std::size_t>(slot)];
  if (known != 0) return;
  known = 2;
  slots_.insert(std::lower_bound(slots_.begin(), slots_.end(), slot), slot);
}

void FragmentContact::evaluate() {
  energy_ = frequency2_ = 0;
  force_.assign(slots_.size(), {});
  if (slots_.empty()) return;
  auto const& s = body_.state();
  int const D = s.dimension;
  if (body_.shared()) allgather_selected_slots(s.x, body_.own(), slots_, D);
  auto const& spacing = body_.body().spacing;
  double const h = *std::min_element(spacing.begin(), spacing.begin() + D);
  std::vector<std::array<double, 3>> x(slots_.size());
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = body_.x(slots_[k]);
  std::vector<double> frequency(slots_.size());
  CellGrid const grid(x, touching * h);
  for (std::size_t k = 0; k < x.size(); ++k)
    grid.visit(x[k], [&](Index other) {
      auto const n = static_cast<std::size_t>(other);
      double const r = n > k && !acts_elsewhere(k, n) ? std::sqrt(square_of_distance(x[k], x[n])) : h;
      if (!(r > 0 && r < touching * h) ||
          square_of_distance(body_.X(slots_[k]), body_.X(slots_[n])) < apart * apart * h * h)
        return;
      double const closed = rest_of(slots_[k], slots_[n], r, touching * h) - r;
      if (!(closed > 0)) return;
      Constants const& law = body_.material(slots_[k]).constants;
      double const m_k = body_.replicated_mass(slots_[k]), m_n = body_.replicated_mass(slots_[n]);
      double const modulus = law.kappa + 4 * law.mu / 3,
                   spring = stiffness * modulus * 0.5 * (m_k + m_n) / (law.rho0 * h * h);
      energy_ += 0.5 * spring * closed * closed;
      for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) {
        double const f = spring * closed * (x[n][c] - x[k][c]) / r;
        force_[k][static_cast<int>(c)] -= f;
        force_[n][static_cast<int>(c)] += f;
      }
      frequency[k] += spring * (1 / m_k + 1 / m_n);
      frequency[n] += spring * (1 / m_k + 1 / m_n);
    });
  frequency2_ = *std::max_element(frequency.begin(), frequency.end());
  forget_parted(touching * h);
  for (Index const slot : slots_) known_[static_cast<std::size_t>(slot)] = 1;
}

/// Whether one of two particles has an Eulerian cell, whose forces keep them apart.
bool FragmentContact::acts_elsewhere(std::size_t k, std::size_t n) const {
  auto const converted = [&](std::size_t at) { return !body_.reference().refits->is_intact(slots_[at]); };
  return body_.state().has.converts && (converted(k) || converted(n));
}

/// Distance from which a pair pushes [m], which is at the distance r: it grows while the pair parts.
double FragmentContact::rest_of(Index a, Index b, double r, double touching) {
  bool const is_new = known_[static_cast<std::size_t>(a)] == 2 || known_[static_cast<std::size_t>(b)] == 2;
  auto const known = nearer_.find({a, b});
  if (known != nearer_.end()) return known->second = std::max(known->second, r);
  if (is_new) return nearer_[{a, b}] = r;
  return touching;
}

/// Pairs that have been farther apart push like all others.
void FragmentContact::forget_parted(double touching) {
  std::erase_if(nearer_, [&](auto const& pair) {
    auto const [a, b] = pair.first;
    return !(square_of_distance(body_.x(a), body_.x(b)) < touching * touching);
  });
}

void FragmentContact::load(std::vector<double> const& state) {
  nearer_ = contact::pair_values_of(state);
  for (Index const slot : slots_) known_[static_cast<std::size_t>(slot)] = 1;
}

void FragmentContact::kick(double dt) const {
  auto const& s = body_.state();
  for (std::size_t k = 0; k < force_.size(); ++k) {
    Index const slot = slots_[k];
    if (slot < body_.own().first || slot >= body_.own().last) continue;
    for (int c = 0; c < s.dimension; ++c) value_at(s.v, slot, c) += dt * force_[k][c] / body_.replicated_mass(slot);
  }
}

}  // namespace piola::nodal
