// SPDX-License-Identifier: Apache-2.0
#include "piola/input/identify.hpp"
#include "piola/base/version.hpp"
#include "piola/exec/backend_registry.hpp"
#include "piola/input/case_files.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/input/document.hpp"
#include "piola/setup/packing_file.hpp"
#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace piola {
namespace {

/// Keys of [run] that change no result, or whose effect is recorded in Identity::backend.
constexpr std::array<std::string_view, 3> keys_without_effect{"threads", "instruction_set", "repartition"};

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

}  // namespace

Identity identity_of(CaseSpec const& spec) {
  Identity identity;
  identity.case_text = digest_text(digest_of(plain_text(spec.source)));
  for (CaseFile const& file : files_of(spec)) identity.files.emplace_back(file.given, digest_of_file(file.path));
  std::string const build = build_id();
  identity.program = fmt::format("{} build {}", version(), build);
  identity.backend = exec_host::backend_text(spec.run.backend);
  std::string all = identity.case_text + "\n" + identity.program + "\n" + identity.backend;
  bool known = !build.empty();
  for (auto const& [name, digest] : identity.files) {
    all += "\n" + name + " " + digest;
    known = known && !digest.empty();
  }
  if (known) identity.run = digest_text(digest_of(all));
  return identity;
}

}  // namespace piola
