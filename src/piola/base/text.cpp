// SPDX-License-Identifier: Apache-2.0
#include "piola/base/text.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

template <class Word>
std::string join(std::span<Word const> words, std::string_view separator) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += separator;
    text += words[i];
  }
  return text;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Letters beyond ASCII stay as they are.
std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 120;  // a message must stay readable whatever the file holds
  std::string out = "\"";
  for (char const c : text.substr(0, longest)) {
    auto const byte = static_cast<unsigned char>(c);
    if (c == '\n')
      out += "\\n";
    else if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\x{:02x}", byte);
    else
      out += c;
  }
  // A cut in the middle of a UTF-8 character would leave a broken one behind.
  if (text.size() > longest) {
    while (out.size() > 1 && (static_cast<unsigned char>(out.back()) & 0xc0) == 0x80) out.pop_back();
    if (out.size() > 1 && (static_cast<unsigned char>(out.back()) & 0x80) != 0) out.pop_back();
    out += "...";
  }
  return out + "\"";
}

std::string joined(std::span<std::string const> words, std::string_view separator) { return join(words, separator); }
std::string joined(std::span<std::string_view const> words, std::string_view separator) {
  return join(words, separator);
}

int edit_distance(std::string_view a, std::string_view b) {
  std::size_t const n = b.size();
  std::vector<int> before(n + 1), last(n + 1), now(n + 1);
  for (std::size_t j = 0; j <= n; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      int const change = a[i - 1] == b[j - 1] ? 0 : 1;
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + change});
      bool const swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  PIOLA_ENSURES(last[n] <= static_cast<int>(std::max(a.size(), n)));
  return last[n];
}

std::optional<std::string> nearest_name(std::string_view asked, std::span<std::string const> known) {
  if (asked.size() > 64) return std::nullopt;
  std::string const wanted = lower_case(asked);
  int best = std::max(1, static_cast<int>(wanted.size()) / 3) + 1;
  std::optional<std::string> found;
  for (std::string const& name : known) {
    int const distance = edit_distance(wanted, lower_case(name));
    if (distance < best && distance < static_cast<int>(std::max(name.size(), wanted.size()))) {
      best = distance;
      found = name;
    }
  }
  if (found || wanted.size() < 3) return found;
  auto const longer =
      std::find_if(known.begin(), known.end(), [&](auto const& name) { return lower_case(name).starts_with(wanted); });
  return longer == known.end() ? std::nullopt : std::optional(*longer);
}

std::string advice_for_name(std::string_view wanted, std::span<std::string const> known) {
  if (auto const near = nearest_name(wanted, known)) return "did you mean " + in_quotes(*near) + "?";
  return "choose one of these";
}

std::string known_names_text(std::string_view wanted, std::span<std::string const> known) {
  constexpr std::size_t few = 24, shown = 8;
  if (known.size() <= few) return joined(known);
  std::vector<std::string> nearest(known.begin(), known.end());
  std::stable_sort(nearest.begin(), nearest.end(), [&](std::string const& a, std::string const& b) {
    std::string const asked = lower_case(wanted.substr(0, 64));
    return edit_distance(asked, lower_case(a)) < edit_distance(asked, lower_case(b));
  });
  nearest.resize(shown);
  return joined(nearest) + " and " + std::to_string(known.size() - shown) + " more";
}

bool is_name(std::string_view text) {
  if (text.empty() || text.size() > 64 || is_digit(text.front())) return false;
  return std::all_of(text.begin(), text.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

std::string_view without_blanks(std::string_view text) {
  auto const blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string> to_strings(std::span<std::string_view const> words) { return {words.begin(), words.end()}; }

std::string number_text(double value, int digits) {
  PIOLA_EXPECTS(digits >= 1);
  return std::isnan(value) ? "not a number" : fmt::format("{:.{}g}", value, digits);
}

std::string exact_text(double value) {
  std::array<char, 40> buffer{};
  auto const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string count_text(std::int64_t count) {
  std::string text = std::to_string(count);
  std::size_t const sign = count < 0 ? 1 : 0;
  for (std::size_t i = text.size(); i > 3 + sign; i -= 3) text.insert(i - 3, ",");
  return text;
}

std::string quantity_text(double value, std::string_view si_unit, int digits) {
  PIOLA_EXPECTS(digits >= 1);
  if (si_unit == "1" || std::isnan(value)) return number_text(value, digits);
  constexpr std::array<std::string_view, 7> prefixed{"Pa", "s", "m", "J", "N", "W", "Hz"};
  constexpr std::array<std::string_view, 9> prefixes{"p", "n", "u", "m", "", "k", "M", "G", "T"};
  bool const usual = std::find(prefixed.begin(), prefixed.end(), si_unit) != prefixed.end();
  double const size = std::abs(value);
  if (!usual || !(size > 0) || !std::isfinite(size)) return number_text(value, digits) + " " + std::string(si_unit);
  // Seconds and metres are not counted in thousands; a stress of 0.5 Pa is better left as it is than called 500 mPa.
  int const highest = si_unit == "s" || si_unit == "m" ? 0 : 4;
  int const power = std::clamp(static_cast<int>(std::floor(std::log10(size) / 3 + 1e-12)), -4, highest);
  return fmt::format("{} {}{}", number_text(value / std::pow(10.0, 3 * power), digits), *(prefixes.begin() + 4 + power),
                     si_unit);
}

std::string duration_text(double seconds) {
  if (!(seconds >= 0) || seconds > 1e15) return "unknown";
  if (seconds < 9.95) return number_text(seconds, 2) + " s";
  auto const whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02d} s", whole / 60, whole % 60);
  if (whole < 86400) return fmt::format("{} h {:02d} min", whole / 3600, whole % 3600 / 60);
  return fmt::format("{} d {:02d} h", whole / 86400, whole % 86400 / 3600);
}

std::string size_text(double bytes) {
  constexpr std::array<std::string_view, 6> units{"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < units.size()) {
    bytes /= 1000;
    ++unit;
  }
  return fmt::format("{} {}", bytes < 99.5 ? number_text(bytes, 2) : number_text(bytes, 3), units[unit]);
}

}  // namespace piola
