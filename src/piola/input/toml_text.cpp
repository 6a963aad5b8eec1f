// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/input/document.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

std::string text_value(std::string_view text) {
  std::string out = "\"";
  for (char const c : text) {
    auto const byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + "\"";
}

std::string key_text(std::string_view key) {
  bool const bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? std::string(key) : text_value(key);
}

std::string real_value(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string text = exact_text(value);
  // TOML distinguishes a real number from an integer by its point or exponent.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string lines_of(Node const& table) {
  std::string out;
  for (Node::Entry const& entry : table.entries) {
    out += key_text(entry.key) + " = " + toml_value(entry.value) + "\n";
  }
  return out;
}

}  // namespace

std::string toml_value(Node const& node) {
  switch (node.kind) {
    case Node::Kind::text: return text_value(node.text);
    case Node::Kind::integer: return std::to_string(node.integer);
    case Node::Kind::real: return real_value(node.real);
    case Node::Kind::flag: return node.flag ? "true" : "false";
    case Node::Kind::date: return node.text;
    case Node::Kind::array: {
      std::string out = "[";
      for (Node const& item : node.items) out += (out.size() > 1 ? ", " : "") + toml_value(item);
      return out + "]";
    }
    case Node::Kind::table: break;
  }
  std::string out = "{";
  for (Node::Entry const& entry : node.entries) {
    out += (out.size() > 1 ? ", " : " ") + key_text(entry.key) + " = " + toml_value(entry.value);
  }
  return out + (out.size() > 1 ? " }" : "}");
}

std::string toml_text(Node const& root) {
  std::string values, sections;
  for (Node::Entry const& entry : root.entries) {
    std::string const key = key_text(entry.key);
    if (entry.value.is_table()) {
      sections += "\n[" + key + "]\n" + lines_of(entry.value);
    } else if (entry.value.is_list_of_tables()) {
      for (Node const& item : entry.value.items) sections += "\n[[" + key + "]]\n" + lines_of(item);
    } else {
      values += key + " = " + toml_value(entry.value) + "\n";
    }
  }
  return values + sections;
}

}  // namespace piola
