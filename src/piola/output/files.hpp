// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// Writes a file so that a reader sees either the old content or all of the new one: to "PATH.part", synced to the
/// disk, then renamed. Throws FileError with path, reason and advice (the part file is removed, other files are
/// untouched).
void write_whole_file(std::filesystem::path const& path, std::span<std::byte const> content);
void write_whole_file(std::filesystem::path const& path, std::string_view content);

/// The whole content of a text file. Throws FileError if it cannot be read.
std::string read_text_file(std::filesystem::path const& path);

/// Makes a folder with its parents. Throws FileError if that is impossible.
void make_folder(std::filesystem::path const& path);

/// The sentence of every failed write: "PATH: cannot be written, REASON - what to do". `error` is an errno.
std::string cannot_write(std::filesystem::path const& path, int error);

}  // namespace piola
