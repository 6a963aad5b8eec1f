// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/reference_pairs.hpp"
#include "particles/lattices.hpp"
#include <algorithm>
#include <vector>

namespace piola::testing {

/// One pair as read by a loop, from the stencil table or the list table.
struct SeenPair {
  Index b = 0;
  std::array<double, 3> r{}, sr{};
  double l = 0;
  bool inner = false;
};

/// All pairs of a body by slot, decoded from its pair tables and sorted by neighbour.
struct SeenPairs {
  ParticleSet const* set;
  SlotOrder order;
  ReferencePairs pairs;
  std::vector<std::vector<SeenPair>> of;  ///< per slot
  int padding = 0;                        ///< number of list entries that are no neighbours

  SeenPairs(ParticleSet const& particles, PairOptions const& options, std::size_t body = 0)
      : set(&particles),
        order(pencil_order(particles, particles.bodies[body])),
        pairs(particles, particles.bodies[body], order, options),
        of(order.id.size()) {
    if (pairs.regular())
      decode_stencils(options.lanes);
    else
      decode_list();
    for (auto& list : of) std::sort(list.begin(), list.end(), [](auto const& p, auto const& q) { return p.b < q.b; });
  }

  std::array<double, 3> const& X(Index slot) const {
    return set->X[static_cast<std::size_t>(order.id[static_cast<std::size_t>(slot)])];
  }
  std::vector<SeenPair> const& at(Index slot) const { return of[static_cast<std::size_t>(slot)]; }
  /// Weight of a pair in the corrected Laplacian.
  double laplacian_weight(Index a, SeenPair const& p) const {
    auto const& c = pairs.corrections();
    auto const at = c.at(a);
    auto const& alpha = c.alpha[at];
    return p.l + alpha[0] * p.r[0] + alpha[1] * p.r[1] + alpha[2] * p.r[2] + c.beta[at] * squared(p.r);
  }
  /// Corrected gradient of a scalar f(X) at particle a.
  template <class F>
  std::array<double, 3> gradient(Index a, F const& f) const {
    std::array<double, 3> raw{}, out{};
    for (SeenPair const& p : at(a))
      for (std::size_t c = 0; c < 3; ++c) raw[c] += p.sr[c] * (f(X(p.b)) - f(X(a)));
    auto const& C = pairs.corrections().C[pairs.corrections().at(a)];
    static constexpr std::size_t packed[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) out[i] += C[packed[i][j]] * raw[j];
    return out;
  }
  template <class F>
  double laplacian(Index a, F const& f) const {
    double sum = 0;
    for (SeenPair const& p : at(a)) sum += laplacian_weight(a, p) * (f(X(p.b)) - f(X(a)));
    return sum;
  }

 private:
  void decode_stencils(int lanes) {
    StencilTable const t = pairs.stencil();
    for (Index first = 0; first < order.slots(); first += lanes) {
      StencilPattern const& p = t.patterns[t.pattern_of[first / lanes]];
      read_run(t, p.inner, first, lanes, true);
      read_run(t, p.outer, first, lanes, false);
    }
  }
  void read_run(StencilTable const& t, std::int32_t const (&run)[2], Index first, int lanes, bool inner) {
    for (int e = run[0]; e < run[1]; ++e)
      for (int lane = 0; lane < lanes; ++lane) {
        double const weight = t.entries[e].weights >= 0 ? t.weights[t.entries[e].weights + lane] : 1;
        if (weight == 0) continue;
        StencilOffset const& o = t.offsets[t.entries[e].offset];
        SeenPair seen{first + lane + t.entries[e].delta, {}, {}, weight * o.l, inner};
        for (std::size_t c = 0; c < 3; ++c) {
          seen.r[c] = o.r[c];
          seen.sr[c] = weight * o.sr[c];
        }
        of[static_cast<std::size_t>(first + lane)].push_back(seen);
      }
  }
  void decode_list() {
    ListTable const t = pairs.list();
    for (Index a = 0; a < order.slots(); ++a) {
      for (std::int64_t k = t.begin[a]; k < t.begin[a + 1]; ++k) {
        bool const inner = k < t.begin[a] + t.inner[a];
        double const l = t.l != nullptr ? t.l[k] : 2 * t.s[k];
        if (t.neighbour[k] == a) {
          padding += t.s[k] == 0 && l == 0 ? 1 : 0;
          if (t.s[k] == 0 && l == 0) continue;
        }
        SeenPair seen{t.neighbour[k], {}, {}, l, inner};
        for (std::size_t c = 0; c < 3; ++c) {
          seen.r[c] = X(t.neighbour[k])[c] - X(a)[c];
          seen.sr[c] = t.s[k] * seen.r[c];
        }
        of[static_cast<std::size_t>(a)].push_back(seen);
      }
    }
  }
};

/// Pair options of a unit box with n particles per direction. `gradient`, `laplacian`: support radii [spacings].
inline PairOptions supports(int n, double gradient, double laplacian, int lanes = 1, bool stencils = true) {
  double const dx = 1.0 / (n - 1);
  return {find_kernel("cubic_spline"), gradient * dx, laplacian * dx, lanes, stencils};
}

}  // namespace piola::testing
