// SPDX-License-Identifier: Apache-2.0
#include "piola/input/key_tables.hpp"
#include "piola/input/observer_keys.hpp"
#include <array>
#include <vector>

namespace piola {
namespace {

using enum KeyInfo::Kind;
using Kind = ProbeSpec::Kind;
using QuantityKey = BoundKey<QuantitySpec>;

constexpr auto probe_words = [] {
  std::array<std::string_view, probe_kinds.size()> words;
  for (std::size_t k = 0; k < words.size(); ++k) words[k] = probe_kinds[k].word;
  return words;
}();

constexpr std::array<std::string_view, 2> fragment_words{"largest", "largest_free"};
constexpr std::array<std::string_view, 18> take_words{"maximum",
                                                      "minimum",
                                                      "final_value",
                                                      "initial_value",
                                                      "first_peak",
                                                      "time_of_first_peak",
                                                      "time_of_maximum",
                                                      "time_of_minimum",
                                                      "first_time_above",
                                                      "first_time_below",
                                                      "mean_absolute_difference",
                                                      "at_time",
                                                      "relative_error",
                                                      "oscillation_period",
                                                      "range",
                                                      "change",
                                                      "mean",
                                                      "final"};

/// The last word, "final", is another one for final_value.
constexpr Member<QuantitySpec> take_member = WordMember<QuantitySpec>{
    [](QuantitySpec const& quantity) { return static_cast<std::size_t>(quantity.take); },
    [](QuantitySpec& quantity, std::size_t word) {
      using enum QuantitySpec::Statistic;
      quantity.take = word > static_cast<std::size_t>(mean) ? final_value : static_cast<QuantitySpec::Statistic>(word);
    }};

constexpr std::array probe_rows{
    ProbeKey{{{"probe", "name", name, "", any_value, "", "first part of the column names"}}},
    ProbeKey{{{"probe", "body", name, "", any_value, "", "name of the body"}}},
    ProbeKey{{{"probe", "kind", word, "", any_value, default_of_member, "what is measured", probe_words},
              fills<&ProbeSpec::kind>,
              true}},
    ProbeKey{
        {{"probe", "at", point, "m", place_range, "none",
          "point, stress_intensity, rim, hole (required there): the nearest particle is used; stress_intensity: the "
          "crack tip; rim, hole, fragment with near_axis: a point of the axis"}},
        kinds_of_probe(Kind::point, Kind::stress_intensity, Kind::fragment, Kind::rim, Kind::hole)},
    ProbeKey{{{"probe", "where", formula, "", any_value, "all particles",
               "all but point, stress_intensity, fragment, rim and hole: condition that selects particles"}}},
    ProbeKey{{{"probe", "axis", word, "", any_value, default_of_member,
               "twist, extent, rim, hole, fragment with near_axis: direction", axis_words},
              chooses<&ProbeSpec::axis>,
              true},
             kinds_of_probe(Kind::twist, Kind::extent, Kind::fragment, Kind::rim, Kind::hole)},
    ProbeKey{{{"probe", "quantities", list, "", any_value, "none",
               "what to record; required but for kinds with numbers of their own"}}},
    ProbeKey{{{"probe", "field", text, "", any_value, "none", "error (required there): name of the field to compare"}},
             kinds_of_probe(Kind::error),
             "the field to compare",
             "\"CauchyStress\""},
    ProbeKey{{{"probe", "reference", formulas, "", any_value, "none",
               "error (required there): one formula in X, Y, Z, t per component of the field (tensors row by row, "
               "CauchyStress as XX YY ZZ XY YZ XZ)"}},
             kinds_of_probe(Kind::error),
             "one formula per component of the field",
             "[\"0\", ...]"},
    ProbeKey{{{"probe", "direction", point, "1", place_range, "[1, 0]",
               "stress_intensity: direction ahead of the crack tip, of any length"}},
             kinds_of_probe(Kind::stress_intensity)},
    ProbeKey{{{"probe", "from", quantity, "m", length_range, "none",
               "stress_intensity (required there): distance from the tip from which on particles count"},
              fills<&ProbeSpec::from>},
             kinds_of_probe(Kind::stress_intensity),
             "a distance from the crack tip"},
    ProbeKey{{{"probe", "to", quantity, "m", length_range, "none",
               "stress_intensity (required there): distance from the tip up to which particles count"},
              fills<&ProbeSpec::to>},
             kinds_of_probe(Kind::stress_intensity),
             "a distance from the crack tip"},
    ProbeKey{{{"probe", "link", quantity, "1", above(0, 100), default_of_member,
               "fragment, rim, hole: particles closer than this many initial spacings hang together"},
              fills<&ProbeSpec::link>},
             kinds_of_probe(Kind::fragment, Kind::rim, Kind::hole)},
    ProbeKey{
        {{"probe", "anchored_where", formula, "", any_value, "none",
          "rim, fragment = \"largest_free\" (required there), hole: condition in X, Y, Z; what hangs together with "
          "one of these particles is attached"}},
        kinds_of_probe(Kind::fragment, Kind::rim, Kind::hole)},
    ProbeKey{{{"probe", "fragment", word, "", any_value, default_of_member,
               "fragment: which one; largest_free is the largest that is not attached", fragment_words},
              fills<&ProbeSpec::fragment>},
             kinds_of_probe(Kind::fragment)},
    ProbeKey{{{"probe", "near_axis", quantity, "m", length_range, "no bound",
               "fragment: extents of the particles that are now nearer to the axis than this"},
              fills<&ProbeSpec::near_axis>},
             kinds_of_probe(Kind::fragment)},
    ProbeKey{{{"probe", "min_particles", whole, "", closed(1, 1e9), default_of_member,
               "fragment: a fragment with fewer particles does not count as a large one"},
              fills<&ProbeSpec::min_particles>},
             kinds_of_probe(Kind::fragment)},
    ProbeKey{{{"probe", "within", quantity, "m", length_range, "none",
               "rim (required there): largest distance from the axis that counts"},
              fills<&ProbeSpec::within>},
             kinds_of_probe(Kind::rim),
             "the largest distance from the axis"},
    ProbeKey{{{"probe", "base", quantity, "m", place_range, "none",
               "rim (required there): coordinate along the axis from which the height counts"},
              fills<&ProbeSpec::base>},
             kinds_of_probe(Kind::rim),
             "the coordinate from which the height counts"},
    ProbeKey{{{"probe", "sectors", whole, "", closed(3, 3600), default_of_member,
               "rim: number of angles in each of which one particle is taken"},
              fills<&ProbeSpec::sectors>},
             kinds_of_probe(Kind::rim)},
    ProbeKey{{{"probe", "slab_from", quantity, "m", place_range, "none",
               "hole (required there): coordinate along the axis from which on particles count for the hole"},
              fills<&ProbeSpec::slab_from>},
             kinds_of_probe(Kind::hole),
             "where the slab begins along the axis"},
    ProbeKey{{{"probe", "slab_to", quantity, "m", place_range, "none",
               "hole (required there): coordinate along the axis up to which particles count for the hole"},
              fills<&ProbeSpec::slab_to>},
             kinds_of_probe(Kind::hole),
             "where the slab ends along the axis"},
    ProbeKey{{{"probe", "cavity_from", quantity, "m", place_range, "slab_from",
               "hole: coordinate along the axis from which on particles count for the cavity"}},
             kinds_of_probe(Kind::hole)},
    ProbeKey{{{"probe", "cavity_to", quantity, "m", place_range, "no bound",
               "hole: coordinate along the axis up to which particles count for the cavity"},
              fills<&ProbeSpec::cavity_to>},
             kinds_of_probe(Kind::hole)},
    ProbeKey{{{"probe", "bin", quantity, "1", above(0, 1000), default_of_member,
               "hole: width of the bins of the cavity along the axis, in initial spacings"},
              fills<&ProbeSpec::bin>},
             kinds_of_probe(Kind::hole)},
};

constexpr std::array quantity_rows{
    QuantityKey{{"quantity", "name", name, "", any_value, "", "key in the summary"}, fills<&QuantitySpec::name>},
    QuantityKey{{"quantity", "column", text, "", any_value, "", "column of history.csv"}},
    QuantityKey{{"quantity", "take", word, "", any_value, default_of_member,
                 "which number of the column; mean: over time; final: the last, as final_value", take_words},
                take_member},
    QuantityKey{{"quantity", "threshold", quantity, "", any_value, "none",
                 "first_time_above, first_time_below (required there), in the unit of the column"}},
    QuantityKey{{"quantity", "time", quantity, "s", not_negative, "none", "at_time (required there)"}},
    QuantityKey{{"quantity", "reference", formula, "", any_value, "none",
                 "mean_absolute_difference, relative_error (required there): formula in t and the constants"}},
    QuantityKey{
        {"quantity", "from", quantity, "s", not_negative, default_of_member,
         "rows from this time on count (all but at_time, initial_value, final_value); change: minus the value then"},
        fills<&QuantitySpec::from>,
        true},
    QuantityKey{{"quantity", "until", quantity, "s", not_negative, "the end of the run",
                 "rows up to this time count; change: the value then"}},
    QuantityKey{
        {"quantity", "unit", text, "", any_value, "that of the column", "unit in which the summary shows the number"}},
};

}  // namespace

std::span<ProbeKey const> probe_keys() { return probe_rows; }
std::span<BoundKey<QuantitySpec> const> quantity_keys() { return quantity_rows; }

std::vector<KeyInfo> keys_of_observers() {
  std::vector<KeyInfo> keys;
  for (ProbeKey const& key : probe_keys()) add_keys(std::span(&key.row, 1), keys);
  add_keys(quantity_keys(), keys);
  return keys;
}

}  // namespace piola
