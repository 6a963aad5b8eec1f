// SPDX-License-Identifier: Apache-2.0
#include "piola/input/case_files.hpp"
#include "piola/base/read_file.hpp"
#include "piola/base/text.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/math/digest.hpp"
#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace piola {
namespace {

namespace fs = std::filesystem;

std::string in_toml(std::string const& text) {
  Node node;
  node.kind = Node::Kind::text;
  node.text = text;
  return toml_value(node);
}

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
}

/// A path may hold bytes that TOML does not: all but the plain ones are written as "%2f".
std::string coded(std::string const& path) {
  std::string text;
  for (char const c : path)
    text +=
        is_plain(c) || c == '/' || c == '_' ? std::string(1, c) : fmt::format("%{:02x}", static_cast<unsigned char>(c));
  return text;
}

/// Inverse of coded().
std::string decoded(std::string const& text) {
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned byte = static_cast<unsigned char>(text[i]);
    if (text[i] == '%' && i + 2 < text.size()) {
      std::from_chars(text.data() + i + 1, text.data() + i + 3, byte, 16);
      i += 2;
    }
    path += static_cast<char>(byte);
  }
  return path;
}

std::string text_at(Node const& entry, char const* key) {
  Node const* const value = entry.find(key);
  return value != nullptr && value->is_text() ? value->text : "";
}

KeptFile const* find_kept(std::vector<KeptFile> const& list, std::string const& given) {
  auto const found = std::find_if(list.begin(), list.end(), [&](KeptFile const& file) { return file.given == given; });
  return found == list.end() ? nullptr : &*found;
}

std::string is_another(std::string const& given, fs::path const& path, std::string const& hash,
                       std::string const& needed) {
  return fmt::format(
      "{}: {} {} (needed: the content that it had when the run began, hash {}{}) - bring it back, or run "
      "the case again with 'piola run'",
      in_quotes(given), path.string(), hash.empty() ? "cannot be read" : "has changed", needed,
      hash.empty() ? "" : ", not " + hash);
}

/// The copy, or the file where it was; nothing, and a problem, if neither has the content of the list.
fs::path place_of_kept(KeptFile const& file, fs::path const& results, Place const& place, Problems& problems) {
  fs::path const copy = results / kept_files / file.kept;
  if (!file.kept.empty() && digest_of_file(copy) == file.hash) return copy;
  std::string const hash = digest_of_file(file.from);
  if (hash == file.hash) return file.from;
  bool const copied = !file.kept.empty() && !digest_of_file(copy).empty();
  fs::path const& wrong = copied ? copy : file.from;
  problems.add(place, is_another(file.given, wrong, copied ? digest_of_file(copy) : hash, file.hash));
  return {};
}

}  // namespace

CaseFile case_file(Node const& text) {
  if (!text.found_at.empty()) return {text.text, text.found_at};
  fs::path const base = text.base.empty() ? text.place.file : text.base;
  return {text.text, base.parent_path() / text.text};
}

CaseFile case_file(Section const& section, std::string const& given) {
  Node const* const node = section.node().find("file");
  if (node != nullptr && !node->found_at.empty()) return {given, node->found_at};
  return {given, fs::path(section.base_of("file").file).parent_path() / given};
}

std::string content_hash(fs::path const& path) {
  constexpr std::size_t block = std::size_t{1} << 20;
  FileToRead file(path);
  Digest digest(file.size());
  std::vector<char> bytes(block);
  for (std::size_t got = block; got == block;) {
    got = file.read(bytes);
    digest.add(std::string_view(bytes.data(), got));
  }
  if (!file.problem().empty()) throw FileError(path.string() + ": " + file.problem());
  return fmt::format("{:016x}", digest.value());
}

std::string digest_of_file(fs::path const& path) {
  return FileToRead(path).problem().empty() ? content_hash(path) : "";
}

std::vector<CaseFile> files_named_in(Node const& root) {
  std::vector<CaseFile> files;
  each_file_name(root, [&](Node const& text) { files.push_back(case_file(text)); });
  return files;
}

std::vector<CaseFile> files_of(CaseSpec const& spec) {
  std::vector<CaseFile> all;
  for (CaseFile const& file : spec.files)
    if (std::none_of(all.begin(), all.end(), [&](CaseFile const& other) { return other.given == file.given; }))
      all.push_back(file);
  return all;
}

std::string kept_name(std::size_t number, std::string const& given) {
  constexpr std::size_t longest = 100;
  std::string name = fs::path(given).filename().string();
  name = name.substr(name.size() - std::min(name.size(), longest));
  for (char& c : name)
    if (!is_plain(c)) c = '_';
  return fmt::format("{}-{}", number, name);
}

std::string text_of_list(std::vector<KeptFile> const& files) {
  std::string text = "# The files that the case names, as they were when the run began.\n";
  for (KeptFile const& file : files)
    text += fmt::format("\n[[file]]\ngiven = {}\nkept = {}\nfrom = {}\nbytes = {}\nhash = {}\n", in_toml(file.given),
                        in_toml(file.kept), in_toml(coded(file.from.string())), file.bytes, in_toml(file.hash));
  return text;
}

std::vector<KeptFile> read_kept_list(fs::path const& results) {
  fs::path const path = results / kept_files / kept_list;
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  Problems problems;
  auto const document = parse_document(read_input_file(path), path.string(), problems);
  problems.raise_if_any();
  std::vector<KeptFile> files;
  Node const* const list = document->root.find("file");
  if (list == nullptr || !list->is_list_of_tables()) return files;
  for (Node const& entry : list->items) {
    // The name of a copy is no path: nothing outside the folder is read by it.
    KeptFile file{text_at(entry, "given"), fs::path(text_at(entry, "kept")).filename().string(),
                  decoded(text_at(entry, "from")), 0, text_at(entry, "hash")};
    if (Node const* const bytes = entry.find("bytes")) file.bytes = static_cast<std::uint64_t>(bytes->integer);
    files.push_back(std::move(file));
  }
  return files;
}

void use_kept_files(Node& root, fs::path const& results, Problems& problems) {
  auto const list = read_kept_list(results);
  each_file_name(root, [&](Node& text) {
    if (KeptFile const* const file = find_kept(list, text.text))
      text.found_at = place_of_kept(*file, results, text.place, problems).string();
  });
}

void compare_with_kept_list(CaseSpec const& spec, fs::path const& results, Problems& problems) {
  std::vector<KeptFile> const list = read_kept_list(results);
  for (CaseFile const& file : files_of(spec)) {
    KeptFile const* const known = find_kept(list, file.given);
    std::string const hash = digest_of_file(file.path);
    if (known == nullptr)
      problems.add({(results / kept_files / kept_list).string(), 0, 0},
                   fmt::format("{} is not in this list of the files that the run began with - run the case again with "
                               "'piola run'",
                               in_quotes(file.given)));
    else if (hash != known->hash)
      problems.add({results.string(), 0, 0}, is_another(file.given, file.path, hash, known->hash));
  }
}

}  // namespace piola
