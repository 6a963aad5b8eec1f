// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/closure.hpp"
#include "piola/formulations/nodal/set_up.hpp"

namespace piola::nodal {

struct FacePartsOf {
  std::array<double, 3> const& h;   ///< spacings [m]
  std::vector<SetUpCheck>& checks;  ///< receives the computed area of each load, with the exact one
};

/// Weights of particles on loaded faces, exact for quadratic fields. Flat faces have their own normal. A pressure on a
/// curved face acts along the vectors of the sampled body's surface, so that it has no resultant on a closed one. All
/// other loads act on the exact area: the areas of a load are scaled if cell sides beside an oblique edge are assigned
/// to the wrong face. Collective on a distributed body.
template <int D>
std::vector<PartFilled<FacePart>> face_parts(SetUp const& from, Fits<D> const& fits, Divergence<D> const& divergence,
                                             FacePartsOf const& of);

extern template std::vector<PartFilled<FacePart>> face_parts<1>(SetUp const&, Fits<1> const&, Divergence<1> const&,
                                                                FacePartsOf const&);
extern template std::vector<PartFilled<FacePart>> face_parts<2>(SetUp const&, Fits<2> const&, Divergence<2> const&,
                                                                FacePartsOf const&);
extern template std::vector<PartFilled<FacePart>> face_parts<3>(SetUp const&, Fits<3> const&, Divergence<3> const&,
                                                                FacePartsOf const&);

}  // namespace piola::nodal
