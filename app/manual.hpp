// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace piola {
struct LibraryMaterial;
}

namespace piola::app {

enum class Layout { plain, markdown };

/// Texts of `piola describe`, generated from the tables of the program. An empty name selects all of a kind. Each
/// throws InputError for an unknown name.
std::string describe_materials(std::string const& name, Layout layout);
std::string describe_kernels(std::string const& name, Layout layout);
std::string describe_formulations(std::string const& name, Layout layout);
std::string describe_library(std::string const& name, Layout layout);
std::string describe_case(std::string const& section, Layout layout);

std::string overview();     ///< all kinds, one line each
std::string manual_page();  ///< docs/user/case-reference.md

std::string library_table(Layout layout);                   ///< names, laws and descriptions
std::string describe_set(LibraryMaterial const& material);  ///< law, words, numbers with their sources
void refuse_renamed(std::string const& name);               ///< throws InputError if a material had this name before

}  // namespace piola::app
