// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_files.hpp"

namespace piola {

CaseFile case_file(Place const& place, std::string const& given) {
  namespace fs = std::filesystem;
  fs::path const folder = fs::path(place.file).parent_path(), kept = folder / kept_files / kept_name(given);
  std::error_code error;
  return {given, fs::is_regular_file(kept, error) ? kept : folder / given};
}

std::string kept_name(std::string const& given) {
  std::string name;
  for (char const c : given) name += c == '/' || c == '\\' ? std::string("__") : std::string(1, c);
  return name;
}

}  // namespace piola
