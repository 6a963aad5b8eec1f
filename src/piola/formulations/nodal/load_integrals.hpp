// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/formulations/nodal/surface_integrals.hpp"

namespace piola::nodal {

/// Sum of the areas of a face, and of areas times normals [m^(D-1)].
struct WholeArea {
  double size = 0;
  std::array<double, 3> vector{};
};

/// Exact area of a load on the body.
WholeArea exact_area(SetUp const& from, Load const& load);

/// Area of a patch of size one in spacings h, by its axis [m^(D-1)].
template <int D>
std::array<double, 3> unit_areas(SetUp const& from, std::array<double, 3> const& h);

struct FacePartsOf {
  std::array<double, 3> const& h;   ///< spacings [m]
  std::vector<SetUpCheck>& checks;  ///< receives the computed area of each load, with the exact one
};

/// Weights of particles on loaded faces, exact for quadratic fields. Flat faces have their own normal. A pressure on a
/// curved face acts along the vectors of the sampled body's surface, so that it has no resultant on a closed one. All
/// other loads act on the exact area: the areas of a load are scaled if cell sides beside an oblique edge are assigned
/// to the wrong face. Collective on a distributed body.
template <int D>
std::vector<LazyZeroArray<FacePart>> load_integrals(SetUp const& from, LocalFits<D> const& fits,
                                                    SurfaceIntegrals<D> const& surface, FacePartsOf const& of);

/// Areas of the flat faces of a box as weights of particles: -x, +x, -y and so on [m^(D-1)]. A uniform pressure on a
/// face with these areas causes uniform stress. Valid for local particles.
template <int D>
std::vector<LazyZeroArray<double>> face_areas(SetUp const& from, SurfaceIntegrals<D> const& surface,
                                              std::array<double, 3> const& h);

extern template std::vector<LazyZeroArray<FacePart>> load_integrals<1>(SetUp const&, LocalFits<1> const&,
                                                                       SurfaceIntegrals<1> const&, FacePartsOf const&);
extern template std::vector<LazyZeroArray<FacePart>> load_integrals<2>(SetUp const&, LocalFits<2> const&,
                                                                       SurfaceIntegrals<2> const&, FacePartsOf const&);
extern template std::vector<LazyZeroArray<FacePart>> load_integrals<3>(SetUp const&, LocalFits<3> const&,
                                                                       SurfaceIntegrals<3> const&, FacePartsOf const&);

}  // namespace piola::nodal
