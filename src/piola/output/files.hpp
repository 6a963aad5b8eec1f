// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace piola {

/// Writes a file so that a reader sees either the old content or all of the new one: to "PATH.part", synced to the
/// disk, then renamed. Throws FileError with path, reason and advice (the part file is removed, other files are
/// untouched). `end` follows the content.
void write_whole_file(std::filesystem::path const& path, std::span<std::byte const> content, std::string_view end = {});
void write_whole_file(std::filesystem::path const& path, std::string_view content);

/// Replaces the last `old_end` bytes of a file of `size` bytes by a longer text, in one write, and waits until it is on
/// the disk. Returns false, with nothing changed, if there is no file of that size. Throws FileError if it cannot be
/// written; the file is then as before.
bool overwrite_end(std::filesystem::path const& path, std::uint64_t size, std::uint64_t old_end, std::string_view text);

inline constexpr std::uint64_t most_text_bytes = 4'000'000'000;  ///< what a text file may hold at most

/// The whole content of a text file. Throws FileError if it cannot be read or holds more than `most` bytes; no more
/// than that is read.
std::string read_text_file(std::filesystem::path const& path, std::uint64_t most = most_text_bytes);

/// Makes a folder with its parents. Throws FileError if that is impossible.
void make_folder(std::filesystem::path const& path);

/// The sentence of every failed write: "PATH: cannot be written, REASON - what to do". `error` is an errno.
std::string cannot_write(std::filesystem::path const& path, int error);

}  // namespace piola
