// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/neighbours/mesh_cells.hpp"

namespace piola {

/// The facets of a kind of cell: which of its corners, in the order for which the normal points outwards.
struct FacetTable {
  int corners = 0;  ///< per facet
  std::span<std::array<int, 4> const> facet;
};

/// The table of simplices and of boxes of a dimension.
FacetTable facets_of(Cells const& cells);

/// Per cell and facet (in the order of facets_of): the cell on the other side, or -1 on the surface.
std::vector<Index> cells_across(Cells const& cells);

}  // namespace piola
