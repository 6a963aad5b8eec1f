// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/build.hpp"
#include "piola/simulation/journal.hpp"
#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace piola {

/// One way to run a case: [[variant]] of checks.toml.
struct CheckVariant {
  std::string name;
  std::vector<std::string> set;  ///< overrides, "key=value"
  bool is_short = false;         ///< belongs to the quick selection
};

/// One published or analytical number beside a measured one: [[check]] of checks.toml.
struct Check {
  enum class Kind { within, below, above };
  std::string variant;
  std::string quantity;   ///< name of a [[quantity]], or a dotted path in summary.json such as "energy.max_increase"
  std::string reference;  ///< a number, or a number with unit
  double tolerance = 0;
  bool relative = false;  ///< the tolerance is a fraction of the reference
  Kind kind = Kind::within;
  std::string source, note;
};

struct CheckFile {
  std::vector<CheckVariant> variants;
  std::vector<Check> checks;
};

/// Reads checks.toml. Throws InputError with all that is wrong in it.
CheckFile read_checks(std::filesystem::path const& path);

/// One line of the table that `piola verify` prints.
struct VerificationRow {
  std::string case_name, variant, quantity, unit;
  double reference = 0;
  std::string source;
  std::optional<double> measured;  ///< nothing: the run failed or has no such quantity
  std::string tolerance;           ///< as written, e.g. "within 1 %"
  std::string verdict;             ///< "pass" or "fall short"
  std::string note;
};

/// Compares checks with the text of a summary.json.
std::vector<VerificationRow> compare(std::string const& case_name, std::vector<Check> const& checks,
                                     std::string const& summary_json);

struct VerifyOptions {
  std::filesystem::path cases;     ///< folder with the cases
  std::vector<std::string> names;  ///< empty: all
  bool short_only = false;         ///< only variants marked short
  std::filesystem::path out;       ///< results go to out/CASE/VARIANT
};

/// Makes a simulation from a case file and overrides.
using Prepare =
    std::function<Simulation(std::filesystem::path const& case_file, std::vector<std::string> const& overrides)>;
/// Told what is about to run.
using Announce = std::function<void(std::string const& case_name, std::string const& variant)>;

/// Folders below `cases` that hold checks.toml and are asked for by name ("twisting_column", "jst_sph/cable", or a
/// whole folder "jst_sph"). Throws InputError with the known names if one is not known.
std::vector<std::filesystem::path> find_cases(std::filesystem::path const& cases,
                                              std::vector<std::string> const& names);

/// Runs the variants of the chosen cases and compares. A run that cannot be made or fails gives rows that fall short.
/// Ends early, with the rows so far, when `stop` is set.
std::vector<VerificationRow> verify(VerifyOptions const& options, Prepare const& prepare, Announce const& announce,
                                    std::atomic<int> const& stop);

std::string verification_json(std::vector<VerificationRow> const& rows);
std::string verification_table(std::vector<VerificationRow> const& rows);
std::string verification_markdown(std::vector<VerificationRow> const& rows);

}  // namespace piola
