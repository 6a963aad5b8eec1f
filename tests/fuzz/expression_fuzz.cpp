// SPDX-License-Identifier: Apache-2.0
// Whatever text stands for a formula, it is compiled and evaluated, or refused with ExpressionError.
#include "piola/base/expression.hpp"
#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string const text(reinterpret_cast<char const*>(data), size);
  try {
    piola::Expression const formula(text, {{{"L", 6.0}}, {{"phase", "pi*Y/(2*L)"}}, {"damage"}});
    formula({0.5, -1, 2}, 0.25, std::array<double, 1>{0.5});
    piola::Expression const copy = formula;
    copy.depends_on_time();
    copy({0, 0, 0}, 0, std::array<double, 1>{0.0});
  } catch (piola::ExpressionError const&) {
  }
  return 0;
}
