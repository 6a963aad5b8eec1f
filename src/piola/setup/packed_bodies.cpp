// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/packed_bodies.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/stopped.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/geometry/boolean_solid.hpp"
#include "piola/geometry/packing.hpp"
#include "piola/geometry/patch_measures.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include "piola/neighbours/nearest_particle.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/particles/body_range.hpp"
#include "piola/setup/cloud_file.hpp"
#include "piola/setup/packing_file.hpp"
#include "piola/setup/solids_of_revolution.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace piola {
namespace {

using Point = std::array<double, 3>;

std::array<int, 3> cells_around(geometry::Bounds const& box, double spacing, int dimension) {
  std::array<int, 3> count{1, 1, 1};
  for (int c = 0; c < dimension; ++c)
    count[static_cast<std::size_t>(c)] =
        std::max(1, static_cast<int>(std::ceil((box.max[c] - box.min[c]) / spacing - 1e-9)));
  return count;
}

/// The cells of a lattice about the middle of the box whose middle is inside, row by row.
void cut_lattice(ShapeSpec const& shape, SolidParticles& to) {
  geometry::Bounds const box = shape.solid->bounds();
  to.spacing = shape.spacing;
  to.volume = std::pow(shape.spacing, shape.dimension);
  to.lattice = cells_around(box, shape.spacing, shape.dimension);
  Point first{};
  for (int c = 0; c < shape.dimension; ++c) {
    auto const i = static_cast<std::size_t>(c);
    first[i] = 0.5 * (box.min[c] + box.max[c]) - 0.5 * (to.lattice[i] - 1) * shape.spacing;
  }
  Index const rows = to.lattice[1] * to.lattice[2];
  std::vector<std::vector<int>> inside(static_cast<std::size_t>(rows));
  auto const place = [&](Index row, int i) {
    Point X{};
    std::array<int, 3> const at{i, row % to.lattice[1], row / to.lattice[1]};
    for (std::size_t c = 0; c < static_cast<std::size_t>(shape.dimension); ++c) X[c] = first[c] + at[c] * shape.spacing;
    return std::pair{X, at};
  };
  exec_host::parallel_for_chunks(rows, rows * to.lattice[0], [&](Index row) {
    for (int i = 0; i < to.lattice[0]; ++i)
      if (shape.solid->at(vector_of(place(row, i).first)).distance < 0)
        inside[static_cast<std::size_t>(row)].push_back(i);
  });
  for (Index row = 0; row < rows; ++row)
    for (int const i : inside[static_cast<std::size_t>(row)]) {
      auto const [X, at] = place(row, i);
      to.X.push_back(X);
      to.lattice_index.push_back(at);
    }
}

/// A region that is packed by itself.
struct Piece {
  geometry::SolidPtr solid;
  double volume = 0;
  std::string key;
};

/// The parts of a solid and what they leave.
std::vector<Piece> pieces_of(ShapeSpec const& shape, SolidParticles const& to) {
  using geometry::BooleanOperation;
  using geometry::combined;
  if (to.parts.empty()) return {{shape.solid, shape.volume, to.key}};
  std::vector<Piece> pieces;
  geometry::SolidPtr rest = shape.solid;
  double left = shape.volume;
  double const least = 0.5 * std::pow(shape.spacing, shape.dimension);
  auto const add = [&](geometry::SolidPtr solid, double volume) {
    if (volume > least)
      pieces.push_back({std::move(solid), volume, to.key + "\npart " + std::to_string(pieces.size())});
  };
  for (geometry::SolidPtr const& part : to.parts) {
    auto const common = combined(BooleanOperation::common, {rest, part});
    double const volume = std::min(left, geometry::volume_of(*common, shape.spacing));
    add(common, volume);
    rest = combined(BooleanOperation::cut, {rest, part});
    left -= volume;
  }
  add(rest, left);
  return pieces;
}

/// Keeps a packing that was stopped.
[[noreturn]] void stop(geometry::UnfinishedPacking const& packing, Piece const& piece, int most_sweeps,
                       SolidParticles const& to) {
  std::string const done = fmt::format("after {} of at most {} sweeps of a packing", packing.sweeps, most_sweeps);
  if (to.unfinished.empty())
    throw SetUpStopped("set-up was stopped " + done +
                       ", which is not kept (there is no folder for it) - allow more time");
  auto const path = to.unfinished / packing_name(piece.key);
  if (comm::rank() == 0) {
    make_folder(to.unfinished);
    write_unfinished(path, piece.key, packing);
  }
  throw SetUpStopped(fmt::format("{}: set-up was stopped {} - start the same command again, which continues from there",
                                 path.string(), done));
}

/// From the disk if it lies there, else made. `done`: of all pieces, the shares before and after this one.
geometry::Packing packing_of(Piece const& piece, double spacing, std::array<double, 2> const& done,
                             SolidParticles const& to) {
  std::string const name = packing_name(piece.key);
  for (auto const& folder : to.folders)
    if (auto found = read_packing(folder / name, piece.key)) return std::move(*found);
  geometry::PackingOptions options;
  if (!to.unfinished.empty()) {
    if (auto found = read_packing(to.unfinished / name, piece.key)) return std::move(*found);
    options.from = read_unfinished(to.unfinished / name, piece.key);
  }
  AfterSweep after_sweep = AfterSweep::go_on;
  options.progress = [&](int sweep) {
    if (to.progress) after_sweep = to.progress(done[0] + (done[1] - done[0]) * sweep / options.sweeps);
    return after_sweep == AfterSweep::go_on;
  };
  constexpr std::chrono::seconds worth_keeping{1};
  auto const start = std::chrono::steady_clock::now();
  geometry::Packing packing = geometry::pack(*piece.solid, piece.volume, spacing, options);
  if (packing.unfinished && after_sweep == AfterSweep::keep) stop(*packing.unfinished, piece, options.sweeps, to);
  bool const dear = options.from || std::chrono::steady_clock::now() - start > worth_keeping;
  if (dear && !packing.unfinished && !to.unfinished.empty() && comm::rank() == 0) {
    make_folder(to.unfinished);
    write_packing(to.unfinished / name, piece.key, packing);
  }
  return packing;
}

/// The cell of a spacing in which a place lies, z first.
std::array<int, 3> cell_of(Point const& X, geometry::Bounds const& box, SolidParticles const& of, int dimension) {
  std::array<int, 3> cell{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    double const at = (X[c] - box.min[static_cast<int>(c)]) / of.spacing;
    cell[2 - c] = std::clamp(static_cast<int>(at), 0, of.lattice[c] - 1);
  }
  return cell;
}

/// The surface of a solid in pieces of a sixth of a spacing, cut on first use.
class SurfacePieces {
 public:
  SurfacePieces(geometry::SolidPtr solid, double spacing) : solid_(std::move(solid)), edge_(spacing / 6) {}

