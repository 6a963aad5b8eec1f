// SPDX-License-Identifier: Apache-2.0
#include "piola/verification/verification_report.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/base/version.hpp"
#include "piola/output/atomic_file.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

namespace piola {
namespace {

namespace fs = std::filesystem;

std::string measured_text(VerificationRow const& row) { return row.measured ? number_text(*row.measured) : "none"; }
std::string unit_text(VerificationRow const& row) { return row.unit == "1" ? "" : row.unit; }
std::string with_unit(std::string const& number, VerificationRow const& row) {
  return unit_text(row).empty() ? number : number + " " + unit_text(row);
}

/// Text for a cell of a Markdown table.
std::string cell(std::string const& text) {
  std::string out;
  for (char const c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

/// A file name from a case and a variant: letters and digits, everything else becomes one '-'.
std::string file_stem(std::string const& text) {
  std::string out;
  for (char const c : text) {
    bool const plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (plain)
      out += c;
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (out.ends_with('-')) out.pop_back();
  return out;
}

/// A file name for this text that no other file of the page has.
std::string new_name(std::string const& text, std::string const& extension, std::set<std::string>& taken) {
  std::string const stem = file_stem(text);
  std::string name = stem + extension;
  for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{}-{}{}", stem, k, extension);
  return name;
}

/// Copies the last picture of a run to the folder of the page; returns its name there, or "".
std::string keep_picture(fs::path const& folder, std::string const& case_name, VariantRun const& run,
                         std::set<std::string>& taken) {
  if (run.picture.empty()) return "";
  std::string const name = new_name(case_name + " " + run.variant, ".png", taken);
  write_whole_file(folder / name, read_text_file(run.picture));
  return name;
}

std::string title_of(CaseVerification const& c) {
  for (VariantRun const& run : c.runs) {
    if (!run.title.empty()) return run.title;
  }
  return c.name;
}

std::string rows_text(CaseVerification const& c) {
  std::string text =
      "| variant | quantity | reference | measured | tolerance | verdict | evidence | source | note |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (VerificationRow const& r : c.rows) {
    std::string const verdict = r.accepted ? r.verdict : "**" + r.verdict + "**";
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", cell(r.variant), cell(r.quantity),
                        with_unit(number_text(r.reference), r), with_unit(measured_text(r), r), r.tolerance, verdict,
                        r.evidence, cell(r.source), cell(r.note));
  }
  return text;
}

std::string runs_text(fs::path const& folder, CaseVerification const& c, std::set<std::string>& taken) {
  std::string text = "| variant | wall time | at the end |\n|---|---|---|\n";
  for (VariantRun const& run : c.runs) {
    std::string const picture = keep_picture(folder, c.name, run, taken);
    std::string const shown = picture.empty() ? "" : fmt::format("![{}]({})", cell(run.variant), picture);
    text += fmt::format("| {} | {} | {} |\n", cell(run.variant),
                        run.summary.empty() ? "did not run" : duration_text(run.wall_seconds), shown);
  }
  return text;
}

/// Draws plots to the folder of the page. A plot without values is omitted.
std::string plots_text(fs::path const& folder, CaseVerification const& c, std::vector<Plot> const& plots,
                       std::set<std::string>& taken) {
  std::string text;
  for (Plot const& plot : plots) {
    std::string const name = new_name(c.name + " " + plot.y.name, ".svg", taken);
    try {
      write_plot(folder / name, plot);
      text += fmt::format("\n![{}, measured and expected]({})\n", cell(plot.y.name), name);
    } catch (InputError const&) {
    }
  }
  return text;
}

/// How many rows stand on each kind of evidence, in the order of evidence_words().
std::vector<std::size_t> count_evidence(std::vector<CaseVerification> const& cases) {
  auto const& words = evidence_words();
  std::vector<std::size_t> counts(words.size());
  for (CaseVerification const& c : cases) {
    for (VerificationRow const& r : c.rows) {
      auto const at = std::find(words.begin(), words.end(), r.evidence);
      if (at != words.end()) ++counts[static_cast<std::size_t>(at - words.begin())];
    }
  }
  return counts;
}

std::string total_text(std::vector<CaseVerification> const& cases) {
  std::size_t rows = 0, accepted = 0, expected = 0;
  double seconds = 0;
  for (CaseVerification const& c : cases) {
    for (VerificationRow const& r : c.rows) {
      ++rows;
      accepted += r.accepted ? 1 : 0;
      expected += r.accepted && r.verdict != "passes" ? 1 : 0;
    }
    for (VariantRun const& run : c.runs) seconds += run.wall_seconds;
  }
  std::string text = fmt::format("{} of {} rows pass", accepted - expected, rows);
  if (expected > 0) text += fmt::format(", {} {} short as expected", expected, expected == 1 ? "falls" : "fall");
  if (accepted < rows) text += fmt::format(", **{} not as they should**", rows - accepted);
  return text + ". The runs took " + duration_text(seconds) + " of wall time. " + evidence_text(cases);
}

}  // namespace

std::string evidence_text(std::vector<CaseVerification> const& cases) {
  auto const counts = count_evidence(cases);
  auto const code = static_cast<std::size_t>(Evidence::code);
  std::string text;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (k != code && counts[k] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[k], evidence_words()[k]);
  }
  text = "Evidence: " + (text.empty() ? "none" : text);
  if (counts[code] > 0)
    text += fmt::format("; also {} {} of the code", counts[code], counts[code] == 1 ? "check" : "checks");
  return text + ".";
}

bool all_accepted(std::vector<CaseVerification> const& cases) {
  return std::all_of(cases.begin(), cases.end(), [](CaseVerification const& c) {
    return std::all_of(c.rows.begin(), c.rows.end(), [](VerificationRow const& r) { return r.accepted; });
  });
}

std::string verification_json(std::vector<CaseVerification> const& cases) {
  auto rows = nlohmann::ordered_json::array(), runs = nlohmann::ordered_json::array();
  for (CaseVerification const& c : cases) {
    for (VerificationRow const& r : c.rows) {
      nlohmann::ordered_json row{{"case", r.case_name},    {"variant", r.variant},     {"quantity", r.quantity},
                                 {"unit", r.unit},         {"reference", r.reference}, {"source", r.source},
                                 {"measured", nullptr},    {"tolerance", r.tolerance}, {"verdict", r.verdict},
                                 {"accepted", r.accepted}, {"note", r.note},           {"evidence", r.evidence}};
      if (r.measured) row["measured"] = *r.measured;
      rows.push_back(std::move(row));
    }
    for (VariantRun const& run : c.runs)
      runs.push_back({{"case", c.name}, {"variant", run.variant}, {"wall_seconds", run.wall_seconds}});
  }
  auto counts = nlohmann::ordered_json::object();
  auto const evidence = count_evidence(cases);
  for (std::size_t k = 0; k < evidence.size(); ++k) counts[evidence_words()[k]] = evidence[k];
  return nlohmann::ordered_json{{"version", version()}, {"rows", rows}, {"runs", runs}, {"evidence", counts}}.dump(2) +
         "\n";
}

std::string verification_table(std::vector<CaseVerification> const& cases) {
  std::string text = fmt::format("{:<28} {:<14} {:<26} {:>12} {:>12} {:<9} {:<16} {}\n", "case", "variant", "quantity",
                                 "reference", "measured", "unit", "tolerance", "verdict");
  for (CaseVerification const& c : cases) {
    for (VerificationRow const& r : c.rows) {
      text += fmt::format("{:<28} {:<14} {:<26} {:>12} {:>12} {:<9} {:<16} {}\n", r.case_name, r.variant, r.quantity,
                          number_text(r.reference), measured_text(r), unit_text(r), r.tolerance, r.verdict);
      if (r.verdict != "passes" && !r.note.empty()) text += fmt::format("    {}\n", r.note);
    }
  }
  return text + evidence_text(cases) + "\n";
}

void write_verification_page(fs::path const& folder, std::vector<CaseVerification> const& cases,
                             PlotCase const& plots_of) {
  make_folder(folder);
  std::set<std::string> taken;
  std::string page =
      fmt::format("# Verification\n\nWritten by `piola verify`, version {}. {}\n", version(), total_text(cases));
  for (CaseVerification const& c : cases) {
    page += fmt::format("\n## {}\n\n`{}`\n\n{}\n{}", title_of(c), c.name, rows_text(c), runs_text(folder, c, taken));
    if (plots_of) page += plots_text(folder, c, plots_of(c), taken);
  }
  write_whole_file(folder / "README.md", page);
}

}  // namespace piola
