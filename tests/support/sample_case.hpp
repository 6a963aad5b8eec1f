// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/model/read_case.hpp"
#include <stdexcept>
#include <string>
#include <string_view>

namespace piola::test {

/// A small valid case. Messages of tests refer to its line numbers.
inline std::string sample_case() {
  return R"toml(title = "Twisting column"
[constants]
Omega = "105 rad/s"
L = 6
[run]
end = "0.5 s"
[[body]]
name = "column"
shape = { box = { min = ["-0.5 m", 0, "-50 cm"], max = [0.5, "6 m", 0.5] }, particles = [5, 25, 5] }
material = { law = "neo_hookean", density = "1100 kg/m^3", youngs_modulus = "17 MPa", poissons_ratio = 0.45 }
formulation = { name = "jst_sph", variables = "pF", eps4_momentum = 0.125 }
define = { w = "Omega*sin(phase)", phase = "pi*Y/(2*L)" }
initial_velocity = ["w*Z", "0", "-w*X"]
[[support]]
body = "column"
where = "Y <= 0"
fix = "xyz"
[[probe]]
name = "tip"
body = "column"
at = [0.5, 6, 0.5]
quantities = ["displacement_x", "pressure"]
)toml";
}

/// The text with the first occurrence of `from` replaced. Throws if there is none.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  std::size_t const at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the sample has no " + std::string(from));
  return text.replace(at, from.size(), to);
}

inline std::string sample_with(std::string_view from, std::string_view to) { return replaced(sample_case(), from, to); }

/// Error message of a case; "" if it is valid.
inline std::string message_of(std::string const& text, std::vector<std::string> const& overrides = {},
                              ReadLimits const& limits = {}) {
  try {
    read_case_text(text, "case.toml", overrides, limits);
  } catch (InputError const& error) {
    return error.what();
  }
  return "";
}

}  // namespace piola::test