  /// The nearest piece of each patch within `reach`, which is at most half a spacing.
  std::vector<PatchFoot> near(Point const& X, double reach) {
    std::call_once(cut_, [this] { cut(); });
    std::vector<std::pair<double, std::size_t>> nearest;
    grid_->visit(X, [&](Index k) {
      auto const piece = static_cast<std::size_t>(k);
      double square = 0;
      for (std::size_t c = 0; c < 3; ++c) square += (X[c] - middle_[piece][c]) * (X[c] - middle_[piece][c]);
      if (square > reach * reach) return;
      auto const same = std::ranges::find_if(
          nearest, [&](auto const& known) { return foot_[known.second].patch == foot_[piece].patch; });
      if (same == nearest.end())
        nearest.emplace_back(square, piece);
      else
        *same = std::min(*same, std::pair(square, piece));
    });
    std::vector<PatchFoot> feet;
    for (auto const& [square, piece] : nearest) feet.push_back(foot_[piece]);
    std::ranges::sort(feet, {}, &PatchFoot::patch);
    return feet;
  }

 private:
  void cut() {
    std::vector<geometry::SurfacePiece> pieces;
    solid_->cut_surface(edge_, pieces);
    for (auto const& piece : pieces) {
      double const area = std::sqrt(dot(piece.area, piece.area));
      if (!(area > 0)) continue;
      middle_.push_back(array_of(piece.X));
      // Half the diagonal of a square, half of a line.
      double const radius = solid_->dimension() == 3 ? std::sqrt(0.5 * area) : 0.5 * area;
      foot_.push_back({piece.patch, middle_.back(), array_of((1 / area) * piece.area), radius});
    }
    grid_.emplace(middle_, 3 * edge_);
  }

