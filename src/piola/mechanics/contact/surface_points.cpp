// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/surface_points.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace piola::contact {

SurfacePoints::SurfacePoints(ParticleSet const& particles, std::vector<Surface> surfaces)
    : surfaces_(std::move(surfaces)), hosts_(particles, surfaces_) {
  for (std::size_t b = 0; b < surfaces_.size(); ++b)
    for (std::size_t k = 0; k < surfaces_[b].points.size(); ++k) {
      SurfacePoint const& p = surfaces_[b].points[k];
      points_.push_back({hosts_.of(b, k), b, p.offset, p.normal, p.area, p.image});
    }
  F_.resize(at(hosts_.count()));
  planes_.resize(points_.size());
  inverse_masses_.resize(ids().size());
}

void SurfacePoints::track_motion() {
  tracks_motion_ = true;
  last_F_.resize(F_.size());
  knows_F_.resize(F_.size());
  knows_last_F_.resize(F_.size());
}

void SurfacePoints::set_masses(std::vector<double> const& masses) {
  PIOLA_EXPECTS(masses.size() == inverse_masses_.size());
  for (std::size_t k = 0; k < masses.size(); ++k) inverse_masses_[k] = masses[k] > 0 ? 1 / masses[k] : 0;
}

Index SurfacePoints::number_of(std::size_t body, std::size_t point) const {
  PIOLA_EXPECTS(body < surfaces_.size() && point < surfaces_[body].points.size());
  for (std::size_t b = 0; b < body; ++b) point += surfaces_[b].points.size();
  return static_cast<Index>(point);
}

void SurfacePoints::activate(std::vector<char> const& marked) {
  PIOLA_EXPECTS(marked.size() == points_.size());
  std::vector<char> has_active(at(hosts_.count()), 0);
  active_points_.clear();
  active_hosts_.clear();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (marked[k] == 0) continue;
    active_points_.push_back(static_cast<Index>(k));
    has_active[at(points_[k].host)] = 1;
  }
  for (std::size_t k = 0; k < has_active.size(); ++k)
    if (has_active[k] != 0) active_hosts_.push_back(static_cast<Index>(k));
}

void SurfacePoints::advance() {
  if (!tracks_motion_) return;
  std::swap(F_, last_F_);
  std::swap(knows_F_, knows_last_F_);
  std::fill(knows_F_.begin(), knows_F_.end(), 0);
}

void SurfacePoints::place(std::vector<Vec<3>> const& x) {
  exec_host::parallel_for(static_cast<Index>(active_hosts_.size()), [&](Index k) {
    Index const host = active_hosts_[at(k)];
    F_[at(host)] = hosts_.F(host, x);
    if (tracks_motion_) knows_F_[at(host)] = 1;
  });
  exec_host::parallel_for(static_cast<Index>(active_points_.size()), [&](Index k) {
    Index const point = active_points_[at(k)];
    Point const& p = points_[at(point)];
    Mat<3> const& F = F_[at(p.host)];
    Vec<3> const m = cofactor(F) * p.N;
    planes_[at(point)] = {x[at(hosts_.self(p.host))] + F * p.S, (1 / std::sqrt(square_of(m))) * m};
  });
}

Mat<3> const& SurfacePoints::last_F(Index host) {
  if (knows_last_F_[at(host)] == 0) {
    knows_last_F_[at(host)] = 1;
    last_F_[at(host)] = hosts_.F(host, last_x_);
  }
  return last_F_[at(host)];
}

Vec<3> SurfacePoints::last_position(Index point) {
  Point const& p = points_[at(point)];
  return last_x_[at(hosts_.self(p.host))] + (tracks_motion_ ? last_F(p.host) : hosts_.F(p.host, last_x_)) * p.S;
}

Vec<3> SurfacePoints::displacement(Index point) {
  Point const& p = points_[at(point)];
  return planes_[at(point)].y - last_x_[at(hosts_.self(p.host))] - last_F(p.host) * p.S;
}

std::size_t SurfacePoints::bytes() const {
  std::size_t const stencils = hosts_.count() > 0 ? hosts_.last(hosts_.count() - 1) : 0;
  return points_.size() * (sizeof(Point) + sizeof(Plane)) + (F_.size() + last_F_.size()) * sizeof(Mat<3>) +
         ids().size() * (sizeof(Vec<3>) + 2 * sizeof(double)) + stencils * sizeof(HostParticles::Neighbour);
}

}  // namespace piola::contact
