// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Several formulations in one run: bodies of one formulation form a part; all parts take the same step.
namespace piola {

/// The bodies of one formulation with their supports, loads and rigid shapes.
struct FormulationGroup {
  /// The ids of one body in the part and in the whole assembly.
  struct Block {
    std::size_t body;          ///< index in the whole
    std::int64_t here, there;  ///< id of its first particle in the part, in the whole
    std::int64_t count;
  };
  std::string formulation;
  std::string name;  ///< unique in the run: formulation, or "formulation.body" for a part of one body
  Assembly assembly;
  std::vector<Block> blocks;
  /// Indices, in the whole assembly, of this part's supports, named loads and rigid shapes: the objects whose
  /// resultants Diagnostics reports.
  std::vector<std::size_t> supports, named_loads, rigid_shapes;

  std::int64_t id_in_whole(std::int64_t id) const;
  std::optional<std::int64_t> id_in_part(std::int64_t id) const;  ///< empty if it is in another part
  std::optional<std::size_t> body_in_part(std::size_t body) const;
};

/// FormulationGroup::name of a body: equal for bodies that one formulation simulates together.
std::string group_name(Assembly const& whole, std::size_t body);

/// Returns one part per formulation, in the order of their first bodies. Rigid shapes and the contact rule go to the
/// parts with kernel contact. With surface contact, each of their bodies becomes a part without them instead.
std::vector<FormulationGroup> split_by_formulation(Assembly const& whole);

/// Combines the formulations of all parts. All take the same step, the smallest of their limits. Totals and columns of
/// history.csv with equal names are sums; pressure_oscillation is the largest. Fields are the union; bodies whose
/// formulation lacks a field show zero. If the whole assembly has surfaces, bodies and rigid shapes are in surface
/// contact.
std::unique_ptr<Formulation> make_coupled_formulations(Assembly const& whole, std::vector<FormulationGroup> parts,
                                                       std::vector<std::unique_ptr<Formulation>> formulations);

}  // namespace piola