  geometry::SolidPtr solid_;
  double edge_;  ///< of pieces [m]
  std::once_flag cut_;
  std::vector<Point> middle_;
  std::vector<PatchFoot> foot_;
  std::optional<CellGrid> grid_;
};

/// Particles counted from the body's first.
std::vector<PatchWeight> find_shares(ShapeSpec const& shape, ParticleSet const& particles, Body const& body) {
  constexpr double rounding = 1e-9;
  double const spacing = body.spacing[0];
  std::vector<geometry::SurfacePiece> pieces;
  shape.solid->cut_surface(0.25 * spacing, pieces);
  if (particles.axisymmetric)
    for (auto& piece : pieces) piece.area = (piece.X[0] > rounding * spacing ? circle(piece.X[0]) : 0) * piece.area;
  NearestParticle const nearest(particles, body);
  std::vector<std::size_t> owner(pieces.size());
  exec_host::parallel_for(static_cast<Index>(pieces.size()), [&](Index i) {
    owner[static_cast<std::size_t>(i)] = nearest(array_of(pieces[static_cast<std::size_t>(i)].X));
  });
  std::map<std::pair<int, std::size_t>, PatchWeight> sums;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    PatchWeight& share = sums[{pieces[i].patch, owner[i]}];
    share.patch = pieces[i].patch;
    share.particle = static_cast<std::int64_t>(owner[i]);
    double const area = std::sqrt(dot(pieces[i].area, pieces[i].area));
    share.area += area;
    for (std::size_t c = 0; c < 3; ++c) {
      share.vector[c] += pieces[i].area[static_cast<int>(c)];
      share.middle[c] += area * pieces[i].X[static_cast<int>(c)];
    }
  }
  std::vector<PatchWeight> shares;
  for (auto& [key, share] : sums) {
    if (!(share.area > 0)) continue;
    for (double& c : share.middle) c /= share.area;
    shares.push_back(share);
  }
  return shares;
}

}  // namespace

SolidParticles const& SolidParticles::of(ShapeSpec const& shape) {
  PIOLA_EXPECTS(shape.kind == ShapeSpec::Kind::solid);
  PIOLA_EXPECTS(shape.solid != nullptr && shape.solid_particles != nullptr);
  SolidParticles& own = *shape.solid_particles;
  std::call_once(own.once_, [&] { own.make(shape); });
  return own;
}

void SolidParticles::make(ShapeSpec const& shape) {
  if (shape.arrangement != ShapeSpec::Arrangement::packed) return cut_lattice(shape, *this);
  double done = 0;
  for (Piece const& piece : pieces_of(shape, *this)) {
    double const after = done + piece.volume / shape.volume;
    packings_.push_back(packing_of(piece, shape.spacing, {done, after}, *this));
    rough = rough || packings_.back().unfinished;
    keys_.push_back(piece.key);
    done = after;
  }
  take(shape);
  if (!cache.empty() && !rough) save(cache);
}

/// The particles of all packings, those of a cell together: spatial neighbours are close in memory.
void SolidParticles::take(ShapeSpec const& shape) {
  std::size_t count = 0;
  for (geometry::Packing const& packing : packings_) {
    count += packing.X.size();
    sweeps = std::max(sweeps, packing.sweeps);
  }
  bool const whole = packings_.size() == 1;
  volume = whole ? packings_[0].volume : shape.volume / static_cast<double>(count);
  spacing = whole ? packings_[0].spacing : std::pow(volume, 1.0 / shape.dimension);
  geometry::Bounds const box = shape.solid->bounds();
  lattice = cells_around(box, spacing, shape.dimension);
  std::vector<std::pair<std::array<int, 3>, std::array<std::size_t, 2>>> order;
  for (std::size_t p = 0; p < packings_.size(); ++p)
    for (std::size_t a = 0; a < packings_[p].X.size(); ++a)
      order.push_back({cell_of(packings_[p].X[a], box, *this, shape.dimension), {p, a}});
  std::sort(order.begin(), order.end());
  for (auto const& [cell, at] : order) {
    X.push_back(packings_[at[0]].X[at[1]]);
    lattice_index.push_back({cell[2], cell[1], cell[0]});
    if (!whole) volumes.push_back(packings_[at[0]].volume);
  }
}

