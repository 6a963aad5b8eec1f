// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/problems.hpp"
#include "piola/setup/shapes.hpp"
#include <filesystem>
#include <string>

namespace piola {

/// The folder of a results folder in which the files lie that the case names, so that it can be resumed anywhere.
inline constexpr char const* kept_files = "case-files";

/// Where a file is that a case names: in `case-files` beside the case, as a run keeps it there, else at its path, which
/// is relative to the case file.
CaseFile case_file(Place const& place, std::string const& given);

/// What it is called there: its path in one name.
std::string kept_name(std::string const& given);

}  // namespace piola
