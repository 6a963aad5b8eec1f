// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/reference_pairs.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>

namespace piola {
namespace {

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

StencilTable ReferencePairs::stencil() const {
  PIOLA_EXPECTS(regular_);
  return {stencils_.offsets.data(),    stencils_.entries.data(), stencils_.patterns.data(),
          stencils_.pattern_of.data(), stencils_.weights.data(), stencils_.kernel.data()};
}

ListTable ReferencePairs::list() const {
  PIOLA_EXPECTS(!regular_);
  return {lists_.begin.data(),
          lists_.inner.data(),
          lists_.neighbour.data(),
          lists_.s.data(),
          lists_.l.empty() ? nullptr : lists_.l.data(),
          lists_.kernel.empty() ? nullptr : lists_.kernel.data()};
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
        double const W =
            !stencils_.kernel.empty() ? stencils_.kernel[static_cast<std::size_t>(p.offset)] : kernel_of(p.r2);
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
  return stencils_.offsets.size() * sizeof(StencilOffset) + stencils_.entries.size() * sizeof(StencilEntry) +
         stencils_.patterns.size() * sizeof(StencilPattern) + stencils_.pattern_of.size() * 4 +
         stencils_.weights.size() * 8 + lists_.begin.size() * 12 + lists_.neighbour.size() * 4 +
         (lists_.s.size() + lists_.l.size() + lists_.kernel.size()) * 8 + corrections_.beta.size() * correction +
         (corrections_.kind.size() + corrections_.neighbours.size()) * 4 + X_.size() * sizeof(std::array<double, 3>) +
         distance_.size() * 4 + found_begin_.size() * 8 + found_.size() * 4;
}

}  // namespace piola