void SolidParticles::save(std::filesystem::path const& folder) const {
  PIOLA_EXPECTS(keys_.size() == packings_.size());
  for (std::size_t k = 0; k < packings_.size() && !key.empty(); ++k) {
    if (packings_[k].X.empty()) continue;
    auto const path = folder / packing_name(keys_[k]);
    if (!read_packing(path, keys_[k])) write_packing(path, keys_[k], packings_[k]);
  }
}

void fill_solid(ShapeSpec const& shape, ParticleSet& set, Body& body) {
  PIOLA_EXPECTS(shape.solid != nullptr && shape.spacing > 0);
  SolidParticles const& from = SolidParticles::of(shape);
  bool const packed = shape.arrangement == ShapeSpec::Arrangement::packed;
  body.spacing = {1, 1, 1};
  for (std::size_t c = 0; c < static_cast<std::size_t>(shape.dimension); ++c) body.spacing[c] = from.spacing;
  body.lattice = from.lattice;
  body.regular = !packed;
  body.off_lattice = packed;
  geometry::Bounds const box = shape.solid->bounds();
  auto const distance = [solid = shape.solid](Point const& X) { return solid->at(vector_of(X)).distance; };
  body.outline.min = array_of(box.min);
  body.outline.max = array_of(box.max);
  body.outline.inside = [distance](Point const& X) { return distance(X) <= 0; };
  if (shape.solid->distance_is_bound()) body.outline.distance = distance;
  body.outline.patches = [pieces = std::make_shared<SurfacePieces>(shape.solid, from.spacing)](
                             Point const& X, double reach) { return pieces->near(X, reach); };
  auto const append = [](auto const& some, auto& to) { to.own().insert(to.own().end(), some.begin(), some.end()); };
  append(from.X, set.X);
  append(from.lattice_index, set.lattice_index);
  append(from.volumes, set.volume);
  append(from.volumes, set.kernel_volume);
  set.volume.resize(set.X.size(), from.volume);
  set.kernel_volume.resize(set.X.size(), from.volume);
  set.body.resize(set.X.size(), static_cast<int>(set.bodies.size()));
}

void fill_points(ShapeSpec const& shape, ParticleSet& set, Body& body) {
  PIOLA_EXPECTS(shape.cloud != nullptr);
  PointCloud const& from = *shape.cloud;
  body.spacing = spacing_of(shape);
  body.regular = false;
  body.off_lattice = true;
  geometry::Bounds const box{vector_of(from.min), vector_of(from.max)};
  body.lattice = cells_around(box, from.spacing, from.dimension);
  for (Point const& X : from.X) {
    std::array<int, 3> cell{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(from.dimension); ++c)
      cell[c] = std::clamp(static_cast<int>((X[c] - from.min[c]) / from.spacing), 0, body.lattice[c] - 1);
    set.lattice_index.own().push_back(cell);
  }
  auto const append = [](auto const& some, auto& to) { to.own().insert(to.own().end(), some.begin(), some.end()); };
  append(from.X, set.X);
  append(from.volume, set.volume);
  append(from.kernel_volume, set.kernel_volume);
  set.body.resize(set.X.size(), static_cast<int>(set.bodies.size()));
}

std::vector<PatchWeight> patch_weights(ShapeSpec const& shape, ParticleSet const& particles, Body const& body) {
  PIOLA_EXPECTS(shape.solid_particles != nullptr);
  return shape.solid_particles->shares(shape, particles, body);
}

std::vector<PatchWeight> SolidParticles::shares(ShapeSpec const& shape, ParticleSet const& particles,
                                                Body const& body) {
  PIOLA_EXPECTS(shape.solid != nullptr && is_range_in(body, particles));
  std::call_once(shared_, [&] { shares_ = find_shares(shape, particles, body); });
  std::vector<PatchWeight> shares = shares_;
  for (PatchWeight& share : shares) share.particle += body.first;
  return shares;
}

std::optional<geometry::Thinnest> SolidParticles::thinnest(ShapeSpec const& shape) {
  PIOLA_EXPECTS(shape.solid != nullptr && shape.spacing > 0);
  std::call_once(measured_, [&] { thinnest_ = geometry::thinnest(*shape.solid, shape.spacing); });
  return thinnest_;
}

}  // namespace piola
