// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/verify.hpp"
#include "piola/base/problems.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/base/version.hpp"
#include "piola/output/files.hpp"
#include "piola/simulation/run_case.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

namespace fs = std::filesystem;

constexpr char const* passed = "pass";
constexpr char const* short_fall = "fall short";

/// Value and unit of a quantity of a summary: first by its name, then as a dotted path.
std::optional<std::pair<double, std::string>> look_up(nlohmann::json const& summary, std::string const& name) {
  if (auto const found = summary.at("quantities").find(name); found != summary.at("quantities").end()) {
    return std::pair{found->at("value").get<double>(), found->at("unit").get<std::string>()};
  }
  nlohmann::json const* at = &summary;
  for (std::size_t from = 0; from <= name.size();) {
    std::size_t const dot = std::min(name.find('.', from), name.size());
    auto const next = at->is_object() ? at->find(name.substr(from, dot - from)) : at->end();
    if (!at->is_object() || next == at->end()) return std::nullopt;
    at = &*next;
    from = dot + 1;
  }
  if (!at->is_number()) return std::nullopt;
  return std::pair{at->get<double>(), std::string("1")};
}

std::string tolerance_text(Check const& c) {
  std::string const amount =
      c.relative ? fmt::format("{} %", number_text(100 * c.tolerance)) : number_text(c.tolerance);
  switch (c.kind) {
    case Check::Kind::below: return c.tolerance > 0 ? fmt::format("below, +{}", amount) : "below";
    case Check::Kind::above: return c.tolerance > 0 ? fmt::format("above, -{}", amount) : "above";
    default: return fmt::format("within {}", amount);
  }
}

bool holds(Check const& c, double measured, double reference) {
  double const allowed = c.relative ? c.tolerance * std::abs(reference) : c.tolerance;
  switch (c.kind) {
    case Check::Kind::below: return measured <= reference + allowed;
    case Check::Kind::above: return measured >= reference - allowed;
    default: return std::abs(measured - reference) <= allowed;
  }
}

VerificationRow row_of(std::string const& case_name, Check const& c) {
  VerificationRow row{case_name, c.variant, c.quantity, {}, 0, c.source, {}, tolerance_text(c), short_fall, c.note};
  row.reference = read_quantity(c.reference, "1").value;
  return row;
}

void add_note(VerificationRow& row, std::string const& text) { row.note += (row.note.empty() ? "" : "; ") + text; }

VerificationRow compare_one(std::string const& case_name, Check const& c, nlohmann::json const& summary) {
  VerificationRow row = row_of(case_name, c);
  auto const found = look_up(summary, c.quantity);
  if (!found) {
    add_note(row, "summary.json has no such quantity");
    return row;
  }
  row.unit = found->second;
  Quantity const reference = read_quantity(c.reference, row.unit);
  row.reference = reference.value;
  row.measured = found->first;
  if (reference.problem)
    add_note(row, *reference.problem);
  else if (summary.at("status") != "completed")
    add_note(row, "the run did not complete");
  else if (holds(c, *row.measured, row.reference))
    row.verdict = passed;
  return row;
}

std::vector<VerificationRow> run_variant(std::string const& name, fs::path const& case_file,
                                         CheckVariant const& variant, std::vector<Check> const& checks,
                                         fs::path const& out, Prepare const& prepare, std::atomic<int> const& stop) {
  Listener quiet;
  try {
    Simulation simulation = prepare(case_file, variant.set);
    CaseOutcome const outcome = run_case(simulation, {.folder = out, .resume = false, .force = true}, quiet, stop);
    auto rows = compare(name, checks, to_json(outcome.summary));
    if (!outcome.failure.empty()) {
      for (VerificationRow& row : rows) add_note(row, outcome.failure.substr(0, outcome.failure.find('\n')));
    }
    return rows;
  } catch (std::runtime_error const& error) {  // one case that cannot run must not hide the others
    std::vector<VerificationRow> rows;
    for (Check const& c : checks) {
      rows.push_back(row_of(name, c));
      add_note(rows.back(), error.what());
    }
    return rows;
  }
}

std::string measured_text(VerificationRow const& row) { return row.measured ? number_text(*row.measured) : "none"; }
std::string unit_text(VerificationRow const& row) { return row.unit == "1" ? "" : row.unit; }

}  // namespace

std::vector<VerificationRow> compare(std::string const& case_name, std::vector<Check> const& checks,
                                     std::string const& summary_json) {
  auto const summary = nlohmann::json::parse(summary_json);
  std::vector<VerificationRow> rows;
  for (Check const& c : checks) rows.push_back(compare_one(case_name, c, summary));
  return rows;
}

