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
  explicit Conduction(NodalBody& body) : body_(body), dimension_(body.state().dimension) {}

  /// Conducts for dt [s], in as many parts as are stable. Collective.
  void advance(double dt);

 private:
  struct Facet;
  Range own_of(MaterialRange const& range) const;
  void put_heat();
  double largest_rate() const;
  void conduct(double dt);
  template <class F>
  void each_facet(Index slot, F const& f) const;

  NodalBody& body_;
  int dimension_;
};

/// Facets of the cells of the local particles of a body. `scaled`: the whole body.
FacetList conducting_facets(SetUp const& from, ScaledBody const& scaled);

}  // namespace piola::nodal
