// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/shapes.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/geometry/packing.hpp"
#include "piola/math/hash.hpp"
#include "piola/setup/cloud_file.hpp"
#include "piola/setup/random_cloud.hpp"
#include "piola/setup/rings.hpp"
#include "piola/setup/solid_bodies.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;
using Index3 = std::array<int, 3>;

/// The lattice on which a body is born: points first + i * spacing.
struct Lattice {
  Vec3 first{};
  Vec3 spacing{1, 1, 1};
  Index3 count{1, 1, 1};
};

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

bool are_points(ShapeSpec const& shape) { return shape.kind == ShapeSpec::Kind::points; }
bool is_solid(ShapeSpec const& shape) { return shape.kind == ShapeSpec::Kind::solid; }
bool in_rings(ShapeSpec const& shape) {
  return !is_solid(shape) && !are_points(shape) && shape.arrangement != ShapeSpec::Arrangement::lattice;
}

// Cells over a length; a number that no lattice can have is kept at the largest int and refused by the caller.
int cells_over(double length, double spacing) {
  double const cells = std::round(length / spacing);
  if (!(cells < std::numeric_limits<int>::max())) return std::numeric_limits<int>::max();
  return std::max(1, static_cast<int>(cells));
}

bool along_axis(ShapeSpec const& shape, int d) { return shape.kind == ShapeSpec::Kind::cylinder && d == shape.axis; }

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

Lattice lattice_of(ShapeSpec const& shape) {
  return shape.kind == ShapeSpec::Kind::box ? box_lattice(shape) : round_lattice(shape);
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
  bool contains(std::int64_t i) const { return i < hole.begin || i >= hole.end; }
};

BodyRow inside_row(ShapeSpec const& shape, Lattice const& lattice, int j, int k) {
  // Points on the inner surface belong to the body in spite of rounding.
  constexpr double rounding = 1e-12;
  if (shape.kind == ShapeSpec::Kind::box) return {{0, lattice.count[0]}, {}};
  BodyRow row{row_within(shape, lattice, shape.radius * shape.radius, j, k), {}};
  double const inner2 = shape.inner_radius * shape.inner_radius;
  if (inner2 > 0) row.hole = row_within(shape, lattice, inner2 * (1 - rounding), j, k);
  return row;
}

double share_of_cell(ShapeSpec const& shape, Lattice const& lattice, Index3 const& index) {
  double share = 1;
  for (int d = 0; d < shape.dimension; ++d) {
    auto const i = static_cast<std::size_t>(d);
    if (!on_faces(shape, d) || lattice.count[i] == 1) continue;
    if (index[i] == 0 || index[i] == lattice.count[i] - 1) share /= 2;
  }
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
  return X;
}

/// The shift of a particle is a function of the seed, its place in the lattice (x fastest) and the axis alone: whoever
/// makes it, beside whichever others, it is the same.
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

/// The exact region of a shape, whatever its particles are.
Outline outline_of(ShapeSpec const& shape) {
  if (shape.kind == ShapeSpec::Kind::box) return {shape.min, shape.max};
  Outline outline;
  for (int d = 0; d < shape.dimension; ++d) {
    auto const i = static_cast<std::size_t>(d);
    bool const along = along_axis(shape, d);
    outline.min[i] = along ? shape.centre[i] : shape.centre[i] - shape.radius;
    outline.max[i] = along ? shape.centre[i] + shape.length : shape.centre[i] + shape.radius;
  }
  outline.inside = [shape](Vec3 const& X) {
    double square = 0;
    for (int d = 0; d < shape.dimension; ++d) {
      auto const i = static_cast<std::size_t>(d);
      if (!along_axis(shape, d)) square += (X[i] - shape.centre[i]) * (X[i] - shape.centre[i]);
    }
    return square <= shape.radius * shape.radius && square >= shape.inner_radius * shape.inner_radius;
  };
  return outline;
}

double row_count_estimate(ShapeSpec const& shape, Lattice const& lattice) {
  double total = 1;
  for (int const n : lattice.count) total *= n;
  if (shape.kind == ShapeSpec::Kind::box) return total;
  return total * 0.5;  // between pi/6 and pi/4 of the enclosing lattice is inside
}

}  // namespace

std::int64_t count_particles(ShapeSpec const& shape) {
  constexpr double countable = 1e8;
  if (are_points(shape)) return shape.cloud ? static_cast<std::int64_t>(shape.cloud->X.size()) : 0;
  if (is_solid(shape))
    return static_cast<std::int64_t>(
        std::min(geometry::packed_count(shape.volume, shape.spacing, shape.dimension), 9e18));
  if (in_rings(shape)) return static_cast<std::int64_t>(std::min(count_ring_particles(shape), 9e18));
  Lattice const lattice = lattice_of(shape);
  double const estimate = row_count_estimate(shape, lattice);
  if (shape.kind == ShapeSpec::Kind::box || estimate > countable) {
    return static_cast<std::int64_t>(std::min(estimate, 9e18));
  }
  bool const along_z = along_axis(shape, 2), along_y = along_axis(shape, 1);
  std::int64_t count = 0;
  for (int k = 0; k < (along_z ? 1 : lattice.count[2]); ++k) {
    for (int j = 0; j < (along_y ? 1 : lattice.count[1]); ++j) {
      count += inside_row(shape, lattice, j, k).count();
    }
  }
  return count * (along_z ? lattice.count[2] : 1) * (along_y ? lattice.count[1] : 1);
}

