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

/// Part of one patch of a solid's surface that a particle represents.
struct PatchWeight {
  int patch = 0;
  std::int64_t particle = 0;       ///< id
  double area = 0;                 ///< [m2; 2D m]; the parts sum to the patch
  std::array<double, 3> vector{};  ///< vector area, outward; those of a closed surface sum to zero
  std::array<double, 3> middle{};  ///< of this part of the surface [m]
};

/// Action after a sweep of a packing: do the next sweep; take the packing as it is; or keep it for a later run and end
/// set-up with SetUpStopped.
enum class AfterSweep { go_on, take, keep };

/// The particles of a solid, generated on first access and then kept. Copies of a shape share them.
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

  /// Returns the particles of a shape, generated on the first call. Precondition: `shape` is of kind `solid` and holds
  /// this object.
  static SolidParticles const& of(ShapeSpec const& shape);

  // Set these before the first access.
  /// Regions of a packed solid. Each part and the rest is packed by itself, so that no particle's cell crosses their
  /// surfaces. A place in several parts belongs to the first.
  std::vector<geometry::SolidPtr> parts = {};
  std::function<AfterSweep(double)> progress = {};  ///< called after each sweep of a packing with the fraction done
  std::string key = {};  ///< all input on which the positions depend; empty: no stored packing is read
  std::vector<std::filesystem::path> folders{};  ///< searched for the packing of an earlier run
  std::filesystem::path cache = {};              ///< folder into which a new packing is written; empty: none
  /// Folder for the unfinished packing of a stopped set-up, from which a later one continues; empty: none.
  std::filesystem::path unfinished = {};

  /// Writes the packing into a folder, if there is one. Throws FileError.
  void save(std::filesystem::path const& folder) const;

  /// Returns patch_weights(), computed on the first call.
  std::vector<PatchWeight> shares(ShapeSpec const& shape, ParticleSet const& particles, Body const& body);
  /// Returns the thinnest place of the solid, by pieces of a spacing; computed on the first call.
  std::optional<geometry::Thinnest> thinnest(ShapeSpec const& shape);

 private:
  void make(ShapeSpec const& shape);
  void take(ShapeSpec const& shape);
  std::vector<geometry::Packing> packings_ = {};  ///< one, or of each part and the rest
  std::vector<std::string> keys_ = {};            ///< of each
  std::once_flag once_, shared_, measured_;
  std::optional<geometry::Thinnest> thinnest_;
  std::vector<PatchWeight> shares_;
};

/// Appends the particles of a solid to a set; lattice indices, volumes and the outline of `body` with them. Called by
/// `fill`.
void fill_solid(ShapeSpec const& shape, ParticleSet& set, Body& body);

/// Appends points from a file to a set. They keep their order and have no outline.
void fill_points(ShapeSpec const& shape, ParticleSet& set, Body& body);

/// Assigns each piece of the surface, a quarter of a spacing wide, to the nearest particle. Ordered by patch, then by
/// id.
std::vector<PatchWeight> patch_weights(ShapeSpec const& shape, ParticleSet const& particles, Body const& body);

}  // namespace piola
