// SPDX-License-Identifier: Apache-2.0
#include "piola/simulation/verify.hpp"
#include "piola/base/problems.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/simulation/run_case.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace piola {
namespace {

namespace fs = std::filesystem;

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

std::string quantity_label(Check const& c) {
  if (c.as == Check::As::ratio) return c.quantity + ", ratio to " + c.relative_to;
  if (c.as == Check::As::order) return c.quantity + ", order from " + c.relative_to;
  return c.quantity;
}

VerificationRow row_of(std::string const& case_name, Check const& c) {
  VerificationRow row{.case_name = case_name,
                      .variant = c.variant,
                      .quantity = quantity_label(c),
                      .unit = {},
                      .reference = read_quantity(c.reference, "1").value,
                      .source = c.source,
                      .measured = {},
                      .tolerance = tolerance_text(c),
                      .verdict = "falls short",
                      .note = c.note};
  return row;
}

void add_note(VerificationRow& row, std::string const& text) { row.note += (row.note.empty() ? "" : "; ") + text; }

// What is expected to fall short must not pass unnoticed: then the expectation is out of date.
void judge(VerificationRow& row, Check const& c, bool good) {
  row.verdict = good ? "passes" : "falls short";
  row.accepted = good;
  if (!c.expected_to_fall_short) return;
  row.verdict += good ? ", contrary to expectation" : ", as expected";
  row.accepted = !good;
}

bool completed(nlohmann::json const& summary) { return summary.at("status") == "completed"; }

/// The number that a check looks at, with its unit; notes in the row why there is none.
std::optional<std::pair<double, std::string>> measured_by(Check const& c, nlohmann::json const& summary,
                                                          nlohmann::json const& other, VerificationRow& row) {
  auto const found = look_up(summary, c.quantity);
  if (!found) add_note(row, "summary.json has no such quantity");
  if (!found || c.as == Check::As::value) return found;
  auto const beside = look_up(other, c.quantity);
  if (!beside) {
    add_note(row, fmt::format("summary.json of {} has no such quantity", c.relative_to));
    return std::nullopt;
  }
  double const quotient = found->first / beside->first;
  double const value = c.as == Check::As::ratio ? quotient : -std::log(quotient) / std::log(c.refinement);
  if (std::isfinite(value)) return std::pair{value, std::string("1")};
  add_note(row, fmt::format("{} and {} cannot be compared", number_text(found->first), number_text(beside->first)));
  return std::nullopt;
}

/// A run with its summary read; null if it left none.
struct ReadRun {
  VariantRun const* run;
  nlohmann::json summary;
};

VerificationRow compare_one(std::string const& case_name, Check const& c, ReadRun const& read, ReadRun const& other) {
  VerificationRow row = row_of(case_name, c);
  for (ReadRun const* each : {&read, &other}) {
    if (!each->summary.is_null()) continue;
    add_note(row, each->run->problem);
    return row;
  }
  auto const found = measured_by(c, read.summary, other.summary, row);
  if (found) {
    row.measured = found->first;
    row.unit = found->second;
    Quantity const reference = read_quantity(c.reference, row.unit);
    row.reference = reference.value;
    if (reference.problem) {
      add_note(row, *reference.problem);
      return row;
    }
  }
  bool const complete = completed(read.summary) && completed(other.summary);
  if (!complete) add_note(row, "the run did not complete");
  for (ReadRun const* each : {&read, &other}) {
    std::string const& problem = each->run->problem;
    if (!problem.empty()) add_note(row, problem.substr(0, problem.find('\n')));
    if (&read == &other) break;
  }
  // A quantity that a completed run does not have is a slip, not a claim that is missed.
  if (found || !complete) judge(row, c, found && complete && holds(c, *row.measured, row.reference));
  return row;
}

/// Tells how far a verification is: how much work each run is, and how much of all is done.
class Watch : public Listener {
 public:
  Watch(Announce const& announce, std::vector<double> work)
      : announce_(announce), work_(std::move(work)), begin_(std::chrono::steady_clock::now()) {}

  void start(std::string const& case_name, std::string const& variant) {
    if (at_.number > 0 && at_.number <= work_.size()) done_ += work_[at_.number - 1];
    at_ = {.case_name = case_name, .variant = variant, .number = at_.number + 1, .count = work_.size()};
    tell(0);
  }
  void progress(Progress const& progress) override { tell(progress.moment.time / progress.end); }

