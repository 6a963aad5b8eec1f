// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/lattice_generator.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/hash.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;
using Index3 = std::array<int, 3>;
using Lattice = GenerationLattice;

/// Particles closer to the axis than this are on it [spacings].
constexpr double on_axis = 1e-6;

struct Rows {
  std::int64_t begin = 0, end = 0;  ///< lattice indices along the first direction [begin, end)
};

bool single(ShapeSpec const& shape, int d) { return shape.particles[static_cast<std::size_t>(d)] <= 1; }

Lattice box_lattice(ShapeSpec const& shape) {
  Lattice lattice;
  for (int d = 0; d < shape.dimension; ++d) {
    auto const i = static_cast<std::size_t>(d);
    double const length = shape.max[i] - shape.min[i];
    int const n = std::max(1, shape.particles[i]);
    bool const cells = shape.placement == ShapeSpec::Placement::cell_centred || single(shape, d);
    lattice.count[i] = n;
    lattice.spacing[i] = cells ? length / n : length / (n - 1);
    lattice.first[i] = cells ? shape.min[i] + lattice.spacing[i] / 2 : shape.min[i];
  }
  return lattice;
}

/// Whether the outermost particles in direction d lie on the faces.
bool on_faces(ShapeSpec const& shape, int d) {
  bool const flat = shape.kind == ShapeSpec::Kind::box || along_axis(shape, d);
  return flat && shape.placement == ShapeSpec::Placement::on_boundary;
}

Lattice round_lattice(ShapeSpec const& shape) {
  Lattice lattice;
  for (int d = 0; d < shape.dimension; ++d) {
    auto const i = static_cast<std::size_t>(d);
    bool const along = along_axis(shape, d), faces = on_faces(shape, d);
    double const length = along ? shape.length : 2 * shape.radius;
    int const n = cells_over(length, shape.spacing);
    lattice.count[i] = faces ? n + 1 : n;
    lattice.spacing[i] = along ? length / n : shape.spacing;
    lattice.first[i] = !along  ? shape.centre[i] - 0.5 * (n - 1) * lattice.spacing[i]
                       : faces ? shape.centre[i]
                               : shape.centre[i] + lattice.spacing[i] / 2;
  }
  return lattice;
}

// Squared distance from the centre, or from the axis of a cylinder, that a lattice index adds in direction d.
double round_part(ShapeSpec const& shape, Lattice const& lattice, int d, std::int64_t index) {
  if (d >= shape.dimension || along_axis(shape, d)) return 0;
  auto const i = static_cast<std::size_t>(d);
  double const offset = (static_cast<double>(index) - 0.5 * (lattice.count[i] - 1)) * lattice.spacing[i];
  return offset * offset;
}

// The lattice points of row (j, k) within a radius: a contiguous range.
Rows row_within(ShapeSpec const& shape, Lattice const& lattice, double radius2, int j, int k) {
  std::int64_t const n = lattice.count[0];
  double const others = round_part(shape, lattice, 1, j) + round_part(shape, lattice, 2, k);
  auto const inside = [&](std::int64_t i) { return round_part(shape, lattice, 0, i) + others <= radius2; };
  std::int64_t const middle = (n - 1) / 2;
  if (!inside(middle)) return {0, 0};
  std::int64_t low = 0, high = middle;  // the first inside index is in [low, high]
  while (low < high) {
    std::int64_t const half = (low + high) / 2;
    if (inside(half))
      high = half;
    else
      low = half + 1;
  }
  return {low, n - low};
}

/// The lattice points of a row that are in the body, [begin, end) without those in the hole.
struct BodyRow {
  Rows all, hole;
  std::int64_t count() const { return all.end - all.begin - (hole.end - hole.begin); }
};

BodyRow inside_row(ShapeSpec const& shape, Lattice const& lattice, int j, int k) {
  // Points on the inner surface belong to the body in spite of rounding.
  constexpr double rounding = 1e-12;
  if (shape.kind == ShapeSpec::Kind::box) return {{0, lattice.count[0]}, {}};
  BodyRow row{row_within(shape, lattice, shape.radius * shape.radius, j, k), {}};
  double const inner2 = shape.inner_radius * shape.inner_radius;
  if (inner2 > 0) row.hole = row_within(shape, lattice, inner2 * (1 - rounding), j, k);
  if (shape.axisymmetric) {
    auto const from = static_cast<std::int64_t>(std::ceil(-lattice.first[0] / lattice.spacing[0] - on_axis));
    for (Rows* const part : {&row.all, &row.hole})
      *part = {std::max(part->begin, from), std::max({part->end, part->begin, from})};
  }
  return row;
}

