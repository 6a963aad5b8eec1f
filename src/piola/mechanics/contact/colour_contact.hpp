// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include "piola/math/tensor.hpp"
#include "piola/mechanics/contact/between.hpp"
#include <cstddef>
#include <vector>

/// Contact of bodies that have no surface, because their particles flow or nobody knows it, by the colour of the other
/// body: C(x) = sum_b V_b W(|x - x_b|), which is 1 deep inside and 0 outside. Theory: docs/theory/contact.md,
/// section 8.
namespace piola::contact {

/// Wendland's C2 kernel of a support R [m], integral 1 over space of a dimension from 1 to 3.
struct ColourKernel {
  int dimension = 3;
  double support = 1;
  double value(double r) const;  ///< [1/m^dimension]
  double slope(double r) const;  ///< of the value by r, over r: what the vector between two points is multiplied by
  /// C and -dC/dd at the distance d >= 0 [m] from the face of a half-space.
  struct Colour {
    double value, slope;
  };
  Colour of_half_space(double d) const;
};

/// The contacts by colour of a run at one instant. Particles are indices into positions that others hold.
class ColourContact {
 public:
  struct Body {
    std::vector<Index> at;       ///< its particles
    std::vector<double> volume;  ///< theirs at the start [m^dimension]
    double spacing = 0;          ///< [m]
    double modulus = 0;          ///< of pressure waves [Pa]
  };
  struct Pair {
    std::size_t a = 0, b = 0;  ///< bodies
    double factor = 0.5;       ///< C_s
  };
  ColourContact() = default;
  ColourContact(int dimension, std::vector<Body> bodies, std::vector<Pair> pairs);
  bool any() const { return !pairs_.empty(); }

  /// Forces [N] at x [m], functions of positions alone. A particle without mass is not there [kg]. The forces are
  /// sums of central ones between pairs of particles.
  void evaluate(std::vector<Vec<3>> const& x, std::vector<double> const& masses);
  std::vector<Vec<3>> const& forces() const { return forces_; }
  std::vector<Index> const& pushed() const { return pushed_; }  ///< ascending

  struct Totals {
    double energy = 0;      ///< stored [J]
    double deepest = 0;     ///< in spacings
    double frequency2 = 0;  ///< a bound of the square of the largest frequency that these contacts add [1/s2]
    double touched = 0;     ///< particles that the other body's colour pushes
  };
  Totals const& totals() const { return totals_; }
  /// The step in which the fastest near particles of two bodies close a tenth of a spacing [s]. v [m/s].
  double closing_step(std::vector<Vec<3>> const& x, std::vector<Vec<3>> const& v) const;
  std::vector<Pair> const& pairs() const { return pairs_; }
  /// What body b does to body a, the moment about the origin.
  Between on_first(std::size_t pair) const { return on_first_[pair].value(); }
  std::size_t bytes() const;

 private:
  /// The particles of one body near another one, and who is near each of them; those of `other` by their place in it.
  struct Pass {
    std::size_t pair, body, other;
    ColourKernel kernel;
    double touching = 0, slope = 0;  ///< C half a spacing in front of a face, and -dC/dd there
    double stiffness = 0;            ///< k [Pa/m]
    double length = 0;               ///< l [m]
    std::vector<Index> target;       ///< places in the body
    std::vector<std::size_t> begin;
    std::vector<Index> source;
  };
  struct Seen {
    double colour = 0;
    Vec<3> slope;     ///< of the colour by the target's place [1/m]
    double size = 0;  ///< sum of all sizes of slopes by places, the target's and the sources' [1/m]
  };
  bool lists_hold(std::vector<Vec<3>> const& x, std::vector<double> const& masses) const;
  void make_lists(std::vector<Vec<3>> const& x, std::vector<double> const& masses);
  void list(Pass& pass, std::vector<Vec<3>> const& x, std::vector<double> const& masses) const;
  Seen look(Pass const& pass, std::size_t target, std::vector<Vec<3>> const& x) const;
  void push(Pass const& pass, std::size_t target, Seen const& seen, std::vector<Vec<3>> const& x,
            exec::ExactSum& energy);
  void add(Index k, Vec<3> const& f);

  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;
  std::vector<Pass> passes_;
  double skin_ = 0;  ///< [m]
  std::vector<Vec<3>> listed_at_;
  std::vector<char> listed_alive_;
  std::vector<Vec<3>> forces_;
  std::vector<double> stiffness_;  ///< by particle, a bound of its row of second derivatives [N/m]
  std::vector<char> is_pushed_;
  std::vector<Index> pushed_;
  std::vector<BetweenSum> on_first_;
  Totals totals_;
};

}  // namespace piola::contact
