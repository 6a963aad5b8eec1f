// SPDX-License-Identifier: Apache-2.0
#include "piola/input/identify.hpp"
#include "piola/base/version.hpp"
#include "piola/exec/instruction_sets.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/input/document.hpp"
#include "piola/math/hash.hpp"
#include "piola/setup/packing_file.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>

namespace piola {
namespace {

/// Keys of [run] that change no result, or whose effect Identity::machine tells.
constexpr std::array<std::string_view, 3> keys_without_effect{"threads", "machine", "repartition"};

std::string digest_text(std::uint64_t digest) { return fmt::format("{:016x}", digest); }

/// The case in the layout that every text of the same content gets.
std::string plain_text(std::string const& source) {
  Problems problems;
  auto document = parse_document(source, "case", problems);
  problems.raise_if_any();
  if (Node* const run = document->root.find("run"); run != nullptr)
    std::erase_if(run->entries, [](Node::Entry const& entry) {
      return std::find(keys_without_effect.begin(), keys_without_effect.end(), entry.key) != keys_without_effect.end();
    });
  return toml_text(document->root);
}

void add_files(std::vector<CaseFile> const& files, Identity& identity) {
  for (CaseFile const& file : files) identity.files.emplace_back(file.given, digest_of_file(file.path));
}

}  // namespace

std::string digest_of_file(std::filesystem::path const& path) {
  constexpr std::size_t block = std::size_t{1} << 20;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return "";
  std::ifstream file(path, std::ios::binary);
  std::string bytes(block, '\0');
  std::uint64_t digest = 0;
  while (file) {
    file.read(bytes.data(), static_cast<std::streamsize>(block));
    digest = mixed(digest) ^ digest_of(std::string_view(bytes).substr(0, static_cast<std::size_t>(file.gcount())));
  }
  return file.eof() ? digest_text(digest) : "";
}

Identity identity_of(CaseSpec const& spec) {
  Identity identity;
  identity.case_text = digest_text(digest_of(plain_text(spec.source)));
  for (BodySpec const& body : spec.bodies) add_files(body.shape.files, identity);
  for (RegionSpec const& region : spec.regions) add_files(region.files, identity);
  std::string const build = build_id();
  identity.program = fmt::format("{} build {}", version(), build);
  identity.machine = exec_host::machine_text(spec.run.machine);
  std::string all = identity.case_text + "\n" + identity.program + "\n" + identity.machine;
  bool known = !build.empty();
  for (auto const& [name, digest] : identity.files) {
    all += "\n" + name + " " + digest;
    known = known && !digest.empty();
  }
  if (known) identity.run = digest_text(digest_of(all));
  return identity;
}

}  // namespace piola
