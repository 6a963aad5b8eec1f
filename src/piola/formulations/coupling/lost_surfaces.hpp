// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/mechanics/contact/colour_contact.hpp"
#include "piola/mechanics/contact/contact_definition.hpp"
#include <cstdint>
#include <string>
#include <vector>

namespace piola {

/// Whether the surface of a body may be lost to a contact of its formulation: then surfaces keep it apart only from
/// bodies that lose theirs in the same way.
bool may_lose_surface(FormulationSpec const& formulation);

/// Bodies whose particles may lose their surface points because material fails, as under `nodal`, and the number of
/// particles that have. Colour contact keeps such particles apart from other bodies, LateRigidContact from rigid
/// shapes; report() counts those that nothing keeps apart.
class LostSurfaces {
 public:
  using Pairs = std::vector<contact::ColourContact::Pair>;
  /// settings: of surface contact. Ignores formulations that keep such particles apart themselves.
  LostSurfaces(Assembly const& whole, contact::PairSettings const& settings);

  /// Pairs of bodies in surface contact of which one may lose its surface, for colour contact; not with mirror planes,
  /// whose images have no colour, nor of rings.
  Pairs const& pairs() const { return pairs_; }
  /// Whether some body may lose surface points, to whatever contact.
  bool any() const { return any_; }
  /// Whether a body may lose its surface and is in contact with another body or a rigid shape.
  bool may_lose(std::size_t body) const { return bodies_[body].loses; }
  /// Whether such a body is in contact with a rigid shape.
  bool meets_shapes(std::size_t body) const { return bodies_[body].meets_shapes; }
  /// Counts the marked particles, by index. ids: of particles, by index; -1: an image.
  void count(std::vector<char> const& lost, std::vector<std::int64_t> const& ids);
  void report(Diagnostics& sum) const;

 private:
  struct BodyCount {
    std::string name;
    std::int64_t first, last;    ///< ids
    bool loses;                  ///< see may_lose()
    bool meets_shapes;           ///< see meets_shapes()
    bool is_uncovered;           ///< whether nothing keeps its particles apart from some bodies
    std::int64_t particles = 0;  ///< without a surface
  };
  void find_pairs(Assembly const& whole, contact::PairSettings const& settings);

  std::vector<BodyCount> bodies_;
  Pairs pairs_;
  bool any_ = false;
};

}  // namespace piola
