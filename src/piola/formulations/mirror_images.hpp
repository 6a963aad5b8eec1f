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

/// Images of a body's particles behind its mirror planes, as far as the kernel reaches; edges and corners of planes
/// give images of images. They are neighbours like any other. Theory: docs/theory/boundaries.md.
class MirrorImages {
 public:
  /// How values of a particle turn into those of its image: of the body's geometry, or of its motion, which a skew
  /// plane turns round.
  enum class Kind { scalar, geometric_vector, vector, position, tensor, deformation };

  /// `reach`: how far from the body images are wanted, per direction [m]. Throws InputError for a plane that the body
  /// cannot have. A plane goes through the outermost particles, or half a spacing outside of them where the body does.
  MirrorImages(Assembly const& assembly, std::size_t body, SlotOrder const& order, std::array<double, 3> const& reach);

  bool empty() const { return !mirrored_; }
  bool skew() const { return skew_; }
  Index count() const { return static_cast<Index>(particles_.source.size()); }
  CopiedParticles const& particles() const { return particles_; }
  /// Volume of a particle in the continued body over that in the body itself: twice per plane through it.
  double multiplicity(Index slot) const { return mirrored_ ? multiplicity_[static_cast<std::size_t>(slot)] : 1; }
  /// Whether the particle is on a plane across this axis.
  bool on_plane(Index slot, std::size_t axis) const {
    return mirrored_ && (on_plane_[static_cast<std::size_t>(slot)] >> axis & 1U) != 0;
  }
  bool has_plane(std::size_t axis, bool upper) const { return plane_[axis][upper ? 1 : 0].mirror; }
  /// Between two planes the body goes on without end.
  bool endless(std::size_t axis) const { return has_plane(axis, false) && has_plane(axis, true); }
  /// By which the components of vectors at image k are those of its source.
  std::array<double, 3> const& sign(Index k) const {
    return maps_[static_cast<std::size_t>(transform_[static_cast<std::size_t>(k)])].sign;
  }
  /// Leaves all images out but these, which are in increasing order. Before any call of copies().
  void keep(std::vector<Index> const& images);
  /// Particles on a plane have no velocity across it, those on a skew plane none along it.
  std::vector<Support> const& planes() const { return planes_; }
  /// How to copy a buffer with these values, one after the other; nullptr if there are no images.
  Copies const* copies(std::vector<Kind> const& values);
  /// The same for values that a mirror across an axis turns round or not.
  Copies const* copies(int values, std::function<bool(int value, int axis)> const& turns);

 private:
  /// X -> sign X + shift, axis by axis; a displacement turns into turn * sign * itself.
  struct Map {
    std::array<double, 3> sign, shift;
    double turn;
  };
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
  double tolerance_ = 0;                       ///< two places are the same [m]
  std::array<double, 3> low_, high_;           ///< of the body's particles [m]
  std::array<std::array<double, 2>, 3> at_{};  ///< where planes would be [m]
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