std::vector<fs::path> find_cases(fs::path const& cases, std::vector<std::string> const& names) {
  std::vector<fs::path> all, chosen;
  std::vector<std::string> known;
  std::error_code missing;
  for (auto const& entry : fs::recursive_directory_iterator(cases, missing)) {
    if (entry.path().filename() == "checks.toml") all.push_back(entry.path().parent_path());
  }
  if (all.empty())
    throw InputError(fmt::format("{}: holds no case with a checks.toml - give the folder of the cases with --cases",
                                 cases.string()));
  std::sort(all.begin(), all.end());
  if (names.empty()) return all;
  for (fs::path const& folder : all) known.push_back(folder.lexically_relative(cases).generic_string());
  for (std::string const& name : names) {
    std::size_t const before = chosen.size();
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (known[k] == name || all[k].filename() == name || known[k].starts_with(name + "/")) chosen.push_back(all[k]);
    }
    if (chosen.size() == before) {
      throw InputError(fmt::format("there is no case '{}' with checks (there are: {}) - {}", name, joined(known),
                                   advice_for_name(name, known)));
    }
  }
  return chosen;
}

std::vector<VerificationRow> verify(VerifyOptions const& options, Prepare const& prepare, Announce const& announce,
                                    std::atomic<int> const& stop) {
  std::vector<VerificationRow> rows;
  for (fs::path const& folder : find_cases(options.cases, options.names)) {
    std::string const name = folder.lexically_relative(options.cases).generic_string();
    CheckFile const file = read_checks(folder / "checks.toml");
    for (CheckVariant const& variant : file.variants) {
      std::vector<Check> checks;
      std::copy_if(file.checks.begin(), file.checks.end(), std::back_inserter(checks),
                   [&](Check const& c) { return c.variant == variant.name; });
      if (stop.load() != 0) return rows;
      if (checks.empty() || (options.short_only && !variant.is_short)) continue;
      if (announce) announce(name, variant.name);
      auto const more =
          run_variant(name, folder / "case.toml", variant, checks, options.out / name / variant.name, prepare, stop);
      rows.insert(rows.end(), more.begin(), more.end());
    }
  }
  return rows;
}

std::string verification_json(std::vector<VerificationRow> const& rows) {
  auto list = nlohmann::ordered_json::array();
  for (VerificationRow const& r : rows) {
    nlohmann::ordered_json row{{"case", r.case_name}, {"variant", r.variant},     {"quantity", r.quantity},
                               {"unit", r.unit},      {"reference", r.reference}, {"source", r.source},
                               {"measured", nullptr}, {"tolerance", r.tolerance}, {"verdict", r.verdict},
                               {"note", r.note}};
    if (r.measured) row["measured"] = *r.measured;
    list.push_back(std::move(row));
  }
  return nlohmann::ordered_json{{"version", version()}, {"rows", list}}.dump(2) + "\n";
}

std::string verification_table(std::vector<VerificationRow> const& rows) {
  std::string text = fmt::format("{:<28} {:<14} {:<26} {:>12} {:>12} {:<9} {:<16} {}\n", "case", "variant", "quantity",
                                 "reference", "measured", "unit", "tolerance", "verdict");
  for (VerificationRow const& r : rows) {
    text += fmt::format("{:<28} {:<14} {:<26} {:>12} {:>12} {:<9} {:<16} {}\n", r.case_name, r.variant, r.quantity,
                        number_text(r.reference), measured_text(r), unit_text(r), r.tolerance, r.verdict);
    if (r.verdict != passed && !r.note.empty()) text += fmt::format("    {}\n", r.note);
  }
  return text;
}

std::string verification_markdown(std::vector<VerificationRow> const& rows) {
  std::string text =
      "| case | variant | quantity | reference | source | measured | tolerance | verdict | note "
      "|\n|---|---|---|---|---|---|---|---|---|\n";
  for (VerificationRow const& r : rows) {
    std::string note = r.note;
    std::replace(note.begin(), note.end(), '\n', ' ');
    text += fmt::format("| {} | {} | {} | {} {} | {} | {} {} | {} | {} | {} |\n", r.case_name, r.variant, r.quantity,
                        number_text(r.reference), unit_text(r), r.source, measured_text(r), unit_text(r), r.tolerance,
                        r.verdict, note);
  }
  return text;
}

}  // namespace piola
