// SPDX-License-Identifier: Apache-2.0
#include "piola/base/problems.hpp"
#include "piola/input/read_case.hpp"
#include "piola/output/files.hpp"
#include "piola/simulation/verify.hpp"
#include "commands.hpp"
#include "run_support.hpp"
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <unistd.h>

namespace piola::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  CaseOptions with;
  std::vector<std::string> names;
  std::string cases, out, markdown;
  bool short_only = false, json = false;
};

/// The cases lie beside the program's sources (cases/ in a folder above it) or where it is installed
/// (share/piola/cases).
fs::path find_case_folder() {
  std::error_code error;
  fs::path const program = fs::read_symlink("/proc/self/exe", error);
  for (fs::path at = program.parent_path(); !error && at.has_relative_path(); at = at.parent_path()) {
    for (char const* place : {"share/piola/cases", "cases"}) {
      if (fs::is_directory(at / place)) return at / place;
    }
  }
  return "cases";
}

/// A folder that is removed in the end.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(fs::temp_directory_path() / fmt::format("piola-verify-{}", ::getpid())) {
    make_folder(path_);
  }
  TemporaryFolder(TemporaryFolder const&) = delete;
  TemporaryFolder& operator=(TemporaryFolder const&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path const& path() const { return path_; }

 private:
  fs::path path_;
};

int run_verify(Options const& options) {
  catch_stop_signals();
  std::unique_ptr<TemporaryFolder> scratch;
  if (options.out.empty()) scratch = std::make_unique<TemporaryFolder>();
  VerifyOptions const what{.cases = options.cases.empty() ? find_case_folder() : fs::path(options.cases),
                           .names = options.names,
                           .short_only = options.short_only,
                           .out = scratch ? scratch->path() : fs::path(options.out)};
  auto const prepare = [&](fs::path const& file, std::vector<std::string> const& variant) {
    auto all = variant;
    auto const own = options.with.overrides();
    all.insert(all.end(), own.begin(), own.end());
    CaseSpec spec = read_case(file, all);
    if (scratch) spec.output.pictures_every = spec.output.frames_every = 0;
    return build(std::move(spec));
  };
  auto const announce = [](std::string const& name, std::string const& variant) {
    fmt::print(stderr, "{} ({})\n", name, variant);
  };
  auto const rows = verify(what, prepare, announce, stop_signal);
  fmt::print("{}", options.json ? verification_json(rows) : verification_table(rows));
  if (!options.markdown.empty()) write_whole_file(options.markdown, verification_markdown(rows));
  if (stop_signal != 0) return stopped_by_signal;
  bool const all_pass =
      std::all_of(rows.begin(), rows.end(), [](VerificationRow const& r) { return r.verdict == "pass"; });
  return all_pass ? completed : internal_error;
}

}  // namespace

void add_verify(CLI::App& program, Action& action) {
  auto const options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("verify", "Run cases and compare with published numbers; exit code 1 if one falls short");
  command->add_option("names", options->names, "Cases, or folders of cases (default: all)");
  command->add_flag("--short", options->short_only, "Only the variants that take seconds");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->add_option("--markdown", options->markdown, "Also write the table to this file");
  command->add_option("--cases", options->cases, "Folder of the cases (default: those that came with the program)");
  command->add_option("--out,-o", options->out,
                      "Keep the results in this folder (default: a temporary one, without frames and pictures)");
  options->with.add_to(*command, false);
  command->callback([options, &action] { action = [options] { return run_verify(*options); }; });
}

}  // namespace piola::app