std::array<double, 3> spacing_of(ShapeSpec const& shape) {
  if (is_solid(shape) || are_points(shape)) {
    std::array<double, 3> spacing{1, 1, 1};
    for (std::size_t c = 0; c < static_cast<std::size_t>(shape.dimension); ++c) spacing[c] = shape.spacing;
    return spacing;
  }
  if (!in_rings(shape)) return lattice_of(shape).spacing;
  double const width = shape.radius - shape.inner_radius;
  double const d = shape.inner_radius > 0 ? width / cells_over(width, shape.spacing) : shape.spacing;
  return {d, d, 1};
}

int particles_over(double length, double spacing, ShapeSpec::Placement placement) {
  double const cells = std::round(length / spacing);
  if (!(cells < std::numeric_limits<int>::max() - 1)) return std::numeric_limits<int>::max();
  int const n = std::max(0, static_cast<int>(cells));
  if (placement == ShapeSpec::Placement::on_boundary) return n + 1;
  return std::max(1, n);
}

namespace {

void fill_rings(ShapeSpec const& shape, ParticleSet& set, Body& body) {
  RingParticles const rings = ring_particles(shape);
  body.spacing = rings.spacing;
  body.lattice = rings.lattice;
  body.regular = false;
  body.scattered = true;
  auto const append = [](auto const& from, auto& to) {
    auto& own = to.own();
    own.insert(own.end(), from.begin(), from.end());
  };
  append(rings.X, set.X);
  append(rings.lattice_index, set.lattice_index);
  append(rings.volume, set.volume);
  append(rings.volume, set.kernel_volume);
  set.body.resize(set.X.size(), static_cast<int>(set.bodies.size()));
}

void fill_lattice(ShapeSpec const& shape, ParticleSet& set, Body& body) {
  Lattice const lattice = lattice_of(shape);
  body.spacing = lattice.spacing;
  body.lattice = lattice.count;
  body.regular = !(shape.jitter > 0) && !shape.random;
  double cell = 1;
  for (int d = 0; d < shape.dimension; ++d) cell *= lattice.spacing[static_cast<std::size_t>(d)];
  auto const planes = static_cast<std::size_t>(lattice.count[2]), across = static_cast<std::size_t>(lattice.count[1]);
  // Where the particles of each row begin.
  std::vector<std::size_t> begin{set.X.size()};
  begin.reserve(planes * across + 1);
  for (int k = 0; k < lattice.count[2]; ++k)
    for (int j = 0; j < lattice.count[1]; ++j)
      begin.push_back(begin.back() + static_cast<std::size_t>(inside_row(shape, lattice, j, k).count()));
  auto const size = begin.back();
  auto& X = set.X.own();
  auto& lattice_index = set.lattice_index.own();
  auto& volume = set.volume.own();
  X.resize(size);
  lattice_index.resize(size);
  volume.resize(size);
  set.kernel_volume.resize(size, cell);
  set.body.resize(size, static_cast<int>(set.bodies.size()));
  exec_host::for_each_part_in_set_up(static_cast<Index>(planes * across), static_cast<Index>(size - begin.front()),
                                     [&](Index number) {
                                       auto const row = static_cast<std::size_t>(number);
                                       int const j = number % lattice.count[1], k = number / lattice.count[1];
                                       BodyRow const inside = inside_row(shape, lattice, j, k);
                                       std::size_t at = begin[row];
                                       for (std::int64_t i = inside.all.begin; i < inside.all.end; ++i) {
                                         if (!inside.contains(i)) continue;
                                         lattice_index[at] = {static_cast<int>(i), j, k};
                                         X[at] = position(shape, lattice, lattice_index[at]);
                                         if (shape.jitter > 0) shake(shape, lattice, lattice_index[at], X[at]);
                                         volume[at] = cell * share_of_cell(shape, lattice, lattice_index[at]);
                                         ++at;
                                       }
                                     });
}

}  // namespace

void fill(ShapeSpec const& shape, std::string const& name, ParticleSet& set) {
  PIOLA_EXPECTS(shape.dimension >= 1 && shape.dimension <= 3);
  Body body;
  body.name = name;
  body.first = set.size();
  if (!is_solid(shape) && !are_points(shape)) body.outline = outline_of(shape);
  if (is_solid(shape))
    fill_solid(shape, set, body);
  else if (are_points(shape))
    fill_points(shape, set, body);
  else if (in_rings(shape))
    fill_rings(shape, set, body);
  else
    fill_lattice(shape, set, body);
  body.last = set.size();
  if (!set.crack_side.empty()) set.crack_side.resize(set.X.size());
  set.dimension = shape.dimension;
  if (shape.random) scatter(shape, set, body);
  set.bodies.push_back(std::move(body));
}

}  // namespace piola
