// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/reference_pairs.hpp"
#include "piola/base/problems.hpp"
#include "piola/math/solve.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

/// Below this ratio of pivots a correction is meaningless: the neighbours do not span the space.
constexpr double smallest_pivot_ratio = 1e-9;

}  // namespace

ReferencePairs::ReferencePairs(ParticleSet const& set, Body const& body, SlotOrder const& order,
                               PairOptions const& options)
    : options_(options),
      dimension_(set.dimension),
      regular_(body.regular && options.stencils),
      kernel_volume_(set.kernel_volume[static_cast<std::size_t>(body.first)]),
      particles_(order.particles),
      id_(order.id),
      lattice_(body.lattice) {
  auto const slots = order.id.size();
  X_.resize(slots);
  at_.resize(slots);
  for (std::size_t k = 0; k < static_cast<std::size_t>(particles_); ++k) {
    X_[k] = set.X[static_cast<std::size_t>(id_[k])];
    at_[k] = set.lattice_index[static_cast<std::size_t>(id_[k])];
  }
  X_.insert(X_.end(), options.copies.X.begin(), options.copies.X.end());
  if (regular_)
    find_offsets(body);
  else
    search();
  correct(set, body);
  if (regular_)
    make_stencils();
  else
    make_list();
}

double ReferencePairs::s_of(double r2) const {
  double const h = options_.h_gradient, r = std::sqrt(r2);
  double const scale = options_.kernel->sigma(dimension_) / std::pow(h, dimension_ + 1);
  return -kernel_volume_ * scale * options_.kernel->dw(dimension_, r / h) / r;
}

double ReferencePairs::l_of(double r2) const {
  double const h = options_.h_laplacian;
  if (h <= 0) return 0;
  double const r = std::sqrt(r2);
  double const scale = options_.kernel->sigma(dimension_) / std::pow(h, dimension_ + 1);
  return -2 * kernel_volume_ * scale * options_.kernel->dw(dimension_, r / h) / r;
}

double ReferencePairs::kernel_of(double r2) const {
  double const h = options_.h_laplacian;
  return options_.kernel->sigma(dimension_) / std::pow(h, dimension_) *
         options_.kernel->w(dimension_, std::sqrt(r2) / h);
}

void ReferencePairs::find_offsets(Body const& body) {
  double const radius = options_.kernel->support * std::max(options_.h_gradient, options_.h_laplacian) * edge;
  double const inner = options_.kernel->support * options_.h_gradient * edge;
  std::array<int, 3> reach{};
  for (std::size_t c = 0; c < 3; ++c) {
    int const wanted = lattice_[c] > 1 ? static_cast<int>(radius / body.spacing[c]) : 0;
    reach[c] = std::min(wanted, lattice_[c] - 1);
  }
  for (int k = -reach[2]; k <= reach[2]; ++k)
    for (int j = -reach[1]; j <= reach[1]; ++j)
      for (int i = -reach[0]; i <= reach[0]; ++i) {
        std::array const r{i * body.spacing[0], j * body.spacing[1], k * body.spacing[2]};
        double const r2 = squared(r);
        if ((i == 0 && j == 0 && k == 0) || r2 > radius * radius) continue;
        bool const is_inner = r2 <= inner * inner;
        double const s = is_inner ? s_of(r2) : 0;
        lattice_offset_.push_back({i, j, k});
        offsets_.push_back({s, {s * r[0], s * r[1], s * r[2]}, {r[0], r[1], r[2]}, r2, l_of(r2)});
        offset_inner_.push_back(is_inner ? 1 : 0);
        if (options_.kernel_table) offset_kernel_.push_back(kernel_of(r2));
      }
  auto const points = static_cast<std::size_t>(lattice_[0]) * static_cast<std::size_t>(lattice_[1]) *
                      static_cast<std::size_t>(lattice_[2]);
  slot_at_.assign(points, SlotOrder::no_particle);
  for (Index a = 0; a < particles_; ++a) {
    auto const& at = at_[static_cast<std::size_t>(a)];
    slot_at_[lattice_number(at)] = a;
  }
}

void ReferencePairs::search() {
  double const radius = options_.kernel->support * std::max(options_.h_gradient, options_.h_laplacian) * edge;
  std::vector<std::array<double, 3>> points(X_.begin(), X_.begin() + particles_);
  points.insert(points.end(), options_.copies.X.begin(), options_.copies.X.end());
  Index const empty = static_cast<Index>(id_.size()) - particles_;  // slots between particles and copies
  CellGrid const grid(points, radius);
  found_begin_.assign(1, 0);
  std::vector<Index> near;
  for (Index a = 0; a < particles_; ++a) {
    near.clear();
    auto const& Xa = X_[static_cast<std::size_t>(a)];
    grid.visit(Xa, [&](Index point) {
      Index const b = point < particles_ ? point : point + empty;
      auto const& Xb = X_[static_cast<std::size_t>(b)];
      std::array const r{Xb[0] - Xa[0], Xb[1] - Xa[1], Xb[2] - Xa[2]};
      if (b != a && squared(r) < radius * radius) near.push_back(b);
    });
    std::sort(near.begin(), near.end());
    found_.insert(found_.end(), near.begin(), near.end());
    found_begin_.push_back(static_cast<std::int64_t>(found_.size()));
  }
}

