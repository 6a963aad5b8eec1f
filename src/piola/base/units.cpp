// SPDX-License-Identifier: Apache-2.0
#include "piola/base/units.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <udunits2.h>

namespace piola {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

// UDUNITS-2 keeps its status and its parser state in globals, so every use of it is under this lock.
std::mutex& library_lock() {
  static std::mutex lock;
  return lock;
}

ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(nullptr);
  }();
  if (system == nullptr) {
    throw std::runtime_error("the UDUNITS-2 unit database cannot be read - install the package libudunits2-data");
  }
  return system;
}

// Everything UDUNITS could take for something else than a product of units is kept away from it: numbers in front
// ("10 6 m"), broken powers ("m^0.5" is 0.5 to it), time stamps ("s since 2000"), logarithms, shifted origins.
bool is_plain_unit(std::string_view text) {
  if (text.empty() || text.size() > 64) return false;
  char const first = text.front();
  if ((first >= '0' && first <= '9') || first == '+' || first == '-' || first == '.' || first == '^') return false;
  constexpr std::string_view marks = " ^*/.-+()%_'\"";
  bool const allowed = std::all_of(text.begin(), text.end(), [&](char c) {
    bool const word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return word || static_cast<unsigned char>(c) >= 0x80 || marks.find(c) != std::string_view::npos;
  });
  for (std::size_t dot = text.find('.'); dot != std::string_view::npos; dot = text.find('.', dot + 1))
    if (dot + 1 < text.size() && text[dot + 1] >= '0' && text[dot + 1] <= '9') return false;
  constexpr std::array<std::string_view, 6> not_units{"since", "after", "from", "ref", "re ", "re:"};
  return allowed && std::none_of(not_units.begin(), not_units.end(), [&](std::string_view word) {
           return text.find(" " + std::string(word)) != std::string_view::npos ||
                  text.find("(" + std::string(word)) != std::string_view::npos;
         });
}

Unit whole_unit(std::string_view text) {
  if (text == "1") return Unit(ut_get_dimensionless_unit_one(unit_system()));
  // "1/s" begins with a number that scales nothing.
  if (!is_plain_unit(text.starts_with("1/") ? text.substr(2) : text)) return nullptr;
  return Unit(ut_parse(unit_system(), std::string(text).c_str(), UT_UTF8));
}

/// A unit, or the square of one that ends in a half power such as "MPa m^0.5": UDUNITS supports whole powers only.
struct Measure {
  Unit unit;
  bool squared = false;
};

Measure parse_unit(std::string_view text) {
  constexpr std::string_view half = "^0.5";
  if (!text.ends_with(half)) return {whole_unit(text), false};
  text.remove_suffix(half.size());
  std::size_t const before = text.find_last_of(" .*") + 1;  // 0 if there is nothing before
  std::string_view const last = text.substr(before);
  std::string_view const rest = text.substr(0, text.find_last_not_of(" .*", before > 0 ? before - 1 : 0) + 1);
  Unit const root = whole_unit(last), others = whole_unit(before > 0 ? rest : "1");
  if (!root || !others) return {};
  Unit const square(ut_raise(others.get(), 2));
  return {Unit(square ? ut_multiply(square.get(), root.get()) : nullptr), true};
}

/// Takes values of one unit to another, if they measure the same.
class Conversion {
 public:
  Conversion(Measure const& from, Measure const& to)
      : converter_(from.unit && to.unit && from.squared == to.squared ? ut_get_converter(from.unit.get(), to.unit.get())
                                                                      : nullptr),
        squared_(from.squared) {
    // UDUNITS converts a time to a rate by its inverse, which is refused here.
    if (converter_ && !std::isfinite(cv_convert_double(converter_.get(), 0))) converter_ = nullptr;
  }
  explicit operator bool() const { return converter_ != nullptr; }
  double operator()(double value) const {
    auto const converted = [&](double x) { return cv_convert_double(converter_.get(), x); };
    return squared_ ? value * std::sqrt(converted(1) - converted(0)) : converted(value);
  }

 private:
  Converter converter_;
  bool squared_;
};

struct Dimension {
  std::string_view unit, noun;
};
constexpr std::array dimensions{
    Dimension{"m", "a length"},
    Dimension{"s", "a time"},
    Dimension{"1/s", "a rate"},
    Dimension{"m/s", "a velocity"},
    Dimension{"kg/m^3", "a density"},
    Dimension{"Pa", "a pressure or modulus"},
    Dimension{"1", "a pure number"},
    Dimension{"J", "an energy"},
    Dimension{"kg m/s", "a momentum"},
    Dimension{"kg m^2/s", "an angular momentum"},
    Dimension{"kg/m^2/s", "a momentum per volume"},
    Dimension{"K", "a temperature"},
    Dimension{"rad", "an angle"},
    Dimension{"degree", "an angle"},
    Dimension{"m/s^2", "an acceleration"},
    Dimension{"N/m^3", "a force per volume"},
    Dimension{"Pa m^0.5", "a stress intensity factor"},
};

std::string unit_advice(std::string_view si_unit) {
  if (si_unit == "1") return "(expected no unit)";
  return "(expected a unit such as " + std::string(si_unit) + ")";
}

struct Split {
  std::optional<double> number;
  std::string_view unit;
  bool too_large = false;
};

