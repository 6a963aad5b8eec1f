// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/reference_pairs.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/math/solve.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <unordered_set>

namespace piola {
namespace {

/// Below this ratio of pivots a correction is meaningless: the neighbours do not span the space.
constexpr double smallest_pivot_ratio = 1e-9;

constexpr std::int64_t copies_last = std::int64_t{1} << 62;

}  // namespace

ReferencePairs::ReferencePairs(ParticleSet const& set, Body const& body, SlotOrder const& order,
                               PairOptions const& options)
    : options_(options),
      dimension_(set.dimension),
      regular_(body.regular && options.stencils),
      kernel_volume_(set.kernel_volume[static_cast<std::size_t>(body.first)]),
      particles_(order.particles),
      slots_(order.slots()),
      own_(options.own && !regular_ ? *options.own : Range{0, order.particles}),
      lattice_(body.lattice) {
  PIOLA_EXPECTS(dimension_ >= 1 && dimension_ <= 3);
  PIOLA_EXPECTS(body.first >= 0 && body.first < body.last);
  PIOLA_EXPECTS(order.particles == body.last - body.first);
  PIOLA_EXPECTS(options.kernel != nullptr);
  PIOLA_EXPECTS(options.h_gradient > 0);
  PIOLA_EXPECTS(!(options.h_laplacian > 0) || options.h_laplacian >= options.h_gradient);
  PIOLA_EXPECTS(options.lanes >= 1);
  PIOLA_EXPECTS(options.copies.source.size() == options.copies.X.size());
  PIOLA_EXPECTS(!regular_ || options.copies.X.empty());
  double const sigma = options.kernel->sigma(dimension_);
  s_scale_ = sigma / std::pow(options.h_gradient, dimension_ + 1);
  if (options.h_laplacian > 0) {
    l_scale_ = sigma / std::pow(options.h_laplacian, dimension_ + 1);
    kernel_scale_ = sigma / std::pow(options.h_laplacian, dimension_);
  }
  if (regular_) {
    find_offsets(body);
    find_kinds(set, order);
  } else {
    X_.resize(order.id.size());
    for (std::size_t k = 0; k < static_cast<std::size_t>(particles_); ++k)
      X_[k] = set.X[static_cast<std::size_t>(order.id[k])];
    X_.insert(X_.end(), options.copies.X.begin(), options.copies.X.end());
    search(order);
  }
  correct(set, body, order);
  if (regular_)
    make_stencils();
  else
    make_list();
}

double ReferencePairs::s_of(double r2) const {
  double const r = std::sqrt(r2);
  return -kernel_volume_ * s_scale_ * options_.kernel->dw(dimension_, r / options_.h_gradient) / r;
}

double ReferencePairs::l_of(double r2) const {
  if (options_.h_laplacian <= 0) return 0;
  double const r = std::sqrt(r2);
  return -2 * kernel_volume_ * l_scale_ * options_.kernel->dw(dimension_, r / options_.h_laplacian) / r;
}

double ReferencePairs::kernel_of(double r2) const {
  return kernel_scale_ * options_.kernel->w(dimension_, std::sqrt(r2) / options_.h_laplacian);
}

void ReferencePairs::find_offsets(Body const& body) {
  double const radius = options_.kernel->support * std::max(options_.h_gradient, options_.h_laplacian) * edge;
  double const inner = options_.kernel->support * options_.h_gradient * edge;
  std::array<int, 3> reach{};
  for (std::size_t c = 0; c < 3; ++c) {
    int const wanted = lattice_[c] > 1 ? static_cast<int>(radius / body.spacing[c]) : 0;
    reach[c] = std::min(wanted, lattice_[c] - 1);
  }
  // Along the rows that are next to each other in memory first.
  auto const axis = row_axes(body);
  std::array<int, 3> offset{};
  auto& i = offset[axis[0]];
  auto& j = offset[axis[1]];
  auto& k = offset[axis[2]];
  for (k = -reach[axis[2]]; k <= reach[axis[2]]; ++k)
    for (j = -reach[axis[1]]; j <= reach[axis[1]]; ++j)
      for (i = -reach[axis[0]]; i <= reach[axis[0]]; ++i) {
        std::array const r{offset[0] * body.spacing[0], offset[1] * body.spacing[1], offset[2] * body.spacing[2]};
        double const r2 = squared(r);
        if ((i == 0 && j == 0 && k == 0) || r2 > radius * radius) continue;
        bool const is_inner = r2 <= inner * inner;
        double const s = is_inner ? s_of(r2) : 0;
        lattice_offset_.push_back(offset);
        offsets_.push_back({s, {s * r[0], s * r[1], s * r[2]}, {r[0], r[1], r[2]}, r2, l_of(r2)});
        offset_inner_.push_back(is_inner ? 1 : 0);
        if (options_.kernel_table) offset_kernel_.push_back(kernel_of(r2));
      }
}

namespace {

/// Rows of numbers, each different one kept once, in the order of their first appearance.
class DistinctRows {
 public:
  explicit DistinctRows(std::size_t width) : width_(width), place_(16, Equal{this}, Equal{this}) {}
  DistinctRows(DistinctRows const&) = delete;
  DistinctRows& operator=(DistinctRows const&) = delete;
  /// The number of a row.
  std::int32_t number(Index const* row) {
    // Most rows are like the one before.
    if (last_ >= 0 && std::equal(row, row + width_, at(last_))) return last_;
    rows_.insert(rows_.end(), row, row + width_);
    auto const [found, is_new] = place_.insert(count_);
    last_ = *found;
    if (is_new)
      ++count_;
    else
      rows_.resize(rows_.size() - width_);
    return last_;
  }
  std::int32_t count() const { return count_; }
  Index const* at(std::int32_t number) const { return rows_.data() + static_cast<std::size_t>(number) * width_; }
  std::vector<Index>& rows() { return rows_; }

