// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace piola::geometry {

/// The last part of a path, for messages.
std::string mesh_name(std::string const& path);

/// File extension in lower case: "stl", "obj", "ply" or another one.
std::string mesh_format(std::string const& name);

/// The whole file; without problems it is not empty.
std::string bytes_of_mesh(std::string const& path, std::vector<std::string>& problems);

/// Refuses files that are no mesh by their name or that promise more than they hold. What passes cannot make a reader
/// reserve memory out of proportion to the size of the file.
void check_declared_sizes(std::string_view bytes, std::string const& name, std::vector<std::string>& problems);

}  // namespace piola::geometry
