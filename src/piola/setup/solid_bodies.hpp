// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/packing.hpp"
#include "piola/geometry/thickness.hpp"
#include "piola/setup/shapes.hpp"
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

namespace piola {

/// What a particle stands for of one patch of a solid's surface.
struct PatchShare {
  int patch = 0;
  std::int64_t particle = 0;       ///< id
  double area = 0;                 ///< [m2; 2D m]; the shares sum to the patch
  std::array<double, 3> vector{};  ///< vector area, outward; those of a closed surface sum to zero
  std::array<double, 3> middle{};  ///< of this part of the surface [m]
};

/// What follows a sweep of a packing: the next one; or the packing is taken as it is; or it is kept for a later run,
/// and set-up ends with SetUpStopped.
enum class AfterSweep { go_on, take, keep };

/// The particles of a solid, made when they are first asked for and then kept; shapes that are copies share them.
class SolidParticles {
 public:
  std::vector<std::array<double, 3>> X;           ///< [m]
  std::vector<std::array<int, 3>> lattice_index;  ///< packed: the cell of a spacing in which it lies
  std::array<int, 3> lattice{1, 1, 1};
  double volume = 0;            ///< of each particle; of a solid in parts their mean
  std::vector<double> volumes;  ///< of a solid in parts: of each particle
  double spacing = 0;           ///< [m]
  int sweeps = 0;               ///< packed
  bool rough = false;           ///< packed: taken before it was finished (AfterSweep::take)

  /// Of a shape of the kind `solid`, which must be the one that it belongs to.
  static SolidParticles const& of(ShapeSpec const& shape);

  // Set before anybody asks.
  /// Packed solids are cut along these, and each part, and the rest, is packed by itself: no particle's cell lies
  /// across. What several of them hold belongs to the first.
  std::vector<geometry::SolidPtr> parts = {};
  std::function<AfterSweep(double)> progress = {};  ///< called after each sweep of a packing with the fraction done
  std::string key = {};                             ///< all that the places depend on; empty: nothing is looked for
  std::vector<std::filesystem::path> folders{};     ///< where the packing may lie from an earlier run
  std::filesystem::path cache = {};                 ///< folder to which it goes once it is made; empty: none
  /// Folder for what a set-up that was stopped has packed, and where a later one looks for it; empty: none.
  std::filesystem::path unfinished = {};

  /// Writes the packing into a folder, if there is one. Throws FileError.
  void save(std::filesystem::path const& folder) const;

  /// patch_shares, found once.
  std::vector<PatchShare> shares(ShapeSpec const& shape, ParticleSet const& particles, Body const& body);
  /// Where the solid is thinnest, by pieces of a spacing; found once.
  std::optional<geometry::Thinnest> thinnest(ShapeSpec const& shape);

 private:
  void make(ShapeSpec const& shape);
  void take(ShapeSpec const& shape);
  std::vector<geometry::Packing> packings_ = {};  ///< one, or of each part and the rest
  std::vector<std::string> keys_ = {};            ///< of each
  std::once_flag once_, shared_, measured_;
  std::optional<geometry::Thinnest> thinnest_;
  std::vector<PatchShare> shares_;
};

/// Appends them to a set; lattice indices, volumes and the outline of `body` with them. Called by `fill`.
void fill_solid(ShapeSpec const& shape, ParticleSet& set, Body& body);

/// The same for points from a file, which keep their order and have no outline.
void fill_points(ShapeSpec const& shape, ParticleSet& set, Body& body);

/// Each piece of the surface, a quarter of a spacing wide, goes to the nearest particle. Ordered by patch, then by id.
std::vector<PatchShare> patch_shares(ShapeSpec const& shape, ParticleSet const& particles, Body const& body);

}  // namespace piola
