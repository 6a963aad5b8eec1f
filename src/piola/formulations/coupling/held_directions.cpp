// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/coupling/held_directions.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/array_conversion.hpp"
#include <limits>
#include <utility>

namespace piola {

HeldDirections::HeldDirections(MirroredAssembly const& continued, Assembly const& whole,
                               std::map<std::int64_t, Index> const& indices, std::size_t count)
    : held_(count), reactions_(whole.supports.size()) {
  for (MirroredAssembly::OnPlane const& on : continued.on_planes) {
    Direction across{};
    across[static_cast<std::size_t>(on.axis)] = 1;
    if (auto const found = indices.find(on.id); found != indices.end())
      held_[static_cast<std::size_t>(found->second)].push_back(
          {plane, across, std::numeric_limits<double>::infinity()});
  }
  for (std::size_t s = 0; s < whole.supports.size(); ++s) {
    Support const& support = whole.supports[s];
    if (support.on_surface()) continue;
    for (auto const id : support.particles) {
      auto const found = indices.find(id);
      if (found == indices.end()) continue;
      auto& here = held_[static_cast<std::size_t>(found->second)];
      std::vector<Direction> known;
      for (HeldDirection const& held : here) known.push_back(held.direction);
      for (Direction d : directions_of(support, whole.particles.dimension)) {
        if (!make_orthogonal(d, known)) continue;
        known.push_back(d);
        here.push_back({s, d, support.until});
      }
    }
  }
}

Vec<3> HeldDirections::constrain(std::size_t particle, double time, Vec<3> impulse, Vec<3> const& x, Vec<3> const& v) {
  for (HeldDirection const& held : held_[particle]) {
    if (has_ended(held.until, time)) continue;
    Vec<3> const d = vector_of(held.direction);
    Vec<3> const kept = dot(impulse, d) * d;
    impulse = impulse - kept;
    if (held.support == plane) continue;
    work_ += dot(kept, v);
    reactions_[held.support].add(array_of(x), array_of(-1.0 * kept));
  }
  return impulse;
}

double HeldDirections::transfer_reactions(std::vector<Impulse>& supports) {
  PIOLA_EXPECTS(supports.size() == reactions_.size());
  for (std::size_t s = 0; s < supports.size(); ++s) supports[s].add(std::exchange(reactions_[s], {}).value());
  return std::exchange(work_, {}).value();
}

}  // namespace piola