double share_of_cell(ShapeSpec const& shape, Lattice const& lattice, Index3 const& index) {
  double share = 1;
  for (int d = 0; d < shape.dimension; ++d) {
    auto const i = static_cast<std::size_t>(d);
    if (!on_faces(shape, d) || lattice.count[i] == 1) continue;
    if (index[i] == 0 || index[i] == lattice.count[i] - 1) share /= 2;
  }
  if (shape.axisymmetric && shape.kind != ShapeSpec::Kind::box &&
      std::abs(lattice.first[0] + index[0] * lattice.spacing[0]) < on_axis * lattice.spacing[0])
    share /= 2;
  return share;
}

Vec3 position(ShapeSpec const& shape, Lattice const& lattice, Index3 const& index) {
  Vec3 X{};
  for (int d = 0; d < shape.dimension; ++d) {
    auto const i = static_cast<std::size_t>(d);
    X[i] = lattice.first[i] + index[i] * lattice.spacing[i];
    // The far face exactly, so that a region such as "Y >= L" selects it in spite of rounding.
    if (!on_faces(shape, d) || lattice.count[i] == 1 || index[i] < lattice.count[i] - 1) continue;
    X[i] = along_axis(shape, d) ? shape.centre[i] + shape.length : shape.max[i];
  }
  if (shape.axisymmetric && std::abs(X[0]) < on_axis * lattice.spacing[0]) X[0] = 0;
  return X;
}

/// The jitter of a particle depends only on the seed, its lattice position (x fastest) and the axis. It thus
/// does not depend on the partition.
void shake(ShapeSpec const& shape, Lattice const& lattice, Index3 const& index, Vec3& X) {
  if (share_of_cell(shape, lattice, index) < 1) return;  // on a face
  std::uint64_t place = 0;
  for (std::size_t i = 3; i-- > 0;)
    place = place * static_cast<std::uint64_t>(lattice.count[i]) + static_cast<std::uint64_t>(index[i]);
  constexpr std::uint64_t stream = std::uint64_t{1} << 32;  // other numbers than those of a material with this seed
  for (int d = 0; d < shape.dimension; ++d) {
    auto const i = static_cast<std::size_t>(d);
    X[i] += shape.jitter * lattice.spacing[i] * (2 * uniform(stream + shape.seed, 3 * place + i) - 1);
  }
}

}  // namespace

int cells_over(double length, double spacing) {
  double const cells = std::round(length / spacing);
  if (!(cells < std::numeric_limits<int>::max())) return std::numeric_limits<int>::max();
  return std::max(1, static_cast<int>(cells));
}

bool along_axis(ShapeSpec const& shape, int d) { return shape.kind == ShapeSpec::Kind::cylinder && d == shape.axis; }

GenerationLattice lattice_of(ShapeSpec const& shape) {
  return shape.kind == ShapeSpec::Kind::box ? box_lattice(shape) : round_lattice(shape);
}

LatticeGenerator::LatticeGenerator(ShapeSpec const& shape) : shape_(shape), lattice_(lattice_of(shape)) {
  PIOLA_EXPECTS(shape.kind != ShapeSpec::Kind::solid && shape.kind != ShapeSpec::Kind::points);
  for (int d = 0; d < shape.dimension; ++d) cell_ *= lattice_.spacing[static_cast<std::size_t>(d)];
}

std::int64_t LatticeGenerator::size() const {
  auto const [n, across, planes] = lattice_.count;
  if (shape_.kind == ShapeSpec::Kind::box) return std::int64_t{n} * across * planes;
  std::vector<std::int64_t> in_plane(static_cast<std::size_t>(planes), 0);
  double const rows = static_cast<double>(planes) * across;
  auto const shared = static_cast<Index>(std::min(rows, double{std::numeric_limits<Index>::max()}));
  exec_host::parallel_for_chunks(planes, shared, [&](Index k) {
    for (int j = 0; j < lattice_.count[1]; ++j)
      in_plane[static_cast<std::size_t>(k)] += inside_row(shape_, lattice_, j, k).count();
  });
  return std::accumulate(in_plane.begin(), in_plane.end(), std::int64_t{0});
}

std::vector<LatticeGenerator::Run> LatticeGenerator::runs() const {
  std::vector<Run> all;
  std::int64_t id = 0;
  for (int k = 0; k < lattice_.count[2]; ++k)
    for (int j = 0; j < lattice_.count[1]; ++j) {
      auto const [row, hole] = inside_row(shape_, lattice_, j, k);
      bool const holed = hole.end > hole.begin;
      for (Rows const& part :
           {Rows{row.begin, holed ? hole.begin : row.end}, Rows{holed ? hole.end : row.end, row.end}}) {
        if (part.end <= part.begin) continue;
        all.push_back({id, part.begin, part.end, j, k});
        id += part.end - part.begin;
      }
    }
  return all;
}

GeneratedParticle LatticeGenerator::at(std::array<int, 3> const& place) const {
  GeneratedParticle particle{position(shape_, lattice_, place), cell_ * share_of_cell(shape_, lattice_, place)};
  if (shape_.jitter > 0) shake(shape_, lattice_, place, particle.X);
  return particle;
}

}  // namespace piola
