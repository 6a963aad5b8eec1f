// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/blended_planes.hpp"
#include "piola/mechanics/contact/cohesive.hpp"
#include "piola/mechanics/contact/force_moment.hpp"
#include "piola/mechanics/contact/rigid_surface.hpp"
#include "piola/mechanics/contact/surface.hpp"
#include "piola/mechanics/contact/tie_rule.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace piola::contact {

/// The ties of a run: springs with memory between surface points of one body and their initial positions on the other
/// one. A jump is a constant linear function of the positions of particles, jump_a = y_a - sum_b N_ab (y_b + F_b R_ab)
/// = sum_i c_ai x_i with sum_i c_ai = 0, so that ties are rows of numbers. With a rigid shape jump_a = y_a - (c + R
/// arm), with the arm in the axes of the shape. Particles are indices into HostParticles::ids().
class Ties {
 public:
  Ties() = default;
  /// Ties the surfaces in contact at x [m], the start. `set` has the reference positions.
  Ties(std::vector<TieRule> rules, ParticleSet const& set, std::vector<Surface> const& surfaces,
       HostParticles const& hosts, std::vector<Vec<3>> const& x, std::vector<RigidSurface> const& rigids = {});

  /// Result of the search of a tie at the start.
  struct TieReport {
    std::array<std::int64_t, 2> points{};  ///< tied points of both bodies
    double area = 0;                       ///< tied area, mean of both bodies [m^(Dim-1)]
    std::int64_t left = 0;                 ///< points of both that face the other body from farther away
    double left_area = 0;                  ///< area of these, mean of both bodies [m^(Dim-1)]
    double farthest = 0;                   ///< largest gap or overlap of a tied point, in spacings
    double nearest = std::numeric_limits<double>::infinity();  ///< smallest gap or overlap of any point, in spacings
    double stiffness = 0;                                      ///< K [Pa/m]
  };
  std::vector<TieRule> const& rules() const { return rules_; }
  std::vector<TieReport> const& found() const { return found_; }

  /// A tied surface point of a body; `other`: the body it is tied to, or a rigid shape, numbered after the bodies.
  struct Hold {
    std::size_t body, point, other;
  };
  std::size_t count() const { return rows_.size(); }
  Hold const& hold(std::size_t row) const { return rows_[row].hold; }
  bool has_failed(std::size_t row) const { return opened_[row] >= rows_[row].law.last; }
  /// Rows that failed in the last evaluation, ascending.
  std::vector<std::size_t> const& released() const { return released_; }

  /// Computes the forces [N] at x [m]: functions of x and of the largest openings so far, which it updates.
  void evaluate(HostParticles const& hosts, std::vector<Vec<3>> const& x, std::vector<RigidSurface> const& rigids = {});
  std::vector<Vec<3>> const& forces() const { return forces_; }
  std::vector<Index> const& loaded_indices() const { return touched_; }  ///< ascending

  struct Totals {
    double energy = 0;  ///< stored [J]
    double heat = 0;    ///< dissipated by failure [J]
    double failed = 0;  ///< failed fraction of the area that can fail
  };
  Totals const& totals() const { return totals_; }
  using Force = ForceMoment;
  /// Force of a tie on its first body; moment about the origin.
  Force const& resultant_on_first(std::size_t tie) const { return on_first_[tie]; }
  /// Force of all ties on a rigid shape; moment about its centre.
  Force const& resultant_on_rigid(std::size_t shape) const { return on_rigid_[shape]; }
  /// Sum over ties of the squared frequencies of a free rigid shape on points at rest, without failure [1/s2]. Added to
  /// frequency2() it bounds the square of the frequency of both.
  double springs_of_shape(std::size_t shape, std::vector<RigidSurface> const& rigids) const;
  /// Bound of the square of the largest frequency of the ties with these inverse masses [1/kg], without failure [1/s2].
  double frequency2(std::vector<double> const& inverse_masses) const;

  std::vector<double> state() const;
  /// Call evaluate() afterwards.
  void restore(std::vector<double> const& state);
  std::size_t bytes() const;

 private:
  struct Term {
    Index at;
    double c;
  };
  struct Row {
    std::size_t tie;
    Hold hold;
    Index host;  ///< host of the tied point
    Vec<3> N;
    double area;  ///< half the area of the tied point, because both sides are tied
    CohesiveLaw law;
    std::size_t first, other, last;  ///< terms of the same body, from `other` on those of the other one; the first is
                                     ///< the host
    std::size_t rigid = no_shape;
    Vec<3> arm = {};  ///< in the axes of the rigid shape, from its centre [m]
  };
  struct TieForce {
    Vec<3> jump, y, by_jump, by_normal;
    double energy = 0;
  };
  static constexpr std::size_t no_shape = static_cast<std::size_t>(-1);
  struct Binding;

  void bind(std::size_t tie, std::size_t side, Binding const& at);
  void bind_to_rigid(std::size_t tie, RigidSurface const& rigid, Binding const& at);
  void add_row(std::size_t tie, Hold const& hold, double area, CohesiveLaw const& law, Binding const& at,
               std::vector<std::pair<std::size_t, double>> const& shares);
  bool is_of_first(Row const& row) const;
  static bool selects(TieRule const& rule, SurfacePoint const& point, Binding const& at);
  void list_by_particle(std::size_t particles);
  void stretch(std::size_t row, HostParticles const& hosts, std::vector<Vec<3>> const& x,
               std::vector<RigidSurface> const& rigids);
  /// Moment of a row on the first body of the tie.
  Vec<3> turn(Row const& row, Vec<3> const& by_normal, HostParticles const& hosts, std::vector<Vec<3>> const& x);
  void add_up(std::vector<ForceMomentSum>& resultant_on_first, std::vector<RigidSurface> const& rigids);

  std::vector<TieRule> rules_;
  std::vector<TieReport> found_;
  std::vector<Row> rows_;
  std::vector<Term> terms_;
  std::vector<Index> touched_;
  std::vector<std::size_t> begin_;  ///< by index into touched_: first row
  std::vector<Term> by_particle_;   ///< at: index of a row
  std::vector<double> opened_;      ///< by row: largest effective opening [m]
  std::vector<double> lost_;        ///< by row: energy dissipated by its failure [J]
  std::vector<TieForce> pulls_;     ///< by row
  std::vector<std::size_t> released_;
  std::vector<Vec<3>> forces_;
  std::vector<Force> on_first_, on_rigid_;
  Totals totals_;
};

}  // namespace piola::contact