Split split(std::string_view text) {
  text = without_blanks(text);
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  // from_chars also takes "inf" and "nan", which no quantity of a case can be.
  std::size_t const first = digits.starts_with('-') && digits.size() == text.size() ? 1 : 0;
  bool const starts = digits.size() > first && (digits[first] == '.' || (digits[first] >= '0' && digits[first] <= '9'));
  if (!starts) return {};
  double value = 0;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  Split result;
  if (error == std::errc::invalid_argument) return result;
  result.too_large = error == std::errc::result_out_of_range;
  result.number = value;
  result.unit = without_blanks(digits.substr(static_cast<std::size_t>(end - digits.data())));
  return result;
}

Quantity failed(std::string problem) { return {0, std::move(problem)}; }

Quantity convert(std::string_view text, Split const& parts, Measure const& from, Measure const& to,
                 std::string_view si_unit) {
  Conversion const conversion(from, to);
  if (!conversion) {
    return failed(in_quotes(text) + " is not " + dimension_noun(si_unit) + " " + unit_advice(si_unit));
  }
  double const value = conversion(*parts.number);
  if (!std::isfinite(value))
    return failed(in_quotes(text) + " is too large for a number (at most 1.8e308 in SI units)");
  return {value, std::nullopt};
}

// Walks down to the base units that a unit is made of and writes them as a product, e.g. "kg^1 m^-1 s^-2".
ut_status visit_basic(ut_unit const* unit, void* out) {
  char const* const symbol = ut_get_symbol(unit, UT_ASCII);
  *static_cast<std::string*>(out) = symbol != nullptr ? symbol : "";
  return symbol != nullptr ? UT_SUCCESS : UT_BAD_ARG;
}
ut_status visit_product(ut_unit const*, int count, ut_unit const* const* units, int const* powers, void* out) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    char const* const symbol = ut_get_symbol(units[i], UT_ASCII);
    if (symbol == nullptr) return UT_BAD_ARG;
    text += (text.empty() ? "" : " ") + std::string(symbol) + "^" + std::to_string(powers[i]);
  }
  *static_cast<std::string*>(out) = text.empty() ? "1" : text;
  return UT_SUCCESS;
}
ut_status visit_timestamp(ut_unit const*, ut_unit const*, double, void*) { return UT_BAD_ARG; }
ut_status visit_logarithm(ut_unit const*, double, ut_unit const*, void*) { return UT_BAD_ARG; }
ut_status visit_galilean(ut_unit const*, double, ut_unit const* underlying, double, void* out);

constexpr ut_visitor base_units{visit_basic, visit_product, visit_galilean, visit_timestamp, visit_logarithm};

ut_status visit_galilean(ut_unit const*, double, ut_unit const* underlying, double, void* out) {
  return ut_accept_visitor(underlying, &base_units, out);
}

std::string bad_number(std::string_view text, std::string_view expected) {
  return in_quotes(text) + " is not a number with a unit (expected " + std::string(expected) + ")";
}

}  // namespace

std::string dimension_noun(std::string_view si_unit) {
  auto const* const found =
      std::find_if(dimensions.begin(), dimensions.end(), [&](Dimension const& d) { return d.unit == si_unit; });
  if (found != dimensions.end()) return std::string(found->noun);
  return "a quantity in " + std::string(si_unit);
}

Quantity read_quantity(std::string_view text, std::string_view si_unit) {
  Split const parts = split(text);
  if (!parts.number) {
    return failed(bad_number(
        text, si_unit == "1" ? "a number such as 0.5" : "a text such as \"2 " + std::string(si_unit) + "\""));
  }
  if (parts.too_large)
    return failed(in_quotes(text) + " cannot be held as a number (at most 1.8e308, at least 5e-324)");
  if (parts.unit.empty()) return {*parts.number, std::nullopt};
  std::lock_guard const lock(library_lock());
  Measure const to = parse_unit(si_unit);
  if (!to.unit) throw std::invalid_argument("not a unit: " + std::string(si_unit));
  Measure const from = parse_unit(parts.unit);
  if (!from.unit)
    return failed(in_quotes(parts.unit) + " in " + in_quotes(text) + " is not a unit " + unit_advice(si_unit));
  return convert(text, parts, from, to, si_unit);
}

Quantity read_any_quantity(std::string_view text) {
  Split const parts = split(text);
  if (!parts.number) return failed(bad_number(text, "a text such as \"105 rad/s\""));
  if (parts.too_large)
    return failed(in_quotes(text) + " cannot be held as a number (at most 1.8e308, at least 5e-324)");
  if (parts.unit.empty()) return {*parts.number, std::nullopt};
  std::lock_guard const lock(library_lock());
  Measure const from = parse_unit(parts.unit);
  std::string base;  // of the square, if it is one
  bool const known = from.unit && ut_accept_visitor(from.unit.get(), &base_units, &base) == UT_SUCCESS;
  Measure const to{known ? whole_unit(base) : nullptr, from.squared};
  if (!to.unit)
    return failed(in_quotes(parts.unit) + " in " + in_quotes(text) + " is not a unit (expected one such as m/s)");
  return convert(text, parts, from, to, base);
}

bool is_unit(std::string_view text) {
  std::lock_guard const lock(library_lock());
  return parse_unit(text).unit != nullptr;
}

bool same_dimension(std::string_view a, std::string_view b) {
  std::lock_guard const lock(library_lock());
  return static_cast<bool>(Conversion(parse_unit(a), parse_unit(b)));
}

double convert_from_si(double value, std::string_view si_unit, std::string_view unit) {
  std::lock_guard const lock(library_lock());
  Conversion const conversion(parse_unit(si_unit), parse_unit(unit));
  if (!conversion) {
    throw std::invalid_argument(in_quotes(unit) + " is not a unit of " + dimension_noun(si_unit) + " " +
                                unit_advice(si_unit));
  }
  return conversion(value);
}

}  // namespace piola
