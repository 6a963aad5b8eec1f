// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/neighbours/reference_pairs.hpp"
#include "piola/particles/ordering.hpp"
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace piola {

/// Images of a body's particles behind its mirror planes, within the support radius; edges and corners of planes give
/// images of images. Images are ordinary neighbours. Theory: docs/theory/boundaries.md.
class MirrorImages {
 public:
  /// Transformation of values from a particle to its image. Skew planes invert vectors of motion, not those of
  /// geometry.
  enum class Kind { scalar, geometric_vector, vector, position, tensor, deformation };

  /// `reach`: distance from the body, per direction, within which images are created [m]. Throws InputError for an
  /// invalid plane. A plane goes through the outermost particles, or half a spacing outside of them if the body ends
  /// there.
  MirrorImages(Assembly const& assembly, std::size_t body, SlotOrder const& order, std::array<double, 3> const& reach);

  bool empty() const { return !mirrored_; }
  bool skew() const { return skew_; }
  Index count() const { return static_cast<Index>(particles_.source.size()); }
  CopiedParticles const& particles() const { return particles_; }
  /// Volume of a particle in the continued body over that in the body itself: a factor of 2 for each plane through it.
  double multiplicity(Index slot) const { return mirrored_ ? multiplicity_[static_cast<std::size_t>(slot)] : 1; }
  /// Whether the particle is on a plane across this axis.
  bool on_plane(Index slot, std::size_t axis) const {
    return mirrored_ && (on_plane_[static_cast<std::size_t>(slot)] >> axis & 1U) != 0;
  }
  bool has_plane(std::size_t axis, bool upper) const { return plane_[axis][upper ? 1 : 0].mirror; }
  /// Whether the body is continued periodically between two planes.
  bool endless(std::size_t axis) const { return has_plane(axis, false) && has_plane(axis, true); }
  /// Factors of the components of vectors from the source to image k.
  std::array<double, 3> const& sign(Index k) const {
    return maps_[static_cast<std::size_t>(transform_[static_cast<std::size_t>(k)])].sign;
  }
  /// X -> sign X + shift, axis by axis; a displacement turns into turn * sign * itself.
  struct Map {
    std::array<double, 3> sign, shift;
    double turn;
  };
  /// The maps of the body to what is behind its planes.
  std::vector<Map> const& maps() const { return maps_; }
  /// Coordinate of a plane across an axis [m].
  double plane(std::size_t axis, bool upper) const { return at_[axis][upper ? 1 : 0]; }
  /// Keeps only these images (ascending). Call before copies().
  void keep(std::vector<Index> const& images);
  /// Supports that enforce the planes: particles on a plane have no velocity across it, or along it if skew.
  std::vector<Support> const& planes() const { return planes_; }
  /// Returns the copy instructions for a buffer with these consecutive values; nullptr if there are no images.
  Copies const* copies(std::vector<Kind> const& values);
  /// As above. turns(value, axis): whether a mirror across the axis inverts the sign of the value.
  Copies const* copies(int values, std::function<bool(int value, int axis)> const& turns);

 private:
  struct AxisMap {
    double sign, shift, turn;
  };
  struct Plane {
    bool mirror = false, skew = false;
    double turn() const { return skew ? -1 : 1; }
  };
  struct Table {
    Copies copies;
    std::vector<double> sign, shift;
  };
  void find_planes(Assembly const& assembly, std::size_t body, SlotOrder const& order);
  void find_places(Assembly const& assembly, std::size_t body);
  std::vector<AxisMap> maps_along(std::size_t axis, double reach) const;
  void add_shifts(std::vector<Kind> const& values, std::vector<double>& shifts) const;
  void add_images(Assembly const& assembly, SlotOrder const& order, std::array<double, 3> const& reach);

  bool mirrored_ = false, skew_ = false;
  int D_;
  double tolerance_ = 0;                       ///< positions closer than this are equal [m]
  std::array<double, 3> low_, high_;           ///< of the body's particles [m]
  std::array<std::array<double, 2>, 3> at_{};  ///< coordinates of possible planes [m]
  std::array<std::array<Plane, 2>, 3> plane_{};
  std::vector<Map> maps_;
  Index first_ = 0;
  CopiedParticles particles_;
  std::vector<std::int32_t> transform_;
  std::vector<double> multiplicity_;
  std::vector<std::uint8_t> on_plane_;  ///< a bit per axis
  std::vector<Support> planes_;
  std::vector<std::array<double, 3>> source_X_;
  std::vector<std::unique_ptr<Table>> tables_;
};

}  // namespace piola