 private:
  void tell(double share) {
    if (!announce_) return;
    at_.share = share;
    double const done = done_ + share * work_[at_.number - 1];
    double const all = std::accumulate(work_.begin(), work_.end(), 0.0);
    double const elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    at_.seconds_left = done > 0 ? std::optional(elapsed * (all - done) / done) : std::nullopt;
    announce_(at_);
  }

  Announce const& announce_;
  std::vector<double> work_;
  std::chrono::steady_clock::time_point begin_;
  VerifyProgress at_{.case_name = {}, .variant = {}, .number = 0, .count = 0, .share = 0, .seconds_left = {}};
  double done_ = 0;
};

VariantRun run_variant(fs::path const& case_file, CheckVariant const& variant, fs::path const& out,
                       Prepare const& prepare, Listener& listener, std::atomic<int> const& stop) {
  VariantRun run{.variant = variant.name};
  try {
    Simulation simulation = prepare(case_file, variant.set);
    run.title = simulation.spec.title;
    CaseOutcome const outcome = run_case(simulation, {.folder = out, .resume = false, .force = true}, listener, stop);
    run.wall_seconds = outcome.summary.wall_seconds;
    run.picture = outcome.last_picture;
    run.summary = to_json(outcome.summary);
    run.problem = outcome.failure;
  } catch (std::runtime_error const& error) {  // one case that cannot run must not hide the others
    run.problem = error.what();
  }
  return run;
}

/// A case with the variants that are to run.
struct Plan {
  std::string name;
  fs::path file;
  std::vector<CheckVariant> variants;
  std::vector<Check> checks;
};

bool looks_at(Check const& c, std::string const& variant) {
  return c.variant == variant || (c.as != Check::As::value && c.relative_to == variant);
}

Plan plan_of(fs::path const& folder, VerifyOptions const& options) {
  CheckFile const file = read_checks(folder / "checks.toml");
  Plan plan{folder.lexically_relative(options.cases).generic_string(), folder / "case.toml", {}, file.checks};
  for (CheckVariant const& variant : file.variants) {
    bool const used =
        std::any_of(file.checks.begin(), file.checks.end(), [&](Check const& c) { return looks_at(c, variant.name); });
    if (used && (variant.is_short || !options.short_only)) plan.variants.push_back(variant);
  }
  return plan;
}

double work_of(Plan const& plan, CheckVariant const& variant, Weigh const& weigh) {
  if (!weigh) return 1;
  try {
    return weigh(plan.file, variant.set);
  } catch (std::runtime_error const&) {  // the run itself will say what is wrong
    return 0;
  }
}

}  // namespace

std::vector<VerificationRow> compare(std::string const& case_name, std::vector<Check> const& checks,
                                     std::vector<VariantRun> const& runs) {
  std::vector<ReadRun> read;
  for (VariantRun const& run : runs)
    read.push_back({&run, run.summary.empty() ? nlohmann::json() : nlohmann::json::parse(run.summary)});
  auto const run_of = [&](std::string const& variant) {
    return std::find_if(read.begin(), read.end(), [&](ReadRun const& each) { return each.run->variant == variant; });
  };
  std::vector<VerificationRow> rows;
  for (ReadRun const& run : read) {
    for (Check const& c : checks) {
      if (c.variant != run.run->variant) continue;
      auto const other = run_of(c.as == Check::As::value ? c.variant : c.relative_to);
      if (other != read.end()) rows.push_back(compare_one(case_name, c, run, *other));
    }
  }
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

std::vector<CaseVerification> verify(VerifyOptions const& options, Prepare const& prepare, Announce const& announce,
                                     std::atomic<int> const& stop) {
  std::vector<Plan> plans;
  std::vector<double> work;
  for (fs::path const& folder : find_cases(options.cases, options.names)) {
    plans.push_back(plan_of(folder, options));
    for (CheckVariant const& variant : plans.back().variants)
      work.push_back(work_of(plans.back(), variant, options.weigh));
  }
  Watch watch(announce, std::move(work));
  std::vector<CaseVerification> cases;
  for (Plan const& plan : plans) {
    if (plan.variants.empty()) continue;
    CaseVerification& result = cases.emplace_back(CaseVerification{plan.name, {}, {}});
    for (CheckVariant const& variant : plan.variants) {
      if (stop.load() != 0) break;
      watch.start(plan.name, variant.name);
      result.runs.push_back(
          run_variant(plan.file, variant, options.out / plan.name / variant.name, prepare, watch, stop));
    }
    result.rows = compare(plan.name, plan.checks, result.runs);
    if (stop.load() != 0) break;
  }
  return cases;
}

}  // namespace piola
