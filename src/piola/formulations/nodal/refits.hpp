// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/crack_lines.hpp"
#include "piola/formulations/nodal/facet_fluxes.hpp"
#include "piola/formulations/nodal/gradient_tables.hpp"
#include "piola/formulations/nodal/scaled_body.hpp"

namespace piola::nodal {

/// The set-up data of D dimensions that a body whose cells may fail keeps: fits, facets, tables. Gradients are
/// functions of the conditions of cells alone, whatever the order in which cells have failed. Theory:
/// docs/theory/nodal.md, "Failure".
template <int D>
class RefitsOf final : public Refits {
 public:
  using Blocked = typename LocalFits<D>::Blocked;
  /// The body has no lattice for its loops. slits(from, scaled): lines that slits block; may be empty.
  RefitsOf(SetUp const& from, ScaledBody&& scaled, std::optional<DistributedSlots> const& shared,
           Blocked (*slits)(SetUp const&, ScaledBody const&))
      : from_(from),
        scaled_(std::move(scaled)),
        cracks_(scaled_.X),
        fits_(scaled_.X, std::nullopt, shared, slits(from_, scaled_)),
        fluxes_(fits_, scaled_, &cracks_) {
    if (from.images != nullptr) source_of_image_ = from.images->particles().source;
  }

  ScaledBody& scaled() { return scaled_; }
  LocalFits<D>& fits() { return fits_; }
  FacetFluxes<D> const& fluxes() const { return fluxes_; }
  GradientTables<D>& tables(Reference& to) {
    if (!tables_) tables_.emplace(from_, scaled_, fits_, fluxes_, to);
    return *tables_;
  }

  Found set(std::vector<Change> const& changes) override;
  std::vector<Index> near(Index slot, double reach) const override;
  bool is_intact(Index slot) const override { return cracks_.is_intact(static_cast<std::size_t>(slot)); }

 private:
  std::vector<std::size_t> set_conditions(std::vector<Change> const& changes);

  SetUp from_;
  ScaledBody scaled_;
  CrackLines cracks_;
  LocalFits<D> fits_;
  FacetFluxes<D> fluxes_;
  std::optional<GradientTables<D>> tables_;
  std::vector<Index> source_of_image_;
};

extern template class RefitsOf<1>;
extern template class RefitsOf<2>;
extern template class RefitsOf<3>;

}  // namespace piola::nodal
