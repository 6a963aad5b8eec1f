// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/math/solve.hpp"
#include "piola/neighbours/reference_pairs.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

/// Below this ratio of pivots a correction is meaningless: the neighbours do not span the space.
constexpr double smallest_pivot_ratio = 1e-9;

struct Moments {
  double M[6]{};   // sum s r (x) r
  double G[3]{};   // sum s r
  double L[16]{};  // left-hand side of (A.5) in units of h
  double rhs[4]{};
  int inner = 0, all = 0;
};

template <int D>
bool invert(Moments const& m, std::array<double, 6>& C) {
  static constexpr int at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  double A[D * D], inverse[D * D];
  for (int k = 0; k < D * D; ++k) A[k] = m.M[at[k / D][k % D]];
  bool const good = piola::invert<D>(A, inverse) > smallest_pivot_ratio;
  for (int j = 0; j < D; ++j)
    for (int i = 0; i < D; ++i) C[static_cast<std::size_t>(at[i][j])] = inverse[i * D + j];
  return good;
}

bool invert(int dimension, Moments const& m, std::array<double, 6>& C) {
  return dimension == 3 ? invert<3>(m, C) : dimension == 2 ? invert<2>(m, C) : invert<1>(m, C);
}

/// Solves (A.5) in r / h, so that pivots compare; the polynomial carries no volume (see docs/theory/jst-sph.md).
template <int D>
bool solve_laplacian(Moments const& m, double h, std::array<double, 3>& alpha, double& beta) {
  double A[(D + 1) * (D + 1)], b[D + 1];
  for (int i = 0; i <= D; ++i) {
    int const from_i = i < D ? i : 3;
    for (int j = 0; j <= D; ++j) A[i * (D + 1) + j] = m.L[from_i * 4 + (j < D ? j : 3)];
    b[i] = m.rhs[from_i];
  }
  b[D] += 2.0 * D / (h * h);
  if (solve_in_place<D + 1>(A, b) <= smallest_pivot_ratio) return false;
  alpha = {0, 0, 0};
  for (int i = 0; i < D; ++i) alpha[static_cast<std::size_t>(i)] = b[i] / h;
  beta = b[D] / (h * h);
  return true;
}

bool solve_laplacian(int dimension, Moments const& m, double h, std::array<double, 3>& alpha, double& beta) {
  return dimension == 3   ? solve_laplacian<3>(m, h, alpha, beta)
         : dimension == 2 ? solve_laplacian<2>(m, h, alpha, beta)
                          : solve_laplacian<1>(m, h, alpha, beta);
}

}  // namespace

/// The condition for which a particle has too few neighbours.
struct ReferencePairs::TooFewNeighbours {
  int found = 0;
  char const* operation = nullptr;
  InputError error(std::string const& body, std::int64_t id, std::array<double, 3> const& X, int dimension) const {
    return InputError(fmt::format(
        "body '{}': particle {} at ({:.4g}, {:.4g}, {:.4g}) m has {} neighbours, too few for a corrected {} in {} "
        "dimension{} (they must span every direction) - use more particles across the body or a larger support",
        body, id, X[0], X[1], X[2], found, operation, dimension, dimension == 1 ? "" : "s"));
  }
};

void ReferencePairs::correct(ParticleSet const& set, Body const& body, SlotOrder const& order) {
  auto& c = corrections_;
  // On a lattice, the first particle of each kind represents all of this kind; the last kind is that of empty slots.
  std::vector<Index> stands_for;
  if (regular_) {
    stands_for.assign(kinds_, absent);
    for (Index a = particles_; a-- > 0;) stands_for[c.at(a)] = a;
  } else {
    c.first = own_.first;
  }
  auto const places = regular_ ? kinds_ : static_cast<std::size_t>(own_.last - own_.first);
  c.C.assign(places, {});
  c.G.assign(places, {});
  c.alpha.assign(places, {});
  c.beta.assign(places, 0);
  c.diagonal.assign(places, 0);
  c.neighbours.assign(places, 0);
  auto const slot_of = [&](std::size_t at) { return regular_ ? stands_for[at] : own_.first + static_cast<Index>(at); };
  std::vector<char> good(places, 1);
  exec_host::parallel_for(static_cast<Index>(places), [&](Index k) {
    TooFewNeighbours refusal;
    auto const at = static_cast<std::size_t>(k);
    if (slot_of(at) != absent) good[at] = correct(slot_of(at), at, refusal) ? 1 : 0;
  });
  auto const bad = std::find(good.begin(), good.end(), 0);
  if (bad == good.end()) return;
  auto const at = static_cast<std::size_t>(bad - good.begin());
  TooFewNeighbours refusal;
  correct(slot_of(at), at, refusal);
  auto const id = order.id[static_cast<std::size_t>(slot_of(at))];
  throw refusal.error(body.name, id, set.X[static_cast<std::size_t>(id)], dimension_);
}

bool ReferencePairs::correct(Index a, std::size_t at, TooFewNeighbours& refusal) {
  double const h = options_.h_laplacian > 0 ? options_.h_laplacian : options_.h_gradient;
  Moments m;
  auto const each = [&](auto const& f) { regular_ ? visit_kind(a, at, f) : visit(a, f); };
  each([&](Pair const& p) {
    ++m.all;
    double const l = l_of(p.r2), q2 = p.r2 / (h * h);
    double const q[4] = {p.r[0] / h, p.r[1] / h, p.r[2] / h, q2};
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) m.L[i * 4 + j] += q[i] * q[j];
      m.rhs[i] -= q[i] * l;
    }
    if (!p.inner) return;
    ++m.inner;
    double const s = s_of(p.r2);
    for (std::size_t c = 0; c < 3; ++c) {
      m.M[c] += s * p.r[c] * p.r[c];
      m.M[3 + c] += s * p.r[c == 2 ? 0 : c] * p.r[c == 2 ? 2 : c + 1];
      m.G[c] += s * p.r[c];
    }
  });
  corrections_.neighbours[at] = m.all;
  corrections_.G[at] = {m.G[0], m.G[1], m.G[2]};
  auto& C = corrections_.C[at];
  bool const spans = invert(dimension_, m, C);
  refusal = {m.inner, "gradient"};
  if (!spans) return false;
  if (options_.h_laplacian <= 0) return true;
  auto& alpha = corrections_.alpha[at];
  double& beta = corrections_.beta[at];
  bool const solved = solve_laplacian(dimension_, m, h, alpha, beta);
  refusal = {m.all, "Laplacian"};
  if (!solved) return false;
  double sum = 0;
  each([&](Pair const& p) {
    sum += l_of(p.r2) + alpha[0] * p.r[0] + alpha[1] * p.r[1] + alpha[2] * p.r[2] + beta * p.r2;
  });
  corrections_.diagonal[at] = sum;
  return true;
}

}  // namespace piola
