// SPDX-License-Identifier: Apache-2.0
#include "piola/base/controls.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

/// Bytes of the control character at a position; 0 if there is another character.
std::size_t control_at(std::string_view text, std::size_t i) {
  unsigned const byte = byte_at(text, i), next = byte_at(text, i + 1);
  if (byte == '\n' || byte == '\t' || (byte == '\r' && next == '\n')) return 0;
  if (byte < 0x20 || byte == 0x7f) return 1;
  return byte == 0xc2 && next >= 0x80 && next <= 0x9f ? 2 : 0;
}

}  // namespace

std::size_t find_control(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (control_at(text, i) > 0) return i;
  return std::string_view::npos;
}

std::string without_controls(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    bool const at_end = i == 0 || i + 1 == text.size();
    std::size_t const bytes = at_end && text[i] == '\r' ? 0 : control_at(text, i);
    if (bytes > 0) out += fmt::format("\\x{:02x}", byte_at(text, i + bytes - 1));
    if (bytes == 0) out += text[i];
    i += std::max<std::size_t>(bytes, 1);
  }
  return out;
}

}  // namespace piola
