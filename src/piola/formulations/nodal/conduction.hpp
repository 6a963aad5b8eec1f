// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"

namespace piola::nodal {

struct ScaledBody;

/// Conduction of heat between the cells of a body, after each of its steps: Fourier's law between cells with a common
/// facet, finite volumes with explicit steps. Changes the temperature of points and the energy of cells; their sum over
/// the body stays. Theory: docs/theory/nodal.md, "Conduction of heat".
class Conduction {
 public:
  /// Keeps the reference to the body.
  explicit Conduction(NodalBody& body)
      : body_(body), dimension_(body.state().dimension), conductance_(body.reference().facets.neighbour.size()) {}

  /// Conducts for dt [s], in as many parts as are stable. Collective.
  void advance(double dt);

 private:
  using At = HeatLayout;
  Range own_of(MaterialRange const& range) const;
  void put_conductivities();
  void put_temperatures();
  double along(std::array<double, 3> const& n, Index i) const;
  double find_conductances();
  void conduct(double dt);

  NodalBody& body_;
  int dimension_;
  std::vector<double> conductance_;  ///< of the facets in this step [W/(m K) m^(D-2)]
};

/// Facets of the cells of the local particles of a body. `scaled`: the whole body.
FacetList conducting_facets(SetUp const& from, ScaledBody const& scaled);

}  // namespace piola::nodal
