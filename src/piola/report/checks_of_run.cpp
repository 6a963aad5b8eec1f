// SPDX-License-Identifier: Apache-2.0
#include "piola/report/checks_of_run.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/input/case_difference.hpp"
#include "piola/input/read_case.hpp"
#include <algorithm>
#include <fmt/format.h>

namespace piola::report {
namespace {

namespace fs = std::filesystem;

/// Whether a run of the case file with these overrides gives the state at each time that the run in the folder has.
bool is_variant(RunFolder const& run, fs::path const& case_file, std::vector<std::string> const& overrides) try {
  auto const differences = case_differences(read_case(case_file, overrides).source, run.case_text);
  return std::all_of(differences.begin(), differences.end(),
                     [](CaseDifference const& d) { return d.key != "run.end" && may_change_on_resume(d.key); });
} catch (InputError const&) {
  return false;
}

std::string variant_of(RunFolder const& run, CheckFile const& file, fs::path const& checks) {
  for (CheckVariant const& variant : file.variants)
    if (is_variant(run, checks.parent_path() / "case.toml", variant.set)) return variant.name;
  return "";
}

void require_variant(CheckFile const& file, fs::path const& checks, std::string const& name) {
  std::vector<std::string> known;
  for (CheckVariant const& variant : file.variants) known.push_back(variant.name);
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw InputError(fmt::format("{}: has no variant {} (known: {}) - {}", checks.string(), in_quotes(name),
                                 joined(known), advice_for_name(name, known)));
}

}  // namespace

std::vector<VerificationRow> rows_of_run(RunFolder const& run, fs::path const& checks, std::string const& variant,
                                         std::string& note) {
  CheckFile const file = read_checks(checks);
  if (!variant.empty()) require_variant(file, checks, variant);
  std::string const name = variant.empty() ? variant_of(run, file, checks) : variant;
  if (name.empty()) {
    note = fmt::format("{} has no variant that is this run; --variant chooses one", checks.string());
    return {};
  }
  VariantRun const one{.variant = name, .title = run.title, .summary = run.summary, .problem = run.failure};
  if (one.summary.empty()) return {};
  std::vector<Check> alone;
  for (Check const& check : file.checks)
    if (check.as == Check::Comparison::value) alone.push_back(check);
  return compare(run.title, alone, {one});
}

}  // namespace piola::report
