// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/state.hpp"
#include "piola/particles/particle_set.hpp"
#include <vector>

namespace piola::adaptle {

/// Reference neighbours of all bodies, which never change, and who takes part in material sums, which changes whenever
/// a particle converts.
class MaterialLists {
 public:
  /// Within 2h of each body, in order of slots. `corrected`: eqs. (4), (5) in the reference configuration; particles
  /// whose correction is singular keep plain gradients.
  void build(ParticleSet const& set, std::vector<BodyConstants> const& bodies, std::vector<Reference> const& reference,
             bool corrected, int lanes);

  /// Who needs a deformation gradient, and who feels material forces. Kinematic ones are marked by gap = 0 in
  /// `deformation`, others by -1.
  void choose(std::vector<State> const& state, bool printed, std::vector<Deformation>& deformation);

  /// f(b) for the reference neighbours of a within the distance [m].
  template <class F>
  void each_neighbour(Index a, double within, std::vector<Reference> const& reference, F const& f) const {
    for (Index k = begin_[static_cast<std::size_t>(a)]; k < begin_[static_cast<std::size_t>(a) + 1]; ++k) {
      Index const b = neighbour_[static_cast<std::size_t>(k)];
      if (b >= particles_) continue;
      double square = 0;
      for (int c = 0; c < 3; ++c) {
        double const d = reference[static_cast<std::size_t>(b)].X[c] - reference[static_cast<std::size_t>(a)].X[c];
        square += d * d;
      }
      if (square <= within * within) f(b);
    }
  }

  void put_into(MaterialTable& table) const;
  bool built() const { return !begin_.empty(); }
  int neighbours(Index a) const { return count_[static_cast<std::size_t>(a)]; }
  std::size_t bytes() const;

 private:
  void correct(std::vector<Reference> const& reference, std::vector<BodyConstants> const& bodies,
               std::vector<int> const& body, int dimension);

  Index particles_ = 0;
  std::vector<Index> begin_, neighbour_, kinematic_, target_;
  std::vector<double> s_, W_;
  std::vector<int> count_;
  std::vector<Correction> correction_;
};

}  // namespace piola::adaptle
