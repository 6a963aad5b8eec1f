// SPDX-License-Identifier: Apache-2.0
#include "piola/input/plausibility.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace piola {
namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();
constexpr std::string_view celsius =
    ", colder than liquid nitrogen (77 K) - temperatures are in K: was 273 + this meant?";

constexpr std::array ranges{
    // Numbers of materials.
    PlausibleRange{"density", "density", "kg/m^3", "", 10, 25000,
                   ", lighter than foam (solids have 100 to 20000 kg/m^3) - was g/cm^3 meant?",
                   ", heavier than any metal (solids have 100 to 20000 kg/m^3) - check the unit"},
    PlausibleRange{"youngs_modulus", "youngs_modulus", "Pa", "", 100, 2e12,
                   ", softer than any jelly (1 kPa to 1 TPa is usual) - was MPa or GPa meant?",
                   ", stiffer than diamond (1 kPa to 1 TPa is usual) - check the unit"},
    PlausibleRange{"poissons_ratio", "poissons_ratio", "1", "", 0, 0.49999,
                   ", below 0 (0 to 0.5 is usual; only re-entrant foams widen when stretched) - check the sign",
                   ", so near to 0.5 that waves of pressure are 100 times as fast as those of shear (0 to 0.4995 is "
                   "usual) - take 0.499 or less"},
    PlausibleRange{"wave_speed", "the speed of pressure waves", "m/s", "", 1, 25000,
                   ", slower than in any solid (10 m/s to 18 km/s is usual) - check the units of moduli and density",
                   ", faster than in any solid (10 m/s to 18 km/s is usual) - check the units of moduli and density"},
    PlausibleRange{"dense_wave_speed", "the speed of pressure waves", "m/s", "", 20, no_bound,
                   " at a density above 2500 kg/m^3 (metals and rocks have 1 to 12 km/s) - was GPa meant for the "
                   "modulus?"},
    PlausibleRange{"yield_stress", "the yield stress at the start", "Pa", "Young's modulus", 1e-6, 0.3,
                   " (1e-4 to 0.03 is usual) - was MPa or GPa meant?",
                   ", above the strength of any solid (1e-4 to 0.03 is usual) - check the units of both"},
    PlausibleRange{"spall_pressure", "spall_pressure", "Pa", "the modulus of pressure waves", 1e-6, 0.1,
                   " (1e-3 to 0.03 is usual) - was MPa or GPa meant?",
                   ", above the strength of any solid (1e-3 to 0.03 is usual) - check the unit"},
    PlausibleRange{"hardening", "the hardening", "Pa", "Young's modulus", 1e-7, 1,
                   " (0, or 1e-3 to 0.1, is usual) - was MPa or GPa meant?",
                   ", stiffer than the elastic law (0, or 1e-3 to 0.1, is usual) - check the unit"},
    PlausibleRange{"hardening_exponent", "hardening_exponent", "1", "", 0, 2, "",
                   " (0.05 to 1 is usual) - check the law that the number is from"},
    PlausibleRange{"rate_coefficient", "rate_coefficient", "1", "", 0, 0.5, "",
                   " (0.001 to 0.1 is usual) - check the law that the number is from"},
    PlausibleRange{"fracture_strain", "the fracture strain in slow tension, d1 + d2 exp(d3/3),", "1", "", 1e-4, 100,
                   ", so that the first plastic strain breaks the material (0.01 to 5 is usual) - check d1, d2 and d3, "
                   "or leave out damage",
                   ", so that nothing ever breaks (0.01 to 5 is usual) - check d1, d2 and d3"},
    PlausibleRange{"initial_temperature", "initial_temperature", "K", "", 77, 3000, celsius,
                   ", hotter than molten steel - check the unit"},
    PlausibleRange{"reference_temperature", "reference_temperature", "K", "", 77, 3000, celsius,
                   ", hotter than molten steel - check the unit"},
    PlausibleRange{"melting_temperature", "melting_temperature", "K", "", 200, 5000,
                   ", lower than that of mercury (234 K) - temperatures are in K: was 273 + this meant?",
                   ", higher than that of any solid (4300 K) - check the unit"},
    PlausibleRange{"heat", "initial_temperature", "K", "the melting temperature", 0, 0.999, "",
                   ", so that the material has no strength from the start (0.1 to 0.9 is usual) - check both"},
    PlausibleRange{"specific_heat", "specific_heat", "J/(kg K)", "", 50, 10000,
                   " (100 to 5000 is usual) - was J/(g K) or kJ/(kg K) meant?",
                   " (100 to 5000 is usual) - check the unit"},
    PlausibleRange{"friction", "friction", "1", "", 0, 2, "", " (0 to 1 is usual) - check the number"},
    // Shapes.
    PlausibleRange{"size", "the size of its box", "m", "", 1e-7, 1e4, ", smaller than a grain - was mm or um meant?",
                   ", larger than a mountain - was mm meant?"},
    PlausibleRange{"particles_across", "the number of particles across", "1", "", 3, no_bound,
                   " (3 or more are needed to bend) - make the spacing smaller"},
    PlausibleRange{"spacing_ratio", "the ratio of the spacings", "1", "", 0, 2, "",
                   " (SPH wants them alike, at most 1.5) - change particles"},
    // Motion and loads.
    PlausibleRange{"speed", "the initial velocity", "m/s", "the speed of pressure waves", 0, 1, "",
                   " (below 1 is usual) - check both units"},
    PlausibleRange{"driven_speed", "the velocity", "m/s", "the speed of pressure waves", 0, 1, "",
                   " (below 0.1 is usual) - check both units"},
    PlausibleRange{"load", "the load", "Pa", "the modulus of pressure waves", 1e-9, 0.2,
                   " (1e-6 to 0.01 is usual) - was MPa or GPa meant?",
                   " (1e-6 to 0.01 is usual), which crushes the body within one wave - check the unit"},
    PlausibleRange{"load_on_metal", "the load", "Pa", "the yield stress", 0, 100, "",
                   " (below 3 is usual, up to 50 under an explosive) - check the units of both"},
    PlausibleRange{"weight", "the load times the size of the body", "Pa", "the modulus of pressure waves", 0, 0.2, "",
                   " (below 0.01 is usual), which crushes the body under its own weight - check the unit"},
    // Time.
    PlausibleRange{"steps", "the number of steps", "1", "", 10, 1e7,
                   " (waves need tens of steps to cross a body) - check the units of run.end and of the moduli",
                   " (more than 10 million take days) - check run.end and the stiffness"},
    PlausibleRange{"transits", "run.end", "s", "the time in which waves cross the thinnest body", 0.1, 1e6,
                   " (2 to 1000 is usual) - check the units of run.end, of the shape (mm given as m?) and of the "
                   "moduli",
                   " (2 to 1000 is usual) - check the units of run.end, of the shape and of the moduli"},
};

