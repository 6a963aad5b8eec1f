// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/blended_planes.hpp"
#include "piola/mechanics/contact/surface.hpp"
#include <vector>

namespace piola::contact {

/// Surface points of all bodies, numbered by body and in the order of its surface: their planes in the current
/// configuration, and their displacements since the last evaluation. Only active points are placed.
class SurfacePoints {
 public:
  struct Point {
    Index host;
    std::size_t body;
    Vec<3> S, N;
    double area;
    bool image;
  };
  SurfacePoints(ParticleSet const& particles, std::vector<Surface> surfaces);
  /// Keeps the deformation gradients of the last evaluation, for friction.
  void track_motion();
  void set_area(Index point, double area) { points_[at(point)].area = area; }  ///< [m^(Dim-1)]
  void set_masses(std::vector<double> const& masses);                          ///< by index into ids() [kg]

  std::vector<Surface> const& surfaces() const { return surfaces_; }
  Surface const& surface_of(Index point) const { return surfaces_[points_[at(point)].body]; }
  HostParticles const& hosts() const { return hosts_; }
  std::vector<std::int64_t> const& ids() const { return hosts_.ids(); }
  std::vector<double> const& inverse_masses() const { return inverse_masses_; }  ///< by index into ids() [1/kg]

  Index count() const { return static_cast<Index>(points_.size()); }
  Point const& operator[](Index point) const { return points_[at(point)]; }
  /// Number of point `point` of a body.
  Index number_of(std::size_t body, std::size_t point) const;
  /// Index into ids() of the host particle.
  Index particle(Index point) const { return hosts_.self(points_[at(point)].host); }
  double inverse_mass(Index point) const { return inverse_masses_[at(particle(point))]; }  ///< [1/kg]
  Plane const& plane(Index point) const { return planes_[at(point)]; }
  Mat<3> const& F(Index host) const { return F_[at(host)]; }

  /// Activates the marked points and their hosts.
  void activate(std::vector<char> const& marked);
  bool any_active() const { return !active_points_.empty(); }
  /// Starts an evaluation: the current deformation gradients become the last ones.
  void advance();
  /// Computes deformation gradients and planes at x, by index into ids() [m].
  void place(std::vector<Vec<3>> const& x);

  /// Ends an evaluation at x [m].
  void set_last(std::vector<Vec<3>> const& x) { last_x_ = x; }
  std::vector<Vec<3>> const& last_x() const { return last_x_; }  ///< of the last evaluation [m]; empty before the first
  Mat<3> const& last_F(Index host);
  /// Position at the last evaluation [m].
  Vec<3> last_position(Index point);
  /// Displacement since the last evaluation [m]. Precondition: track_motion().
  Vec<3> displacement(Index point);
  std::size_t bytes() const;

 private:
  std::vector<Surface> surfaces_;
  HostParticles hosts_;
  std::vector<Point> points_;
  std::vector<double> inverse_masses_;
  std::vector<Index> active_points_, active_hosts_;
  std::vector<Mat<3>> F_;      ///< of active hosts, by host
  std::vector<Plane> planes_;  ///< of active points, by point
  bool tracks_motion_ = false;
  std::vector<Mat<3>> last_F_;                ///< by host; of inactive ones computed on demand
  std::vector<char> knows_F_, knows_last_F_;  ///< by host
  std::vector<Vec<3>> last_x_;
};

}  // namespace piola::contact
