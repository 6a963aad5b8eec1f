// SPDX-License-Identifier: Apache-2.0
#include "piola/base/problems.hpp"

namespace piola {
namespace {

std::string place_text(Place const& place) {
  std::string text = place.file;
  if (place.line > 0) text += ":" + std::to_string(place.line);
  if (place.line > 0 && place.column > 0) text += ":" + std::to_string(place.column);
  return text;
}

}  // namespace

void Problems::add(Place const& place, std::string text) {
  std::string const where = place_text(place);
  lines_.push_back(where.empty() ? std::move(text) : where + ": " + text);
}

void Problems::raise_if_any() const {
  if (lines_.empty()) return;
  std::string message;
  for (std::string const& line : lines_) message += (message.empty() ? "" : "\n") + line;
  throw InputError(message);
}

}  // namespace piola
