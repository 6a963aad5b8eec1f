// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include "piola/particles/particle_set.hpp"
#include <cstdint>
#include <vector>

namespace piola::contact {

inline std::size_t at(Index k) { return static_cast<std::size_t>(k); }
inline double square_of(Vec<3> const& a) { return dot(a, a); }

/// A point of a body's surface in the reference configuration, attached to its host particle: y = x + F S.
struct SurfacePoint {
  std::int64_t particle = 0;  ///< id
  Vec<3> offset;              ///< S: from the particle to the surface [m]
  Vec<3> normal;              ///< N: outward unit normal
  double area = 0;            ///< of the reference surface [m^(Dim-1)]
  bool image = false;         ///< image point behind a mirror plane: acts on other surfaces, receives no force
};

/// The surface of one body. Without points the body has no surface contact.
struct Surface {
  std::vector<SurfacePoint> points;
  bool is_box = false;  ///< every point lies on a flat face across an axis
  double spacing = 0;   ///< of its particles [m]
  double modulus = 0;   ///< P-wave modulus kappa + 4/3 mu [Pa]
};

/// Deformation gradients of the host particles of surface points: F = sum_j (x_j - x_p) (x) g_pj over the particles of
/// the same body around p in the reference configuration, exact for linear fields. They depend on positions alone, so
/// that forces derived from an energy of F conserve it for any formulation.
class HostParticles {
 public:
  /// One host for every particle with a surface point; surfaces by body. Throws InputError naming the body if the
  /// particles around one of its points lie on a line or a plane (in 2D: on a line).
  HostParticles(ParticleSet const& particles, std::vector<Surface> const& surfaces);

  struct Neighbour {
    Index at;  ///< index into ids()
    Vec<3> g;  ///< [1/m]
  };
  int dimension() const { return dimension_; }
  Index count() const { return static_cast<Index>(self_.size()); }
  /// Ids of all particles whose positions are read, ascending.
  std::vector<std::int64_t> const& ids() const { return ids_; }
  Index self(Index host) const { return self_[static_cast<std::size_t>(host)]; }  ///< index into ids()
  /// The host of point k of a body.
  Index of(std::size_t body, std::size_t point) const { return of_[body][point]; }
  std::size_t first(Index host) const { return begin_[static_cast<std::size_t>(host)]; }
  std::size_t last(Index host) const { return begin_[static_cast<std::size_t>(host) + 1]; }
  Neighbour const& neighbour(std::size_t k) const { return neighbours_[k]; }
  /// x: by index into ids() [m].
  Mat<3> F(Index host, std::vector<Vec<3>> const& x) const;

 private:
  int dimension_;
  std::vector<std::int64_t> ids_;
  std::vector<Index> self_;
  std::vector<std::vector<Index>> of_;
  std::vector<std::size_t> begin_;
  std::vector<Neighbour> neighbours_;
};

}  // namespace piola::contact
