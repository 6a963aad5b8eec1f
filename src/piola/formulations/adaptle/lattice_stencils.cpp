// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/lattice_stencils.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/formulations/adaptle/records.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace piola::adaptle {
namespace {

/// Below this fraction of lanes with a neighbour at the offset of an entry, lists are faster.
constexpr double least_fill = 0.6;
constexpr Index absent = 2147483647;

/// Entries of one group of lanes: offset, distance in memory, bits of the lanes with a neighbour.
using GroupShape = std::vector<std::int32_t>;

/// distance: [offset][lane].
GroupShape shape_of_group(std::vector<Index> const& distance, int lanes) {
  GroupShape shape;
  auto const W = static_cast<std::size_t>(lanes);
  for (std::size_t o = 0; o * W < distance.size(); ++o) {
    Index const* const row = distance.data() + o * W;
    for (std::size_t first = 0; first < W; ++first) {
      if (row[first] == absent || std::find(row, row + first, row[first]) != row + first) continue;
      std::int32_t bits = 0;
      for (std::size_t l = first; l < W; ++l) bits |= row[l] == row[first] ? 1 << l : 0;
      shape.insert(shape.end(), {static_cast<std::int32_t>(o), row[first], bits});
    }
  }
  return shape;
}

template <int D, class Shape>
void evaluate(double h, double square, double& s, double& W) {
  Kernel<D, Shape>(h).evaluate(square, s, W);
}

}  // namespace

KernelFunction kernel_function(piola::Kernel const& kernel, int dimension) {
  KernelFunction function = nullptr;
  with_kernel(kernel, LaneKernels{},
              [&]<class Shape>() { function = dimension == 2 ? &evaluate<2, Shape> : &evaluate<3, Shape>; });
  PIOLA_ENSURES(function != nullptr);
  return function;
}

double lattice_square(Body const& body, std::array<int, 3> const& from, std::array<int, 3> const& to) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    double const d = (to[c] - from[c]) * body.spacing[c];
    square += d * d;
  }
  return square;
}

LatticeStencils::LatticeStencils(ParticleSet const& set, BodyInput const& body, std::span<Offset const> begin,
                                 std::span<Index const> neighbour, int lanes, bool rounded, int components)
    : first_(static_cast<Index>(body.geometry.first)) {
  PIOLA_EXPECTS(lanes >= 1 && components >= 1);
  if (!body.geometry.regular || body.geometry.off_lattice || set.axisymmetric) return;
  find_offsets(body, set.dimension, rounded);
  Fill fill = find_patterns(set, body, begin, neighbour, lanes);
  comm::allreduce(fill, [](void const* other, void* mine) {
    auto const& from = *static_cast<Fill const*>(other);
    auto& to = *static_cast<Fill*>(mine);
    to = {to.present + from.present, to.all + from.all, to.lattice && from.lattice};
  });
  bool const faster = static_cast<double>(fill.present) >= least_fill * static_cast<double>(fill.all);
  has_rows_ = fill.lattice && faster && fill.present > 0;
  if (has_rows_) allocate(body.geometry, components);
}

void LatticeStencils::find_offsets(BodyInput const& input, int dimension, bool rounded) {
  Body const& body = input.geometry;
  for (std::size_t c = 0; c < 3; ++c)
    reach_[c] = static_cast<int>(c) < dimension ? static_cast<int>(2 * input.h / body.spacing[c]) + 1 : 0;
  std::array<int, 3> n{};
  for (n[2] = -reach_[2]; n[2] <= reach_[2]; ++n[2])
    for (n[1] = -reach_[1]; n[1] <= reach_[1]; ++n[1])
      for (n[0] = -reach_[0]; n[0] <= reach_[0]; ++n[0]) {
        double s = 0, W = 0;
        double const square = lattice_square(body, {}, n);
        if (square > 0) input.kernel(input.h, square, s, W);
        number_.push_back(W > 0 ? static_cast<std::int32_t>(offsets_.size()) : -1);
        if (!(W > 0)) continue;
        StencilOffset o{};
        o.s = rounded ? static_cast<double>(static_cast<float>(s)) : s;
        for (std::size_t c = 0; c < 3; ++c) {
          o.r[c] = n[c] * body.spacing[c];
          o.sr[c] = o.s * o.r[c];
        }
        o.r2 = square;
        offsets_.push_back(o);
        kernel_.push_back(W);
      }
}

