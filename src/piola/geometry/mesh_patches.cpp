// SPDX-License-Identifier: Apache-2.0
#include "piola/base/contracts.hpp"
#include "piola/geometry/mesh_surface.hpp"
#include <algorithm>
#include <cmath>
#include <set>

namespace piola::geometry {

namespace {

/// The name of a group as one that case files can contain: letters, digits and underscores, not starting with a digit.
std::string name_for_group(std::string const& given) {
  constexpr std::size_t longest = 56;  // names have at most 64 characters, and a number may follow
  std::string name;
  for (char const c : given.substr(0, longest)) {
    bool const good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += good ? c : '_';
  }
  if (name.empty()) return "group";
  if (name[0] >= '0' && name[0] <= '9') name.insert(0, 1, '_');
  return name;
}

std::vector<int> patches_of_groups(Surface const& surface, std::vector<Patch>& patches) {
  std::vector<int> patch_of_group(surface.group_name.size(), -1), patch;
  std::set<std::string> taken;
  for (int const group : surface.group) {
    if (patch_of_group[group] < 0) {
      patch_of_group[group] = static_cast<int>(patches.size());
      std::string const wanted = name_for_group(surface.group_name[group]);
      std::string name = wanted;
      for (int k = 2; !taken.insert(name).second; ++k) name = wanted + "_" + std::to_string(k);
      patches.push_back({name});
    }
    patch.push_back(patch_of_group[group]);
  }
  return patch;
}

/// Whether the surface goes on smoothly across a side. A flat face goes with the neighbour over its longest side.
bool smooth_across(Surface const& surface, int half, int other, double cosine) {
  bool const flat = surface.is_flat(half / 3), flat_other = surface.is_flat(other / 3);
  if (flat || flat_other)
    return (flat && surface.longest_side(half / 3) == half % 3) ||
           (flat_other && surface.longest_side(other / 3) == other % 3);
  Vec<3> const a = surface.twice_area(half / 3), b = surface.twice_area(other / 3);
  return dot(a, b) > cosine * std::sqrt(dot(a, a)) * std::sqrt(dot(b, b));
}

}  // namespace

std::vector<int> patches_of(Surface const& surface, Links const& links, double feature_angle,
                            std::vector<Patch>& patches) {
  PIOLA_EXPECTS(surface.group.size() == surface.corner.size());
  PIOLA_EXPECTS(links.across.size() == 3 * surface.corner.size());
  if (std::set<int>(surface.group.begin(), surface.group.end()).size() > 1) return patches_of_groups(surface, patches);
  double const cosine = std::cos(feature_angle);
  std::vector<int> patch(surface.corner.size(), -1), waiting;
  for (int first = 0; first < surface.faces(); ++first) {
    if (patch[first] >= 0) continue;
    patch[first] = static_cast<int>(patches.size());
    patches.push_back({std::to_string(patches.size() + 1)});
    waiting.push_back(first);
    while (!waiting.empty()) {
      int const face = waiting.back();
      waiting.pop_back();
      for (int half = 3 * face; half < 3 * face + 3; ++half) {
        int const other = links.across[half];
        if (other < 0 || patch[other / 3] >= 0 || !smooth_across(surface, half, other, cosine)) continue;
        patch[other / 3] = patch[first];
        waiting.push_back(other / 3);
      }
    }
  }
  return patch;
}

}  // namespace piola::geometry
