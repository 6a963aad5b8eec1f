// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/blended_planes.hpp"
#include "piola/mechanics/contact/chatter.hpp"
#include "piola/mechanics/contact/force_moment.hpp"
#include "piola/mechanics/contact/friction.hpp"
#include "piola/mechanics/contact/rigid_surface.hpp"
#include "piola/mechanics/contact/self_contact_exclusions.hpp"
#include "piola/mechanics/contact/shape_points.hpp"
#include "piola/mechanics/contact/surface.hpp"
#include "piola/mechanics/contact/surface_mirror.hpp"
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace piola::contact {

class StateVector;

inline double square_of(Vec<3> const& a) { return dot(a, a); }

/// Search distance: gaps below this number of spacings limit the step.
inline constexpr double near = 0.25;

/// Totals of all surface contacts of a run at one instant.
struct Totals {
  double energy = 0;         ///< stored in the layers [J]
  double deepest = 0;        ///< largest depth of a point behind a surface, in spacings
  double frequency2 = 0;     ///< square of the largest frequency that contact adds [1/s2]
  double spring_energy = 0;  ///< of friction springs [J]
  double friction_work = 0;  ///< work taken by friction since the last evaluation, stored or dissipated [J]
  std::int64_t touched = 0;  ///< surface points with a contact force
};

/// Points of one surface that have passed through another one: they were deeper than a spacing behind it and left at
/// the far side. Numbers of bodies; those of rigid shapes follow.
struct Passed {
  std::size_t of = 0, through = 0;
  std::int64_t points = 0;
};

/// Contact between bodies, and between bodies and rigid shapes, by blended planes on oriented surface points. Input:
/// positions; output: forces; both by index into ids().
class SurfaceContactSystem {
 public:
  /// Contact setting between a body and another one, itself, or a rigid shape.
  struct PairSetting {
    bool is_active = false;  ///< whether they are in surface contact
    double factor = 0.5;     ///< C_s
    FrictionLaw friction;
  };
  /// [body][other]: bodies first, then rigid shapes; symmetric.
  using Setting = std::vector<std::vector<PairSetting>>;
  SurfaceContactSystem(ParticleSet const& particles, std::vector<Surface> surfaces, std::vector<RigidSurface> rigids,
                       Setting setting);

  std::vector<std::int64_t> const& ids() const { return hosts_.ids(); }
  HostParticles const& hosts() const { return hosts_; }
  /// Inverse masses by index into ids() [1/kg].
  void set_masses(std::vector<double> const& masses);
  /// Mirror planes of a body. Their images are among its surface points.
  void set_mirrors(std::size_t body, std::vector<SurfaceMirror> mirrors) { mirrors_[body] = std::move(mirrors); }
  /// Whether bodies a and b are in surface contact here.
  bool is_active(std::size_t a, std::size_t b) const { return setting_[a][b].is_active; }
  /// Excludes the contact of this surface point with body `other`, or includes it again. Rigid shapes are numbered
  /// after the bodies.
  void exclude_pair(std::size_t body, std::size_t point, std::size_t other, bool out);
  /// Removes the points of particles that have lost their surface permanently, by index into ids(). Not in state():
  /// call before restore() again.
  void drop(std::vector<char> const& lost);
  /// Energy stored by the contact of this point with `other` [J].
  double stored_at(std::size_t body, std::size_t point, std::size_t other) const;
  RigidSurface& rigid(std::size_t k) { return rigids_[k]; }
  RigidSurface const& rigid(std::size_t k) const { return rigids_[k]; }
  std::vector<RigidSurface>& rigids() { return rigids_; }
  std::vector<RigidSurface> const& rigids() const { return rigids_; }

  /// Computes the forces [N] at x [m]: functions of x and of the poses of rigid shapes and, with friction, of the
  /// springs and the positions of the last evaluation, dt [s] ago.
  void evaluate(std::vector<Vec<3>> const& x, double dt);
  /// As evaluate(), without motion before it: at the start.
  void start(std::vector<Vec<3>> const& x);
  /// State after the last evaluation, for a checkpoint, without the poses of rigid shapes.
  std::vector<double> state() const;
  void restore(std::vector<Vec<3>> const& x, std::vector<double> const& state);
  std::vector<Vec<3>> const& forces() const { return forces_; }
  /// Indices of ids() that have a force, ascending.
  std::vector<Index> const& loaded_indices() const { return loaded_indices_; }
  Totals const& totals() const { return totals_; }
  std::vector<Passed> const& passed() const { return passed_; }  ///< since the start
  using ForceMoment = contact::ForceMoment;
  /// Sets the load of ties on a rigid shape; moment about its centre. springs: as in Frequencies [1/s2].
  void tie_rigid(std::size_t k, ForceMoment const& load, double springs) { ties_on_rigid_[k] = {load, springs}; }
  /// Force of bodies on a rigid shape; moment about its centre.
  ForceMoment resultant_on_rigid(std::size_t k) const {
    ForceMoment const &pushed = on_rigid_[k], &tied = ties_on_rigid_[k].load;
    return {pushed.force + tied.force, pushed.moment + tied.moment};
  }
  /// Springs between a free rigid shape and the points near it: the largest square of the frequency that one of them
  /// gives its point, and the sum of the squares for the shape [1/s2]. The sum of both is a bound.
  struct Frequencies {
    double of_points = 0, of_shape = 0;
  };
  Frequencies frequencies(std::size_t k) const {
    return {frequencies_[k].of_points, frequencies_[k].of_shape + ties_on_rigid_[k].springs};
  }
  /// Force of body b on body a; moment about the origin.
  ForceMoment const& between(std::size_t a, std::size_t b) const { return between_[a][b]; }

  /// Contact values of a particle with surface points.
  struct ParticleContactState {
    std::int64_t id = 0;
    double pressure = 0;  ///< of contact, mean over its points [Pa]
    double gap = 0;       ///< smallest gap of its points [m], capped at the search distance of `near` spacings
    double slid = 0;      ///< sliding distance, maximum over its points [m]
    double heat = 0;      ///< half of the friction heat [J/m2]
  };
  std::vector<ParticleContactState> at_particles() const;

  /// Enables chatter damping; shares: by body, largest fraction of the friction heat.
  void damp_chatter(std::vector<double> const& shares);
  /// Chatter-damping impulses after the last evaluation, which must have been one with friction. v [m/s].
  ChatterDamping const& chatter(std::vector<Vec<3>> const& x, std::vector<Vec<3>> const& v);
  bool damps_chatter() const { return has_friction_ && chatter_.any(); }

  /// The step in which the fastest pair of near points approaches by a tenth of a spacing [s]. v [m/s].
  double contact_time_step(std::vector<Vec<3>> const& v) const;
  std::size_t bytes() const;

 private:
  struct Point {
    Index host;
    std::size_t body;
    Vec<3> S, N;
    double area;
    bool image;
  };
  struct Run {
    Index target;      ///< index of a point
    std::size_t body;  ///< of the sources
    std::size_t first, last;
  };

  /// Contact force of a point on another object.
  struct NormalContact {
    std::int64_t point;
    std::size_t with;  ///< see Stuck
    double force;      ///< along the normal [N]
    double stiffness;  ///< [N/m]
    double area;       ///< weight of this pass [m2]
  };
  struct FrictionForce {
    Vec<3> force;               ///< on the point [N]
    double heat = 0, slid = 0;  ///< [J], [m]
  };

  /// Points of a rigid shape that are tested against the planes of a body, where the body's own points are too coarse.
  struct ShapePass {
    std::size_t body, rigid;
    ShapePoints points;
    PairRule rule;
  };
  struct ShapeRun {
    std::size_t pass;
    ShapePoint point;
    std::size_t first, last;  ///< of its sources
    Plane plane = {};
    Gap gap = {};
  };
  /// A point with a recorded entry face of a thin shape.
  struct Kept {
    Index point;
    std::size_t rigid;
    Sides sides;
  };
  /// A point deep behind a surface.
  struct Deep {
    std::int64_t point;
    std::size_t with;  ///< see Stuck
    Vec<3> normal;
    bool counts;  ///< whether it is deeper than a spacing
    bool operator<(Deep const& o) const { return with != o.with ? with < o.with : point < o.point; }
  };

  void look_at_others(std::size_t body);
  void make_lists(std::vector<Vec<3>> const& x);
  void list_sources(std::size_t b, std::vector<Index> const& of_body, Vec<3> const& low, Vec<3> const& high);
  bool may_touch(Index target, Index source) const;
  std::size_t place_of(std::size_t body, std::size_t point) const {
    for (std::size_t b = 0; b < body; ++b) point += surfaces_[b].points.size();
    return point;
  }
  std::size_t others() const { return surfaces_.size() + rigids_.size(); }
  bool is_left_out(std::size_t point, std::size_t other) const {
    return !left_out_.empty() && left_out_[point * others() + other] != 0;
  }
  bool is_dropped(std::size_t point) const { return !dropped_.empty() && dropped_[point] != 0; }
  bool is_met(Index point, std::size_t rigid) const {
    return !is_dropped(at(point)) && with_rigid(points_[at(point)].body, rigid).is_active &&
           !is_left_out(at(point), surfaces_.size() + rigid);
  }
  /// Whether the point itself is tested against the shape; false if points of the shape cover all of it.
  bool is_tested(Index point, std::size_t rigid) const {
    return is_met(point, rigid) && covered_[points_[at(point)].body][rigid] == 0;
  }
  void list_points_near_rigids();
  void list_shape_points(std::vector<std::vector<Index>> const& of_body);
  std::vector<ShapePoint> shape_points_near(ShapePass const& pass, std::vector<Index> const& of_body) const;
  double share_before_mirrors(ShapeRun const& run) const;
  void place_shape_points();
  void push_from_shape_points();
  void push_by(ShapeRun const& run);
  void note_spring_by(ShapeRun const& run, double area);
  void rub_by(ShapeRun const& run, double normal_force, double area);
  void note_shape_springs();
  double closing_step_of_shapes(std::vector<Vec<3>> const& v) const;
  double crossing_step(std::vector<Vec<3>> const& v) const;
  Kept const* kept(Index point, std::size_t rigid) const;
  Distance distance_on_side(Index point, std::size_t rigid) const;
  void keep_on_side(Index point, std::size_t rigid, std::vector<Vec<3>> const& x, std::vector<Kept>& now);
  void note_deep(std::int64_t point, std::size_t with, double depth, Vec<3> const& normal);
  void count_passed();
  void pass(std::size_t of, std::size_t through);
  void put_sides(std::vector<double>& all) const;
  void take_sides(StateVector& from);
  void activate(std::vector<char> const& points);
  bool lists_hold(std::vector<Vec<3>> const& x) const;
  PairSetting const& with_rigid(std::size_t body, std::size_t rigid) const {
    return setting_[body][surfaces_.size() + rigid];
  }
  void place_points(std::vector<Vec<3>> const& x);
  void evaluate_forces(std::vector<Vec<3>> const& x);
  void forget_forces();
  void place_anew(std::vector<Vec<3>> const& x);
  void remember(std::vector<Vec<3>> const& x);
  void push_bodies();
  void push_from_rigids(std::vector<Vec<3>> const& x);
  void add_up();
  double largest_inverse_mass(Run const& run) const;
  void note_spring(std::size_t rigid, Index point, Vec<3> const& n, double stiffness);
  void apply_friction(Run const& run, Gap const& gap, NormalContact const& press);
  void rub_on_rigid(NormalContact const& press, std::size_t rigid, Vec<3> const& n);
  Mat<3> const& last_F(Index host);
  Vec<3> moved(Index point);
  void slide_over(std::size_t first, std::size_t last, double weight, Vec<3> const& y, Vec<3>& jump, Vec<3>& n);
  void rub_back(std::size_t first, FrictionForce const& rubbed);
  FrictionForce drag(NormalContact const& press, FrictionLaw const& law, Mat<3> const& frame, Vec<3> const& jump,
                     Vec<3> const& n);
  void book_lost_springs();
  void trace(Index point, double slid, double heat);
  void add_load(Index point, PointLoad const& load);
  void add_force(Index id, Vec<3> const& f);
  void add_between(Run const& run, Vec<3> const& f);
  void note(Index point, double gap, double layer_modulus, double length, double spacing, double inverse);
  double inverse_mass_of(Index point) const {
    return inverse_mass_[static_cast<std::size_t>(hosts_.self(points_[static_cast<std::size_t>(point)].host))];
  }

  std::vector<Surface> surfaces_;
  std::vector<RigidSurface> rigids_;
  Setting setting_;
  HostParticles hosts_;
  std::vector<Point> points_;
  std::vector<std::vector<PairRule>> rules_;
  std::vector<SelfContactExclusions> own_;  ///< by body: empty without self-contact
  bool has_friction_ = false;               ///< whether any pair has friction
  double dt_ = 0;                           ///< since the last evaluation [s]
  std::vector<double> inverse_mass_;
  std::vector<Vec<3>> listed_at_;         ///< positions of host particles at the last list update [m]
  std::vector<RigidPose> listed_rigids_;  ///< poses of rigid shapes at the last list update
  double skin_ = 0;                       ///< [m]
  std::vector<char> left_out_;            ///< by point and other, or empty
  std::vector<char> dropped_;             ///< by point, or empty
  std::vector<Run> runs_;
  std::vector<Index> sources_;
  std::vector<Gap> gaps_;          ///< by run
  std::vector<double> weights_;    ///< of sources
  std::vector<Index> near_rigid_;  ///< points near a rigid shape
  std::vector<std::vector<SurfaceMirror>> mirrors_ = std::vector<std::vector<SurfaceMirror>>(surfaces_.size());
  std::vector<ShapePass> shape_passes_;
  std::vector<ShapeRun> shape_runs_;
  std::vector<double> shape_springs_;                   ///< by host particle: of points of shapes [N/m]
  std::vector<std::vector<char>> covered_;              ///< [body][rigid]: see ShapePoints::cover()
  std::vector<std::vector<std::array<bool, 3>>> thin_;  ///< [body][rigid]: along which axes the shape is thin
  bool any_thin_ = false;
  std::vector<Kept> kept_;  ///< by point and shape
  std::vector<Deep> deep_, last_deep_;
  std::vector<Passed> passed_;
  std::vector<Index> active_points_, active_hosts_;
  std::vector<Mat<3>> F_;         ///< of active host particles, by host
  std::vector<Plane> planes_;     ///< of active points, by point
  std::vector<PointLoad> loads_;  ///< by point
  std::vector<char> loaded_;
  std::vector<Index> loaded_points_;
  /// Springs of contact points, with a body, or with a rigid shape, numbered after the bodies. In the order of
  /// contacts: runs, then near_rigid_.
  struct StickState {
    std::int64_t point;     ///< of a shape: its key
    std::size_t with;       ///< of a shape's points: the number of their pass, counted after the shapes
    Vec<3> stretch, force;  ///< [m] in the reference configuration of the point, [N]
    double energy;          ///< [J]
    bool operator<(StickState const& o) const { return with != o.with ? with < o.with : point < o.point; }
  };
  std::vector<StickState> stuck_, last_stuck_;
  std::vector<double> gap_;           ///< by point: smallest gap of the last evaluation [m]
  std::vector<double> normal_force_;  ///< by point: outward, of the last evaluation [N]
  struct SlipHistory {
    double slid = 0, heat = 0;  ///< [m], [J]
  };
  std::vector<SlipHistory> traces_;  ///< by point, if any pair has friction
  ChatterDamping chatter_;
  std::vector<double> heat_;    ///< by host particle, of the last evaluation, with chatter damping [J]
  std::vector<Mat<3>> last_F_;  ///< of host particles at the last evaluation; inactive ones are computed on demand
  std::vector<char> knows_F_, knows_last_F_;
  /// Sources of a sliding target: weight, F^-1 r.
  std::vector<std::pair<double, Vec<3>>> rubbed_;
  std::vector<Vec<3>> last_x_;        ///< of the last evaluation
  std::vector<RigidPose> last_pose_;  ///< of rigid shapes
  std::vector<Vec<3>> forces_;
  std::vector<Index> loaded_indices_;
  std::vector<char> is_pushed_;
  std::vector<ForceMoment> on_rigid_;
  struct Tied {
    ForceMoment load;
    double springs = 0;
  };
  std::vector<Tied> ties_on_rigid_ = std::vector<Tied>(rigids_.size());
  std::vector<Frequencies> frequencies_;
  std::vector<std::vector<ForceMoment>> between_;
  Totals totals_;
  /// Sums of an evaluation over points, in any order.
  struct Sums {
    exec::ReproducibleSum energy, spring_energy, friction_work;
    std::vector<ForceMomentSum> resultant_on_rigid;
    std::vector<exec::ReproducibleSum> springs_of_shape;
    std::map<std::pair<std::size_t, std::size_t>, ForceMomentSum> resultant_on_first;  ///< of two bodies, on the one of
                                                                                       ///< the lower number
  };
  Sums sums_;
};

}  // namespace piola::contact
