// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh_bytes.hpp"
#include "piola/base/text.hpp"
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace piola::geometry {

namespace {

constexpr std::uintmax_t largest_file = 2'000'000'000;  // 40 million faces; indices of half-edges fit an int
constexpr std::size_t stl_header = 84, stl_face = 50;

void check_binary_stl(std::string_view bytes, std::string const& name, std::vector<std::string>& problems) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + stl_header - sizeof count, sizeof count);
  std::size_t const room = (bytes.size() - stl_header) / stl_face;
  if (count > room)
    problems.push_back(
        fmt::format("{}: the file promises {} faces and has room for {}: it was cut off or is no STL - "
                    "export it again",
                    name, count_text(count), count_text(static_cast<std::int64_t>(room))));
}

bool is_text_of_stl(std::string_view bytes) {
  auto const start = bytes.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || bytes.substr(start, 5) != "solid") return false;
  std::string_view const begin = bytes.substr(0, 4096);
  return begin.find('\0') == std::string_view::npos && bytes.find("facet") != std::string_view::npos;
}

void check_stl(std::string_view bytes, std::string const& name, std::vector<std::string>& problems) {
  if (is_text_of_stl(bytes)) {
    if (bytes.find("endsolid") == std::string_view::npos)
      problems.push_back(
          fmt::format("{}: the line \"endsolid\" is missing: the file was cut off - export it again", name));
    return;
  }
  if (bytes.size() < stl_header)
    problems.push_back(
        fmt::format("{}: is no STL file (neither \"solid\" with facets nor a binary header) - export it "
                    "again as STL",
                    name));
  else
    check_binary_stl(bytes, name, problems);
}

/// Where the line "end_header" of a PLY file begins. Without such a line, assimp searches endlessly.
std::size_t end_of_header(std::string_view bytes) {
  constexpr std::string_view word = "end_header", line_ends = "\r\n";
  for (auto at = bytes.find(word); at != std::string_view::npos; at = bytes.find(word, at + 1)) {
    auto const before = bytes.substr(0, at).find_last_not_of(" \t");
    bool const starts = before != std::string_view::npos && line_ends.find(bytes[before]) != std::string_view::npos;
    auto const after = bytes.find_first_not_of(" \t", at + word.size());
    bool const ends = after != std::string_view::npos && line_ends.find(bytes[after]) != std::string_view::npos;
    if (starts && ends) return at;
  }
  return std::string_view::npos;
}

/// Each element of a PLY file takes at least a byte for each of its properties.
void check_ply(std::string_view bytes, std::string const& name, std::vector<std::string>& problems) {
  auto const end = end_of_header(bytes);
  if (!bytes.starts_with("ply") || end == std::string_view::npos) {
    problems.push_back(
        fmt::format("{}: is no PLY file (no header from \"ply\" to \"end_header\") - export it again", name));
    return;
  }
  std::istringstream header{std::string(bytes.substr(0, end))};
  std::string line, word, kind;
  double wanted = 0, count = 0;
  bool good = true;
  while (std::getline(header, line)) {
    std::istringstream words(line);
    words >> word;
    if (word == "element") good = good && (words >> kind >> count) && count >= 0 && count < 1e9;
    if (word == "property") wanted += count;
  }
  auto const room = static_cast<double>(bytes.size() - end);
  if (!good || wanted > room)
    problems.push_back(
        fmt::format("{}: the header promises more elements than the file has room for: it was cut off - "
                    "export it again",
                    name));
}

}  // namespace

std::string mesh_name(std::string const& path) { return std::filesystem::path(path).filename().string(); }

std::string mesh_format(std::string const& name) {
  auto const dot = name.rfind('.');
  std::string format = dot == std::string::npos ? "" : name.substr(dot + 1);
  for (char& c : format)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return format;
}

std::string bytes_of_mesh(std::string const& path, std::vector<std::string>& problems) {
  std::string const name = mesh_name(path);
  auto const refuse = [&](std::string const& what) {
    problems.push_back(fmt::format("{}: {}", name.empty() ? in_quotes(path) : name, what));
    return std::string();
  };
  std::error_code error;
  auto const status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return refuse("there is no such file - correct its name or folder");
  if (std::filesystem::is_directory(status)) return refuse("is a folder (a file is wanted) - name the file in it");
  if (!std::filesystem::is_regular_file(status)) return refuse("is not an ordinary file - copy the mesh into one");
  auto const size = std::filesystem::file_size(path, error);
  if (!error && size > largest_file)
    return refuse(fmt::format("has {} (allowed: {}) - export it with a coarser tolerance",
                              size_text(static_cast<double>(size)), size_text(static_cast<double>(largest_file))));
  if (!error && size == 0) return refuse("is empty - export it again");
  std::string bytes(error ? 0 : size, '\0');
  std::ifstream file(path, std::ios::binary);
  if (error || !file.read(bytes.data(), static_cast<std::streamsize>(size)))
    return refuse("cannot be read - check its permissions");
  return bytes;
}

void check_declared_sizes(std::string_view bytes, std::string const& name, std::vector<std::string>& problems) {
  std::string const format = mesh_format(name);
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos)
    problems.push_back(fmt::format("{}: is empty - export it again", name));
  else if (format == "stl")
    check_stl(bytes, name, problems);
  else if (format == "ply")
    check_ply(bytes, name, problems);
  else if (format != "obj")
    problems.push_back(fmt::format("{}: the name ends in {} (allowed: .stl, .obj, .ply) - export one of these", name,
                                   format.empty() ? "no format" : in_quotes("." + format)));
}

}  // namespace piola::geometry