void ReferencePairs::refuse(ParticleSet const& set, Body const& body, Index a, int found, char const* operation) const {
  auto const id = id_[static_cast<std::size_t>(a)];
  auto const& X = set.X[static_cast<std::size_t>(id)];
  throw InputError(fmt::format(
      "body '{}': particle {} at ({:.4g}, {:.4g}, {:.4g}) m has {} neighbours, too few for a corrected {} in {} "
      "dimension{} (they must span every direction) - use more particles across the body or a larger support",
      body.name, id, X[0], X[1], X[2], found, operation, dimension_, dimension_ == 1 ? "" : "s"));
}

namespace {

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

}  // namespace

void ReferencePairs::correct(ParticleSet const& set, Body const& body) {
  auto const slots = id_.size();
  corrections_.C.assign(slots, {});
  corrections_.G.assign(slots, {});
  corrections_.alpha.assign(slots, {});
  corrections_.beta.assign(slots, 0);
  corrections_.diagonal.assign(slots, 0);
  corrections_.neighbours.assign(slots, 0);
  double const h = options_.h_laplacian > 0 ? options_.h_laplacian : options_.h_gradient;
  for (Index a = 0; a < particles_; ++a) {
    auto const slot = static_cast<std::size_t>(a);
    Moments m;
    visit(a, [&](Pair const& p) {
      ++m.all;
      max_delta_ = std::max(max_delta_, std::abs(p.b - a));
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
    pairs_ += m.all;
    corrections_.neighbours[slot] = m.all;
    corrections_.G[slot] = {m.G[0], m.G[1], m.G[2]};
    corrections_.largest_moment = std::max(corrections_.largest_moment, (m.M[0] + m.M[1] + m.M[2]) / dimension_);
    auto& C = corrections_.C[slot];
    bool const spans = dimension_ == 3 ? invert<3>(m, C) : dimension_ == 2 ? invert<2>(m, C) : invert<1>(m, C);
    if (!spans) refuse(set, body, a, m.inner, "gradient");
    if (options_.h_laplacian <= 0) continue;
    auto& alpha = corrections_.alpha[slot];
    double& beta = corrections_.beta[slot];
    bool const solved = dimension_ == 3   ? solve_laplacian<3>(m, h, alpha, beta)
                        : dimension_ == 2 ? solve_laplacian<2>(m, h, alpha, beta)
                                          : solve_laplacian<1>(m, h, alpha, beta);
    if (!solved) refuse(set, body, a, m.all, "Laplacian");
    double sum = 0;
    visit(a, [&](Pair const& p) {
      sum += l_of(p.r2) + alpha[0] * p.r[0] + alpha[1] * p.r[1] + alpha[2] * p.r[2] + beta * p.r2;
    });
    corrections_.diagonal[slot] = sum;
  }
}

StencilTable ReferencePairs::stencil() const {
  return {offsets_.data(),    entries_.data(), patterns_.data(),
          pattern_of_.data(), weights_.data(), offset_kernel_.data()};
}

ListTable ReferencePairs::list() const {
  return {list_begin_.data(),
          list_inner_.data(),
          list_neighbour_.data(),
          list_s_.data(),
          list_l_.empty() ? nullptr : list_l_.data(),
          list_kernel_.empty() ? nullptr : list_kernel_.data()};
}

ReferencePairs::Filter ReferencePairs::make_filter(std::vector<double> const& volume) const {
  constexpr int most = 200;
  constexpr double close = 1e-8;
  auto const n = static_cast<std::size_t>(particles_);
  Filter filter{std::vector<double>(id_.size(), 1.0), std::vector<double>(id_.size(), 0.0)};
  auto& d = filter.scale;
  std::vector<double> neighbours(n);
  double const self = kernel_of(0);
  for (int sweep = 0;; ++sweep) {
    for (Index a = 0; a < particles_; ++a) {
      double sum = 0;
      visit(a, [&](Pair const& p) {
        auto const b = static_cast<std::size_t>(source_of(p.b));
        sum += kernel_of(p.r2) * volume[b] * d[b];
      });
      neighbours[static_cast<std::size_t>(a)] = sum;
    }
    double worst = 0;
    for (std::size_t a = 0; a < n; ++a) {
      filter.sum[a] = d[a] * neighbours[a];
      neighbours[a] += self * volume[a] * d[a];
      worst = std::max(worst, std::abs(d[a] * neighbours[a] - 1));
    }
    if (worst < close || sweep == most) break;
    for (std::size_t a = 0; a < n; ++a) d[a] = std::sqrt(d[a] / neighbours[a]);
  }
  return filter;
}

std::size_t ReferencePairs::bytes() const {
  return offsets_.size() * sizeof(StencilOffset) + entries_.size() * sizeof(StencilEntry) +
         patterns_.size() * sizeof(StencilPattern) + pattern_of_.size() * 4 + weights_.size() * 8 +
         list_begin_.size() * 12 + list_neighbour_.size() * 4 +
         (list_s_.size() + list_l_.size() + list_kernel_.size()) * 8;
}

}  // namespace piola