 private:
  struct Equal {
    DistinctRows const* of;
    std::size_t operator()(std::int32_t number) const {
      std::uint64_t hash = 0;
      for (std::size_t k = 0; k < of->width_; ++k)
        hash = (hash ^ static_cast<std::uint32_t>(of->at(number)[k])) * 0x9E3779B97F4A7C15U + (hash >> 29);
      return static_cast<std::size_t>(hash ^ (hash >> 32));
    }
    bool operator()(std::int32_t a, std::int32_t b) const {
      return std::equal(of->at(a), of->at(a) + of->width_, of->at(b));
    }
  };
  std::size_t width_;
  std::vector<Index> rows_;
  std::unordered_set<std::int32_t, Equal, Equal> place_;
  std::int32_t count_ = 0, last_ = -1;
};

/// Which slot is at each point of a lattice, and how far from a slot its neighbours at given offsets are.
class SlotsOfLattice {
 public:
  SlotsOfLattice(std::array<int, 3> const& lattice, std::vector<std::array<int, 3>> const& offsets)
      : lattice_(lattice), offsets_(offsets), stride_{1, lattice[0], std::ptrdiff_t{lattice[0]} * lattice[1]} {
    slot_.assign(static_cast<std::size_t>(stride_[2] * lattice[2]), SlotOrder::no_particle);
    for (auto const& o : offsets) {
      step_.push_back(number(o));
      for (std::size_t c = 0; c < 3; ++c) reach_[c] = std::max(reach_[c], o[c]);
    }
  }
  void put(std::array<int, 3> const& at, Index slot) { slot_[static_cast<std::size_t>(number(at))] = slot; }
  /// row[k]: from slot a, at `from`, to its neighbour at offset k, or `absent`.
  void read(std::array<int, 3> const& from, Index a, Index absent, std::vector<Index>& row) const {
    auto const here = number(from);
    bool deep = true;  // all neighbours are within the lattice
    for (std::size_t c = 0; c < 3; ++c) deep = deep && from[c] >= reach_[c] && from[c] + reach_[c] < lattice_[c];
    for (std::size_t k = 0; k < offsets_.size(); ++k) {
      bool inside = true;
      for (std::size_t c = 0; c < 3 && !deep; ++c) {
        int const to = from[c] + offsets_[k][c];
        inside = inside && to >= 0 && to < lattice_[c];
      }
      Index const b = inside ? slot_[static_cast<std::size_t>(here + step_[k])] : SlotOrder::no_particle;
      row[k] = b == SlotOrder::no_particle ? absent : b - a;
    }
  }

