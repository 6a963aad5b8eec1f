// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/simulation/build.hpp"
#include "piola/simulation/field_samples.hpp"
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

/// Where the number of a check comes from.
enum class Evidence {
  theory,           ///< closed forms, conservation laws, orders of convergence
  finite_elements,  ///< converged, published or of bench/finite_elements
  experiment,
  paper,           ///< what the paper of the formulation shows or claims
  other_code,      ///< numbers of other programs
  own_trial,       ///< an independent trial implementation of the same scheme
  own_refinement,  ///< this program with more particles
  own_regression,  ///< what this program gave before
  code             ///< holds by construction: shows a slip in the code, tells nothing about the answer
};
/// As in checks.toml, e.g. "finite elements"; in the order of Evidence.
std::vector<std::string> const& evidence_words();
std::string const& evidence_word(Evidence evidence);

/// One published or analytical number beside a measured one: [[check]] of checks.toml.
struct Check {
  enum class Kind { within, below, above, between };
  /// What is compared: the quantity itself, or what it comes to beside that of another variant.
  enum class As {
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
  As as = As::value;
  std::string relative_to = {};         ///< ratio, order: the other variant
  double refinement = 0;                ///< order: key `ratio`, spacing of the other variant by that of this one
  bool expected_to_fall_short = false;  ///< then `note` says why
  std::string source, note;
  Evidence evidence = Evidence::theory;
  std::string field = {};   ///< field_error: what is compared, e.g. "Pressure"
  double time = 0;          ///< field_error: when [s]
  std::string where = {};   ///< field_error: a condition in X, Y, Z; empty: everywhere
  std::string beside = {};  ///< field_error: a variant by whose error that of this one is divided; empty: none
};

struct CheckFile {
  std::vector<CheckVariant> variants;
  std::vector<Check> checks;
};

/// The folder of a variant below that of its case: its name, with _ in place of each slash, so that no name leads out.
std::string folder_of(std::string variant);

/// Reads checks.toml. Throws InputError with all that is wrong in it.
CheckFile read_checks(std::filesystem::path const& path);

/// One line of the table that `piola verify` prints.
struct VerificationRow {
  std::string case_name, variant, quantity, unit;
  double reference = 0;
  std::string source;
  std::optional<double> measured;  ///< nothing: the run failed or has no such quantity
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

/// All that was run for one case, and what the checks say about it.
struct CaseVerification {
  std::string name;  ///< e.g. "jst_sph/cable"
  std::vector<VariantRun> runs;
  std::vector<VerificationRow> rows;
};

/// Compares the checks of a case with what its runs measured, variant by variant. Checks that look at a variant which
/// is not among the runs are left out.
std::vector<VerificationRow> compare(std::string const& case_name, std::vector<Check> const& checks,
                                     std::vector<VariantRun> const& runs);

/// Where a verification stands.
struct VerifyProgress {
  std::string case_name, variant;
  std::size_t number = 1, count = 1;        ///< of the variant, from 1, among all that run
  double share = 0;                         ///< of this run that is done
  std::optional<double> seconds_left = {};  ///< wall time of all that is left, estimated; nothing: not known yet
};

/// Makes a simulation from a case file and overrides.
using Prepare =
    std::function<Simulation(std::filesystem::path const& case_file, std::vector<std::string> const& overrides)>;
/// Told what is about to run, and several times per second how far it is.
using Announce = std::function<void(VerifyProgress const&)>;
/// How much work a run is, in any unit.
using Weigh = std::function<double(std::filesystem::path const& case_file, std::vector<std::string> const& overrides)>;

struct VerifyOptions {
  std::filesystem::path cases;     ///< folder with the cases
  std::vector<std::string> names;  ///< empty: all
  bool short_only = false;         ///< only variants marked short
  std::filesystem::path out;       ///< results go to out/CASE/VARIANT
  Weigh weigh = {};                ///< for the time that is left; nothing: all runs count the same
};

/// Folders below `cases` that hold checks.toml and are asked for by name ("twisting_column", "jst_sph/cable", or a
/// whole folder "jst_sph"). Throws InputError with the known names if one is not known.
std::vector<std::filesystem::path> find_cases(std::filesystem::path const& cases,
                                              std::vector<std::string> const& names);

/// Runs the variants of the chosen cases and compares. A run that cannot be made or fails gives rows that fall short.
/// Ends early, with the rows so far, when `stop` is set.
std::vector<CaseVerification> verify(VerifyOptions const& options, Prepare const& prepare, Announce const& announce,
                                     std::atomic<int> const& stop);

}  // namespace piola
