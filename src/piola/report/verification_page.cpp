// SPDX-License-Identifier: Apache-2.0
#include "piola/report/verification_page.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/version.hpp"
#include "piola/report/page.hpp"
#include "piola/verification/verification_report.hpp"
#include <algorithm>

namespace piola::report {
namespace {

/// Plots and pictures that each run may hold, so that the page stays below 30 MB.
struct RunBudget {
  std::size_t plots;
  std::uintmax_t picture_bytes;
  explicit RunBudget(std::size_t runs)
      : plots(runs > 150 ? 1 : 3), picture_bytes(12'000'000 / std::max<std::size_t>(runs, 80)) {}
};

/// The section of one run; without plots if it could not be made or left no folder.
Json about_variant(CaseVerification const& c, VariantRun const& variant, std::filesystem::path const& folder,
                   RunBudget const& budget) {
  Json section{{"case", c.name},
               {"variant", variant.variant},
               {"wall_seconds", variant.wall_seconds},
               {"failure", variant.problem},
               {"plots", Json::array()},
               {"pictures", Json::array()}};
  section["title"] = variant.title.empty() ? c.name : variant.title;
  section["summary"] = variant.summary.empty() ? Json() : Json::parse(variant.summary);
  if (variant.summary.empty()) return section;  // the folder may hold the results of an earlier run
  try {
    RunFolder const run = open_run(folder);
    std::size_t left = 0;
    section["plots"] = about_plots(run, budget.plots, left);
    section["pictures"] = about_pictures(run, budget.picture_bytes);
    section["text"] = run.case_text;
  } catch (InputError const&) {  // a run that left no folder
  }
  return section;
}

}  // namespace

double write_verification_report(std::filesystem::path const& page, std::vector<CaseVerification> const& cases,
                                 std::filesystem::path const& results) {
  Json about{{"kind", "verification"},
             {"title", "Verification"},
             {"version", version()},
             {"accepted", all_accepted(cases)},
             {"evidence", evidence_text(cases)},
             {"rows", Json::array()},
             {"runs", Json::array()}};
  std::size_t runs = 0;
  for (CaseVerification const& c : cases) runs += c.runs.size();
  RunBudget const budget(runs);
  for (CaseVerification const& c : cases) {
    for (Json& row : about_rows(c.rows)) about["rows"].push_back(std::move(row));
    for (VariantRun const& run : c.runs)
      about["runs"].push_back(about_variant(c, run, results / c.name / folder_of(run.variant), budget));
  }
  PageFile file(page, "Verification");
  file.data("about", script_text(about), true);
  file.finish();
  return file.size();
}

}  // namespace piola::report
