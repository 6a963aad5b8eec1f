// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/input/section.hpp"
#include "piola/materials/library.hpp"
#include "piola/setup/shapes.hpp"
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace piola {

/// A file of data/materials, which is a text inside the program (cmake/PiolaEmbeddedFiles.cmake).
struct BuiltInLibraryFile {
  std::string_view name, text;
};
std::span<BuiltInLibraryFile const> built_in_library_files();

/// The materials that come with the program. Read when first asked for, once per process.
MaterialLibrary const& material_library();

/// Adds the sources and materials of a library file to a library; docs/user/case-file.md describes the format. `name`:
/// of the file, for messages. Materials with a problem are left out.
void read_library_file(std::string_view text, std::string const& name, MaterialLibrary& library, Problems& problems);

/// Materials that a case may name: those of the program and of its key `library`. Nothing without the key, so that
/// material_library() is read only if a material of the case has a name.
using CaseLibrary = std::optional<MaterialLibrary>;

/// The library of a case, with the files of its key `library`. Throws InputError if a file has a problem: what names
/// its materials could not be read either.
CaseLibrary read_case_library(Section const& top);

}  // namespace piola
