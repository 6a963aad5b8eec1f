// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/history_names.hpp"
#include <array>
#include <span>
#include <string_view>

/// Kinds of probes. A new kind: its enumerator and its row here, its measurement in measures/probe.cpp; rows for keys
/// of its own in keys_of_observers.cpp.
namespace piola {

/// Kind of a [[probe]].
enum class ProbeKind {
  point,
  average,
  maximum,
  minimum,
  twist,
  extent,
  error,
  stress_intensity,
  spacing,
  fragment,
  rim,
  hole
};

struct ProbeKindInfo {
  std::string_view word;
  std::span<HistoryName const> quantities = {};  ///< that it computes; none: it samples fields
  int dimension = 0;                             ///< of the only bodies that it measures; 0: any
  /// Values are sums and extrema over particles, so that each rank can evaluate its local ones; else one rank needs
  /// all.
  bool is_reducible = true;
};

namespace quantities_of_probe {

inline constexpr std::array twist{HistoryName{"twist_angle", "rad"}};
inline constexpr std::array extent{HistoryName{"extent", "m"}};
inline constexpr std::array error{HistoryName{"relative_error", "1"}};
inline constexpr std::array intensity{HistoryName{"stress_intensity", "Pa m^0.5"}};
inline constexpr std::array spacing{HistoryName{"spacing_min", "1"},    HistoryName{"spacing_p1", "1"},
                                    HistoryName{"spacing_p5", "1"},     HistoryName{"spacing_median", "1"},
                                    HistoryName{"spacing_std", "1"},    HistoryName{"share_below_0_75", "1"},
                                    HistoryName{"share_below_0_5", "1"}};
/// Volumes assume a thickness of 1 m in 2D.
inline constexpr std::array fragment{
    HistoryName{"fragment_count", "1"},          HistoryName{"fragment_particles", "1"},
    HistoryName{"fragment_volume", "m^3"},       HistoryName{"fragment_velocity_x", "m/s"},
    HistoryName{"fragment_velocity_y", "m/s"},   HistoryName{"fragment_velocity_z", "m/s"},
    HistoryName{"fragment_extent_x", "m"},       HistoryName{"fragment_extent_y", "m"},
    HistoryName{"fragment_extent_z", "m"},       HistoryName{"large_fragment_count", "1"},
    HistoryName{"large_fragment_volume", "m^3"}, HistoryName{"large_fragment_volume_cv", "1"}};
inline constexpr std::array rim{HistoryName{"rim_diameter", "m"}, HistoryName{"rim_height", "m"},
                                HistoryName{"rim_sectors", "1"}};
inline constexpr std::array hole{HistoryName{"hole_slab", "m"}, HistoryName{"cavity_width", "m"}};

}  // namespace quantities_of_probe

/// In the order of ProbeKind.
inline constexpr std::array probe_kinds{
    ProbeKindInfo{"point"},
    ProbeKindInfo{"average"},
    ProbeKindInfo{"maximum"},
    ProbeKindInfo{"minimum"},
    ProbeKindInfo{"twist", quantities_of_probe::twist},
    ProbeKindInfo{"extent", quantities_of_probe::extent},
    ProbeKindInfo{"error", quantities_of_probe::error},
    ProbeKindInfo{"stress_intensity", quantities_of_probe::intensity, 2},
    ProbeKindInfo{"spacing", quantities_of_probe::spacing, 0, false},
    ProbeKindInfo{"fragment", quantities_of_probe::fragment, 0, false},
    ProbeKindInfo{"rim", quantities_of_probe::rim, 3, false},
    ProbeKindInfo{"hole", quantities_of_probe::hole, 2, false},
};
static_assert(probe_kinds.size() == static_cast<std::size_t>(ProbeKind::hole) + 1);

constexpr ProbeKindInfo const& info_of(ProbeKind kind) { return probe_kinds[static_cast<std::size_t>(kind)]; }

/// SI unit of a quantity of a probe, of a kind's own or of a field; "1" if it is not known.
std::string_view unit_of_probe_quantity(ProbeKind kind, std::string_view quantity);

}  // namespace piola
