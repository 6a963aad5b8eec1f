// SPDX-License-Identifier: Apache-2.0
#include "piola/input/bound_keys.hpp"
#include <deque>

namespace piola {

std::string default_number(double value, std::string_view unit) {
  bool const clear = value == 0 || unit == "1" || unit == "degree";
  return exact_text(value) + (clear ? "" : " " + std::string(unit));
}

std::string_view kept_text(std::string text) {
  static std::deque<std::string> texts;  // never moves what it holds
  return texts.emplace_back(std::move(text));
}

void read_limit(Section const& section, std::string_view key, double& limit, double off) {
  auto const value = section.find(key);
  if (value && value->node.is_text("off"))
    limit = off;
  else
    section.read(key, limit);
}

}  // namespace piola
