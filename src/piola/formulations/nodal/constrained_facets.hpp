// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/local_fits.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/neighbours/particle_cells.hpp"

namespace piola::nodal {

/// Surface places that supports hold, one for each particle along the surface: the mean over the place, with the motion
/// expanded about the nearest particle by its fit. The weights are those that distribute a traction on the place to
/// particles, so that reactions can balance any uniform stress. Places smaller than a quarter of a spacing's area are
/// merged into the nearest one. `h`: spacings [m].
template <int D>
std::vector<ConstrainedFacet> constrained_facets(SetUp const& from, LocalFits<D> const& fits,
                                                 std::vector<SurfacePatch> const& patches,
                                                 std::array<double, 3> const& h);

/// Facets of the loads that absorb waves, as the places of supports, with areas whose sum is exact.
template <int D>
std::vector<AbsorbingFacet> absorbing_facets(SetUp const& from, LocalFits<D> const& fits,
                                             std::vector<SurfacePatch> const& patches, std::array<double, 3> const& h);

extern template std::vector<ConstrainedFacet> constrained_facets<1>(SetUp const&, LocalFits<1> const&,
                                                                    std::vector<SurfacePatch> const&,
                                                                    std::array<double, 3> const&);
extern template std::vector<ConstrainedFacet> constrained_facets<2>(SetUp const&, LocalFits<2> const&,
                                                                    std::vector<SurfacePatch> const&,
                                                                    std::array<double, 3> const&);
extern template std::vector<ConstrainedFacet> constrained_facets<3>(SetUp const&, LocalFits<3> const&,
                                                                    std::vector<SurfacePatch> const&,
                                                                    std::array<double, 3> const&);
extern template std::vector<AbsorbingFacet> absorbing_facets<1>(SetUp const&, LocalFits<1> const&,
                                                                std::vector<SurfacePatch> const&,
                                                                std::array<double, 3> const&);
extern template std::vector<AbsorbingFacet> absorbing_facets<2>(SetUp const&, LocalFits<2> const&,
                                                                std::vector<SurfacePatch> const&,
                                                                std::array<double, 3> const&);
extern template std::vector<AbsorbingFacet> absorbing_facets<3>(SetUp const&, LocalFits<3> const&,
                                                                std::vector<SurfacePatch> const&,
                                                                std::array<double, 3> const&);

}  // namespace piola::nodal
