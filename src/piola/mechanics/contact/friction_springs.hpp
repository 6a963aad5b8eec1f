// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/chatter.hpp"
#include "piola/mechanics/contact/contact_forces.hpp"
#include "piola/mechanics/contact/contact_model.hpp"
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace piola::contact {

/// Normal contact force of a point on an object.
struct NormalContact {
  std::int64_t point;  ///< its number; of a point of a rigid shape: its key
  std::size_t with;    ///< the object; of a point of a rigid shape: the number of its pass, counted after the objects
  double force;        ///< along the normal [N]
  double stiffness;    ///< [N/m]
  double area;         ///< weight of this pass [m2]
};

/// Planes near a point, as numbers of surface points, with their weights and the sum of these.
struct NearPlanes {
  std::span<Index const> points;
  std::span<double const> weights;
  double weight;
};

/// Friction springs of contact points, and slip and friction heat of surface points. A spring exists while its contact
/// lasts. Springs are in the order of contacts during an evaluation, then sorted.
class FrictionSprings {
 public:
  /// Slip and its heat since the start.
  struct SlipHistory {
    double slid = 0, heat = 0;  ///< [m], [J]
  };
  explicit FrictionSprings(ContactModel const& model);

  /// Starts an evaluation.
  void begin();
  /// Friction of a surface point on the planes of another body. The slip is zero for any rigid motion of all.
  void slide_on_body(ContactModel& model, NormalContact const& contact, NearPlanes const& planes,
                     ContactForces& forces);
  /// Friction of a surface point on a rigid shape with the unit normal n.
  void slide_on_rigid(ContactModel& model, NormalContact const& contact, std::size_t rigid, Vec<3> const& n,
                      ContactForces& forces);
  /// Friction of a point of a rigid shape, at y [m], on the planes of a body.
  void slide_shape_point(ContactModel& model, NormalContact const& contact, Vec<3> const& y, NearPlanes const& planes,
                         ContactForces& forces);
  /// Ends an evaluation. The energy of springs whose contact has opened becomes heat.
  void finish(ContactModel const& model);

  bool has_history() const { return !history_.empty(); }
  SlipHistory const& history(Index point) const { return history_[at(point)]; }

  /// Enables chatter damping; fractions: by body, largest fraction of the friction heat.
  void damp_chatter(ContactModel const& model, std::vector<double> const& fractions);
  bool damps_chatter() const { return has_history() && chatter_.any(); }
  /// Computes chatter-damping impulses after an evaluation at x [m] with velocities v [m/s].
  ChatterDamping const& chatter(ContactModel const& model, std::vector<Vec<3>> const& x, std::vector<Vec<3>> const& v);

  void save(std::vector<double>& all) const;
  void load(StateVector& from);

 private:
  struct StickState {
    std::int64_t point;     ///< as in NormalContact
    std::size_t with;       ///< as in NormalContact
    Vec<3> stretch, force;  ///< [m] in the reference configuration of the point, [N]
    double energy;          ///< [J]
    bool operator<(StickState const& o) const { return with != o.with ? with < o.with : point < o.point; }
  };
  struct FrictionForce {
    Vec<3> force;               ///< on the point [N]
    double heat = 0, slid = 0;  ///< [J], [m]
  };
  /// Slip over planes since the last evaluation [m], and their mean unit normal.
  struct Slip {
    Vec<3> jump, n;
  };
  Slip slip_over(ContactModel& model, NearPlanes const& planes, Vec<3> const& y, Vec<3> const& moved);
  void react(ContactModel const& model, NearPlanes const& planes, FrictionForce const& friction, ContactForces& forces);
  FrictionForce update(NormalContact const& contact, FrictionLaw const& law, Mat<3> const& frame, Slip const& slip,
                       double dt, ContactForces& forces);
  void add_slip(ContactModel const& model, Index point, double slid, double heat);

  std::vector<StickState> springs_, last_springs_;
  std::vector<SlipHistory> history_;  ///< by point; empty if no pair has friction
  /// Planes under a sliding point: fraction of the weights, F^-1 r.
  std::vector<std::pair<double, Vec<3>>> arms_;
  ChatterDamping chatter_;
  std::vector<double> heat_;  ///< by host particle, of the last evaluation, with chatter damping [J]
};

}  // namespace piola::contact
