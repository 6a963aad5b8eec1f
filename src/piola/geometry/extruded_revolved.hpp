// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/profile.hpp"
#include "piola/geometry/solid.hpp"

namespace piola::geometry {

/// Solids whose distance is that of a plane profile: all the primitives of a case file.

/// A region of the plane, for cases in 2D.
class Flat final : public Solid {
 public:
  explicit Flat(Profile profile) : profile_(std::move(profile)) {}
  int dimension() const override { return 2; }
  Foot at(Vec<3> const& X) const override;
  Bounds bounds() const override;
  std::optional<double> exact_volume() const override { return profile_.area(); }
  std::vector<Patch> patches() const override;
  void cut_surface(double edge, std::vector<SurfacePiece>& pieces) const override;

 private:
  Profile profile_;
};

/// A profile in x, y drawn along z. Its last patches are the ends, "-z" and "+z".
class Extruded final : public Solid {
 public:
  Extruded(Profile profile, double from, double to) : profile_(std::move(profile)), from_(from), to_(to) {}
  Foot at(Vec<3> const& X) const override;
  Bounds bounds() const override;
  std::optional<double> exact_volume() const override { return profile_.area() * (to_ - from_); }
  std::vector<Patch> patches() const override;
  void cut_surface(double edge, std::vector<SurfacePiece>& pieces) const override;

 private:
  void cut_ends(double edge, std::vector<SurfacePiece>& pieces) const;
  Profile profile_;
  double from_, to_;
};

/// A profile in radius and height turned about the z axis.
class Revolved final : public Solid {
 public:
  explicit Revolved(Profile profile) : profile_(std::move(profile)) {}
  Foot at(Vec<3> const& X) const override;
  Bounds bounds() const override;
  std::optional<double> exact_volume() const override { return profile_.revolved_volume(); }
  std::vector<Patch> patches() const override;
  void cut_surface(double edge, std::vector<SurfacePiece>& pieces) const override;

 private:
  Profile profile_;
};

}  // namespace piola::geometry
