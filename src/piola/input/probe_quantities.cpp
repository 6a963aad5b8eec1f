// SPDX-License-Identifier: Apache-2.0
#include "piola/input/probe_quantities.hpp"
#include "piola/formulations/quantity_names.hpp"
#include <algorithm>
#include <array>

namespace piola {
namespace {

using Kind = ProbeSpec::Kind;

constexpr std::array twist{HistoryName{twist_quantity, "rad"}};
constexpr std::array extent{HistoryName{extent_quantity, "m"}};
constexpr std::array error{HistoryName{error_quantity, "1"}};
constexpr std::array intensity{HistoryName{intensity_quantity, intensity_unit}};
constexpr std::array spacing{HistoryName{"spacing_min", "1"},    HistoryName{"spacing_p1", "1"},
                             HistoryName{"spacing_p5", "1"},     HistoryName{"spacing_median", "1"},
                             HistoryName{"spacing_std", "1"},    HistoryName{"share_below_0_75", "1"},
                             HistoryName{"share_below_0_5", "1"}};
constexpr std::array fragment{
    HistoryName{"fragment_count", "1"},          HistoryName{"fragment_particles", "1"},
    HistoryName{"fragment_volume", "m^3"},       HistoryName{"fragment_velocity_x", "m/s"},
    HistoryName{"fragment_velocity_y", "m/s"},   HistoryName{"fragment_velocity_z", "m/s"},
    HistoryName{"fragment_extent_x", "m"},       HistoryName{"fragment_extent_y", "m"},
    HistoryName{"fragment_extent_z", "m"},       HistoryName{"large_fragment_count", "1"},
    HistoryName{"large_fragment_volume", "m^3"}, HistoryName{"large_fragment_volume_cv", "1"}};
constexpr std::array rim{HistoryName{"rim_diameter", "m"}, HistoryName{"rim_height", "m"},
                         HistoryName{"rim_sectors", "1"}};
constexpr std::array hole{HistoryName{"hole_slab", "m"}, HistoryName{"cavity_width", "m"}};

}  // namespace

std::span<HistoryName const> own_quantities(Kind kind) {
  switch (kind) {
    case Kind::twist: return twist;
    case Kind::extent: return extent;
    case Kind::error: return error;
    case Kind::stress_intensity: return intensity;
    case Kind::spacing: return spacing;
    case Kind::fragment: return fragment;
    case Kind::rim: return rim;
    case Kind::hole: return hole;
    default: return {};
  }
}

std::string_view unit_of_probe_quantity(Kind kind, std::string_view quantity) {
  for (HistoryName const& own : own_quantities(kind))
    if (own.name == quantity) return own.unit;
  auto const& known = all_quantities();
  auto const found =
      std::find_if(known.begin(), known.end(), [&](FieldQuantity const& q) { return q.name == quantity; });
  return found == known.end() ? std::string_view("1") : std::string_view(found->unit);
}

}  // namespace piola
