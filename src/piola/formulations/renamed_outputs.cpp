// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/renamed_outputs.hpp"
#include <algorithm>
#include <array>

namespace piola {
namespace {

constexpr std::array outputs{
    RenamedOutput{"parting", "strain_drift"},
    RenamedOutput{"Parting", "StrainDrift"},
    RenamedOutput{"least_jacobian", "cell_jacobian_min"},
    RenamedOutput{"LeastJacobian", "CellJacobianMin"},
    RenamedOutput{"contact_dissipation", "chatter_damping_loss"},
    RenamedOutput{"tie_heat", "tie_dissipation"},
    RenamedOutput{"tie_failed", "tie_failed_fraction"},
    RenamedOutput{"piece_count", "large_fragment_count"},
    RenamedOutput{"piece_volume", "large_fragment_volume"},
    RenamedOutput{"piece_spread", "large_fragment_volume_cv"},
    RenamedOutput{"turn_x", "rotation_x", true},
    RenamedOutput{"turn_y", "rotation_y", true},
    RenamedOutput{"turn_z", "rotation_z", true},
};

}  // namespace

std::span<RenamedOutput const> renamed_outputs() { return outputs; }

std::string current_output_name(std::string_view name) {
  std::size_t const dot = name.rfind('.'), start = dot == std::string_view::npos ? 0 : dot + 1;
  std::string_view const word = name.substr(start);
  auto const found = std::find_if(outputs.begin(), outputs.end(), [&](RenamedOutput const& output) {
    return output.before == word && (start > 0 || !output.of_parts);
  });
  return std::string(name.substr(0, start)) + std::string(found == outputs.end() ? word : found->now);
}

std::string stored_output_name(std::string const& name, std::span<std::string const> in_file) {
  if (std::find(in_file.begin(), in_file.end(), name) != in_file.end()) return name;
  auto const found =
      std::find_if(outputs.begin(), outputs.end(), [&](RenamedOutput const& output) { return output.now == name; });
  return found == outputs.end() ? name : std::string(found->before);
}

}  // namespace piola
