// SPDX-License-Identifier: Apache-2.0
#include "piola/verification/verify.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/expression.hpp"
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
  if (c.kind == Check::Kind::between) return "to " + c.upper;
  std::string const amount =
      c.relative ? fmt::format("{} %", number_text(100 * c.tolerance)) : number_text(c.tolerance);
  switch (c.kind) {
    case Check::Kind::below: return c.tolerance > 0 ? fmt::format("below, +{}", amount) : "below";
    case Check::Kind::above: return c.tolerance > 0 ? fmt::format("above, -{}", amount) : "above";
    default: return fmt::format("within {}", amount);
  }
}

bool holds(Check const& c, double measured, double reference, double upper) {
  double const allowed = c.relative ? c.tolerance * std::abs(reference) : c.tolerance;
  switch (c.kind) {
    case Check::Kind::below: return measured <= reference + allowed;
    case Check::Kind::above: return measured >= reference - allowed;
    case Check::Kind::between: return measured >= reference && measured <= upper;
    default: return std::abs(measured - reference) <= allowed;
  }
}

std::string quantity_label(Check const& c) {
  if (c.as == Check::Comparison::field_error) {
    std::string const where = c.where.empty() ? "" : " where " + c.where;
    std::string const by = c.beside.empty() ? "" : ", by that of " + c.beside;
    return fmt::format("{} at {}{}, error against {}{}", c.field, quantity_text(c.time, "s"), where, c.relative_to, by);
  }
  if (c.as == Check::Comparison::ratio) return c.quantity + ", ratio to " + c.relative_to;
  if (c.as == Check::Comparison::order) return c.quantity + ", order from " + c.relative_to;
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
                      .note = c.note,
                      .evidence = evidence_word(c.evidence)};
  return row;
}

void add_note(VerificationRow& row, std::string const& text) { row.note += (row.note.empty() ? "" : "; ") + text; }

// A check that is expected to fall short must not pass unnoticed: the expectation is then out of date.
void judge(VerificationRow& row, Check const& c, bool good) {
  row.verdict = good ? "passes" : "falls short";
  row.accepted = good;
  if (!c.expected_to_fall_short) return;
  row.verdict += good ? ", contrary to expectation" : ", as expected";
  row.accepted = !good;
}

bool completed(nlohmann::json const& summary) { return summary.at("status") == "completed"; }

/// A run with its summary read; null if it left none.
struct ReadRun {
  VariantRun const* run;
  nlohmann::json summary;
};

FieldSample const* sample_of(VariantRun const& run, Check const& c, VerificationRow& row) {
  for (FieldSample const& sample : run.samples) {
    if (sample.field == c.field && sample.time == c.time) return &sample;
  }
  add_note(row, fmt::format("{} has no {} at {}", run.variant, c.field, quantity_text(c.time, "s")));
  return nullptr;
}

/// The error of the field in one variant against that of another.
std::optional<double> error_of(Check const& c, VariantRun const& run, VariantRun const& reference,
                               VerificationRow& row) {
  FieldSample const *const f = sample_of(run, c, row), *const r = sample_of(reference, c, row);
  if (f == nullptr || r == nullptr) return std::nullopt;
  auto const where = c.where.empty() ? std::nullopt : std::optional(Expression(c.where));
  auto const value = relative_difference(*f, *r, where ? &*where : nullptr);
  if (!value)
    add_note(row, fmt::format("{} of {} and of {} cannot be compared", c.field, run.variant, reference.variant));
  return value;
}

std::optional<std::pair<double, std::string>> field_error(Check const& c, std::vector<ReadRun const*> const& runs,
                                                          VerificationRow& row) {
  auto value = error_of(c, *runs[0]->run, *runs[1]->run, row);
  auto const by = c.beside.empty() ? std::optional(1.0) : error_of(c, *runs[2]->run, *runs[1]->run, row);
  if (!value || !by) return std::nullopt;
  *value /= *by;
  if (std::isfinite(*value)) return std::pair{*value, std::string("1")};
  add_note(row, fmt::format("{} has no error to divide by", c.beside));
  return std::nullopt;
}

/// The value of a check, with its unit; stores the reason in the row if there is none.
std::optional<std::pair<double, std::string>> measured_by(Check const& c, std::vector<ReadRun const*> const& runs,
                                                          VerificationRow& row) {
  if (c.as == Check::Comparison::field_error) return field_error(c, runs, row);
  auto found = look_up(runs[0]->summary, c.quantity);
  if (!found) add_note(row, "summary.json has no such quantity");
  if (!found || c.as == Check::Comparison::value) return found;
  auto const other = look_up(runs[1]->summary, c.quantity);
  if (!other) {
    add_note(row, fmt::format("summary.json of {} has no such quantity", c.relative_to));
    return std::nullopt;
  }
  double const quotient = found->first / other->first;
  double const value = c.as == Check::Comparison::ratio ? quotient : -std::log(quotient) / std::log(c.refinement);
  if (std::isfinite(value)) return std::pair{value, std::string("1")};
  add_note(row, fmt::format("{} and {} cannot be compared", number_text(found->first), number_text(other->first)));
  return std::nullopt;
}

