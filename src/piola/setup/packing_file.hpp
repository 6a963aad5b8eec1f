// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/geometry/packing.hpp"
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace piola {

/// Packings on disk, so that a body is packed once. `key` contains all input on which the positions depend.

/// File name of a packing, from its key: "packed-0123456789abcdef.cloud".
std::string packing_name(std::string const& key);

/// Throws FileError.
void write_packing(std::filesystem::path const& path, std::string const& key, geometry::Packing const& packing);

/// Reads a packing. Returns nothing if the file is missing, damaged or of another key; the caller then packs the body.
std::optional<geometry::Packing> read_packing(std::filesystem::path const& path, std::string const& key);

/// Folder in the results in which a stopped set-up leaves packings, finished or not, for the next run.
inline constexpr char const* unfinished_set_up = "unfinished-set-up";

/// A packing that was stopped, under the same name as a finished one. Throws FileError. Inverse of read_unfinished().
void write_unfinished(std::filesystem::path const& path, std::string const& key,
                      geometry::UnfinishedPacking const& packing);

/// Nothing in the cases of read_packing().
std::optional<geometry::UnfinishedPacking> read_unfinished(std::filesystem::path const& path, std::string const& key);

/// 64-bit hash of a text.
std::uint64_t digest_of(std::string_view text);

}  // namespace piola