/// Number of the offset from one place of the lattice to another; negative: they are no neighbours.
std::int32_t LatticeStencils::offset_between(std::array<int, 3> const& from, std::array<int, 3> const& to) const {
  std::int32_t cell = 0;
  for (std::size_t c = 3; c-- > 0;) cell = cell * (2 * reach_[c] + 1) + to[c] - from[c] + reach_[c];
  return number_[at(cell)];
}

LatticeStencils::Fill LatticeStencils::find_patterns(ParticleSet const& set, BodyInput const& body,
                                                     std::span<Offset const> begin, std::span<Index const> neighbour,
                                                     int lanes) {
  auto const& place = set.lattice_index.seen();
  auto const W = static_cast<std::size_t>(lanes);
  std::vector<Index> distance(offsets_.size() * W);
  std::map<GroupShape, std::int32_t> known;
  pattern_of_.assign(at((static_cast<Index>(body.geometry.last) - first_ + lanes - 1) / lanes), 0);
  Fill fill;
  for (Index group = body.own.first; group < body.own.last; group += lanes) {
    std::fill(distance.begin(), distance.end(), absent);
    for (Index i = group; i < std::min(group + lanes, body.own.last); ++i)
      for (Offset k = begin[at(i)]; k < begin[at(i) + 1]; ++k) {
        Index const j = neighbour[at(k)];
        if (j >= static_cast<Index>(set.size())) continue;
        std::int32_t const o = offset_between(place[at(i)], place[at(j)]);
        if (o < 0) return {0, 0, false};  // not a lattice after all
        distance[at(o) * W + at(i - group)] = j - i;
        farthest_ = std::max(farthest_, std::abs(j - i));
        ++fill.present;
      }
    GroupShape shape = shape_of_group(distance, lanes);
    fill.all += std::ssize(shape) / 3 * lanes;
    auto const [found, is_new] = known.try_emplace(std::move(shape), static_cast<std::int32_t>(known.size()));
    pattern_of_[at((group - first_) / lanes)] = found->second;
    if (is_new) add_pattern(found->first, lanes);
  }
  for (std::int32_t bits = 0; bits < 1 << lanes; ++bits)
    for (int l = 0; l < lanes; ++l) weights_.push_back(((bits >> l) & 1) != 0 ? 1.0 : 0.0);
  return fill;
}

void LatticeStencils::add_pattern(std::span<std::int32_t const> entries, int lanes) {
  StencilPattern pattern{};
  pattern.inner[0] = static_cast<std::int32_t>(entries_.size());
  for (std::size_t e = 0; e < entries.size(); e += 3)
    entries_.push_back({entries[e + 1], entries[e], entries[e + 2] == (1 << lanes) - 1 ? -1 : entries[e + 2] * lanes});
  pattern.inner[1] = pattern.outer[0] = pattern.outer[1] = static_cast<std::int32_t>(entries_.size());
  patterns_.push_back(pattern);
}

/// Allocates padding for whole lanes beyond both ends of the body.
void LatticeStencils::allocate(Body const& body, int components) {
  constexpr Index line = 8;
  auto const up = [](Index n) { return (n + line - 1) / line * line; };
  margin_ = up(farthest_ + line);
  stride_ = 2 * static_cast<std::ptrdiff_t>(margin_) + up(static_cast<Index>(body.last - body.first)) + line;
  // Components that are equal modulo 4 KiB would evict each other from the first-level cache.
  while (stride_ % 512 != 264) stride_ += line;
  record_ = Memory(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(components));
}

MaterialRows LatticeStencils::view() {
  MaterialRows r;
  if (!is_lattice()) return r;
  r.first = first_;
  r.record = record_.data() + margin_;
  r.stride = stride_;
  r.empty = -1;
  r.stencil = {offsets_.data(), entries_.data(), patterns_.data(), pattern_of_.data(), weights_.data(), kernel_.data()};
  return r;
}

std::size_t LatticeStencils::bytes() const {
  return record_.bytes() + sizeof(StencilEntry) * entries_.size() + sizeof(StencilPattern) * patterns_.size() +
         sizeof(std::int32_t) * (pattern_of_.size() + number_.size()) + sizeof(double) * weights_.size();
}

}  // namespace piola::adaptle