std::string_view words_for(PlausibleRange const& range, double measure) {
  if (measure < range.low * (1 - 1e-9)) return range.below;
  return measure > range.high * (1 + 1e-9) ? range.above : std::string_view{};
}

}  // namespace

std::span<PlausibleRange const> plausible_ranges() { return ranges; }

PlausibleRange const* find_plausible_range(std::string_view name) {
  auto const found = std::find_if(ranges.begin(), ranges.end(), [&](auto const& range) { return range.name == name; });
  return found == ranges.end() ? nullptr : &*found;
}

PlausibleRange const& plausible_range(std::string_view name) {
  auto const* range = find_plausible_range(name);
  PIOLA_EXPECTS(range != nullptr);
  return *range;
}

std::string implausible(PlausibleRange const& range, double value) {
  std::string_view const words = std::isfinite(value) ? words_for(range, value) : std::string_view{};
  if (words.empty()) return "";
  return std::string(range.quantity) + " is " + quantity_text(value, range.unit) + std::string(words);
}

std::string implausible(PlausibleRange const& range, double value, double reference, std::string_view reference_unit) {
  double const ratio = value / reference;
  std::string_view const words = std::isfinite(ratio) ? words_for(range, ratio) : std::string_view{};
  if (words.empty()) return "";
  return std::string(range.quantity) + " is " + quantity_text(value, range.unit) + ", " + number_text(ratio, 3) +
         " times " + std::string(range.reference) + ", " + quantity_text(reference, reference_unit) +
         std::string(words);
}

}  // namespace piola
