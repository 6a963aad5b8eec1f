// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/quantity_names.hpp"
#include "piola/input/bound_keys.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/input/history_names.hpp"
#include <array>
#include <span>
#include <string_view>

/// Kinds of probes and the keys that they use. A new kind: its enumerator, a row here, rows for its keys in
/// keys_of_observers.cpp; beside that its measurement, see Probe.
namespace piola {

struct ProbeKind {
  std::string_view word;
  std::span<HistoryName const> quantities = {};  ///< that it computes; none: it samples fields
  int dimension = 0;                             ///< of the only bodies that it measures; 0: any
};

namespace quantities_of_probe {

inline constexpr std::array twist{HistoryName{twist_quantity, "rad"}};
inline constexpr std::array extent{HistoryName{extent_quantity, "m"}};
inline constexpr std::array error{HistoryName{error_quantity, "1"}};
inline constexpr std::array intensity{HistoryName{intensity_quantity, intensity_unit}};
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

/// In the order of ProbeSpec::Kind.
inline constexpr std::array probe_kinds{
    ProbeKind{"point"},
    ProbeKind{"average"},
    ProbeKind{"maximum"},
    ProbeKind{"minimum"},
    ProbeKind{"twist", quantities_of_probe::twist},
    ProbeKind{"extent", quantities_of_probe::extent},
    ProbeKind{"error", quantities_of_probe::error},
    ProbeKind{"stress_intensity", quantities_of_probe::intensity, 2},
    ProbeKind{"spacing", quantities_of_probe::spacing},
    ProbeKind{"fragment", quantities_of_probe::fragment},
    ProbeKind{"rim", quantities_of_probe::rim, 3},
    ProbeKind{"hole", quantities_of_probe::hole, 2},
};
static_assert(probe_kinds.size() == static_cast<std::size_t>(ProbeSpec::Kind::hole) + 1);

constexpr ProbeKind const& info_of(ProbeSpec::Kind kind) { return probe_kinds[static_cast<std::size_t>(kind)]; }

/// SI unit of a quantity of a probe, of a kind's own or of a field; "1" if it is not known.
std::string_view unit_of_probe_quantity(ProbeSpec::Kind kind, std::string_view quantity);

/// Kinds of probes as bits.
template <class... Kinds>
constexpr unsigned kinds_of_probe(Kinds... kinds) {
  return ((1U << static_cast<unsigned>(kinds)) | ...);
}

/// A key of [[probe]], and which kinds use it.
struct ProbeKey {
  BoundKey<ProbeSpec> row;
  unsigned kinds = ~0U;                   ///< see kinds_of_probe
  std::string_view needed_for = {};       ///< these kinds need it, for this; empty: they may leave it out
  std::string_view example = "\"1 mm\"";  ///< for the message that it is missing

  bool is_used_by(ProbeSpec::Kind kind) const { return (kinds & kinds_of_probe(kind)) != 0; }
};
std::span<ProbeKey const> probe_keys();
std::span<BoundKey<QuantitySpec> const> quantity_keys();

}  // namespace piola
