// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/neighbours/particle_cells.hpp"
#include <algorithm>
#include <limits>
#include <vector>

namespace piola::nodal {

/// The part of a body's surface that a load acts on, or a support holds, as patches.
template <int D>
class LoadedFace {
 public:
  LoadedFace(SetUp const& from, LocalFits<D> const& fits, std::vector<SurfacePatch> const& patches, Load const& load)
      : load_(load),
        body_(from.body),
        fits_(fits),
        images_(from.images),
        particles_(static_cast<std::size_t>(from.order.particles)),
        place_(fits.X().size(), none),
        area_(place_.size(), 0) {
    std::vector<std::size_t> of_id(static_cast<std::size_t>(body_.last - body_.first), none);
    for (std::size_t k = 0; k < load.particles.size(); ++k)
      if (load.particles[k] >= body_.first && load.particles[k] < body_.last)
        of_id[static_cast<std::size_t>(load.particles[k] - body_.first)] = k;
    for (std::size_t slot = 0; slot < particles_; ++slot)
      place_[slot] = of_id[static_cast<std::size_t>(from.order.id[slot] - body_.first)];
    for (std::size_t image = particles_; image < place_.size(); ++image)
      place_[image] = place_[static_cast<std::size_t>(images_->particles().source[image - particles_])];
    for (std::size_t k = 0; k < load.particles.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) faces_[c] = faces_[c] || load.normal_of(k)[c] != 0;
    for (auto const& patch : patches)
      if (faces_[static_cast<std::size_t>(patch.axis)])
        area_[static_cast<std::size_t>(patch.particle)] += patch.extent[0];
    whole_face_ = is_whole_face(from);
  }

  /// Cosine between patch and exact surface; zero if the load does not act there. Known patches lie on it.
  double cosine(SurfacePatch const& patch) const {
    return is_known(patch) ? (has(patch) ? 1 : 0) : std::max(0.0, facing(patch));
  }

  /// Index of the load's particle that a patch belongs to. Precondition: cosine(patch) is not zero.
  std::size_t owner(SurfacePatch const& patch) const { return place_of(static_cast<std::size_t>(patch.particle)); }

  /// Whether the patch is part of that surface. Sides of cells beside a pole may face away from it a little.
  bool has(SurfacePatch const& patch) const {
    if (is_known(patch))
      return patch.patch == load_.patch && place_of(static_cast<std::size_t>(patch.particle)) != none;
    return facing(patch) > -0.5;
  }

 private:
  using Point = std::array<double, 3>;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// A patch may be nearest to a particle behind the loaded ones. It belongs to a loaded particle if that is not
  /// farther away than this [spacings]: if a curved surface cuts a corner off a cell, which then has less than `corner`
  /// of the surface, or on irregular clouds.
  static constexpr double beside = 1.01, corner = 0.5, behind = 0.75;

  bool is_known(SurfacePatch const& patch) const { return patch.patch >= 0 && load_.patch >= 0; }
  /// Whether the load acts on all particles of a face of a box, and so on all sides of cells there.
  bool is_whole_face(SetUp const& from) const {
    if (!load_.normal || body_.outline.inside) return false;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(from.set.dimension); ++axis) {
      double const along = (*load_.normal)[axis];
      if (along == 0) continue;
      int const layer = along > 0 ? body_.lattice[axis] - 1 : 0;
      for (std::size_t slot = 0; slot < particles_; ++slot)
        if (place_[slot] == none &&
            from.set.lattice_index[static_cast<std::size_t>(from.order.id[slot])][axis] == layer)
          return false;
    }
    return true;
  }

  /// -1 if the load does not act.
  double facing(SurfacePatch const& patch) const {
    auto const axis = static_cast<std::size_t>(patch.axis);
    if ((load_.normal && !patch.outermost) || !faces_[axis]) return -1;
    std::size_t const k = place_of(static_cast<std::size_t>(patch.particle));
    return k == none ? -1 : turned(patch, axis) * load_.normal_of(k)[axis] * (patch.upper ? 1 : -1);
  }

  /// -1 for an image with the opposite orientation of its source.
  double turned(SurfacePatch const& patch, std::size_t axis) const {
    auto const particle = static_cast<std::size_t>(patch.particle);
    return particle < particles_ ? 1 : images_->sign(static_cast<Index>(particle - particles_))[axis];
  }

  /// Index of the load's particle that takes the patches nearest to particle a.
  std::size_t place_of(std::size_t a) const {
    if (place_[a] != none) return place_[a];
    std::size_t found = none;
    double const reach = whole_face_ || load_.whole_patch     ? std::numeric_limits<double>::infinity()
                         : !load_.normal && area_[a] < corner ? beside
                         : body_.regular                      ? 0
                                                              : behind;
    double least = reach * reach;
    auto const& X = fits_.X();
    for (std::size_t n = fits_.pairs().first(a); n < fits_.pairs().end(a); ++n) {
      std::size_t const b = fits_.pairs().at(n);
      double square = 0;
      for (std::size_t c = 0; c < 3; ++c) square += (X[b][c] - X[a][c]) * (X[b][c] - X[a][c]);
      if (place_[b] == none || square >= least) continue;
      least = square;
      found = place_[b];
    }
    return found;
  }

  Load const& load_;
  Body const& body_;
  LocalFits<D> const& fits_;
  MirrorImages const* images_;
  std::size_t particles_;
  std::array<bool, 3> faces_{};     ///< axes that the surface faces
  std::vector<std::size_t> place_;  ///< slot -> index of the load's particle
  std::vector<double> area_;        ///< area of a slot's patches along these axes, in spacings
  bool whole_face_ = false;
};

}  // namespace piola::nodal
