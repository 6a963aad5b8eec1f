// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Several formulations in one run: bodies of the same formulation move together, all with one step.
namespace piola {

/// Bodies of one formulation and what concerns them.
struct EnsemblePart {
  /// Where the particles of one body stand in the part and in the whole.
  struct Block {
    std::size_t body;          ///< index in the whole
    std::int64_t here, there;  ///< id of its first particle in the part, in the whole
    std::int64_t count;
  };
  std::string formulation;
  std::string name;  ///< of its own in the run: that of the formulation, and of the body where it stands alone
  Assembly assembly;
  std::vector<Block> blocks;
  /// Of what tells its action in Diagnostics, the positions among those of the whole: supports, loads with a name,
  /// rigid shapes.
  std::vector<std::size_t> supports, named_loads, rigid_shapes;

  std::int64_t id_in_whole(std::int64_t id) const;
  std::optional<std::int64_t> id_in_part(std::int64_t id) const;  ///< nothing: of another part
  std::optional<std::size_t> body_in_part(std::size_t body) const;
};

/// One part per formulation, in the order of their first bodies. Rigid shapes and the contact rule go to the parts
/// whose formulation knows contact; if surfaces are to push its bodies instead, each is a part for itself without them.
std::vector<EnsemblePart> split_by_formulation(Assembly const& whole);

/// Of each part: the particles that what acts between bodies reads in every step.
std::vector<std::size_t> read_between_bodies(Assembly const& whole, std::vector<EnsemblePart> const& parts);

/// The formulations of all parts as one. Each step is taken by all of them, the shortest that one of them bears.
/// Totals are sums (pressure_oscillation is the largest); columns of history.csv that several of them have, too.
/// Fields are all that one of them has; bodies whose formulation has no such field show zero.
/// Where the whole has surfaces, bodies and rigid shapes push each other.
std::unique_ptr<Formulation> make_ensemble(Assembly const& whole, std::vector<EnsemblePart> parts,
                                           std::vector<std::unique_ptr<Formulation>> formulations);

}  // namespace piola
