// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/measures/field_samples.hpp"
#include "piola/observers/run_log.hpp"
#include "piola/simulation/build.hpp"
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

/// Source of the reference value of a check.
enum class Evidence {
  theory,           ///< closed forms, conservation laws, orders of convergence
  finite_elements,  ///< converged, published or of bench/finite_elements
  experiment,
  paper,           ///< results or claims of the paper of the formulation
  other_code,      ///< numbers of other programs
  own_trial,       ///< an independent trial implementation of the same scheme
  own_refinement,  ///< this program with more particles
  own_regression,  ///< earlier results of this program
  code             ///< holds by construction: detects errors in the code, no evidence for the result
};
/// Words as in checks.toml, e.g. "finite elements"; in the order of Evidence.
std::vector<std::string> const& evidence_words();
std::string const& evidence_word(Evidence evidence);

/// A measured value with its published or analytical reference: [[check]] of checks.toml.
struct Check {
  enum class Kind { within, below, above, between };
  /// The compared value: the quantity itself, or its relation to that of another variant.
  enum class Comparison {
    value,
    ratio,       ///< q / q_other
    order,       ///< log(q_other / q) / log(refinement): the order of convergence
    field_error  ///< relative_difference() of a field between the two
  };
  std::string variant;
  std::string quantity;    ///< name of a [[quantity]], or a dotted path in summary.json such as "energy.max_increase"
  std::string reference;   ///< a number, or a number with unit; between: the lower one
  std::string upper = {};  ///< between: the upper one
  double tolerance = 0;
  bool relative = false;  ///< the tolerance is a fraction of the reference
  Kind kind = Kind::within;
  Comparison as = Comparison::value;
  std::string relative_to = {};         ///< ratio, order: the other variant
  double refinement = 0;                ///< order: key `ratio`, spacing of the other variant over that of this one
  bool expected_to_fall_short = false;  ///< if true, `note` gives the reason
  std::string source, note;
  Evidence evidence = Evidence::theory;
  std::string field = {};   ///< field_error: the compared field, e.g. "Pressure"
  double time = 0;          ///< field_error: time of comparison [s]
  std::string where = {};   ///< field_error: a condition in X, Y, Z; empty: everywhere
  std::string beside = {};  ///< field_error: a variant whose error divides that of this one; empty: none
};

struct CheckFile {
  std::vector<CheckVariant> variants;
  std::vector<Check> checks;
};

/// The folder of a variant below that of its case: its name, with _ in place of each slash, so that it stays inside.
std::string folder_of(std::string variant);

/// Reads checks.toml. Throws InputError with all errors.
CheckFile read_checks(std::filesystem::path const& path);

/// One line of the table that `piola verify` prints.
struct VerificationRow {
  std::string case_name, variant, quantity, unit;
  double reference = 0;
  std::string source;
  std::optional<double> measured;  ///< empty: the run failed or has no such quantity
  std::string tolerance;           ///< as written, e.g. "within 1 %"
  std::string verdict;    ///< "passes", "falls short", or one of these with ", as" or ", contrary to" expectation
  bool accepted = false;  ///< passes, or falls short as expected
  std::string note;
  std::string evidence = {};  ///< a word of evidence_words()
};

/// One variant of a case after its run.
struct VariantRun {
  std::string variant;
  std::string title = {};  ///< of the case; empty if the run could not be made
  double wall_seconds = 0;
  std::filesystem::path picture = {};  ///< the last one; empty if there is none
  std::string summary = {};            ///< text of summary.json; empty if the run could not be made
  std::string problem = {};            ///< why it failed or could not be made
  std::vector<FieldSample> samples = {};
};

/// All runs of one case, and the results of its checks.
struct CaseVerification {
  std::string name;  ///< e.g. "jst_sph/cable"
  std::vector<VariantRun> runs;
  std::vector<VerificationRow> rows;
};

/// Compares the checks of a case with the values of its runs, variant by variant. Checks that refer to a missing
/// variant are omitted.
std::vector<VerificationRow> compare(std::string const& case_name, std::vector<Check> const& checks,
                                     std::vector<VariantRun> const& runs);

/// Progress of a verification.
struct VerifyProgress {
  std::string case_name, variant;
  std::size_t number = 1, count = 1;        ///< of the variant, from 1, among all that run
  double share = 0;                         ///< completed fraction of this run
  std::optional<double> seconds_left = {};  ///< estimated wall time of the remaining work; empty: unknown
};

/// Builds a simulation from a case file and overrides.
using Prepare =
    std::function<Simulation(std::filesystem::path const& case_file, std::vector<std::string> const& overrides)>;
/// Called before each run, and several times per second with its progress.
using Announce = std::function<void(VerifyProgress const&)>;
/// Returns the work of a run, in any unit.
using Weigh = std::function<double(std::filesystem::path const& case_file, std::vector<std::string> const& overrides)>;

struct VerifyOptions {
  std::filesystem::path cases;     ///< folder with the cases
  std::vector<std::string> names;  ///< empty: all
  bool short_only = false;         ///< only variants marked short
  std::filesystem::path out;       ///< results go to out/CASE/VARIANT
  Weigh weigh = {};                ///< for the remaining time; empty: all runs count equally
};

/// Folders below `cases` that hold checks.toml and match the names ("twisting_column", "jst_sph/cable", or a whole
/// folder "jst_sph"). Throws InputError with the known names if one is unknown.
std::vector<std::filesystem::path> find_cases(std::filesystem::path const& cases,
                                              std::vector<std::string> const& names);

/// Runs the variants of the selected cases and compares. A run that cannot be built or fails gives rows that fall
/// short. Returns early, with the rows so far, when `stop` is set.
std::vector<CaseVerification> verify(VerifyOptions const& options, Prepare const& prepare, Announce const& announce,
                                     std::atomic<int> const& stop);

}  // namespace piola
