// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include "piola/math/tensor.hpp"
#include "piola/mechanics/contact/force_moment.hpp"
#include "piola/mechanics/contact/late_targets.hpp"
#include <cstddef>
#include <vector>

/// Contact of bodies without a surface (Eulerian particles, or particles from a file), and of particles that have lost
/// theirs, by the colour function of the other body: C(x) = sum_b V_b W(|x - x_b|), which is 1 deep inside and 0
/// outside. Theory: docs/theory/contact.md, section 8.
namespace piola::contact {

/// Wendland's C2 kernel with support radius R [m], integral 1 over space of 1 to 3 dimensions.
struct ColourKernel {
  int dimension = 3;
  double support = 1;
  double value(double r) const;  ///< [1/m^dimension]
  double slope(double r) const;  ///< dW/dr / r: factor of the vector between two points
  /// C and -dC/dd at the distance d >= 0 [m] from the face of a half-space.
  struct Colour {
    double value, slope;
  };
  Colour of_half_space(double d) const;
};

/// All colour contacts of a run at one instant. Particles are indices into positions that the caller owns.
class ColourContact {
 public:
  struct Body {
    std::vector<Index> at;       ///< indices of its particles
    std::vector<double> volume;  ///< initial volumes of these [m^dimension]
    double spacing = 0;          ///< [m]
    double modulus = 0;          ///< P-wave modulus [Pa]
  };
  struct Pair {
    std::size_t a = 0, b = 0;  ///< indices of the bodies
    double factor = 0.5;       ///< C_s
    bool late = false;         ///< targets are particles that have lost their surface, else all particles
  };
  ColourContact() = default;
  ColourContact(int dimension, std::vector<Body> bodies, std::vector<Pair> pairs);
  /// Whether there are targets.
  bool any() const;
  /// Makes particles targets that have lost their surface, marked by index. Each pushes from its depth in the next
  /// evaluation on.
  void add_targets(std::vector<char> const& marked);
  /// Depths from which such targets push, for a checkpoint. To be loaded after add_targets().
  std::vector<double> state() const { return late_.state(); }
  void load(std::vector<double> const& state) { late_.load(state); }

  /// Computes the forces [N] at x [m], functions of positions alone. Particles without mass are skipped [kg]. The
  /// forces are sums of central ones between pairs of particles.
  void evaluate(std::vector<Vec<3>> const& x, std::vector<double> const& masses);
  std::vector<Vec<3>> const& forces() const { return forces_; }
  std::vector<Index> const& loaded_indices() const { return loaded_indices_; }  ///< ascending

  struct Totals {
    double energy = 0;      ///< stored [J]
    double deepest = 0;     ///< in spacings
    double frequency2 = 0;  ///< bound of the square of the largest frequency of these contacts [1/s2]
    double touched = 0;     ///< particles on which the other body's colour acts
  };
  Totals const& totals() const { return totals_; }
  /// The step in which the fastest adjacent particles of two bodies approach by a tenth of a spacing [s]. v [m/s].
  double contact_time_step(std::vector<Vec<3>> const& x, std::vector<Vec<3>> const& v) const;
  std::vector<Pair> const& pairs() const { return pairs_; }
  /// Force of body b on body a; moment about the origin.
  ForceMoment resultant_on_first(std::size_t pair) const { return on_first_[pair].value(); }
  std::size_t bytes() const;

 private:
  /// The particles of one body near another one with their neighbours, which are numbered as in `other`.
  struct Pass {
    Index number;  ///< of this pass
    std::size_t pair, body, other;
    bool late, active;  ///< see Pair; whether the body has targets
    ColourKernel kernel;
    double touching = 0, slope = 0;  ///< C half a spacing in front of a face, and -dC/dd there
    double stiffness = 0;            ///< k [Pa/m]
    double length = 0;               ///< l [m]
    std::vector<Index> target;       ///< indices in the body
    std::vector<std::size_t> begin;
    std::vector<Index> source;
  };
  struct Seen {
    double colour = 0;
    Vec<3> slope;     ///< of the colour by the position of the target [1/m]
    double size = 0;  ///< sum of the norms of the derivatives by positions of target and sources [1/m]
  };
  void activate();
  std::vector<Index> present(std::size_t body, bool late, std::vector<Vec<3>> const& x,
                             std::vector<double> const& masses) const;
  bool lists_hold(std::vector<Vec<3>> const& x, std::vector<double> const& masses) const;
  void make_lists(std::vector<Vec<3>> const& x, std::vector<double> const& masses);
  void list(Pass& pass, std::vector<Vec<3>> const& x, std::vector<double> const& masses) const;
  Seen look(Pass const& pass, std::size_t target, std::vector<Vec<3>> const& x) const;
  void push(Pass const& pass, std::size_t target, Seen const& seen, std::vector<Vec<3>> const& x,
            exec::ReproducibleSum& energy);
  void add(Index k, Vec<3> const& f);

  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;
  std::vector<Pass> passes_;
  std::vector<char> in_active_pass_;  ///< by body
  LateTargets late_;
  double skin_ = 0;  ///< [m]
  std::vector<Vec<3>> listed_at_;
  std::vector<char> listed_alive_;
  std::vector<Vec<3>> forces_;
  std::vector<double> stiffness_;  ///< by particle: bound of its row of second derivatives [N/m]
  std::vector<char> is_pushed_;
  std::vector<Index> loaded_indices_;
  std::vector<ForceMomentSum> on_first_;
  Totals totals_;
};

}  // namespace piola::contact
