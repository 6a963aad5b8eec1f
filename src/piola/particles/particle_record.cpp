// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/particle_record.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/math/digest.hpp"
#include "piola/particles/body_range.hpp"
#include <fmt/format.h>

namespace piola {
namespace {

/// Hash of the values of one body in some arrays; arrays that are not there have none.
template <class... Array>
std::string hash_of(Body const& body, Array const&... arrays) {
  auto const first = static_cast<std::size_t>(body.first), count = static_cast<std::size_t>(body.last - body.first);
  auto const part = [&](auto const& array) {
    return std::as_bytes(std::span(array.seen()).subspan(array.empty() ? 0 : first, array.empty() ? 0 : count));
  };
  std::string text;
  auto const add = [&](auto const& array) {
    Digest digest(part(array).size());
    digest.add(part(array));
    text += fmt::format("{:016x}", digest.value());
  };
  (add(arrays), ...);
  return text;
}

std::vector<std::string> split(std::string const& text, char at) {
  std::vector<std::string> pieces;
  for (std::size_t start = 0; start < text.size();) {
    std::size_t const end = std::min(text.find(at, start), text.size());
    pieces.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return pieces;
}

/// The columns of a line, by what they hold.
constexpr std::array<char const*, 5> columns{"names", "numbers of particles", "positions", "volumes", "parts"};

std::string body_difference(std::vector<std::string> const& before, std::vector<std::string> const& now) {
  if (before.size() != columns.size() || now.size() != columns.size()) return "another record";
  if (before[0] != now[0]) return fmt::format("body {}, not {}", in_quotes(now[0]), in_quotes(before[0]));
  if (before[1] != now[1]) return fmt::format("body {}: {} particles, not {}", in_quotes(now[0]), now[1], before[1]);
  std::string text;
  for (std::size_t c = 2; c < columns.size(); ++c)
    if (before[c] != now[c]) text += (text.empty() ? "" : " and ") + std::string(columns[c]);
  return text.empty() ? "" : fmt::format("body {}: {} of its {} particles", in_quotes(now[0]), text, now[1]);
}

}  // namespace

std::string particle_record(ParticleSet const& particles) {
  std::string text;
  for (Body const& body : particles.bodies) {
    PIOLA_EXPECTS(is_range_in(body, particles));
    text += fmt::format("{}\t{}\t{}\t{}\t{}\n", body.name, body.last - body.first, hash_of(body, particles.X),
                        hash_of(body, particles.volume, particles.kernel_volume),
                        hash_of(body, particles.part, particles.crack_side));
  }
  return text;
}

std::string particle_difference(std::string const& before, std::string const& now) {
  auto const old_lines = split(before, '\n'), new_lines = split(now, '\n');
  if (old_lines.size() != new_lines.size()) return fmt::format("{} bodies, not {}", new_lines.size(), old_lines.size());
  std::vector<std::string> found;
  for (std::size_t b = 0; b < new_lines.size(); ++b)
    if (auto text = body_difference(split(old_lines[b], '\t'), split(new_lines[b], '\t')); !text.empty())
      found.push_back(std::move(text));
  return joined(found, "; ");
}

}  // namespace piola
