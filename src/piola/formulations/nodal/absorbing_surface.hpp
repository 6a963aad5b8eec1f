// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/state.hpp"
#include "piola/mechanics/body_boundary_conditions.hpp"
#include "piola/mechanics/load.hpp"
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace piola::nodal {

/// A part of a non-reflecting patch, one for each particle along it.
struct AbsorbingFacet {
  /// Weight of a particle's velocity in the mean velocity of the part, by component: mirror images invert some.
  struct Weight {
    Index slot;
    std::array<double, 3> of;
  };
  std::array<double, 3> X{}, normal{};  ///< mean reference position [m]; outward unit vector
  double area = 0;                      ///< [m^(D-1)]
  std::vector<Weight> weights = {};
  Index slot = 0;                          ///< particle whose material it has
  std::size_t load = 0;                    ///< index in the assembly
  double normal_drag = 0, shear_drag = 0;  ///< force over velocity, along the normal and across it [N s/m]
};

/// Sets the drags: area times impedance of the material, which `constants_of` gives for a slot.
void set_drags(std::vector<AbsorbingFacet>& facets, std::vector<Load> const& loads, int dimension,
               std::function<Constants const&(Index slot)> const& constants_of);

/// Dashpots on non-reflecting patches. The matrix B takes velocities v of particles to the mean velocities of facets; Z
/// holds the drags of the facets; g is the background velocity. The forces on the particles are B^T Z (g - B v), so
/// that a uniform stress wave finds its own traction.
///
/// The dashpots act in both kicks of a step, each h = dt / 2 long, together with the other accelerations a:
///   v' - v = h (a + M^-1 B^T Z (g - B u)),  u = (v + v') / 2
/// Conjugate gradients solve for u, on every rank alike. The dashpots take the energy h u^T C u, C = B^T Z B, and a
/// kick inverts when time is reversed. Theory: docs/theory/nodal.md, section 6.
class AbsorbingSurface {
 public:
  using Point = std::array<double, 3>;
  struct Input {
    std::vector<Load> const& loads;
    std::vector<AbsorbingFacet> const& facets;
    std::function<double(Index slot)> mass;  ///< on this side of mirror planes [kg]
    std::function<Point(Index slot)> X;
  };
  AbsorbingSurface(int dimension, Input const& input);

  static constexpr int not_converged = 4;  ///< FailureSlot::code
  bool empty() const { return facets_.empty(); }
  bool converges() const { return converges_; }  ///< whether the solutions of this step are accurate
  void share(Range own) { own_ = own; }
  std::span<Index const> slots() const { return slots_; }  ///< of particles that the dashpots act on
  /// Before a step: what supports and mirror planes hold stays as it is. Evaluates the background velocities.
  void begin_step(std::span<PrescribedDirection const> held, std::span<MirroredParticle const> mirrored, double time,
                  double dt);
  struct Motion {
    FieldRef const &x, &v, &a;
  };
  /// Adds the part of the dashpots in a kick of length `half`, before the first kick or after the second one. `a`: of
  /// that kick. Collective if the body is distributed.
  void absorb(Motion const& of, double half, bool at_end);
  /// sum m a^2 of the part of accelerations that dashpots remove at the end of a step [N m/s2].
  double square_of_absorbed(Motion const& of) const;
  /// After the step: adds the impulses of loads and of the reactions of supports to `to`, and the work of the
  /// background velocity to `work` [J].
  void end_step(BodyBoundary& to, DeferredGlobalSum& work);
  /// Energy that has left the body since the start [J], on all ranks alike.
  double radiated() const { return radiated_; }
  void set_radiated(double energy) { radiated_ = energy; }

 private:
  using Vector = std::vector<double>;  ///< D values per particle
  struct Particle {
    double mass;
    Point X;
  };
  struct Facet {
    AbsorbingFacet of;
    std::size_t first, last;  ///< in weights_
    bool acts = true;
    Point background[2]{};  ///< at the start and at the end of the step [m/s]
  };
  struct Weight {
    std::size_t particle;
    Point of;
  };
  /// A direction in which a particle does not move, by this support; -1: by a mirror plane.
  struct Held {
    std::size_t particle;
    Point direction;
    std::int32_t support;
  };
  struct Impulse {
    std::size_t of;  ///< load or support
    bool by_load;
    Point x, p;
  };
  Vector values(FieldRef const& field) const;
  Point mean(Facet const& facet, Vector const& of) const;
  Point drag(Facet const& facet, Point const& velocity) const;
  template <class Of>
  Vector forces(Of const& traction_of) const;
  void accelerate(Vector& forces) const;
  void remove_held(Vector& of) const;
  Vector dashpots(Vector const& v, bool at_end) const;
  Vector mean_velocity(Vector const& v, double half, bool at_end);
  void record(Vector const& x, Vector const& mean_v, Vector const& force, double half, bool at_end);

  int D_;
  std::vector<Load> loads_;
  std::vector<Facet> facets_;
  std::vector<Weight> weights_;
  std::vector<Particle> particles_;
  std::vector<Index> slots_;            ///< of particles_
  std::map<Index, std::size_t> place_;  ///< in particles_, by slot
  std::vector<Held> held_;
  std::vector<Impulse> impulses_;  ///< of this step
  double lost_ = 0, work_ = 0;     ///< in this step [J]
  double radiated_ = 0;
  bool converges_ = true;  ///< in this step
  std::optional<Range> own_;
};

}  // namespace piola::nodal
