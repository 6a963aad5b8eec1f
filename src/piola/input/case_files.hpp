// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/input/document.hpp"
#include "piola/input/section.hpp"
#include "piola/setup/shapes.hpp"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

struct CaseSpec;

/// The folder of a results folder with copies of the files that the case names and a list of them, so that the run can
/// be resumed anywhere.
inline constexpr char const* kept_files = "case-files";
inline constexpr char const* kept_list = "files.toml";  ///< the list in it

/// A file that the case names, as an entry of that list.
struct KeptFile {
  std::string given;           ///< as the case names it
  std::string kept;            ///< name of the copy in `case-files`; empty: too large to copy
  std::filesystem::path from;  ///< where it was when the run began, absolute
  std::uint64_t bytes = 0;
  std::string hash;  ///< of its content
};

/// Path of the file that the key `file` of a section names: as found by use_kept_files(), else at its path, which is
/// relative to the case file.
CaseFile case_file(Section const& section, std::string const& given);
/// As case_file(), for a text that names a file.
CaseFile case_file(Node const& text);

/// Hash of the content of a file, 16 hexadecimal digits (math/digest.hpp). Throws FileError if it cannot be read.
std::string content_hash(std::filesystem::path const& path);

/// Digest of the content of a file; empty if it is no ordinary file or cannot be read.
std::string digest_of_file(std::filesystem::path const& path);

/// Whether the value of a key names a file, or is a list of texts that do.
inline bool names_files(std::string_view key) { return key == "file" || key == "library"; }

/// Calls f(text) for each text below `root`, a Node, that names a file, in the order of the document.
template <class AnyNode, class F>
void each_file_name(AnyNode& root, F const& f) {
  auto const take = [&](auto& node) {
    if (node.is_text()) f(node);
  };
  for (auto& entry : root.entries) {
    if (names_files(entry.key)) {
      take(entry.value);
      for (auto& item : entry.value.items) take(item);
    }
    each_file_name(entry.value, f);
  }
  for (auto& item : root.items) each_file_name(item, f);
}

/// The files that a document names, in its order.
std::vector<CaseFile> files_named_in(Node const& root);

/// All files that a case reads, each once, in the order of the case.
std::vector<CaseFile> files_of(CaseSpec const& spec);

/// The copy's name in `case-files`: different for each `number`, whatever the paths are.
std::string kept_name(std::size_t number, std::string const& given);

/// Writes and reads the list. No list, no entries. Throws FileError, InputError.
std::string text_of_list(std::vector<KeptFile> const& files);
std::vector<KeptFile> read_kept_list(std::filesystem::path const& results);

/// For the case.toml of a results folder: every value of a key `file` or `library` that is in the list points to the
/// copy, or else to the file where it was. A problem for each that is missing or has another content than when the run
/// began.
void use_kept_files(Node& root, std::filesystem::path const& results, Problems& problems);

/// A problem for each file of the case that is not the one that the run in a results folder began with.
void compare_with_kept_list(CaseSpec const& spec, std::filesystem::path const& results, Problems& problems);

}  // namespace piola