 private:
  std::ptrdiff_t number(std::array<int, 3> const& at) const { return at[0] + at[1] * stride_[1] + at[2] * stride_[2]; }
  std::array<int, 3> lattice_;
  std::vector<std::array<int, 3>> const& offsets_;
  std::array<std::ptrdiff_t, 3> stride_;
  std::array<int, 3> reach_{};
  std::vector<std::ptrdiff_t> step_;
  std::vector<Index> slot_;
};

}  // namespace

void ReferencePairs::find_kinds(ParticleSet const& set, SlotOrder const& order) {
  auto const& lattice_index = set.lattice_index.seen();
  auto const at = [&](Index slot) -> std::array<int, 3> const& {
    return lattice_index[static_cast<std::size_t>(order.id[static_cast<std::size_t>(slot)])];
  };
  SlotsOfLattice slots(lattice_, lattice_offset_);
  for (Index a = 0; a < particles_; ++a) slots.put(at(a), a);
  std::size_t const width = offsets_.size();
  auto& kind = corrections_.kind;
  kind.assign(static_cast<std::size_t>(slots_), 0);
  // Each part numbers its kinds by itself first.
  struct Found {
    std::vector<Index> rows;
    std::int32_t count = 0;
  };
  std::vector<Found> found(static_cast<std::size_t>(parts()));
  each_part([&](Index part, Index first, Index end) {
    DistinctRows mine(width);
    std::vector<Index> row(width);
    for (Index a = first; a < end; ++a) {
      slots.read(at(a), a, absent, row);
      kind[static_cast<std::size_t>(a)] = mine.number(row.data());
    }
    found[static_cast<std::size_t>(part)] = {std::move(mine.rows()), mine.count()};
  });
  DistinctRows all(width);
  std::vector<std::vector<std::int32_t>> of_part;
  for (Found const& part : found) {
    auto& numbers = of_part.emplace_back();
    for (std::size_t k = 0; k < static_cast<std::size_t>(part.count); ++k)
      numbers.push_back(all.number(part.rows.data() + k * width));
  }
  each_part([&](Index part, Index first, Index end) {
    for (Index a = first; a < end; ++a) {
      auto& of_slot = kind[static_cast<std::size_t>(a)];
      of_slot = of_part[static_cast<std::size_t>(part)][static_cast<std::size_t>(of_slot)];
    }
  });
  // Empty slots have no neighbours.
  for (Index a = particles_; a < slots_; ++a) kind[static_cast<std::size_t>(a)] = all.count();
  kinds_ = static_cast<std::size_t>(all.count()) + 1;
  distance_.swap(all.rows());
  distance_.resize(kinds_ * width, absent);
}

void ReferencePairs::search(SlotOrder const& order) {
  double const radius = options_.kernel->support * std::max(options_.h_gradient, options_.h_laplacian) * edge;
  std::vector<std::array<double, 3>> points(X_.begin(), X_.begin() + particles_);
  points.insert(points.end(), options_.copies.X.begin(), options_.copies.X.end());
  Index const empty = slots_ - particles_;  // slots between particles and copies
  CellGrid const grid(points, radius);
  found_begin_.assign(static_cast<std::size_t>(own_.last - own_.first) + 1, 0);
  std::vector<std::vector<Index>> found(static_cast<std::size_t>(parts()));
  each_part([&](Index part, Index first, Index end) {
    auto& near = found[static_cast<std::size_t>(part)];
    std::vector<std::pair<std::int64_t, Index>> by_id;
    for (Index a = first; a < end; ++a) {
      auto const before = std::ssize(near);
      by_id.clear();
      auto const& Xa = X_[static_cast<std::size_t>(a)];
      grid.visit(Xa, [&](Index point) {
        Index const b = point < particles_ ? point : point + empty;
        auto const& Xb = X_[static_cast<std::size_t>(b)];
        std::array const r{Xb[0] - Xa[0], Xb[1] - Xa[1], Xb[2] - Xa[2]};
        if (b != a && squared(r) < radius * radius)
          by_id.emplace_back(b < slots_ ? order.id[static_cast<std::size_t>(b)] : copies_last + b, b);
      });
      std::sort(by_id.begin(), by_id.end());
      for (auto const& [id, b] : by_id) near.push_back(b);
      found_begin_[static_cast<std::size_t>(a - own_.first) + 1] = std::ssize(near) - before;
    }
  });
  for (std::size_t a = 0; a + 1 < found_begin_.size(); ++a) found_begin_[a + 1] += found_begin_[a];
  found_.resize(static_cast<std::size_t>(found_begin_.back()));
  each_part([&](Index part, Index first, Index) {
    auto const& near = found[static_cast<std::size_t>(part)];
    std::copy(near.begin(), near.end(), found_.begin() + found_begin_[static_cast<std::size_t>(first - own_.first)]);
  });
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

/// The condition for which a particle has too few neighbours.
struct ReferencePairs::TooFewNeighbours {
  int found = 0;
  char const* operation = nullptr;
};

void ReferencePairs::correct(ParticleSet const& set, Body const& body, SlotOrder const& order) {
  auto& c = corrections_;
  // On a lattice, the first particle of each kind represents all of this kind; the last kind is that of empty slots.
  std::vector<Index> stands_for;
  if (regular_) {
    stands_for.assign(kinds_, absent);
    for (Index a = particles_; a-- > 0;) stands_for[c.at(a)] = a;
  }
  if (!regular_) c.first = own_.first;
  auto const places = static_cast<std::size_t>(regular_ ? std::ssize(stands_for) : own_.last - own_.first);
  c.C.assign(places, {});
  c.G.assign(places, {});
  c.alpha.assign(places, {});
  c.beta.assign(places, 0);
  c.diagonal.assign(places, 0);
  c.neighbours.assign(places, 0);
  auto const first_refused = [&](std::size_t n, auto const& slot_of) {
    std::vector<char> good(n, 1);
    exec_host::parallel_for(static_cast<Index>(n), [&](Index k) {
      TooFewNeighbours refusal;
      auto const at = static_cast<std::size_t>(k);
      if (slot_of(at) != absent) good[at] = correct(slot_of(at), at, refusal) ? 1 : 0;
    });
    auto const bad = std::find(good.begin(), good.end(), 0);
    return bad == good.end() ? absent : static_cast<Index>(bad - good.begin());
  };
  Index const refused =
      regular_ ? first_refused(places, [&](std::size_t at) { return stands_for[at]; })
               : first_refused(places, [&](std::size_t at) { return own_.first + static_cast<Index>(at); });
  if (refused != absent) {
    auto const at = static_cast<std::size_t>(refused);
    Index const a = regular_ ? stands_for[at] : own_.first + refused;
    TooFewNeighbours refusal;
    correct(a, at, refusal);
    auto const id = order.id[static_cast<std::size_t>(a)];
    auto const& X = set.X[static_cast<std::size_t>(id)];
    throw InputError(fmt::format(
        "body '{}': particle {} at ({:.4g}, {:.4g}, {:.4g}) m has {} neighbours, too few for a corrected {} in {} "
        "dimension{} (they must span every direction) - use more particles across the body or a larger support",
        body.name, id, X[0], X[1], X[2], refusal.found, refusal.operation, dimension_, dimension_ == 1 ? "" : "s"));
  }
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
  bool const spans = dimension_ == 3 ? invert<3>(m, C) : dimension_ == 2 ? invert<2>(m, C) : invert<1>(m, C);
  refusal = {m.inner, "gradient"};
  if (!spans) return false;
  if (options_.h_laplacian <= 0) return true;
  auto& alpha = corrections_.alpha[at];
  double& beta = corrections_.beta[at];
  bool const solved = dimension_ == 3   ? solve_laplacian<3>(m, h, alpha, beta)
                      : dimension_ == 2 ? solve_laplacian<2>(m, h, alpha, beta)
                                        : solve_laplacian<1>(m, h, alpha, beta);
  refusal = {m.all, "Laplacian"};
  if (!solved) return false;
  double sum = 0;
  each([&](Pair const& p) {
    sum += l_of(p.r2) + alpha[0] * p.r[0] + alpha[1] * p.r[1] + alpha[2] * p.r[2] + beta * p.r2;
  });
  corrections_.diagonal[at] = sum;
  return true;
}

StencilTable ReferencePairs::stencil() const {
  PIOLA_EXPECTS(regular_);
  return {offsets_.data(),    entries_.data(), patterns_.data(),
          pattern_of_.data(), weights_.data(), offset_kernel_.data()};
}

ListTable ReferencePairs::list() const {
  PIOLA_EXPECTS(!regular_);
  return {list_begin_.data(),
          list_inner_.data(),
          list_neighbour_.data(),
          list_s_.data(),
          list_l_.empty() ? nullptr : list_l_.data(),
          list_kernel_.empty() ? nullptr : list_kernel_.data()};
}

ReferencePairs::Filter ReferencePairs::make_filter(std::vector<double> const& volume, FilterShare const* share) const {
  PIOLA_EXPECTS(options_.h_laplacian > 0);
  PIOLA_EXPECTS(volume.size() >= static_cast<std::size_t>(particles_));
  PIOLA_EXPECTS(share == nullptr || (share->tell != nullptr && share->allreduce_max != nullptr));
  constexpr int most = 200;
  constexpr double close = 1e-8;
  Range const own = share != nullptr ? share->own : Range{0, particles_};
  auto const first = static_cast<std::size_t>(own.first), n = static_cast<std::size_t>(own.last - own.first);
  auto const slots = static_cast<std::size_t>(slots_);
  Filter filter{std::vector<double>(slots, 1.0), std::vector<double>(slots, 0.0)};
  auto& d = filter.scale;
  std::vector<double> neighbours(n);
  double const self = kernel_of(0);
  for (int sweep = 0;; ++sweep) {
    exec_host::parallel_for(own.last - own.first, [&](Index k) {
      double sum = 0;
      visit(own.first + k, [&](Pair const& p) {
        auto const b = static_cast<std::size_t>(source_of(p.b));
        double const W = !offset_kernel_.empty() ? offset_kernel_[static_cast<std::size_t>(p.offset)] : kernel_of(p.r2);
        sum += W * volume[b] * d[b];
      });
      neighbours[static_cast<std::size_t>(k)] = sum;
    });
    double worst = 0;
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t const a = first + k;
      filter.sum[a] = d[a] * neighbours[k];
      neighbours[k] += self * volume[a] * d[a];
      worst = std::max(worst, std::abs(d[a] * neighbours[k] - 1));
    }
    if (share != nullptr) share->allreduce_max(worst);
    if (worst < close || sweep == most) break;
    for (std::size_t k = 0; k < n; ++k) d[first + k] = std::sqrt(d[first + k] / neighbours[k]);
    if (share != nullptr) share->tell(d);
  }
  return filter;
}

void ReferencePairs::keep_tables() {
  auto const free = [](auto&... arrays) { ((arrays = {}, arrays.shrink_to_fit()), ...); };
  free(X_, distance_, found_begin_, found_, lattice_offset_);
  free(corrections_.C, corrections_.G, corrections_.alpha, corrections_.beta, corrections_.diagonal);
}

std::size_t ReferencePairs::bytes() const {
  constexpr std::size_t correction = 14 * sizeof(double);  // C, G, alpha, beta, diagonal
  return offsets_.size() * sizeof(StencilOffset) + entries_.size() * sizeof(StencilEntry) +
         patterns_.size() * sizeof(StencilPattern) + pattern_of_.size() * 4 + weights_.size() * 8 +
         list_begin_.size() * 12 + list_neighbour_.size() * 4 +
         (list_s_.size() + list_l_.size() + list_kernel_.size()) * 8 + corrections_.beta.size() * correction +
         (corrections_.kind.size() + corrections_.neighbours.size()) * 4 + X_.size() * sizeof(std::array<double, 3>) +
         distance_.size() * 4 + found_begin_.size() * 8 + found_.size() * 4;
}

}  // namespace piola