/// Judges one check; `runs` are that of the check and those that it is compared with.
VerificationRow compare_one(std::string const& case_name, Check const& c, std::vector<ReadRun const*> const& runs) {
  VerificationRow row = row_of(case_name, c);
  for (ReadRun const* each : runs) {
    if (!each->summary.is_null()) continue;
    add_note(row, each->run->problem);
    return row;
  }
  auto const found = measured_by(c, runs, row);
  double upper = 0;
  if (found) {
    row.measured = found->first;
    row.unit = found->second;
    Quantity const reference = read_quantity(c.reference, row.unit);
    row.reference = reference.value;
    Quantity const high = c.kind == Check::Kind::between ? read_quantity(c.upper, row.unit) : Quantity{};
    upper = high.value;
    for (auto const& problem : {reference.problem, high.problem}) {
      if (!problem) continue;
      add_note(row, *problem);
      return row;
    }
  }
  bool complete = true;
  for (ReadRun const* each : runs) complete = complete && completed(each->summary);
  if (!complete) add_note(row, "the run did not complete");
  for (ReadRun const* each : runs) {
    std::string const& problem = each->run->problem;
    if (!problem.empty()) add_note(row, problem.substr(0, problem.find('\n')));
  }
  // A quantity that a completed run does not have is a slip, not a claim that is missed.
  if (found || !complete) judge(row, c, found && complete && holds(c, *row.measured, row.reference, upper));
  return row;
}

/// Names of the variants that a check needs, its own first.
std::vector<std::string> involved(Check const& c) {
  std::vector<std::string> names{c.variant};
  if (c.as != Check::Comparison::value) names.push_back(c.relative_to);
  if (!c.beside.empty()) names.push_back(c.beside);
  return names;
}

/// Tells how far a verification is: how much work each run is, and how much of all is done.
class VariantListener : public Listener {
 public:
  VariantListener(Announce const& announce, std::vector<double> work)
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
                       std::vector<FieldSampler::SampleRequest> sample_requests, Prepare const& prepare,
                       Listener& listener, std::atomic<int> const& stop) {
  VariantRun run{.variant = variant.name};
  try {
    Simulation simulation = prepare(case_file, variant.set);
    run.title = simulation.spec.title;
    FieldSampler sampler(std::move(sample_requests), simulation.particles);
    CaseOutcome const outcome =
        run_case(simulation, {.folder = out, .resume = false, .force = true, .also = &sampler}, listener, stop);
    run.samples = sampler.samples();
    run.wall_seconds = outcome.summary.wall_seconds;
    run.picture = outcome.last_picture;
    run.summary = to_json(outcome.summary);
    run.problem = outcome.failure;
  } catch (std::runtime_error const& error) {  // one case that cannot run must not hide other results
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
  auto const names = involved(c);
  return std::find(names.begin(), names.end(), variant) != names.end();
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

/// The fields that checks of a variant need.
std::vector<FieldSampler::SampleRequest> sample_requests_of(std::vector<Check> const& checks,
                                                            std::string const& variant) {
  std::vector<FieldSampler::SampleRequest> requests;
  for (Check const& c : checks) {
    FieldSampler::SampleRequest const request{c.field, c.time};
    bool const known = std::find(requests.begin(), requests.end(), request) != requests.end();
    if (c.as == Check::Comparison::field_error && looks_at(c, variant) && !known) requests.push_back(request);
  }
  return requests;
}

/// Reads all files of checks before anything runs. Throws InputError with the problems of all of them.
std::vector<Plan> all_plans(VerifyOptions const& options) {
  std::vector<Plan> plans;
  std::string problems;
  for (fs::path const& folder : find_cases(options.cases, options.names)) {
    try {
      plans.push_back(plan_of(folder, options));
    } catch (InputError const& error) {
      problems += (problems.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return plans;
}

double work_of(Plan const& plan, CheckVariant const& variant, Weigh const& weigh) {
  if (!weigh) return 1;
  try {
    return weigh(plan.file, variant.set);
  } catch (std::runtime_error const&) {  // the run itself reports the error
    return 0;
  }
}

}  // namespace

std::vector<VerificationRow> compare(std::string const& case_name, std::vector<Check> const& checks,
                                     std::vector<VariantRun> const& runs) {
  std::vector<ReadRun> read;
  read.reserve(runs.size());
  for (VariantRun const& run : runs)
    read.push_back({&run, run.summary.empty() ? nlohmann::json() : nlohmann::json::parse(run.summary)});
  auto const run_of = [&](std::string const& variant) {
    return std::find_if(read.begin(), read.end(), [&](ReadRun const& each) { return each.run->variant == variant; });
  };
  std::vector<VerificationRow> rows;
  for (ReadRun const& run : read) {
    for (Check const& c : checks) {
      if (c.variant != run.run->variant) continue;
      std::vector<ReadRun const*> runs_of_check;
      for (std::string const& name : involved(c)) {
        if (auto const found = run_of(name); found != read.end()) runs_of_check.push_back(&*found);
      }
      if (runs_of_check.size() == involved(c).size()) rows.push_back(compare_one(case_name, c, runs_of_check));
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
  known.reserve(all.size());
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
  PIOLA_EXPECTS(prepare != nullptr);
  std::vector<Plan> const plans = all_plans(options);
  std::vector<double> work;
  for (Plan const& plan : plans)
    for (CheckVariant const& variant : plan.variants) work.push_back(work_of(plan, variant, options.weigh));
  VariantListener watch(announce, std::move(work));
  std::vector<CaseVerification> cases;
  for (Plan const& plan : plans) {
    if (plan.variants.empty()) continue;
    CaseVerification& result = cases.emplace_back(CaseVerification{plan.name, {}, {}});
    for (CheckVariant const& variant : plan.variants) {
      if (stop.load() != 0) break;
      watch.start(plan.name, variant.name);
      result.runs.push_back(run_variant(plan.file, variant, options.out / plan.name / folder_of(variant.name),
                                        sample_requests_of(plan.checks, variant.name), prepare, watch, stop));
    }
    result.rows = compare(plan.name, plan.checks, result.runs);
    if (stop.load() != 0) break;
  }
  return cases;
}

}  // namespace piola
